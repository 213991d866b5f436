//! The threads that the core works on, made once in each process: those of the process that it was forked from are not there.

use crate::errors::input_error;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use std::thread::available_parallelism;

/// Threads for a core at most: more only get in each other's way.
const MOST_FOR_A_CORE: usize = 4;

/// Where work is to run.
pub struct Threads(Option<Arc<ThreadPool>>);

/// The pools of this process, and of those that it was forked from, by process and number of threads.
///
/// Looked at only with the interpreter's lock held and for as long as nothing lets go of it, so no process is forked meanwhile.
#[derive(Default)]
struct Pools {
    made: HashMap<(u32, usize), Arc<ThreadPool>>,
    /// The process whose pool is rayon's own.
    home: Option<u32>,
}

static POOLS: LazyLock<Mutex<Pools>> = LazyLock::new(Mutex::default);

impl Threads {
    /// So many threads; by default `RAYON_NUM_THREADS`, or one a core.
    pub fn get(py: Python<'_>, threads: Option<usize>) -> PyResult<Self> {
        let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
        let process = std::process::id();
        if threads.is_none() && pools.home == Some(process) {
            return Ok(Self(None));
        }
        // The system reads files to tell, which takes longer than a small call.
        let cores = available_parallelism().map_or(1, usize::from);
        let count = threads.or_else(wanted).unwrap_or(cores).min(MOST_FOR_A_CORE * cores.max(4));
        pools.pool(process, count, threads.is_none()).map(Self).map_err(|error| {
            let message = format!("the system does not give {count} threads ({error}): pass fewer");
            input_error(py, message)
        })
    }

    /// Do `work` on them.
    pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match &self.0 {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}

impl Pools {
    /// A pool of `count` threads for `process`, which has none by default; none where rayon's own serves, as it does in one process.
    fn pool(
        &mut self,
        process: u32,
        count: usize,
        is_default: bool,
    ) -> Result<Option<Arc<ThreadPool>>, rayon::ThreadPoolBuildError> {
        let builder = || ThreadPoolBuilder::new().num_threads(count);
        if is_default && self.home.is_none() {
            builder().build_global()?;
            self.home = Some(process);
            return Ok(None);
        }
        if let Some(pool) = self.made.get(&(process, count)) {
            return Ok(Some(Arc::clone(pool)));
        }
        let pool = Arc::new(builder().build()?);
        self.made.insert((process, count), Arc::clone(&pool));
        Ok(Some(pool))
    }
}

/// The number that the environment asks for.
fn wanted() -> Option<usize> {
    std::env::var("RAYON_NUM_THREADS").ok()?.parse().ok().filter(|&threads| threads > 0)
}

/// Do `work`, which is short, off the interpreter's lock, on so many threads.
pub fn aside<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let threads = Threads::get(py, threads)?;
    Ok(py.detach(|| threads.run(work)))
}
