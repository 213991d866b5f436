//! Disks whose points a verdict rests on, never smaller than they should be.

use crate::exact::circumcenter::circumcenter;
use crate::exact::pencil::{Circle, Pencil, Vertex};
use crate::point::{Point, length, sub};
use crate::space::bounds::Bounds;

/// More than all relative roundings of a center and a radius.
const SLACK: f64 = 1e-9;

/// A closed disk, in the scale of the triangulation.
#[derive(Debug, Clone, Copy)]
pub struct Disk {
    /// The center.
    pub center: Point,
    /// The radius, rounded up.
    pub radius: f64,
}

impl Disk {
    /// The disk around `from` + `center` whose radius is known but for an `error`.
    pub(super) fn new(from: Point, center: Point, radius: f64, error: f64) -> Self {
        let center = [from[0] + center[0], from[1] + center[1]];
        let rounding = 4.0 * f64::EPSILON * (center[0].abs() + center[1].abs());
        let radius = radius * (1.0 + SLACK) + 4.0 * error + rounding;
        if radius.is_finite() {
            Self { center, radius }
        } else {
            Self { center: from, radius: f64::INFINITY }
        }
    }

    /// Does it meet a rectangle? Its radius has been rounded up by more than this rounds.
    #[inline]
    pub(super) fn meets(&self, bounds: &Bounds) -> bool {
        bounds.square_to(self.center) <= self.radius * self.radius
    }

    /// The square around the disk, grown by more than this and `meets` round, so that nothing outside of it meets the disk.
    pub(super) fn square(&self) -> Bounds {
        let [x, y] = self.center;
        let half = self.radius * (1.0 + SLACK) + 8.0 * f64::EPSILON * (x.abs() + y.abs());
        Bounds { low: [x - half, y - half], high: [x + half, y + half] }
    }

    /// The disk inside a circle through p and q that is centered at the height `tangent` · |p q| / 2 to the left of p → q.
    pub(super) fn at_height(pencil: &Pencil, tangent: f64, error: f64) -> Self {
        let [dx, dy] = sub(pencil.q, pencil.p).map(|x| x / 2.0);
        let half = length([dx, dy]);
        let center = [dx - tangent * dy, dy + tangent * dx];
        Self::new(pencil.p, center, half * tangent.hypot(1.0), half * error)
    }

    /// Around the center of `circle`, all points that the Voronoi diagram inside the circle depends on.
    ///
    /// With ρ the radius and t the distance of the center from the midpoint of p and q, each place x in the disk has its nearest
    /// point no farther than min(|xp|, |xq|) ≤ √(2ρ(ρ + |t|)). A point farther than ρ + √(2ρ(ρ + |t|)) from the center is nearest to
    /// none of them, so it neither makes nor removes a Voronoi vertex there.
    pub(super) fn influence(pencil: &Pencil, circle: Circle) -> Self {
        let disk = pencil.disk(circle);
        let middle = sub(pencil.q, pencil.p).map(|x| x / 2.0);
        let height = length(sub(disk.center, middle));
        let nearest = (2.0 * disk.radius * (disk.radius + height)).sqrt();
        Self::new(pencil.p, disk.center, disk.radius + nearest, 4.0 * disk.error)
    }

    /// The disk that must be empty for `vertex` to be a Voronoi vertex.
    pub(super) fn around(vertex: &Vertex) -> Self {
        let center = circumcenter(vertex.triangle());
        Self::new(vertex.triangle()[0], center, length(center), 0.0)
    }
}
