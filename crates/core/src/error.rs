//! What can go wrong in the core. Input is checked before it gets here, so the list is short.

use std::fmt;

/// An error of the core; its `Display` is the sentence that a user reads.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// More points than the 32-bit indices can name.
    TooManyPoints {
        /// How many points there were.
        count: usize,
        /// How many there may be.
        limit: usize,
    },
    /// The coordinates span more orders of magnitude than can be scaled exactly.
    Range {
        /// The first row at fault.
        row: usize,
        /// The coordinate that is too small beside `largest`.
        value: f64,
        /// The largest absolute coordinate of all points.
        largest: f64,
    },
    /// An argument outside of its domain.
    Argument {
        /// The sentence that says which, and what it may be.
        message: String,
    },
    /// There is less memory than the work needs.
    Memory {
        /// How many bytes it needs at one time.
        needed: usize,
    },
    /// The caller asked to stop.
    Cancelled,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyPoints { count, limit } => {
                write!(
                    f,
                    "{count} points are more than the {limit} that one triangulation can hold: split them into tiles"
                )
            }
            Self::Range { row, value, largest } => write!(
                f,
                "row {row}: the coordinate {value:e} is too small beside the largest, {largest:e}, to be scaled exactly: set it to 0 or remove the far points"
            ),
            Self::Argument { message } => f.write_str(message),
            Self::Memory { needed } => write!(
                f,
                "{:.1} MB of memory are needed at one time and not to be had: free some, or split the points into tiles",
                *needed as f64 / 1e6
            ),
            Self::Cancelled => f.write_str("the call was cancelled"),
        }
    }
}

impl std::error::Error for Error {}

/// The result of a call of the core.
pub type Result<T> = std::result::Result<T, Error>;
