//! The smooth interpolant: at each sample a tangent, and the curvature as a quadratic function of arc length.
//!
//! The circle through three successive samples has the curvature's mean over them, weighted by the B-spline with knots at
//! the three. Three such means, from five samples, determine a quadratic that has exactly these means. Where the means
//! change abruptly, as from a line to an arc, its second derivative is limited so that it does not overshoot.

use super::stencil::Scale;
use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::parts::{GRAIN, copies, try_each};
use crate::point::{Point, cross, dot, sub};
use crate::progress::Progress;

/// How much larger than a neighbor's second derivative of the curvature that of a sample may be.
const LIMIT: f64 = 3.0;
/// How much larger than its means the curvature may be.
const OVERSHOOT: f64 = 1.15;

/// The curve near a sample, run through from `before` to `after`.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// The adjacent samples; an endpoint has one.
    pub adjacent: [Option<u32>; 2],
    /// The arc lengths to them, from the sample; 0 where there is none.
    pub reach: [f64; 2],
    /// The unit tangent.
    pub tangent: Point,
    /// The signed curvature at the sample: positive where the curve turns left.
    pub curvature: f64,
    /// Its derivative by arc length.
    pub slope: f64,
    /// Half of its second derivative.
    pub second: f64,
    /// The curvature is not believed to be larger than this anywhere near.
    pub most: f64,
}

impl Bend {
    /// The unit normal to the left.
    #[must_use]
    pub fn normal(&self) -> Point {
        left(self.tangent)
    }

    /// +1 if the curve leaves through `next` forward, −1 if backward.
    #[must_use]
    pub fn direction(&self, next: u32) -> f64 {
        if self.adjacent[1] == Some(next) { 1.0 } else { -1.0 }
    }

    /// The longer of the arcs to the adjacent samples.
    #[must_use]
    pub fn longest(&self) -> f64 {
        self.reach[0].max(self.reach[1])
    }

    /// The curvature at arc length `s` from the sample.
    #[must_use]
    pub fn curvature_at(&self, s: f64) -> f64 {
        self.curvature + s * (self.slope + s * self.second)
    }

    /// The angle that the tangent turns by from the sample to arc length `s`.
    #[must_use]
    pub fn turn(&self, s: f64) -> f64 {
        s * (self.curvature + s * (self.slope / 2.0 + s * self.second / 3.0))
    }

    /// The place at arc length `s` from the sample, relative to it; for turns of less than about one radian.
    #[must_use]
    pub fn place(&self, s: f64) -> Point {
        // Simpson's rule for the integral of the tangent.
        let tangent = |s: f64| turned(self.tangent, self.turn(s));
        let (middle, end) = (tangent(s / 2.0), tangent(s));
        [0, 1].map(|k| s / 6.0 * (self.tangent[k] + 4.0 * middle[k] + end[k]))
    }

    /// Where between the adjacent samples the curvature has its extremum, if nearer to this sample than to them.
    #[must_use]
    pub fn vertex(&self) -> Option<f64> {
        let s = -self.slope / (2.0 * self.second);
        (self.second != 0.0 && -self.reach[0] <= 2.0 * s && 2.0 * s <= self.reach[1]).then_some(s)
    }
}

/// The vector a quarter turn to the left of `v`.
#[must_use]
pub fn left([x, y]: Point) -> Point {
    [-y, x]
}

/// `v` turned left by `angle` radians.
#[must_use]
pub fn turned([x, y]: Point, angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

/// The interpolant at each vertex; `None` at isolated points and branches.
///
/// # Errors
/// A cancelled `progress`.
pub fn bends(
    delaunay: &Delaunay,
    curve: &Adjacency,
    scale: &Scale,
    progress: &Progress,
) -> Result<Vec<Option<Bend>>> {
    let mut bends = copies(None, delaunay.points().len());
    try_each(bends.chunks_mut(GRAIN).collect(), |k, bends| {
        let (first, end) = (k * GRAIN, k * GRAIN + bends.len());
        for (bend, v) in bends.iter_mut().zip(first..end) {
            *bend = circle(delaunay, curve, v as u32);
        }
        // Of other vertices so few matter that each part makes its own.
        let others = Circles { delaunay, curve, first, known: &[] };
        let circles = Circles { known: bends, ..others };
        let fit = |v| Fit::new(&circles, scale, v as u32);
        let fits: Vec<Option<Fit>> = (first..end).map(fit).collect();
        let second = |v: u32| {
            let known = fits.get((v as usize).wrapping_sub(first)).copied();
            known.unwrap_or_else(|| Fit::new(&others, scale, v)).map(|fit| fit.second)
        };
        for (bend, fit) in bends.iter_mut().zip(&fits) {
            if let (Some(bend), Some(fit)) = (bend, fit) {
                let near = bend.adjacent.map(|next| next.and_then(second).unwrap_or(0.0));
                fit.refine(bend, near);
            }
        }
        progress.advance(bends.len())
    })?;
    Ok(bends)
}

/// The circles at vertices: those of successive ones are known.
struct Circles<'a> {
    delaunay: &'a Delaunay,
    curve: &'a Adjacency,
    first: usize,
    known: &'a [Option<Bend>],
}

impl Circles<'_> {
    /// The circle at `v`; `made` is where it is kept if it was not known.
    #[inline]
    fn at<'b>(&'b self, v: u32, made: &'b mut Option<Bend>) -> Option<&'b Bend> {
        if let Some(known) = self.known.get((v as usize).wrapping_sub(self.first)) {
            return known.as_ref();
        }
        *made = circle(self.delaunay, self.curve, v);
        made.as_ref()
    }
}

/// The circle through a vertex and those adjacent to it; at an endpoint through it and the next two.
fn circle(delaunay: &Delaunay, curve: &Adjacency, v: u32) -> Option<Bend> {
    let at = |vertex: u32| delaunay.point(vertex);
    match *curve.of(v) {
        [(a, _), (b, _)] => Some(through(sub(at(a), at(v)), sub(at(b), at(v)), [Some(a), Some(b)])),
        [(b, _)] => {
            let &(c, _) = curve.of(b).iter().find(|&&(c, _)| c != v && curve.of(b).len() == 2)?;
            // The same circle, with the endpoint first: c stands on the far side.
            let mut bend = through(sub(at(c), at(v)), sub(at(b), at(v)), [None, Some(b)]);
            let forward = dot(bend.tangent, sub(at(b), at(v)));
            if forward < 0.0 {
                bend.tangent = bend.tangent.map(|x| -x);
                bend.curvature = -bend.curvature;
            }
            bend.reach = [0.0, arc(sub(at(b), at(v)), bend.curvature)];
            Some(bend)
        }
        _ => None,
    }
}

/// The circle through the origin, `a` and `b`, run through from a by the origin to b.
fn through(a: Point, b: Point, adjacent: [Option<u32>; 2]) -> Bend {
    let (aa, bb, chord) = (dot(a, a), dot(b, b), sub(b, a));
    // Inversion in the origin makes the circle a line along the tangent.
    let along = [0, 1].map(|k| b[k] / bb - a[k] / aa);
    let length = libm::hypot(along[0], along[1]);
    let tangent =
        if length > 0.0 { along.map(|x| x / length) } else { left(b.map(|x| x / bb.sqrt())) };
    let curvature = 2.0 * cross(b, a) / (aa * bb * dot(chord, chord)).sqrt();
    let curvature = if curvature.is_finite() { curvature } else { 0.0 };
    let reach = [arc(a, curvature), arc(b, curvature)];
    Bend { adjacent, reach, tangent, curvature, slope: 0.0, second: 0.0, most: curvature.abs() }
}

/// The length of an arc of small curvature over the chord `d`.
fn arc(d: Point, curvature: f64) -> f64 {
    let chord = dot(d, d).sqrt();
    let square = (chord * curvature / 2.0).powi(2).min(1.0);
    chord * (1.0 + square * (1.0 / 6.0 + square * 0.075))
}

/// What makes a quadratic of the mean curvature at a vertex and those adjacent, in the vertex's direction.
#[derive(Debug, Clone, Copy)]
struct Fit {
    /// Half the second derivative of the quadratic that has these means, not limited.
    second: f64,
    /// The quadratic's slope is the first, less the second times half its second derivative.
    slope: [f64; 2],
    /// The moments of the weights of the mean at the vertex.
    moments: [f64; 2],
    /// The largest of the means.
    most: f64,
    /// Do the adjacent vertices run in the same direction?
    agree: [bool; 2],
}

impl Fit {
    fn new(circles: &Circles<'_>, scale: &Scale, v: u32) -> Option<Self> {
        let [mut here, mut before, mut after] = [None; 3];
        let here = circles.at(v, &mut here)?;
        let [Some(a), Some(b)] = here.adjacent else { return None };
        let (before, after) = (circles.at(a, &mut before)?, circles.at(b, &mut after)?);
        if before.adjacent.contains(&None) || after.adjacent.contains(&None) {
            return None;
        }
        let signs = [before.direction(v), -after.direction(v)];
        let [h1, h2] = here.reach;
        let h0 = before.reach[usize::from(signs[0] < 0.0)];
        let h3 = after.reach[usize::from(signs[1] > 0.0)];
        if !scale.fits([h0, h1, h2, h3]) {
            return None;
        }
        let knots = [[-h1 - h0, -h1, 0.0], [-h1, 0.0, h2], [0.0, h2, h2 + h3]];
        let means = [signs[0] * before.curvature, here.curvature, signs[1] * after.curvature];
        let first = knots.map(|[x, y, z]| (x + y + z) / 3.0);
        let second = knots.map(|[x, y, z]| (x * (x + y + z) + y * (y + z) + z * z) / 6.0);
        let span = first[2] - first[0];
        Some(Self {
            second: quadratic(means, first, second),
            slope: [(means[2] - means[0]) / span, (second[2] - second[0]) / span],
            moments: [first[1], second[1]],
            most: means.iter().fold(0.0, |most: f64, mean| most.max(mean.abs())),
            agree: signs.map(|sign| sign > 0.0),
        })
    }

    /// Give `bend`, the circle at the vertex, the quadratic's curvature, and the tangent that goes with it.
    ///
    /// `near` are the second derivatives, halved, at the adjacent vertices.
    fn refine(&self, bend: &mut Bend, near: [f64; 2]) {
        let near = [0, 1].map(|end| if self.agree[end] { near[end] } else { -near[end] });
        let second = limited(self.second, near);
        let slope = self.slope[0] - second * self.slope[1];
        let correction = -slope * self.moments[0] - second * self.moments[1];
        let h = bend.reach[1];
        let angle = -h * (correction / 2.0 + h * (slope / 6.0 + h * second / 12.0));
        if [slope, correction, angle].iter().all(|x| x.is_finite()) {
            bend.most = OVERSHOOT * self.most;
            bend.second = second;
            bend.slope = slope;
            bend.curvature = (bend.curvature + correction).clamp(-bend.most, bend.most);
            bend.tangent = turned(bend.tangent, angle);
        }
    }
}

/// Half the second derivative of the quadratic with these means, given the moments of their weights.
fn quadratic(means: [f64; 3], first: [f64; 3], second: [f64; 3]) -> f64 {
    let left = (means[1] - means[0]) / (first[1] - first[0]);
    let right = (means[2] - means[1]) / (first[2] - first[1]);
    let steps = (second[2] - second[1]) / (first[2] - first[1])
        - (second[1] - second[0]) / (first[1] - first[0]);
    let quadratic = (right - left) / steps;
    if quadratic.is_finite() { quadratic } else { 0.0 }
}

/// `value`, no larger than a multiple of the larger neighbor of its sign.
fn limited(value: f64, near: [f64; 2]) -> f64 {
    let sign = value.signum();
    let most = near.iter().fold(0.0, |most: f64, x| most.max(sign * x));
    sign * value.abs().min(LIMIT * most)
}
