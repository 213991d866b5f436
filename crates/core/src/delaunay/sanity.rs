//! The definition of a Delaunay triangulation, checked on a finished one: shared by tests and fuzzing.

use super::{Delaunay, Edge};
use crate::exact::predicates::{in_circle, is_left, orientation};
use std::cmp::Ordering::Equal;

impl Delaunay {
    /// Check that this is a Delaunay triangulation of its vertices.
    ///
    /// Twins agree, triangles turn left, the hull is convex, Euler's formula holds, and no apex lies inside the
    /// circle of the triangle across its edge, which for a triangulation implies that all circles are empty.
    ///
    /// # Errors
    /// A sentence that says what does not hold, and where.
    pub fn sanity_check(&self) -> Result<(), String> {
        self.check_twins()?;
        self.check_triangles()?;
        self.check_hull()?;
        self.check_euler()?;
        self.edges().try_for_each(|edge| self.check_edge(edge))
    }

    fn check_twins(&self) -> Result<(), String> {
        for p in 0..self.points.len() as u32 {
            for &q in self.star(p).neighbors {
                if p == q || !self.star(q).neighbors.contains(&p) {
                    return Err(format!("{q} is in the star of {p}, but not the reverse"));
                }
            }
        }
        Ok(())
    }

    fn check_triangles(&self) -> Result<(), String> {
        for p in 0..self.points.len() as u32 {
            for (q, r) in self.star(p).wedges() {
                if !is_left(self.point(p), self.point(q), self.point(r)) {
                    return Err(format!("triangle {p} {q} {r} does not turn left"));
                }
                if !self.star(q).wedges().any(|wedge| wedge == (r, p)) {
                    return Err(format!("triangle {p} {q} {r} is not in the star of {q}"));
                }
            }
        }
        Ok(())
    }

    fn check_hull(&self) -> Result<(), String> {
        let count = self.hull.len();
        for k in 0..count {
            let [a, b, c] = [k, k + 1, k + 2].map(|k| self.point(self.hull[k % count]));
            if is_left(a, c, b) {
                return Err(format!("the hull turns right after its vertex {k}"));
            }
        }
        Ok(())
    }

    fn check_euler(&self) -> Result<(), String> {
        let (vertices, edges) = (self.points.len(), self.edges().count());
        let expected = match vertices {
            0 => 0,
            _ if self.is_in_line() => vertices - 1,
            _ => 3 * vertices - 3 - self.hull.len(),
        };
        if edges == expected { Ok(()) } else { Err(format!("{edges} edges instead of {expected}")) }
    }

    fn check_edge(&self, edge: Edge) -> Result<(), String> {
        let Edge { p, q, left, right } = edge;
        let (Some(a), Some(b)) = (left, right) else { return Ok(()) };
        if in_circle(self.point(p), self.point(q), self.point(a), self.point(b)) {
            return Err(format!("{b} is inside the circle of the triangle {p} {q} {a}"));
        }
        Ok(())
    }

    /// Do all vertices lie on one line?
    fn is_in_line(&self) -> bool {
        let [a, b, rest @ ..] = self.points.as_slice() else { return true };
        rest.iter().all(|&c| orientation(*a, *b, c) == Equal)
    }
}
