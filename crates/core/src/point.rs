//! Points of the plane and the two products that all the geometry is made of.

/// A point, or a vector, of the plane: x and y.
pub type Point = [f64; 2];

/// The vector from `a` to `b`, each coordinate correctly rounded.
#[must_use]
pub fn sub(b: Point, a: Point) -> Point {
    [b[0] - a[0], b[1] - a[1]]
}

/// The dot product.
#[must_use]
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The cross product: twice the signed area of the triangle 0, `a`, `b`.
#[must_use]
pub fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// `v` in the frame whose first axis is `along`, of length one.
#[inline]
#[must_use]
pub fn turned(along: Point, v: Point) -> Point {
    [dot(along, v), cross(along, v)]
}

/// The lexicographic order by x, then y.
///
/// # Panics
/// If a coordinate is not a number; points are finite by the time they are here.
#[must_use]
pub fn lexicographic(a: &Point, b: &Point) -> std::cmp::Ordering {
    // 0.0 and -0.0 are one coordinate, so `total_cmp` would not do.
    a.partial_cmp(b).expect("coordinates are finite")
}

/// The length of `v`, without the cost of `hypot` where squares neither overflow nor vanish.
#[inline]
#[must_use]
pub fn length(v: Point) -> f64 {
    let square = dot(v, v);
    if square.is_normal() { square.sqrt() } else { libm::hypot(v[0], v[1]) }
}
