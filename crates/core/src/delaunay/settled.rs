//! Which vertices of a leaf no merge will touch.
//!
//! A leaf is a cell of the Z-order, so no other vertex is in the rectangle around its own. A triangle whose disk lies in there is one of
//! the whole triangulation. As seen from a point outside, triangles whose disk holds it lie in front of one another up to the hull (H. Edelsbrunner, "An
//! acyclicity theorem for cell complexes in d dimensions", Combinatorica 10 (1990)), so from the hull on all triangles are found that may go.

use super::leaf::Leaf;
use super::rings::{Graph, Index, Rings, hull_edges};
use crate::exact::filter::UNDERFLOW;
use crate::point::{Point, cross, dot, sub};
use crate::space::bounds::Bounds;

/// Triangles, about, that tell whether most are settled.
const ASKED: u16 = 256;

/// Which of the `count` vertices of `leaf` a merge may touch, where all others are out of `bounds`: those on its hull, which `hull` is a half-edge
/// of, and those of the triangles whose disk may reach out, and that hang together with it. None if these are many, so that it does not pay.
pub fn open_vertices(leaf: &Leaf, count: usize, hull: u16, bounds: &Bounds) -> Option<Vec<bool>> {
    if !is_mostly_settled(leaf, bounds) {
        return None;
    }
    let mut is_open = vec![false; count];
    // Whether the triangle to the left of a half-edge has been looked at.
    let mut is_seen = vec![false; leaf.used() as usize];
    let mut front: Vec<u16> = hull_edges(leaf, hull).collect();
    for &e in &front {
        is_open[leaf.origin(e) as usize] = true;
        is_seen[e.twin() as usize] = true;
    }
    while let Some(e) = front.pop() {
        if is_seen[e as usize] {
            continue;
        }
        let sides = sides(leaf, e);
        let corners = sides.map(|side| leaf.origin(side));
        for side in sides {
            is_seen[side as usize] = true;
        }
        if !holds_disk(bounds, corners.map(|corner| leaf.point(corner))) {
            for corner in corners {
                is_open[corner as usize] = true;
            }
            front.extend(sides.map(Index::twin));
        }
    }
    Some(is_open)
}

/// The sides of the triangle to the left of `e`, which is one of them.
#[inline]
fn sides(leaf: &Leaf, e: u16) -> [u16; 3] {
    [e, leaf.prev(e.twin()), leaf.next(e).twin()]
}

/// Do the disks of all but few triangles lie in `bounds`? Else it does not pay to look at all, as where leaves hold few curves. It is asked of some.
fn is_mostly_settled(leaf: &Leaf, bounds: &Bounds) -> bool {
    let step = (leaf.used() / ASKED).max(1) | 1;
    let (mut settled, mut all) = (0, 0);
    for e in (0..leaf.used()).step_by(step.into()).filter(|&e| !leaf.is_free(e)) {
        let corners = sides(leaf, e).map(|side| leaf.point(leaf.origin(side)));
        settled += u32::from(holds_disk(bounds, corners));
        all += 1;
    }
    6 * settled > 5 * all
}

/// Does the disk of a triangle lie in `bounds`? True only if it certainly does.
///
/// Where the sine of the angle at `a` is above 10⁻⁶ the center, and so the radius, is off by less than 10⁻⁸ times the two sides there: no product below is
/// off by more than 10⁻¹⁵ of its factors, and the quotient multiplies that by 10⁶.
fn holds_disk(bounds: &Bounds, [a, b, c]: [Point; 3]) -> bool {
    let (b, c) = (sub(b, a), sub(c, a));
    let [bb, cc] = [b, c].map(|side| dot(side, side));
    let double = 2.0 * cross(b, c);
    let sides = (bb * cc).sqrt();
    let from_a = [(c[1] * bb - b[1] * cc) / double, (b[0] * cc - c[0] * bb) / double];
    let reach = dot(from_a, from_a).sqrt() + 1e-7 * (bb.sqrt() + cc.sqrt());
    let is_in = |k: usize| {
        let center = a[k] + from_a[k];
        let reach = reach + 1e-14 * (a[k].abs() + reach);
        center - reach > bounds.low[k] && center + reach < bounds.high[k]
    };
    // What is not a number is not in.
    double.abs() > 2e-6 * sides + UNDERFLOW && is_in(0) && is_in(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disk_is_in_bounds_that_it_does_not_touch() {
        let unit = |x: f64| Bounds { low: [-x; 2], high: [x; 2] };
        let corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
        for shift in 0..3 {
            let corners = [0, 1, 2].map(|k| corners[(k + shift) % 3]);
            assert!(holds_disk(&unit(1.000_001), corners));
            assert!(!holds_disk(&unit(1.0), corners));
        }
        assert!(!holds_disk(&Bounds::EMPTY, corners));
        assert!(!holds_disk(&unit(1e9), [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]));
        assert!(!holds_disk(&unit(1.0), [[0.0; 2]; 3]));
    }
}
