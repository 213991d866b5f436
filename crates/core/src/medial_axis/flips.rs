//! Where the inside of rings begins and ends.

use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::parts::in_parts;
use crate::progress::{Progress, Stage};

/// Vertices, or edges, that one task takes at a time.
const GRAIN: usize = 1 << 13;

/// For each edge: does crossing it lead from the inside of a ring to its outside?
///
/// Open curves do not separate. Neither do rings with an edge that is not in the triangulation. Curves are as `trace` has them: they
/// end where other than two edges meet. Most are rings without such an end, so only the others are followed, from where they end.
pub fn flipping(delaunay: &Delaunay, curve: &Adjacency, progress: &Progress) -> Result<Vec<bool>> {
    progress.enter(Stage::Trace, delaunay.points().len() + curve.edges().len())?;
    let is_end = |&v: &u32| !matches!(curve.of(v).len(), 0 | 2);
    let is_absent = |&number: &u32| {
        let [p, q] = curve.edges()[number as usize];
        delaunay.position(p, q).is_none()
    };
    let ends = those(curve.vertices(), progress, is_end)?;
    let absent = those(curve.edges().len(), progress, is_absent)?;
    let mut flips = vec![true; curve.edges().len()];
    for number in absent {
        let [p, q] = curve.edges()[number as usize];
        progress.advance(0)?;
        // What was followed before is not followed again.
        follow(curve, p, (q, number), |edge| std::mem::take(&mut flips[edge as usize]));
    }
    let mut path = Vec::new();
    for (start, step) in ends.iter().flat_map(|&v| curve.of(v).iter().map(move |&step| (v, step))) {
        progress.advance(0)?;
        path.clear();
        let last = follow(curve, start, step, |edge| {
            path.push(edge);
            true
        });
        if last != start || path.iter().any(|&edge| !flips[edge as usize]) {
            for &edge in &path {
                flips[edge as usize] = false;
            }
        }
    }
    Ok(flips)
}

/// Those numbers below `count` that `are`, in order.
fn those(count: usize, progress: &Progress, are: impl Fn(&u32) -> bool + Sync) -> Result<Vec<u32>> {
    let parts = in_parts(count, GRAIN, progress, |numbers| {
        (numbers.start as u32..numbers.end as u32).filter(&are).collect::<Vec<_>>()
    })?;
    Ok(parts.concat())
}

/// Visit the edges from `start` along the curve until it ends, comes back, or `visit` gives false; return where.
fn follow(
    curve: &Adjacency,
    start: u32,
    (mut v, mut edge): (u32, u32),
    mut visit: impl FnMut(u32) -> bool,
) -> u32 {
    while visit(edge)
        && v != start
        && let &[a, b] = curve.of(v)
    {
        (v, edge) = if a.1 == edge { b } else { a };
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::Point;
    use crate::trace::trace_edges;

    /// The edges of the rings that `trace` finds, if all are in the triangulation.
    fn of_rings(delaunay: &Delaunay, curve: &Adjacency) -> Vec<bool> {
        let traced = trace_edges(delaunay.points(), curve.edges(), &Progress::default());
        let traced = traced.expect("no one cancels");
        let mut flips = vec![false; curve.edges().len()];
        for (ends, _) in traced.offsets.windows(2).zip(&traced.closed).filter(|&(_, &ring)| ring) {
            let ring = &traced.indices[ends[0]..ends[1]];
            let sides = || ring.iter().copied().zip(ring.iter().copied().cycle().skip(1));
            if sides().all(|(p, q)| delaunay.position(p, q).is_some()) {
                for (p, q) in sides() {
                    flips[curve.edge(p, q).expect("an edge of the ring") as usize] = true;
                }
            }
        }
        flips
    }

    #[test]
    fn rings_flip_whatever_else_there_is() {
        let (size, progress) = (300, Progress::default());
        let at = |k: u32| [f64::from(k * 7919 % 1009), f64::from(k * 104_729 % 1013)];
        let points: Vec<Point> = (0..size).map(at).collect();
        let delaunay = Delaunay::new(&points, &progress).expect("points");
        let (mut some, mut none) = (0, 0);
        for round in 0..40 {
            // Rings of three to six successive rows, some of them open, and edges that end at them.
            let keeps = |k: u32| !(k * 31 + round * 17).is_multiple_of(23);
            let ring = |first: u32| {
                let count = 3 + (first + round) % 4;
                (0..count).map(move |k| [first + k, first + (k + 1) % count])
            };
            let rings = (0..size - 6).step_by(6).flat_map(ring).filter(|[p, _]| keeps(*p));
            let more = (0..round % 5).map(|k| [6 * k, 60 * k + 97]);
            let edges = rings.chain(more).map(|[p, q]| [p.min(q), p.max(q)]).collect();
            let near = (0..size).step_by(3).map(|v| [v, delaunay.star(v).neighbors[0]]);
            let near = near.map(|[p, q]| [p.min(q), p.max(q)]).collect();
            let triangles = delaunay.triangles();
            let apart = triangles
                .iter()
                .step_by(7 + round as usize)
                .flat_map(|&[a, b, c]| [[a, b], [a, c], [b.min(c), b.max(c)]]);
            for parts in [vec![edges], vec![near], vec![apart.collect()]] {
                let curve = Adjacency::of_vertices(&parts, size as usize);
                let flips = flipping(&delaunay, &curve, &progress).expect("no one cancels");
                assert_eq!(flips, of_rings(&delaunay, &curve));
                some += usize::from(flips.contains(&true));
                none += usize::from(flips.contains(&false));
            }
        }
        assert!(some > 20 && none > 20);
    }
}
