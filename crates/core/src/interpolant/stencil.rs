//! The samples that the interpolant is made of: all but those so close together that rounding bends the curve between them.
//!
//! Three samples at distances h, each rounded by ε, give a curvature that is wrong by about 4 ε/h². Along a stretch as straight as its rounding
//! lets one see, samples nearer than √(4 ε D/10⁻⁴) are passed over, so that the error is below 10⁻⁴ of the curvature of the extent D.

use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::parts::GRAIN;
use crate::point::{Point, cross, dot, sub};
use crate::progress::Progress;
use crate::space::bounds::Bounds;
use crate::trace::trace_edges;
use rayon::prelude::*;
use std::borrow::Cow;

/// The error of a curvature, as a part of one over the extent, that rounding may cause.
const ACCURACY: f64 = 1e-4;
/// A turn by more than this (its sine) is seen whatever the distance.
const TURN: f64 = 0.05;
/// The same error, where a quadratic through five samples amplifies it.
const FIT: f64 = 1e-2;
/// A ring of fewer samples than this is kept whole.
const FEWEST: usize = 8;

/// `curve` without the samples that are too close together; itself in most cases.
///
/// Only what is joined to an edge that is too short is traced: elsewhere all samples are kept.
pub fn stencil<'a>(
    delaunay: &Delaunay,
    curve: &'a Adjacency,
    scale: &Scale,
    progress: &Progress,
) -> Result<Cow<'a, Adjacency>> {
    let short = |&[p, q]: &[u32; 2]| {
        let step = sub(delaunay.point(q), delaunay.point(p));
        dot(step, step) < scale.spacing * scale.spacing
    };
    let short: Edges =
        curve.edges().par_iter().with_min_len(GRAIN).copied().filter(short).collect();
    if short.is_empty() {
        return Ok(Cow::Borrowed(curve));
    }
    // What is joined to a short edge; there is little of it.
    let near = joined(curve, short, progress)?;
    let (near, mut edges) = curve.edges().iter().partition::<Edges, _>(|[p, _]| near[*p as usize]);
    let traced = trace_edges(delaunay.points(), near, progress)?;
    for (ends, &closed) in traced.offsets.windows(2).zip(&traced.closed) {
        let whole = &traced.indices[ends[0]..ends[1]];
        let kept = scale.kept(delaunay, whole, closed);
        edges.extend(kept.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]));
        if let (true, [first, .., last]) = (closed, &kept[..]) {
            edges.push([*first.min(last), *first.max(last)]);
        }
    }
    Ok(Cow::Owned(Adjacency::of_vertices(&[edges], delaunay.points().len())))
}

/// For each vertex: does a path along `curve` lead from it to one of `edges`?
fn joined(curve: &Adjacency, edges: Edges, progress: &Progress) -> Result<Vec<bool>> {
    let mut is_joined = vec![false; curve.vertices()];
    let mut ahead = edges.into_flattened();
    while let Some(v) = ahead.pop() {
        if !std::mem::replace(&mut is_joined[v as usize], true) {
            progress.advance(0)?;
            ahead.extend(curve.of(v).iter().map(|&(next, _)| next));
        }
    }
    Ok(is_joined)
}

/// How closely rounding lets one look.
pub struct Scale {
    /// The box around the points.
    pub bounds: Bounds,
    rounding: f64,
    extent: f64,
    spacing: f64,
}

impl Scale {
    /// Of coordinates like those of `points`.
    pub fn of(points: &[Point]) -> Self {
        let bounds = Bounds::of(points);
        let rounding = f64::EPSILON / 2.0 * bounds.largest();
        let extent = bounds.extent();
        Self { bounds, rounding, extent, spacing: (4.0 * rounding * extent / ACCURACY).sqrt() }
    }

    /// Does a quadratic through five samples, `steps` apart, make sense of their curvature?
    pub fn fits(&self, steps: [f64; 4]) -> bool {
        let shortest = steps.into_iter().fold(f64::INFINITY, f64::min);
        let longest = steps.into_iter().fold(0.0, f64::max);
        let error = 8.0 * self.rounding / (shortest * shortest);
        error * (longest / shortest).powi(2) * self.extent <= FIT
    }

    /// The samples of a traced curve that are far enough from the last one kept, or where it turns.
    fn kept(&self, delaunay: &Delaunay, curve: &[u32], closed: bool) -> Vec<u32> {
        let mut kept = vec![curve[0]];
        for (k, &vertex) in curve.iter().enumerate().skip(1) {
            let next = match curve.get(k + 1) {
                Some(&next) => next,
                None if closed => curve[0],
                None => {
                    kept.push(vertex);
                    continue;
                }
            };
            let last = kept[kept.len() - 1];
            if self.shows(delaunay.point(last), delaunay.point(vertex), delaunay.point(next)) {
                kept.push(vertex);
            }
        }
        if closed && kept.len() < FEWEST { curve.to_vec() } else { kept }
    }

    fn shows(&self, last: Point, here: Point, next: Point) -> bool {
        let (u, v) = (sub(here, last), sub(next, here));
        let [a, b] = [u, v].map(|step| dot(step, step).sqrt());
        a >= self.spacing
            || cross(u, v).abs() > TURN * a * b + 8.0 * self.rounding * (a + b)
            || dot(u, v) < 0.0 && a.min(b) > 8.0 * self.rounding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_short_edge_is_joined_to_keeps_all_its_samples() {
        let (progress, count) = (Progress::default(), 400);
        let circle = |x: f64, angle: f64| [x + angle.cos(), angle.sin()];
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
        let sparse = (0..count).map(|k| circle(0.0, angle(k)));
        // On the second circle three samples lie between two, closer than rounding lets one see.
        let dense = (0..count).map(|k| circle(3.0, angle(k)));
        let close = (1..4).map(|k| circle(3.0, angle(7) + 1e-9 * f64::from(k)));
        let points: Vec<Point> = sparse.chain(dense).chain(close).collect();
        let delaunay = Delaunay::new(&points, &progress).expect("points");
        let edges = crate::methods::crust(&delaunay, &progress).expect("no one cancels");
        let curve = Adjacency::new(&delaunay, &edges).expect("memory");
        assert_eq!(curve.edges().len(), points.len());
        let scale = Scale::of(delaunay.points());
        let stencil = stencil(&delaunay, &curve, &scale, &progress).expect("no one cancels");
        for (v, &row) in delaunay.rows().iter().enumerate() {
            let (own, before) = (stencil.of(v as u32), curve.of(v as u32));
            match row as usize {
                0..400 => assert!(own.iter().map(|end| end.0).eq(before.iter().map(|end| end.0))),
                _ => assert!(own.is_empty() || own.len() == 2),
            }
        }
        assert_eq!(stencil.edges().len(), points.len() - 3);
    }
}
