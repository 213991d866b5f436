//! How wide the noise is around each point, judged by the points.
//!
//! A straight curve under normal noise of deviation σ, seen through a Gaussian window of width h, has the variance h² along it
//! and σ²h² / (σ² + h²) across, so the quotient q of the two gives σ = h √(q / (1 − q)), whatever h is: as long as enough points
//! are in the window, and it is small beside the curve's radius and its distance from others. So the smallest window counts in
//! which the points look like a curve.

use super::cloud::{Cloud, Eye};
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::point::{Point, length, sub};

/// Points in the first window, about.
const FEW: usize = 8;
/// Points in a window from which on they are a cloud if they still do not look like a curve.
const MANY: f64 = 80.0;
/// The largest quotient of the variances that looks like a curve, in windows of few points and of many: few points often
/// are in line by chance.
const SLIM: [f64; 2] = [0.3, 0.42];
/// The factor from one window to the next, and how many there are at the most.
const STEP: f64 = std::f64::consts::SQRT_2;
const STEPS: i32 = 16;

/// The most neighbors of a point whose neighbors are near each other: those of a circle's center are not, though they are all its own.
const HUB: usize = 256;

/// The width of the noise, and of the windows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// The deviation of the noise; not a number where the points do not look like a curve.
    pub noise: f64,
    /// The width of the first window: with little noise twice the spacing.
    pub first: f64,
}

/// What a vertex has seen so far.
#[derive(Debug, Clone, Copy)]
struct Sight {
    /// The quotient of the variances in the last window.
    quotient: f64,
    /// The points in it.
    count: f64,
    noise: f64,
    is_open: bool,
}

/// The scales at all vertices.
///
/// # Errors
/// The call is cancelled.
pub fn scales(delaunay: &Delaunay, cloud: &Cloud<'_>) -> Result<Vec<Scale>> {
    let first = first_windows(delaunay, cloud)?;
    let mut sights =
        vec![Sight { quotient: 1.0, count: 0.0, noise: f64::NAN, is_open: true }; first.len()];
    for step in 0..STEPS {
        let factor = STEP.powi(step);
        let is_asked = |v: usize| rings(delaunay, v).any(|u| sights[u].is_open);
        let seen = cloud.each(first.len(), |eye, v| {
            let moments =
                is_asked(v).then(|| eye.moments(delaunay.point(v as u32), first[v] * factor));
            moments.map(|m| (m.variances[1] / m.variances[0].max(f64::MIN_POSITIVE), m.count))
        })?;
        for (sight, seen) in sights.iter_mut().zip(&seen) {
            let Some((quotient, count)) = *seen else { continue };
            (sight.quotient, sight.count) = (quotient, count);
            sight.is_open &= count < MANY;
        }
        sights = cloud.each(first.len(), |eye, v| {
            let quotient =
                sights[v].noise.is_nan().then(|| agreed(delaunay, v, |u| sights[u].quotient));
            match quotient {
                Some(q) if q <= slim(sights[v].count) => Sight {
                    noise: noise(eye, delaunay.point(v as u32), first[v] * factor, q),
                    is_open: false,
                    ..sights[v]
                },
                _ => sights[v],
            }
        })?;
        if !sights.iter().any(|sight| sight.is_open) {
            break;
        }
    }
    cloud.each(first.len(), |eye, v| Scale {
        noise: settled(delaunay, eye, &sights, &first, v),
        first: first[v],
    })
}

/// The noise about `place`, where the variances have the quotient `q`, less what is due to the curve's bend.
///
/// A parabola over the principal direction leaves a residual; windows with three points more than it has parameters count.
fn noise(eye: &mut Eye<'_>, place: Point, window: f64, q: f64) -> f64 {
    let straight = window * (q / (1.0 - q)).sqrt();
    let Some(residual) = eye.bent(place, window) else { return straight };
    let q = (residual / (window * window)).min(0.9);
    straight.min(window * (q / (1.0 - q)).sqrt())
}

/// The largest quotient that looks like a curve in a window of `count` points.
fn slim(count: f64) -> f64 {
    let share = ((count - 10.0) / 20.0).clamp(0.0, 1.0);
    SLIM[0] + share * (SLIM[1] - SLIM[0])
}

/// The noise that the points within some windows agree on.
fn settled(
    delaunay: &Delaunay,
    eye: &mut Eye<'_>,
    sights: &[Sight],
    first: &[f64],
    v: usize,
) -> f64 {
    let own = agreed(delaunay, v, |u| sights[u].noise);
    if own.is_nan() {
        return own;
    }
    let mut all = Vec::new();
    let reach = 3.0 * own.max(first[v]);
    eye.near(delaunay.point(v as u32), reach, |k, _, _| all.push(sights[k as usize].noise));
    median(&mut all)
}

/// Half the distance from each vertex to the few nearest.
fn first_windows(delaunay: &Delaunay, cloud: &Cloud<'_>) -> Result<Vec<f64>> {
    let distances = cloud.each(delaunay.points().len(), |eye, v| {
        let p = delaunay.point(v as u32);
        let star = delaunay.star(v as u32).neighbors;
        let far = star.iter().map(|&q| length(sub(delaunay.point(q), p)));
        eye.distance_to_nearest(p, FEW, far.fold(f64::INFINITY, f64::min) * 3.0) / 2.0
    })?;
    cloud.each(distances.len(), |_, v| agreed(delaunay, v, |u| distances[u]))
}

/// The neighbors of a vertex and their neighbors, but for those of hubs; near ones come more than once.
fn rings(delaunay: &Delaunay, v: usize) -> impl Iterator<Item = usize> {
    let star = |u: u32| delaunay.star(u).neighbors;
    let beyond = move |u: u32| if star(u).len() > HUB { &[] } else { star(u) };
    let near = star(v as u32).iter();
    near.flat_map(move |&u| beyond(u).iter().copied().chain([u])).map(|u| u as usize)
}

/// The median of a value over two rings of neighbors; what is not a number is larger than all that is.
fn agreed(delaunay: &Delaunay, v: usize, value: impl Fn(usize) -> f64) -> f64 {
    let mut all: Vec<f64> = rings(delaunay, v).chain([v]).map(value).collect();
    median(&mut all)
}

fn median(all: &mut [f64]) -> f64 {
    let middle = all.len() / 2;
    // `total_cmp` puts what is not a number last.
    *all.select_nth_unstable_by(middle, f64::total_cmp).1
}
