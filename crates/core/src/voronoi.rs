//! Voronoi vertices by place, for disks that meet many more cells than they hold vertices.

use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::exact::circumcenter::{Center, circumcenter};
use crate::exact::filter::ROUNDING;
use crate::memory;
use crate::parts::map;
use crate::point::{Point, length};
use crate::progress::Progress;
use crate::space::halves::halve;
use crate::space::oriented::Place;
use crate::space::region::Region;
use crate::space::strips::Strips;

/// Memory for each triangle.
const BYTES: usize = 128;

/// A center is solved for where floating point leaves more than this part of its radius uncertain.
const UNCERTAIN: f64 = 1e-9;

/// The Voronoi vertices as triangles, in boxes.
#[derive(Debug)]
pub struct VoronoiVertices {
    /// Where the circumcenter is, hardly in doubt, of each triangle.
    vertices: Vec<(Place, [u32; 3])>,
    /// Vertices on a curve are met by disks that touch it, so boxes lie along them.
    strips: Strips,
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
        let quiet = progress.quiet();
        let places = map(triangles.len(), Place::default(), &quiet, |t| {
            #[cfg(test)]
            crate::progress::work_tests::count(crate::progress::work_tests::PLACE);
            place(corners(t))
        })?;
        let key = |t: usize| (places[t].at, t as u32);
        // Less to move than all that is known of each.
        let mut order = map(triangles.len(), Default::default(), &quiet, key)?;
        halve(&mut order, |&(at, _)| at, progress)?;
        let vertex = |k: usize| {
            let t = order[k].1 as usize;
            (places[t], triangles[t])
        };
        let vertices = map(triangles.len(), Default::default(), &quiet, vertex)?;
        let strips = Strips::new(&vertices, |&(place, _)| place);
        Ok(Self { vertices, strips })
    }

    /// For each of `regions`, the triangle of a vertex that it `holds`, if there is one.
    pub fn find(
        &self,
        regions: &[Region],
        holds: impl Fn(usize, [u32; 3]) -> bool,
    ) -> Vec<Option<[u32; 3]>> {
        let mut found = vec![None; regions.len()];
        self.strips.search(regions, |number, item| {
            #[cfg(test)]
            crate::progress::work_tests::count(crate::progress::work_tests::BOX);
            let (number, (place, triangle)) = (number as usize, self.vertices[item as usize]);
            let region = &regions[number];
            let may_hold = region.span(&place.seen_from(region.p)).is_some();
            let is_in = may_hold && holds(number, triangle);
            if is_in {
                found[number] = Some(triangle);
            }
            is_in
        });
        found
    }
}

/// Where the circumcenter of a counter-clockwise triangle is.
fn place(corners: [Point; 3]) -> Place {
    let Center { at, error } = Center::estimate(corners, corners[0]);
    let is_known = error <= UNCERTAIN * length(at);
    let at = if is_known { at } else { circumcenter(corners) };
    let error = if is_known { error } else { UNCERTAIN * length(at) };
    let center = [corners[0][0] + at[0], corners[0][1] + at[1]];
    if !center.iter().all(|x| x.is_finite()) {
        return Place { at: [0.0; 2], doubt: f64::INFINITY };
    }
    Place { at: center, doubt: error + 4.0 * ROUNDING * (center[0].abs() + center[1].abs()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::{dot, sub};
    use std::cell::Cell;

    fn centers(delaunay: &Delaunay) -> Vec<([u32; 3], Point)> {
        let center = |triangle: [u32; 3]| {
            let corners = triangle.map(|vertex| delaunay.point(vertex));
            let from = circumcenter(corners);
            (triangle, [corners[0][0] + from[0], corners[0][1] + from[1]])
        };
        delaunay.triangles().into_iter().map(center).collect()
    }

    #[test]
    fn a_vertex_is_found_in_each_disk_that_holds_one_and_each_is_in_a_small_disk_around_it() {
        let points: Vec<Point> = (0..1000_u32)
            .map(|k| [f64::from(k * 7919 % 1009), f64::from(k * 104_729 % 1013)])
            .collect();
        let progress = Progress::default();
        let delaunay = Delaunay::new(&points, &progress).expect("points");
        let vertices = VoronoiVertices::new(&delaunay, &progress).expect("memory");
        let centers = centers(&delaunay);
        let regions: Vec<Region> = centers
            .iter()
            .map(|(_, [x, y])| Region::new([x - 1e-6, *y], [1e-6, 0.0], 1e-6, 1e-9 * x.abs()))
            .collect();
        let looked = Cell::new(0);
        let found = vertices.find(&regions, |k, other| {
            looked.set(looked.get() + 1);
            other == centers[k].0
        });
        assert!(found.iter().zip(&centers).all(|(found, (own, _))| *found == Some(*own)));
        assert!(looked.get() < 2 * centers.len());
        for radius in [0.1, 10.0, 300.0, 1e5] {
            let disk = |k: usize| (points[k], [radius * 0.6, radius * 0.8]);
            let is_in = |k: usize, place: Point| {
                let (p, center) = disk(k);
                let from = sub(sub(place, p), center);
                dot(from, from) < radius * radius
            };
            let regions: Vec<Region> = (0..300)
                .map(|k| Region::new(disk(k).0, disk(k).1, radius, 1e-12 * radius))
                .collect();
            let place = |triangle| centers.iter().find(|(t, _)| *t == triangle).expect("one").1;
            let found = vertices.find(&regions, |k, triangle| is_in(k, place(triangle)));
            for (k, found) in found.into_iter().enumerate() {
                assert_eq!(found.is_some(), centers.iter().any(|(_, place)| is_in(k, *place)));
            }
        }
    }
}
