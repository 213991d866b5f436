//! The ridge of noisy points: where, across the curve that they suggest, they are densest.
//!
//! U. Ozertem and D. Erdogmus, "Locally Defined Principal Curves and Surfaces", Journal of Machine Learning Research 12 (2011):
//! a point is on the ridge if the mean of what a window sees lies along the curve from it. Every point moves there across the
//! principal direction of its window. The ridge has the order that the points have lost.

mod cloud;
mod scale;

use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::point::Point;
use crate::progress::{Progress, Stage};
use cloud::{Cloud, Eye, Moments};
pub use scale::Scale;

/// The widths of the windows in deviations of the noise: where even narrow ones see many points, strands stay apart.
const WIDTHS: [f64; 2] = [1.0, 1.5];
/// Points that a narrow window has at least.
const MANY: f64 = 20.0;
/// The noise beside the first window below which points stay where they are.
const STILL: f64 = 0.05;
/// Moves over the points as they are, and over the points as they have moved.
const MOVES: [usize; 2] = [5, 3];
/// The distance between points of the ridge, in windows.
const GAP: f64 = 0.7;
/// The weight beside that of the neighbors below which a point is not on the ridge but on its way.
const FAINT: f64 = 0.4;

/// Points between two looks at whether to stop, where one after another takes little.
const SELDOM: usize = 1 << 14;

/// A point of the ridge.
#[derive(Debug, Clone, Copy)]
pub struct Crest {
    /// The vertex that moved there.
    pub vertex: u32,
    /// Where it is.
    pub at: Point,
}

/// The scales of all vertices, and the ridge.
#[derive(Debug, Default)]
pub struct Ridge {
    /// The scale at each vertex.
    pub scales: Vec<Scale>,
    /// Points of the ridge, so far apart that their order is plain.
    pub crests: Vec<Crest>,
}

/// The ridge of the vertices of `delaunay`, whose noise is `noise` if that is known.
///
/// Does not depend on the order of the rows or the number of threads. O(n log n) where windows hold few points.
///
/// # Errors
/// A cancelled `progress`.
pub fn ridge(delaunay: &Delaunay, noise: Option<&[f64]>, progress: &Progress) -> Result<Ridge> {
    let count = delaunay.points().len();
    progress.enter(Stage::Measure, count)?;
    let quiet = progress.quiet();
    let cloud = Cloud::new(delaunay.points(), &quiet);
    let mut scales = scale::scales(delaunay, &cloud)?;
    if let Some(noise) = noise {
        scales.iter_mut().zip(noise).for_each(|(scale, &noise)| scale.noise = noise);
    }
    progress.advance(count / 3)?;
    let widths = cloud.each(count, |eye, v| width(eye, delaunay.points()[v], &scales[v]))?;
    let mut at = delaunay.points().to_vec();
    for _ in 0..MOVES[0] {
        at = cloud.each(count, |eye, v| moved(eye, at[v], widths[v]))?;
        progress.advance(count / 12)?;
    }
    for _ in 0..MOVES[1] {
        let cloud = Cloud::new(&at, &quiet);
        at = cloud.each(count, |eye, v| moved(eye, at[v], widths[v]))?;
        progress.advance(count / 12)?;
    }
    let crests = crests(&at, &widths, &quiet)?;
    Ok(Ridge { scales, crests })
}

/// The width of the window at a vertex: 0 if it is to stay, not a number if there is no curve.
fn width(eye: &mut Eye<'_>, at: Point, scale: &Scale) -> f64 {
    if scale.noise < STILL * scale.first {
        return 0.0;
    }
    let [narrow, wide] = WIDTHS.map(|factor| factor * scale.noise);
    if narrow > scale.first && eye.moments(at, narrow).count >= MANY {
        return narrow;
    }
    if scale.noise.is_nan() { f64::NAN } else { scale.first.max(wide) }
}

/// Where a point at `at` moves: across the principal direction, to the mean.
fn moved(eye: &mut Eye<'_>, at: Point, width: f64) -> Point {
    if width.is_nan() || width == 0.0 {
        return at;
    }
    let Moments { mean, tangent: [tx, ty], .. } = eye.moments(at, width);
    let across = mean[1] * tx - mean[0] * ty;
    [at[0] - across * ty, at[1] + across * tx]
}

/// Points that are on the ridge, one for each gap.
fn crests(at: &[Point], widths: &[f64], progress: &Progress) -> Result<Vec<Crest>> {
    let cloud = Cloud::new(at, progress);
    let weights = cloud.each(at.len(), |eye, v| {
        if widths[v] > 0.0 { eye.moments(at[v], widths[v]).weight } else { 0.0 }
    })?;
    let is_bright = cloud.each(at.len(), |eye, v| {
        let mut around = Vec::new();
        eye.near(at[v], 2.0 * widths[v].max(0.0), |k, _, _| around.push(weights[k as usize]));
        let middle = around.len() / 2;
        let usual = *around.select_nth_unstable_by(middle, f64::total_cmp).1;
        widths[v] == 0.0 || weights[v] >= FAINT * usual && widths[v] > 0.0
    })?;
    let mut eye = cloud.eye();
    let mut is_covered = vec![false; at.len()];
    let mut crests = Vec::new();
    for v in 0..at.len() {
        if v % SELDOM == 0 {
            progress.advance(0)?;
        }
        if is_bright[v] && !is_covered[v] {
            crests.push(Crest { vertex: v as u32, at: at[v] });
            eye.near(at[v], GAP * widths[v], |k, _, _| is_covered[k as usize] = true);
        }
    }
    Ok(crests)
}
