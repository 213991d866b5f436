//! Gathan.
//!
//! T. K. Dey and R. Wenger, "Reconstructing Curves with Sharp Corners", Computational Geometry: Theory
//! and Applications 19 (2001). A long Voronoi cell shows the normal at its point; an edge of the
//! curve runs across it.

use super::length::compare_distances;
use super::neighborhood::mutual;
use crate::cocircular::is_tied;
use crate::delaunay::{Delaunay, Edge, Star};
use crate::edges::Edges;
use crate::error::{Error, Result};
use crate::exact::circumcenter::HomogeneousCenter;
use crate::exact::constant::{Constant, fraction};
use crate::exact::sign::{self, Form, Number};
use crate::point::Point;
use crate::progress::Progress;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// The edges whose ends ask for each other: each point for the shortest on either side of its normal
/// that runs at a small angle to the tangent and is short beside the cell.
///
/// The normal points to the pole, the farthest Voronoi vertex of the point's cell, and on the hull is
/// across the chord of the hull's neighbors. `sine` is that of the largest angle between an edge and
/// the tangent, `ratio` the least of the distance to the pole over the length of the edge. Equally
/// short edges, and those for any of equally far poles, are all in. O(n log n).
///
/// # Errors
/// A `sine` that is not from 0 to 1, a `ratio` that is negative or not finite, or a cancelled `progress`.
pub fn gathan(delaunay: &Delaunay, sine: f64, ratio: f64, progress: &Progress) -> Result<Edges> {
    if !(0.0..=1.0).contains(&sine) {
        let message = format!("the sine of the angle must be from 0 to 1, not {sine}");
        return Err(Error::Argument { message });
    }
    if !(ratio >= 0.0 && ratio.is_finite()) {
        let message = format!("ratio must be a finite number of at least 0, not {ratio}");
        return Err(Error::Argument { message });
    }
    let conditions = Conditions { delaunay, sine: squares(sine), ratio: squares(ratio) };
    mutual(delaunay, progress, |p| conditions.asked_for(p))
}

/// The squares of the numerator and the denominator of the double `x`.
fn squares(x: f64) -> [Constant; 2] {
    fraction(x).map(|value| Constant::new(&(&value * &value)))
}

/// The direction of a normal: to the center of the point and two others, or across a chord.
#[derive(Debug, Clone, Copy)]
struct Normal {
    is_pole: bool,
    ends: [Point; 2],
}

struct Conditions<'a> {
    delaunay: &'a Delaunay,
    sine: [Constant; 2],
    ratio: [Constant; 2],
}

impl Conditions<'_> {
    /// The other ends of the edges that `p` asks for.
    fn asked_for(&self, p: u32) -> Vec<u32> {
        let star = self.delaunay.star(p);
        let neighbors: Vec<u32> = (0..star.neighbors.len())
            .filter(|&k| !is_tied(self.delaunay, edge(p, star, k)))
            .map(|k| star.neighbors[k])
            .collect();
        let mut asked_for = Vec::new();
        for normal in self.normals(p, star) {
            for side in [Less, Greater] {
                let admitted = neighbors.iter().filter(|&&q| self.admits(p, &normal, q, side));
                self.shortest(p, admitted.copied(), &mut asked_for);
            }
        }
        asked_for
    }

    /// The normals at `p`: one, but where several Voronoi vertices are equally far.
    fn normals(&self, p: u32, star: Star<'_>) -> Vec<Normal> {
        let (at, [first, last]) = (|vertex| self.delaunay.point(vertex), ends(p, star));
        if star.on_hull {
            return vec![Normal { is_pole: false, ends: [at(last), at(first)] }];
        }
        let mut poles: Vec<[Point; 2]> = Vec::new();
        for (a, b) in star.wedges() {
            let center = [at(a), at(b)];
            let order = poles.first().map_or(Equal, |&best| farther(at(p), center, best));
            if order.is_gt() {
                poles.clear();
            }
            if order.is_ge() {
                poles.push(center);
            }
        }
        poles.into_iter().map(|ends| Normal { is_pole: true, ends }).collect()
    }

    /// Does the edge from `p` to `q`, on this `side` of the normal, fulfill both conditions?
    fn admits(&self, p: u32, normal: &Normal, q: u32, side: Ordering) -> bool {
        let [p, q] = [p, q].map(|vertex| self.delaunay.point(vertex));
        let (is_pole, at) = (normal.is_pole, [q, normal.ends[0], normal.ends[1]]);
        let slope = Slope { is_pole, sine: &self.sine };
        sign::sign(&Side { is_pole }, p, &at) == side
            && sign::sign(&slope, p, &at) != Less
            && (!is_pole || sign::sign(&Height { ratio: &self.ratio }, p, &at) != Less)
    }

    /// Add all of `among` at the least distance from `p`.
    fn shortest(&self, p: u32, among: impl Iterator<Item = u32> + Clone, to: &mut Vec<u32>) {
        let at = |vertex| self.delaunay.point(vertex);
        let compare = |&a: &u32, &b: &u32| compare_distances(at(p), at(a), at(b));
        if let Some(best) = among.clone().min_by(compare) {
            to.extend(among.filter(|s| compare(s, &best) == Equal));
        }
    }
}

/// Number `k` of the edges of `star`, that of `p`.
fn edge(p: u32, star: Star<'_>, k: usize) -> Edge {
    Edge { p, q: star.neighbors[k], left: star.left(k), right: star.right(k) }
}

/// The next and the last point along the hull; at the end of a line the point itself is one of them.
fn ends(p: u32, star: Star<'_>) -> [u32; 2] {
    match star.neighbors {
        [] => [p, p],
        &[only] => [only, p],
        &[first, .., last] => [first, last],
    }
}

/// The distance from `p` to its circumcenter with the two of `a`, compared with that of `b`.
fn farther(p: Point, a: [Point; 2], b: [Point; 2]) -> Ordering {
    sign::sign(&Farther, p, &[a[0], a[1], b[0], b[1]])
}

/// The circumcenter of the origin and two points.
fn center<T: Number>(a: &[T; 2], b: &[T; 2]) -> HomogeneousCenter<T> {
    let origin = [T::integer(0), T::integer(0)];
    HomogeneousCenter::new(&origin, a, b)
}

/// The normal as a vector, of degree 3 or 1.
fn normal<T: Number>(is_pole: bool, a: &[T; 2], b: &[T; 2]) -> [T; 2] {
    if is_pole {
        return center(a, b).at;
    }
    let [x, y] = sign::difference(b, a);
    [T::integer(0).minus(&y), x]
}

/// The squared distance to one circumcenter, less that to the other.
struct Farther;

impl Form<4> for Farther {
    fn bound(&self, bits: u32) -> u32 {
        10 * bits + 16
    }
    fn value<T: Number>(&self, [a, b, c, d]: &[[T; 2]; 4]) -> T {
        let (v, w) = (center(a, b), center(c, d));
        let far = sign::dot(&v.at, &v.at).times(&w.w.times(&w.w));
        far.minus(&sign::dot(&w.at, &w.at).times(&v.w.times(&v.w)))
    }
}

/// On which side of the normal a point is.
struct Side {
    is_pole: bool,
}

impl Form<3> for Side {
    fn bound(&self, bits: u32) -> u32 {
        4 * bits + 6
    }
    fn value<T: Number>(&self, [q, a, b]: &[[T; 2]; 3]) -> T {
        sign::cross(&normal(self.is_pole, a, b), q)
    }
}

/// sin² |n|² |q|² − (n·q)²: 0 or more if the edge to q is near enough to the tangent.
struct Slope<'a> {
    is_pole: bool,
    sine: &'a [Constant; 2],
}

impl Form<3> for Slope<'_> {
    fn bound(&self, bits: u32) -> u32 {
        8 * bits + 12 + self.sine.iter().map(Constant::bits).max().unwrap_or(0)
    }
    fn value<T: Number>(&self, [q, a, b]: &[[T; 2]; 3]) -> T {
        let n = normal(self.is_pole, a, b);
        let along = sign::dot(&n, q);
        let [above, below] = self.sine.each_ref().map(Constant::number::<T>);
        let whole = above.times(&sign::dot(&n, &n)).times(&sign::dot(q, q));
        whole.minus(&below.times(&along.times(&along)))
    }
}

/// |pole|² − ratio² |q|²: 0 or more if the edge to q is short beside the cell.
struct Height<'a> {
    ratio: &'a [Constant; 2],
}

impl Form<3> for Height<'_> {
    fn bound(&self, bits: u32) -> u32 {
        6 * bits + 12 + self.ratio.iter().map(Constant::bits).max().unwrap_or(0)
    }
    fn value<T: Number>(&self, [q, a, b]: &[[T; 2]; 3]) -> T {
        let pole = center(a, b);
        let [above, below] = self.ratio.each_ref().map(Constant::number::<T>);
        let height = below.times(&sign::dot(&pole.at, &pole.at));
        height.minus(&above.times(&sign::dot(q, q)).times(&pole.w.times(&pole.w)))
    }
}
