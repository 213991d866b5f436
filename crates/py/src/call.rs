//! Calls of the core: off the interpreter lock, on a chosen number of threads, observable and interruptible.

use crate::errors::exception;
use crate::threads::Threads;
use crustline_core::{Progress, Result};
use pyo3::prelude::*;
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Points below which a call takes less time than it takes to start a thread that watches it.
const SMALL: usize = 1 << 13;
/// How often a long call looks for Ctrl-C and reports progress.
const TICK: Duration = Duration::from_millis(50);

/// How a call is to run.
pub struct Call {
    /// The number of points that it is about.
    pub size: usize,
    /// Threads; the default is rayon's: `RAYON_NUM_THREADS`, or one a core.
    pub threads: Option<usize>,
    /// Called with the name of a stage and the fraction of it that is done.
    pub callback: Option<Py<PyAny>>,
}

impl Call {
    /// Run `work` and give its result, or the exception for its error.
    pub fn run<T: Send>(
        self,
        py: Python<'_>,
        work: impl FnOnce(&Progress) -> Result<T> + Send,
    ) -> PyResult<T> {
        let progress = Progress::default();
        let result = if self.size < SMALL {
            let threads = Threads::get(py, None)?;
            py.detach(|| threads.run(|| work(&progress)))
        } else {
            self.watch(py, &progress, work)?
        };
        result.map_err(|error| exception(py, &error))
    }

    fn watch<T: Send>(
        self,
        py: Python<'_>,
        progress: &Progress,
        work: impl FnOnce(&Progress) -> Result<T> + Send,
    ) -> PyResult<Result<T>> {
        let threads = Threads::get(py, self.threads)?;
        let (sender, receiver) = channel();
        std::thread::scope(|scope| {
            let worker = scope.spawn(move || {
                let result = threads.run(|| work(progress));
                // The receiver waits in this scope, so it is there.
                let _ = sender.send(());
                result
            });
            // A worker that panics drops its sender, which ends the wait as well.
            let receiver = Mutex::new(receiver);
            let wait = || receiver.lock().expect("only this thread locks it").recv_timeout(TICK);
            while py.detach(wait) == Err(RecvTimeoutError::Timeout) {
                if let Err(error) = self.tick(py, progress) {
                    progress.cancel();
                    let _ = py.detach(|| worker.join());
                    return Err(error);
                }
            }
            match py.detach(|| worker.join()) {
                Ok(result) => Ok(result),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        })
    }

    fn tick(&self, py: Python<'_>, progress: &Progress) -> PyResult<()> {
        py.check_signals()?;
        if let Some(callback) = &self.callback {
            callback.call1(py, progress.state())?;
        }
        Ok(())
    }
}
