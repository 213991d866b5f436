//! The spheres-of-influence graph within the Delaunay graph.
//!
//! G. T. Toussaint, "A Graph-Theoretical Primal Sketch", in Computational Morphology (1988); D.
//! Marin, S. Ohrhallinger and M. Wimmer, "SIGDT: 2D Curve Reconstruction", Computer Graphics Forum
//! 41 (2022).

use super::neighborhood::Neighborhood;
use crate::cocircular::select_closed;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::Edges;
use crate::error::Result;
use crate::exact::sign::{self, Form, Number};
use crate::parts::map;
use crate::point::{length, sub};
use crate::progress::Progress;
use std::cmp::Ordering::Greater;

/// The edges of the closed Delaunay graph no longer than the distances of their ends to their nearest, summed.
///
/// Around each point lies its sphere of influence, which reaches to its nearest point; the graph joins
/// those whose spheres meet, touching included. O(n log n).
///
/// # Errors
/// A cancelled `progress`.
pub fn sig_delaunay(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let neighborhood = Neighborhood::new(delaunay, progress)?;
    let first = |p: u32| {
        let nearest = neighborhood.nearest(p, delaunay.star(p).neighbors.iter().copied());
        nearest.first().copied().unwrap_or(p)
    };
    let nearest = map(delaunay.points().len(), 0, &progress.quiet(), |p| first(p as u32))?;
    let meet = |edge: Edge| {
        let ends = [edge.p, edge.q];
        spheres_meet(delaunay, ends, ends.map(|vertex| nearest[vertex as usize]))
    };
    select_closed(delaunay, progress, meet)
}

/// Do the circles around `ends` through `nearest` meet?
fn spheres_meet(delaunay: &Delaunay, ends: [u32; 2], nearest: [u32; 2]) -> bool {
    let [p, q] = ends.map(|vertex| delaunay.point(vertex));
    let [s, t] = nearest.map(|vertex| delaunay.point(vertex));
    let (distance, reach) = (length(sub(q, p)), length(sub(s, p)) + length(sub(t, q)));
    if (distance - reach).abs() > 1e-14 * reach + f64::MIN_POSITIVE {
        return distance < reach;
    }
    let at = [q, s, t];
    sign::sign(&Excess, p, &at) != Greater || sign::sign(&Gap, p, &at) != Greater
}

/// d² − a² − b² for the distance d of the origin from `q`, that of the origin from `s`, a, and that of `q` from `t`, b.
struct Excess;

impl Form<3> for Excess {
    fn bound(&self, bits: u32) -> u32 {
        2 * bits + 4
    }
    fn value<T: Number>(&self, [q, s, t]: &[[T; 2]; 3]) -> T {
        let b = sign::difference(t, q);
        sign::dot(q, q).minus(&sign::dot(s, s)).minus(&sign::dot(&b, &b))
    }
}

/// (d² − a² − b²)² − (2ab)²: where [`Excess`] is positive, positive exactly if d > a + b.
struct Gap;

impl Form<3> for Gap {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 9
    }
    fn value<T: Number>(&self, at: &[[T; 2]; 3]) -> T {
        let [q, s, t] = at;
        let (excess, b) = (Excess.value(at), sign::difference(t, q));
        let product = sign::dot(s, s).times(&sign::dot(&b, &b));
        excess.times(&excess).minus(&T::integer(4).times(&product))
    }
}
