//! The γ-neighborhood graph.
//!
//! R. C. Veltkamp, "The γ-neighborhood graph", Computational Geometry: Theory and Applications 1
//! (1992). His two disks through p and q of radius d / 2(1 − |c|), joined or intersected by the
//! signs of c₀ and c₁, come to this: no point on one side sees p q under more than the angle of c₀,
//! and none on the other under more than that of c₁.

use crate::cocircular::select_closed;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, select, sort};
use crate::error::{Error, Result};
use crate::exact::angle_bound::AngleBound;
use crate::forbidden_region::ForbiddenRegion;
use crate::memory::Growing;
use crate::parts::in_parts;
use crate::progress::{Progress, Stage};
use crate::space::bounds::Bounds;
use crate::space::boxes::Boxes;
use std::cell::RefCell;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// The edges with an empty γ(c₀, c₁)-neighborhood, on either side of the edge, for −1 ≤ c₀, c₁ ≤ 1.
///
/// O(n log n) for c₀ + c₁ ≥ 0, where the graph is a part of the closed Delaunay graph. Below that,
/// up to all pairs are edges: see `gamma_of`.
///
/// # Errors
/// A parameter outside of its range, or a cancelled `progress`.
pub fn gamma_graph(delaunay: &Delaunay, c: [f64; 2], progress: &Progress) -> Result<Edges> {
    if let Some(k) = c.iter().position(|c| !(-1.0..=1.0).contains(c)) {
        let message = format!("c{k} must be a number from -1 to 1, not {}", c[k]);
        return Err(Error::Argument { message });
    }
    let [a, b] = c.map(AngleBound::of_gamma);
    // The cotangent grows with c and is odd, so the sums have the same sign.
    let sum = (c[0] + c[1]).partial_cmp(&0.0).unwrap_or(Equal);
    gamma_of(delaunay, [&a, &b], sum, progress)
}

/// The edges for which one bound holds on one side and the other, or the same, on the other.
///
/// `sum` is the sign of the sum of the cotangents. If it is not negative some disk lies in every
/// neighborhood, so the edges are Delaunay edges, and the apexes see them under the largest angles.
/// If it is 0 the only such disk may be that of cocircular points. If it is negative all pairs are
/// candidates; see [`Pairs`].
pub(super) fn gamma_of(
    delaunay: &Delaunay,
    [a, b]: [&AngleBound; 2],
    sum: Ordering,
    progress: &Progress,
) -> Result<Edges> {
    let is_symmetric = std::ptr::eq(a, b);
    let keep = |edge| {
        has_angles(delaunay, edge, a, b) || !is_symmetric && has_angles(delaunay, edge, b, a)
    };
    match sum {
        Greater => select(delaunay, progress, || (), |(), edge| keep(edge)),
        Equal => select_closed(delaunay, progress, keep),
        Less => {
            let regions = [(a, b), (b, a)].map(|(left, right)| ForbiddenRegion { left, right });
            let boxes = Boxes::new(delaunay.points(), |&p| Bounds::at(p));
            Pairs { delaunay, regions, boxes, found: Growing::default() }.select(progress)
        }
    }
}

/// Do the apexes of `edge` see it under at most these angles?
pub(crate) fn has_angles(
    delaunay: &Delaunay,
    edge: Edge,
    left: &AngleBound,
    right: &AngleBound,
) -> bool {
    let (p, q) = (delaunay.point(edge.p), delaunay.point(edge.q));
    let admits = |bound: &AngleBound, apex: Option<u32>| {
        apex.is_none_or(|apex| bound.admits(p, q, delaunay.point(apex)))
    };
    admits(left, edge.left) && admits(right, edge.right)
}

/// The search among all pairs.
///
/// For each p, walk the tree of boxes for q and leave out a box if one point, a neighbor of p or
/// one found to block an earlier pair, lies in the regions of all its points; then walk it for
/// points in the region of the pair. O(m log n) for m edges as a rule; O(n³) at worst.
struct Pairs<'a> {
    delaunay: &'a Delaunay,
    regions: [ForbiddenRegion<'a>; 2],
    boxes: Boxes,
    found: Growing,
}

impl Pairs<'_> {
    fn select(&self, progress: &Progress) -> Result<Edges> {
        /// Vertices that one task takes at a time: early ones have more pairs before them.
        const GRAIN: usize = 64;
        let count = self.delaunay.points().len();
        progress.enter(Stage::Select, count)?;
        let parts = in_parts(count, GRAIN, progress, |vertices| {
            let mut edges = Edges::new();
            for p in vertices {
                let more = self.edges_from(p as u32, progress);
                self.found.add(more.len(), size_of::<[u32; 2]>())?;
                edges.extend(more);
                progress.advance(0)?;
            }
            Ok(edges)
        })?;
        let parts = parts.into_iter().collect::<Result<Vec<_>>>()?;
        Ok(sort(&parts, self.delaunay.input_len()))
    }

    /// The edges from `p` to vertices of larger number, as rows; some of them only if the call is cancelled.
    fn edges_from(&self, p: u32, progress: &Progress) -> Edges {
        let blockers = self.delaunay.star(p).neighbors.to_vec();
        let blockers = RefCell::new([blockers.clone(), blockers]);
        let mut edges = Edges::new();
        self.boxes.any(
            &mut |bounds, range| {
                let blockers = blockers.borrow();
                let is_blocked = |k: usize| self.is_blocked(k, p, bounds, &blockers[k]);
                range.end > p + 1 && !(0..2).all(is_blocked)
            },
            &mut |q| {
                let mut blockers = blockers.borrow_mut();
                if q > p && (0..2).any(|k| self.is_empty(k, p, q, &mut blockers[k])) {
                    edges.push(rows(self.delaunay, p, q));
                }
                progress.is_cancelled()
            },
        );
        edges
    }

    /// Is one of `blockers` in region `k` of `p` and any point in `bounds`?
    fn is_blocked(&self, k: usize, p: u32, bounds: &Bounds, blockers: &[u32]) -> bool {
        let p = self.delaunay.point(p);
        let blocks = |&r: &u32| self.regions[k].blocks(p, self.delaunay.point(r), bounds);
        blockers.iter().any(blocks)
    }

    /// Does region `k` of `p` and `q` hold no point? If only a far one, add that to the `blockers`
    /// of p.
    fn is_empty(&self, k: usize, p: u32, q: u32, blockers: &mut Vec<u32>) -> bool {
        let region = &self.regions[k];
        let [from, to] = [p, q].map(|vertex| self.delaunay.point(vertex));
        let holds = |&r: &u32| region.holds(from, to, self.delaunay.point(r));
        if blockers.iter().any(holds) || self.delaunay.star(q).neighbors.iter().any(holds) {
            return false;
        }
        let may_meet = region.may_meet(from, to);
        let mut found = None;
        self.boxes.any(&mut |bounds, _| may_meet(bounds), &mut |r| {
            found = Some(r).filter(holds);
            found.is_some()
        });
        blockers.extend(found);
        found.is_none()
    }
}
