//! Memory asked for before long work starts, because there is no way back from an allocation that fails within.

use crate::error::{Error, Result};
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Bytes that are not asked for: to ask the system takes as long as many a small call.
const LITTLE: usize = 1 << 20;

/// Is there memory for `bytes_each` of `count` items, all at one time?
///
/// # Errors
/// How much is needed, if there is not.
pub fn check(count: usize, bytes_each: usize) -> Result<()> {
    let bytes = count.saturating_mul(bytes_each);
    if bytes < LITTLE {
        return Ok(());
    }
    // Threads and what lies between allocations take some, too.
    let needed = bytes.saturating_add(bytes / 8);
    let mut room = Vec::<u8>::new();
    // Unless it is looked at, the compiler leaves such an allocation out.
    black_box(&mut room).try_reserve_exact(needed).map_err(|_| Error::Memory { needed })
}

/// A result that grows while it is made, on several threads.
#[derive(Debug, Default)]
pub struct Growing {
    count: AtomicUsize,
}

impl Growing {
    /// Items below which nothing is asked.
    const FEW: usize = 1 << 20;

    /// Is there memory to have all items once more, with `more` that came, at `bytes` each? Then they can be put in order.
    ///
    /// # Errors
    /// How much is needed, if there is not.
    pub fn add(&self, more: usize, bytes: usize) -> Result<()> {
        let count = self.count.fetch_add(more, Relaxed) + more;
        if count > Self::FEW { check(count, bytes) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_there_can_be_is_refused() {
        assert_eq!(check(1000, 16), Ok(()));
        let needed = (1 << 62) + (1 << 59);
        assert_eq!(check(1 << 31, 1 << 31), Err(Error::Memory { needed }));
        assert_eq!(Growing::default().add(1 << 31, 1 << 31), Err(Error::Memory { needed }));
        assert_eq!(check(usize::MAX, 2), Err(Error::Memory { needed: usize::MAX }));
    }
}
