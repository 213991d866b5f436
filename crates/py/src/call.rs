//! Calls of the core: off the interpreter lock, on a chosen number of threads, observable and interruptible.

use crate::errors::exception;
use crustline_core::{Progress, Result};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::HashMap;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, LazyLock, Mutex};
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
            py.detach(|| work(&progress))
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
        let pool = self.threads.map(pool);
        let (sender, receiver) = channel();
        std::thread::scope(|scope| {
            let worker = scope.spawn(move || {
                let result = match pool {
                    Some(pool) => pool.install(|| work(progress)),
                    None => work(progress),
                };
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

/// The pool of `threads` threads, made once: starting one takes longer than many a call.
fn pool(threads: usize) -> Arc<ThreadPool> {
    static POOLS: LazyLock<Mutex<HashMap<usize, Arc<ThreadPool>>>> = LazyLock::new(Mutex::default);
    let mut pools = POOLS.lock().expect("no thread panics while it holds the lock");
    let make = || {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        Arc::new(pool.expect("the system gives threads"))
    };
    Arc::clone(pools.entry(threads).or_insert_with(make))
}
