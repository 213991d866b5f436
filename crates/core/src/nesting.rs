//! Nesting: which rings are holes, and in which shell.
//!
//! By the definition: a ray from a point of each ring crosses the rings around it an odd number of times. Boxes around the
//! sides of the rings, which follow each other in the plane as they do in memory, lead to the sides that it crosses.

use crate::error::Result;
use crate::exact::predicates::is_left;
use crate::point::Point;
use crate::progress::{Progress, Stage};
use crate::space::bounds::Bounds;
use crate::space::boxes::Boxes;
use crate::trace::Curves;
use rayon::prelude::*;

/// For each curve the shell that it belongs to: itself, if it is a shell, that around it, if it is a hole; `None` for a polyline.
///
/// A ring inside an even number of other rings is a shell, one inside an odd number a hole of the innermost shell around it,
/// or a shell, if there is none, as may be where rings cross. A ring is inside of others if its first point with the fewest
/// rings through it is. Linear time, and that of the sides that the rays cross: about √c of c rings spread over the plane each.
///
/// # Errors
/// A cancelled `progress`.
pub fn shells(points: &[Point], curves: &Curves, progress: &Progress) -> Result<Vec<Option<u32>>> {
    progress.advance(0)?;
    let rings = Rings::new(points, curves);
    progress.enter(Stage::Nest, curves.closed.len())?;
    let around = |ring: usize| {
        progress.advance(1)?;
        Ok(rings.around(ring as u32))
    };
    let around = (0..curves.closed.len()).into_par_iter().map(around);
    let around = around.collect::<Result<Vec<Vec<u32>>>>()?;
    let depth = |ring: u32| around[ring as usize].len();
    let shell = |ring: u32| {
        let around = &around[ring as usize];
        // Of equally deep ones, which cross, `max_by_key` takes the last.
        let shells = around.iter().rev().copied().filter(|&other| depth(other) % 2 == 0);
        let innermost = shells.max_by_key(|&other| depth(other));
        innermost.filter(|_| around.len() % 2 == 1).unwrap_or(ring)
    };
    let is_ring = |&ring: &u32| curves.closed[ring as usize];
    Ok((0..around.len() as u32).map(|k| Some(k).filter(is_ring).map(shell)).collect())
}

/// The rings among some curves.
struct Rings<'a> {
    points: &'a [Point],
    curves: &'a Curves,
    /// How many times each row is on a ring.
    uses: Vec<u32>,
    sides: Vec<Side>,
    boxes: Boxes,
}

/// An edge of a ring, from its lower to its higher end, and the number of the ring.
struct Side {
    low: Point,
    high: Point,
    ring: u32,
}

impl<'a> Rings<'a> {
    fn new(points: &'a [Point], curves: &'a Curves) -> Self {
        let mut uses = vec![0; points.len()];
        let mut sides = Vec::with_capacity(curves.indices.len());
        for ring in (0..curves.closed.len()).filter(|&ring| curves.closed[ring]) {
            let rows = curves.curve(ring);
            for (&a, &b) in rows.iter().zip(rows.iter().cycle().skip(1)) {
                uses[a as usize] += 1;
                let (a, b) = (points[a as usize], points[b as usize]);
                let [low, high] = if a[1] <= b[1] { [a, b] } else { [b, a] };
                sides.push(Side { low, high, ring: ring as u32 });
            }
        }
        let boxes = Boxes::new(&sides, |side| Bounds::of(&[side.low, side.high]));
        Self { points, curves, uses, sides, boxes }
    }

    /// The other rings around a ring, sorted; none around a polyline.
    fn around(&self, ring: u32) -> Vec<u32> {
        if !self.curves.closed[ring as usize] {
            return Vec::new();
        }
        let rows = self.curves.curve(ring as usize);
        let own = rows.iter().min_by_key(|&&row| self.uses[row as usize]);
        let mut crossed = own.map_or_else(Vec::new, |&row| self.crossed(self.points[row as usize]));
        crossed.sort_unstable();
        let odd = crossed.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1);
        odd.map(|same| same[0]).filter(|&other| other != ring).collect()
    }

    /// The rings that the ray from `p` to the right crosses, each as many times as it does.
    fn crossed(&self, p: Point) -> Vec<u32> {
        let mut rings = Vec::new();
        self.boxes.any(
            &mut |bounds, _| {
                bounds.low[1] <= p[1] && p[1] < bounds.high[1] && p[0] < bounds.high[0]
            },
            &mut |k| {
                let &Side { low, high, ring } = &self.sides[k as usize];
                if low[1] <= p[1] && p[1] < high[1] && is_left(low, high, p) {
                    rings.push(ring);
                }
                false
            },
        );
        rings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shells of squares around `center`, as rings one after another.
    fn of_squares(center: Point, halves: &[f64]) -> Vec<Option<u32>> {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let ring = |&half: &f64| corners.map(|[x, y]| [center[0] + half * x, center[1] + half * y]);
        let points: Vec<Point> = halves.iter().flat_map(ring).collect();
        let curves = Curves {
            indices: (0..points.len() as u32).collect(),
            offsets: (0..=halves.len()).map(|k| 4 * k).collect(),
            closed: vec![true; halves.len()],
            isolated: Vec::new(),
        };
        shells(&points, &curves, &Progress::default()).expect("no one cancels")
    }

    #[test]
    fn a_ring_inside_a_hole_is_a_shell() {
        let of = |halves: &[f64]| of_squares([0.5, -2.0], halves);
        assert_eq!(of(&[1.0, 3.0, 2.0]), [Some(0), Some(1), Some(1)]);
        assert_eq!(of(&[4.0, 1.0, 3.0, 2.0]), [Some(0), Some(3), Some(0), Some(3)]);
        assert_eq!(of(&[]), []);
    }
}
