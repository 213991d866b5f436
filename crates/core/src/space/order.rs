//! The order in which vertices are kept: distinct points along the Z-order curve.
//!
//! A run of codes that share their leading bits is a cell of a quadtree, so the next bit splits it by
//! a vertical or a horizontal line; `divide` cuts there. G. M. Morton, "A computer oriented geodetic
//! data base", IBM, 1966.

use crate::error::{Error, Result};
use crate::parts::{self, GRAIN, split, try_each};
use crate::point::{Point, lexicographic};
use crate::progress::{Progress, Stage};
use crate::space::bounds::Bounds;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Points in one bucket of the first pass of the sort, about.
const BUCKET: usize = 64;
/// The most buckets that one pass can scatter to without thrashing the address translation.
const MOST_BUCKETS: usize = 1 << 12;
/// Buckets that one task sorts.
const BUCKETS: usize = 16;

/// Distinct points along the Z-order curve, and where they came from.
#[derive(Debug)]
pub struct Order {
    /// The distinct points, scaled by `scale`.
    pub points: Vec<Point>,
    /// The first row with these coordinates, a vertex each.
    pub rows: Vec<u32>,
    /// What gives the codes that the points are sorted by; equal codes are sorted by x, then y.
    pub grid: Grid,
    /// Row, and the first row with the same coordinates; sorted.
    pub duplicates: Vec<[u32; 2]>,
    /// The power of two that coordinates were multiplied by.
    pub scale: f64,
    /// What the keys were in, two of them for each point, to be used again: to have memory costs as much as to sort in it.
    pub memory: Vec<Key>,
}

/// The code of a point, lower half first, and its row.
pub type Key = [u32; 3];

#[inline]
fn code([low, high, _]: &Key) -> u64 {
    u64::from(*high) << u32::BITS | u64::from(*low)
}

/// Sort `points` along the Z-order curve and set repeated ones aside.
///
/// # Errors
/// Coordinates too far apart in size, or a cancelled `progress`.
pub fn order(points: &[Point], progress: &Progress) -> Result<Order> {
    progress.enter(Stage::Sort, 2 * points.len())?;
    let bounds = Bounds::of(points);
    let scale = scale(bounds.largest());
    if scale != 1.0 {
        check_scaling(points, scale, bounds.largest())?;
    }
    let grid = Grid::around(&bounds, scale);
    let mut memory = keys(points, &grid, scale, progress)?;
    let (unsorted, keys) = memory.split_at_mut(points.len());
    let is_tied = sort(unsorted, keys, points, progress)?;
    let duplicates = if is_tied { set_duplicates_aside(keys, points) } else { Vec::new() };
    let keys = &keys[..points.len() - duplicates.len()];
    Ok(Order {
        points: parts::collect(keys, |&[.., row]| points[row as usize].map(|x| x * scale)),
        rows: parts::collect(keys, |&[.., row]| row),
        grid,
        duplicates,
        scale,
        memory,
    })
}

/// A power of two that brings the coordinates to where no product of the filters overflows.
fn scale(largest: f64) -> f64 {
    if largest == 0.0 || !largest.is_finite() || (1e-20..1e20).contains(&largest) {
        return 1.0;
    }
    // Two steps: 2^1074, which brings up the smallest denormal, is not itself a double.
    2f64.powi(-largest.log2().floor().max(-1000.0) as i32)
}

/// Scaling by a power of two is exact unless it underflows; find the first row where it does.
fn check_scaling(points: &[Point], scale: f64, largest: f64) -> Result<()> {
    let inexact = |x: &f64| (x * scale) / scale != *x;
    match points.iter().position(|p| p.iter().any(inexact)) {
        None => Ok(()),
        Some(row) => {
            let value = *points[row].iter().find(|x| inexact(x)).expect("the row has one");
            Err(Error::Range { row, value, largest })
        }
    }
}

/// The cells that coordinates are quantized to, 2³² along the longer side of all points.
///
/// The quantization is monotone in x and in y, which is all that the cuts of `divide` ask for: different codes in x mean that the x
/// are different, and in the same order.
#[derive(Debug)]
pub struct Grid {
    low: Point,
    /// Cells a unit of length.
    cells: f64,
}

impl Grid {
    fn around(bounds: &Bounds, scale: f64) -> Self {
        let low = bounds.low.map(|x| x * scale);
        let high = bounds.high.map(|x| x * scale);
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        let cells = if extent > 0.0 { (f64::from(u32::MAX) / extent).min(f64::MAX) } else { 0.0 };
        Self { low, cells }
    }

    /// The Z-order code of `point`, which is scaled.
    #[inline]
    pub fn code(&self, point: Point) -> u64 {
        let [x, y] = [0, 1].map(|axis| ((point[axis] - self.low[axis]) * self.cells) as u32);
        spread(x) << 1 | spread(y)
    }
}

/// Put a zero bit before each bit of `x`.
fn spread(x: u32) -> u64 {
    let mut x = u64::from(x);
    for (shift, mask) in [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ] {
        x = (x | x << shift) & mask;
    }
    x
}

/// The keys of all points, and room for them once more.
fn keys(points: &[Point], grid: &Grid, scale: f64, progress: &Progress) -> Result<Vec<Key>> {
    let key = |row: usize| {
        if !progress.goes_on() {
            return [0; 3];
        }
        let code = grid.code(points[row].map(|x| x * scale));
        [code as u32, (code >> u32::BITS) as u32, row as u32]
    };
    let mut keys = Vec::with_capacity(2 * points.len());
    parts::extend(&mut keys, points.len(), key);
    parts::extend(&mut keys, points.len(), |_| [0; 3]);
    progress.advance(points.len())?;
    Ok(keys)
}

/// Move the keys `unsorted` to `keys`, by code; equal ones by x, y, then row. Are there equal ones?
///
/// One pass into buckets by the leading bits, then each bucket by comparison.
fn sort(unsorted: &[Key], keys: &mut [Key], points: &[Point], progress: &Progress) -> Result<bool> {
    let buckets = (points.len() / BUCKET).next_power_of_two().min(MOST_BUCKETS);
    // Of a single one this is not asked.
    let bucket = |key: &Key| (code(key) >> (64 - buckets.trailing_zeros())) as usize;
    let parts: Vec<&[Key]> = unsorted.chunks(GRAIN).collect();
    let counts = parts::scatter_to(keys, &parts, buckets, bucket);
    progress.advance(0)?;
    let tied = AtomicBool::new(false);
    let parts = split(keys, counts.chunks(BUCKETS).map(|counts| counts.iter().sum()));
    try_each(parts.into_iter().zip(counts.chunks(BUCKETS)).collect(), |_, (part, counts)| {
        for bucket in split(part, counts.iter().copied()) {
            bucket.sort_unstable_by_key(code);
        }
        if sort_runs(part, points) {
            tied.store(true, Relaxed);
        }
        progress.advance(part.len())
    })?;
    Ok(tied.into_inner())
}

/// Sort each run of equal codes by x, y, then row. Is there any?
fn sort_runs(keys: &mut [Key], points: &[Point]) -> bool {
    let mut is_tied = false;
    let at = |&[.., row]: &Key| &points[row as usize];
    for run in keys.chunk_by_mut(|a, b| code(a) == code(b)).filter(|run| run.len() > 1) {
        run.sort_unstable_by(|a, b| lexicographic(at(a), at(b)).then(a[2].cmp(&b[2])));
        is_tied = true;
    }
    is_tied
}

/// Move the first row of each run of equal points to the front; return the others with that first row, sorted.
fn set_duplicates_aside(keys: &mut [Key], points: &[Point]) -> Vec<[u32; 2]> {
    let mut duplicates = Vec::new();
    let mut count = 1;
    for k in 1..keys.len() {
        let ([.., first], [.., row]) = (keys[count - 1], keys[k]);
        if points[row as usize] == points[first as usize] {
            duplicates.push([row, first]);
        } else {
            keys[count] = keys[k];
            count += 1;
        }
    }
    duplicates.sort_unstable();
    duplicates
}
