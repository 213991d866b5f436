//! Peeling the longest edges.
//!
//! A. D. Parakkat, S. Methirumangalath and R. Muthuganapathy, "Peeling the Longest: A Simple
//! Generalized Curve Reconstruction Algorithm", Computers & Graphics 74 (2018). The first half is the
//! graph of R. B. Urquhart, "Algorithms for Computation of Relative Neighbourhood Graph",
//! Electronics Letters 16 (1980).

use super::length::{Ranked, compare_distances, ranked};
use crate::cocircular::{corners, is_tied};
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, sort};
use crate::error::Result;
use crate::parts::sort_by;
use crate::progress::{PACE, Progress, Stage};

/// The edges that are longest in no Delaunay triangle, less those peeled off points of more than two.
///
/// A triangle is any three points on an empty circle, and takes away a longest edge only if there is
/// one. Then the edges are looked at from the longest to the shortest, and one goes if an end still
/// has more than two. Of equally long edges that with the lexicographically larger smaller end comes
/// first, then that with the larger other end. O(n log n), and quadratic in the points of one circle.
///
/// # Errors
/// A cancelled `progress`.
pub fn peel(delaunay: &Delaunay, progress: &Progress) -> Result<Edges> {
    let count = delaunay.points().len();
    progress.enter(Stage::Select, 2 * count)?;
    let is_short = |edge| !is_tied(delaunay, edge) && !is_longest(delaunay, edge);
    let mut kept = ranked(delaunay, progress, is_short)?;
    sort_by(&mut kept, progress, |a, b| b.compare(a, delaunay))?;
    let mut degrees = vec![0u32; count];
    kept.iter().flat_map(|edge| [edge.p, edge.q]).for_each(|end| degrees[end as usize] += 1);
    let mut stays = |edge: &&Ranked| {
        let ends = [edge.p, edge.q].map(|vertex| vertex as usize);
        let stays = ends.iter().all(|&end| degrees[end] <= 2);
        if !stays {
            degrees[ends[0]] -= 1;
            degrees[ends[1]] -= 1;
        }
        stays
    };
    let mut edges = Edges::new();
    for part in kept.chunks(PACE) {
        let staying = part.iter().filter(&mut stays);
        edges.extend(staying.map(|edge| rows(delaunay, edge.p, edge.q)));
        progress.advance(part.len() / 2)?;
    }
    Ok(sort(&[edges], delaunay.input_len()))
}

/// Is `edge` longer than the other two of one of its triangles?
///
/// A diagonal between cocircular points always is, which need not be looked at: of the two arcs
/// that it cuts off, a point on the one that is no longer than half the circle is nearer to both ends.
fn is_longest(delaunay: &Delaunay, edge: Edge) -> bool {
    let [p, q] = [edge.p, edge.q].map(|vertex| delaunay.point(vertex));
    let is_inside = |&s: &u32| {
        let s = delaunay.point(s);
        compare_distances(p, s, q).is_lt() && compare_distances(q, s, p).is_lt()
    };
    [(edge.p, edge.q), (edge.q, edge.p)]
        .into_iter()
        .any(|(u, v)| corners(delaunay, u, v).iter().any(is_inside))
}
