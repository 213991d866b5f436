//! The circles through the corners of the triangles: Voronoi vertices, with bounds on their errors.

use crate::delaunay::{Delaunay, triangle_parts, vertices_of_part};
use crate::error::Result;
use crate::exact::circumcenter::{Center, circumcenter};
use crate::exact::filter::ROUNDING;
use crate::parts::{each, split, try_each};
use crate::point::{Point, length, sub};
use crate::progress::Progress;

/// The circles of all triangles, in the scale of the triangulation.
pub struct Circles {
    pub centers: Vec<Point>,
    pub radii: Vec<f64>,
    /// Bounds on the distance from each center to the true one.
    errors: Vec<f64>,
}

impl Circles {
    /// Of the triangulation with `first` as the first triangles of its vertices.
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn new(delaunay: &Delaunay, first: &[u32], progress: &Progress) -> Result<Self> {
        let count = first.last().map_or(0, |&count| count as usize);
        let mut circles = Self {
            centers: vec![[0.0; 2]; count],
            radii: vec![0.0; count],
            errors: vec![0.0; count],
        };
        let centers = split(&mut circles.centers, triangle_parts(first));
        let radii = split(&mut circles.radii, triangle_parts(first));
        let errors = split(&mut circles.errors, triangle_parts(first));
        let parts = centers.into_iter().zip(radii).zip(errors).collect();
        try_each(parts, |k, ((centers, radii), errors)| {
            let mut slots = centers.iter_mut().zip(radii).zip(errors);
            for p in vertices_of_part(first, k) {
                for (triangle, slot) in delaunay.triangles_from(p).zip(&mut slots) {
                    let ((center, radius), error) = slot;
                    (*center, *radius, *error) = circle(delaunay, triangle);
                }
            }
            progress.advance(vertices_of_part(first, k).len())
        })?;
        Ok(circles)
    }

    /// Are the centers certainly not the same?
    pub fn differ(&self, a: u32, b: u32) -> bool {
        let (a, b) = (a as usize, b as usize);
        let step = sub(self.centers[a], self.centers[b]);
        step[0].abs().max(step[1].abs()) > 1.001 * (self.errors[a] + self.errors[b])
    }

    /// The centers and radii of those that are `used`, divided by `scale`.
    pub fn used(self, used: &[bool], scale: f64) -> (Vec<Point>, Vec<f64>) {
        let Self { mut centers, mut radii, errors } = self;
        drop(errors);
        if !used.iter().all(|&is_used| is_used) {
            keep(&mut centers, used);
            keep(&mut radii, used);
        }
        each(centers.as_flattened_mut().chunks_mut(GRAIN).collect(), |_, part| divide(part, scale));
        each(radii.chunks_mut(GRAIN).collect(), |_, part| divide(part, scale));
        (centers, radii)
    }
}

/// Numbers that one task takes at a time.
const GRAIN: usize = 1 << 14;

fn divide(numbers: &mut [f64], scale: f64) {
    for x in numbers {
        *x /= scale;
    }
}

/// Keep those of `values` that are `used`, where they are: fresh memory costs more than the serial pass.
fn keep<T>(values: &mut Vec<T>, used: &[bool]) {
    let mut used = used.iter();
    values.retain(|_| used.next() == Some(&true));
}

/// Where a center is known to this part of its radius, floating point is good enough.
///
/// A flat triangle's center depends on the rounding of the samples themselves by more than this.
const ACCURACY: f64 = 1e-7;

/// The center, the radius, and the bound on the error.
fn circle(delaunay: &Delaunay, triangle: [u32; 3]) -> (Point, f64, f64) {
    let corners = triangle.map(|vertex| delaunay.point(vertex));
    let Center { at, error } = Center::estimate(corners, corners[0]);
    let is_known = error <= ACCURACY * length(at);
    let from = if is_known { at } else { circumcenter(corners) };
    let center = [corners[0][0] + from[0], corners[0][1] + from[1]];
    let rounding = ROUNDING * (center[0].abs() + center[1].abs());
    (center, length(from), if is_known { error + rounding } else { f64::INFINITY })
}
