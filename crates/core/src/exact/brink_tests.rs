//! Where a filter is most likely to mislead: the doubles around the place at which a decision changes.

use crate::exact::sign::{Form, big_sign};
use crate::point::Point;
use crate::xorshift::Xorshift;
use std::cmp::Ordering;

/// How many changes of sign are looked at; some sets of points have none, however one coordinate is moved.
const CHANGES: usize = 250;
const TRIALS: usize = 20_000;

/// Coordinates of many sizes: a filter that takes a size for too small is misled by those that differ most.
struct Coordinates(Xorshift);

impl Coordinates {
    fn below(&mut self, limit: u64) -> u64 {
        (self.0.next() >> 11) % limit
    }
    fn coordinate(&mut self) -> f64 {
        // Few bits make ties, many make roundings.
        let bits = [3, 26, 52][self.below(3) as usize];
        let mantissa = self.below(1 << bits) as f64 - 2f64.powi(bits - 1);
        mantissa * 2f64.powi(12 - bits - self.below(24) as i32)
    }
    fn point(&mut self) -> Point {
        [self.coordinate(), self.coordinate()]
    }
}

/// Check points at which the sign of `form` changes, to the next double of one coordinate, and others near them.
///
/// The sign that `check` is told is that by integers of any size. The origin is zero if `is_central`.
pub fn at_brinks<const N: usize>(
    form: &impl Form<N>,
    is_central: bool,
    mut check: impl FnMut(Point, [Point; N], Ordering),
) {
    let mut random = Coordinates(Xorshift(20_261));
    let mut changes = 0;
    for _ in 0..TRIALS {
        let origin = if is_central { [0.0; 2] } else { random.point() };
        let points: [Point; N] = std::array::from_fn(|_| random.point());
        let (k, axis) = (random.below(N as u64) as usize, random.below(2) as usize);
        let moved = |x: f64| {
            let mut points = points;
            points[k][axis] = x;
            (points, big_sign(form, origin, &points))
        };
        let ends = [random.coordinate(), random.coordinate()];
        let Some(brink) = brink(ends, |x| moved(x).1) else { continue };
        changes += 1;
        if changes > CHANGES {
            return;
        }
        for x in about(brink) {
            let (points, sign) = moved(x);
            check(origin, points, sign);
        }
    }
    panic!("only {changes} changes of sign were met");
}

/// The doubles next to `x`, and some farther off, where filters begin to tell.
fn about(x: f64) -> impl Iterator<Item = f64> {
    let first = (0..3).fold(x, |x, _| x.next_down());
    let near = std::iter::successors(Some(first), |x| Some(x.next_up())).take(8);
    let far = (4..48).flat_map(move |bits| [1.0, -1.0].map(|side| x + side * x * 2f64.powi(-bits)));
    near.chain(far)
}

/// Where `sign` changes between the ends, if it differs there.
fn brink([mut a, mut b]: [f64; 2], sign: impl Fn(f64) -> Ordering) -> Option<f64> {
    let start = sign(a);
    if sign(b) == start {
        return None;
    }
    loop {
        let middle = f64::midpoint(a, b);
        if middle == a || middle == b {
            return Some(a);
        }
        *(if sign(middle) == start { &mut a } else { &mut b }) = middle;
    }
}
