//! The circles through the corners of the triangles: Voronoi vertices.

use crate::delaunay::{Delaunay, triangle_parts, vertices_of_part};
use crate::error::Result;
use crate::exact::circumcenter::{Center, circumcenter};
use crate::parts::{split, try_each};
use crate::point::{Point, length};
use crate::progress::Progress;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The circles of all triangles, in the scale of the input.
pub struct Circles {
    pub centers: Vec<Point>,
    pub radii: Vec<f64>,
    /// Is each of these numbers finite?
    pub are_finite: bool,
}

impl Circles {
    /// Of the triangulation with `first` as the first triangles of its vertices.
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn new(delaunay: &Delaunay, first: &[u32], progress: &Progress) -> Result<Self> {
        let count = first.last().map_or(0, |&count| count as usize);
        let (mut centers, mut radii) = (vec![[0.0; 2]; count], vec![0.0; count]);
        let parts = split(&mut centers, triangle_parts(first)).into_iter();
        let parts = parts.zip(split(&mut radii, triangle_parts(first))).collect();
        let is_any_far = AtomicBool::new(false);
        try_each(parts, |k, (centers, radii)| {
            let mut slots = centers.iter_mut().zip(radii);
            let mut are_finite = true;
            for p in vertices_of_part(first, k) {
                for (triangle, (center, radius)) in delaunay.triangles_from(p).zip(&mut slots) {
                    (*center, *radius) = circle(delaunay, triangle);
                    are_finite &=
                        center[0].is_finite() & center[1].is_finite() & radius.is_finite();
                }
            }
            if !are_finite {
                is_any_far.store(true, Relaxed);
            }
            progress.advance(vertices_of_part(first, k).len())
        })?;
        Ok(Self { centers, radii, are_finite: !is_any_far.into_inner() })
    }

    /// Keep those that are `used`.
    pub fn keep(&mut self, used: &[bool]) {
        keep(&mut self.centers, used);
        keep(&mut self.radii, used);
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

/// The center and the radius, in the scale of the input.
fn circle(delaunay: &Delaunay, triangle: [u32; 3]) -> (Point, f64) {
    let corners = triangle.map(|vertex| delaunay.point(vertex));
    let Center { at, error } = Center::estimate(corners, corners[0]);
    let radius = length(at);
    let (at, radius) = if error <= ACCURACY * radius {
        (at, radius)
    } else {
        let at = circumcenter(corners);
        (at, length(at))
    };
    let scale = delaunay.scale();
    ([0, 1].map(|axis| (corners[0][axis] + at[axis]) / scale), radius / scale)
}
