//! Watching and stopping a long call from another thread, without a callback inside the core.

use crate::error::{Error, Result};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

/// The stages of a call, in the order in which they run.
pub const STAGES: [&str; 9] =
    ["sort", "triangulate", "stars", "select", "trace", "nest", "axis", "interpolate", "measure"];

/// How many points a loop may pass between two looks at whether to stop: some milliseconds.
pub const PACE: usize = 1 << 19;

/// A stage of a call, as an index into [`STAGES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub enum Stage {
    /// Sorting the points along the space-filling curve.
    Sort,
    /// Dividing and conquering.
    Triangulate,
    /// Collecting the star of neighbors of each vertex.
    Stars,
    /// Deciding edges.
    Select,
    /// Joining edges into curves.
    Trace,
    /// Nesting rings.
    Nest,
    /// Collecting the medial axis of samples.
    Axis,
    /// Fitting the smooth interpolant, and finding its axis.
    Interpolate,
    /// Measuring edges and points for a certificate.
    Measure,
}

/// The state of a running call: shared by reference, written by the workers, read by the caller.
#[derive(Debug, Default)]
pub struct Progress {
    cancelled: Arc<AtomicBool>,
    stage: AtomicUsize,
    done: AtomicUsize,
    total: AtomicUsize,
    #[cfg(test)]
    pub(crate) looks: Arc<looks_tests::Looks>,
}

impl Progress {
    /// Ask the call to stop; it returns [`Error::Cancelled`] soon after.
    pub fn cancel(&self) {
        self.cancelled.store(true, Relaxed);
    }

    /// The progress of a part of the call: it stops with the whole, and what it reports is not shown.
    #[must_use]
    pub fn quiet(&self) -> Self {
        Self {
            cancelled: Arc::clone(&self.cancelled),
            #[cfg(test)]
            looks: Arc::clone(&self.looks),
            ..Self::default()
        }
    }

    /// The current stage's name and the fraction of it that is done.
    #[must_use]
    pub fn state(&self) -> (&'static str, f64) {
        let total = self.total.load(Relaxed).max(1);
        let fraction = self.done.load(Relaxed) as f64 / total as f64;
        (STAGES[self.stage.load(Relaxed)], fraction.min(1.0))
    }

    /// Enter a stage of `total` units of work.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the caller asked to stop.
    #[cfg_attr(test, track_caller)]
    pub fn enter(&self, stage: Stage, total: usize) -> Result<()> {
        self.done.store(0, Relaxed);
        self.total.store(total, Relaxed);
        self.stage.store(stage as usize, Relaxed);
        self.advance(0)
    }

    /// Did the caller ask to stop?
    #[inline]
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Relaxed)
    }

    /// Did no one ask to stop? For loops within a part, whose result is then of no use.
    #[cfg_attr(test, track_caller)]
    #[inline]
    #[must_use]
    pub fn goes_on(&self) -> bool {
        #[cfg(test)]
        self.looks.note();
        !self.is_cancelled()
    }

    /// Report `units` of work as done.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the caller asked to stop.
    #[cfg_attr(test, track_caller)]
    pub fn advance(&self, units: usize) -> Result<()> {
        #[cfg(test)]
        self.looks.note();
        self.done.fetch_add(units, Relaxed);
        if self.is_cancelled() { Err(Error::Cancelled) } else { Ok(()) }
    }
}

#[cfg(test)]
mod hub_tests;
#[cfg(test)]
mod looks_tests;
#[cfg(test)]
pub(crate) mod work_tests;
