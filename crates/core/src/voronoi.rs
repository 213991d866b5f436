//! Voronoi vertices by place, for disks that meet many more cells than they hold vertices.

use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::exact::circumcenter::{Center, circumcenter};
use crate::exact::filter::ROUNDING;
use crate::memory;
use crate::parts::map;
use crate::point::{Point, length};
use crate::progress::Progress;
use crate::space::bounds::Bounds;
use crate::space::boxes::Boxes;
use crate::space::halves::halve;
use crate::space::oriented::{Oriented, Seen};

/// Memory for each triangle.
const BYTES: usize = 64;

/// A center is solved for where floating point leaves more than this part of its radius uncertain.
const UNCERTAIN: f64 = 1e-9;

/// The Voronoi vertices as triangles, in boxes.
#[derive(Debug)]
pub struct VoronoiVertices {
    /// For each triangle a box around its circumcenter, hardly larger than that.
    places: Vec<(Bounds, [u32; 3])>,
    /// Vertices on a curve are met by disks that touch it, so boxes lie along them.
    boxes: Boxes<Oriented>,
}

impl VoronoiVertices {
    /// Those of a triangulation. O(n log n).
    ///
    /// # Errors
    /// Too little memory, or a cancelled `progress`.
    pub fn new(delaunay: &Delaunay, progress: &Progress) -> Result<Self> {
        let triangles = delaunay.triangles();
        memory::check(triangles.len(), BYTES)?;
        let corners = |t: usize| triangles[t].map(|vertex| delaunay.point(vertex));
        let place = |t: usize| {
            #[cfg(test)]
            crate::progress::work_tests::count(crate::progress::work_tests::PLACE);
            (around(corners(t)), triangles[t])
        };
        let empty = (Bounds::EMPTY, [0; 3]);
        let mut places = map(triangles.len(), empty, &progress.quiet(), place)?;
        halve(&mut places, |(bounds, _)| bounds.low, progress)?;
        let boxes = Boxes::oriented(&places, |&(bounds, _)| bounds);
        Ok(Self { places, boxes })
    }

    /// The triangle of a vertex that `holds`, if there is one among those in boxes, seen from `p`, that `may_meet` admits.
    pub fn find(
        &self,
        p: Point,
        may_meet: impl Fn(&Seen) -> bool,
        holds: impl Fn([u32; 3]) -> bool,
    ) -> Option<[u32; 3]> {
        let mut found = None;
        self.boxes.any(&mut |around, _| may_meet(&around.seen_from(p)), &mut |number| {
            #[cfg(test)]
            crate::progress::work_tests::count(crate::progress::work_tests::BOX);
            let (bounds, triangle) = self.places[number as usize];
            found = (may_meet(&bounds.seen_from(p).into()) && holds(triangle)).then_some(triangle);
            found.is_some()
        });
        found
    }
}

/// A box around the circumcenter of a counter-clockwise triangle.
fn around(corners: [Point; 3]) -> Bounds {
    let Center { at, error } = Center::estimate(corners, corners[0]);
    let is_known = error <= UNCERTAIN * length(at);
    let at = if is_known { at } else { circumcenter(corners) };
    let error = if is_known { error } else { UNCERTAIN * length(at) };
    let center = [corners[0][0] + at[0], corners[0][1] + at[1]];
    if !center.iter().all(|x| x.is_finite()) {
        return Bounds { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };
    }
    let doubt = error + 2.0 * ROUNDING * (center[0].abs() + center[1].abs());
    Bounds { low: center.map(|x| x - doubt), high: center.map(|x| x + doubt) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::oriented::CORNERS;
    use std::cell::Cell;

    #[test]
    fn each_vertex_is_found_in_its_own_box() {
        let points: Vec<Point> = (0..1000_u32)
            .map(|k| [f64::from(k * 7919 % 1009), f64::from(k * 104_729 % 1013)])
            .collect();
        let progress = Progress::default();
        let delaunay = Delaunay::new(&points, &progress).expect("points");
        let vertices = VoronoiVertices::new(&delaunay, &progress).expect("memory");
        for triangle in delaunay.triangles() {
            let corners = triangle.map(|vertex| delaunay.point(vertex));
            let center = circumcenter(corners);
            let center = [corners[0][0] + center[0], corners[0][1] + center[1]];
            let looked = Cell::new(0);
            let may_meet = |seen: &Seen| {
                looked.set(looked.get() + 1);
                seen.bounds.square_to([0.0; 2]) <= (CORNERS * seen.reach).powi(2)
            };
            assert_eq!(vertices.find(center, may_meet, |other| other == triangle), Some(triangle));
            assert!(looked.get() < 200);
        }
    }
}
