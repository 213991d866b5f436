//! What the edges at a vertex cost by two: an edge a lane, four lanes a quad, which is a vector of the processor's.
//!
//! Nothing branches on what the values are, for that is hard to foretell.

use super::constants::MOST_PAIRED;
use super::geometry::root_turns;
use std::array;
use wide::{f32x4, i32x4};

/// One value for each of so many times four edges.
pub type Quads<const Q: usize> = [f32x4; Q];

/// As many quads hold all edges that form pairs.
pub const MOST_QUADS: usize = MOST_PAIRED.div_ceil(4);
/// Lanes without an edge have this cost.
pub const INFINITE: f32x4 = f32x4::splat(f32::INFINITY);
/// What keeps the edge of each lane of a quad from being a pair with itself.
const SELF: Quads<4> = {
    let i = f32::INFINITY;
    [
        f32x4::new([i, 0.0, 0.0, 0.0]),
        f32x4::new([0.0, i, 0.0, 0.0]),
        f32x4::new([0.0, 0.0, i, 0.0]),
        f32x4::new([0.0, 0.0, 0.0, i]),
    ]
};
/// The numbers of the lanes.
pub const LANES: Quads<MOST_QUADS> = {
    let mut quads = [INFINITE; MOST_QUADS];
    let mut q = 0;
    while q < MOST_QUADS {
        let k = 4.0 * q as f32;
        quads[q] = f32x4::new([k, k + 1.0, k + 2.0, k + 3.0]);
        q += 1;
    }
    quads
};

/// The edges at a vertex that form pairs, and the weights of their turns and of their steps.
pub struct Paired<const Q: usize> {
    /// How many they are.
    pub count: usize,
    /// What each edge costs as seen from its other end.
    pub seen: Quads<Q>,
    /// Where each leads, in 2⁻³² turns.
    pub directions: [i32x4; Q],
    /// The logarithm of the length of each.
    pub lengths: Quads<Q>,
    /// What turns weigh.
    pub turn: f32x4,
    /// What steps weigh.
    pub step: f32x4,
}

/// What the edges at a vertex cost by two.
pub struct Pairs<const Q: usize> {
    /// In row j, lane i: what edge j costs beside edge i, at the vertex and as seen from its own other end.
    rows: [[Quads<Q>; 4]; Q],
    /// By lane: the least of its rows.
    beside: Quads<Q>,
    /// By lane: the second least of its rows.
    second: Quads<Q>,
    /// By lane: what the edge costs as seen from its other end.
    seen: Quads<Q>,
}

impl<const Q: usize> Pairs<Q> {
    /// The pairs of some edges.
    #[inline]
    pub fn new(edges: &Paired<Q>) -> Self {
        let Paired { count, seen, directions, lengths, turn, step } = edges;
        let infinite = [INFINITE; Q];
        let (mut rows, mut beside, mut second) = ([[infinite; 4]; Q], infinite, infinite);
        for r in 0..Q {
            for k in 0..4 {
                if r == Q - 1 && k == 2 && *count <= 4 * Q - 2 {
                    // Few vertices have edges in these two lanes; one branch costs less than their rows.
                    break;
                }
                let direction = i32x4::splat(directions[r].as_array()[k]);
                let [length, seen] = [lengths[r], seen[r]].map(|own| splat(own, k));
                for q in 0..Q {
                    let turn = *turn * root_turns(directions[q], direction);
                    let step = *step * (lengths[q] - length).abs();
                    let cost = turn + step + if q == r { seen + SELF[k] } else { seen };
                    rows[r][k][q] = cost;
                    second[q] = second[q].fast_min(beside[q].fast_max(cost));
                    beside[q] = beside[q].fast_min(cost);
                }
            }
        }
        Self { rows, beside, second, seen: *seen }
    }

    /// What the cheapest pair costs, and on less off, for each edge, given what an end costs and the point alone, and the two
    /// cheapest edges.
    #[inline]
    pub fn messages(&self, [end, alone]: [f32; 2], single: Least) -> (f32, Quads<Q>) {
        let sums: Quads<Q> = array::from_fn(|q| self.seen[q] + self.beside[q]);
        let best = least_of(&sums);
        let i = place(&sums, best);
        let column: Quads<Q> =
            array::from_fn(|q| f32x4::new(self.rows[q].map(|row| lane(&row, i))));
        let j = place(&column, lane(&self.beside, i));
        let [without_i, without_j] = [i, j].map(|k| f32x4::splat(self.without(k)));
        let [end, alone] = [end, alone].map(f32x4::splat);
        let messages = array::from_fn(|q| {
            let pair = is_lane(q, j).bitselect(without_j, f32x4::splat(best));
            let pair = is_lane(q, i).bitselect(without_i, pair);
            let off = alone.fast_min(end + single.without(self.seen[q])).fast_min(pair);
            end.fast_min(self.beside[q]) - off
        });
        (best, messages)
    }

    /// What the cheapest pair without lane `k` costs.
    #[inline]
    fn without(&self, k: usize) -> f32 {
        let row = &self.rows[k / 4][k % 4];
        least_of(&array::from_fn::<_, Q, _>(|q| {
            let is_cheapest = row[q].simd_eq(self.beside[q]);
            let rest = self.seen[q] + is_cheapest.bitselect(self.second[q], self.beside[q]);
            is_lane(q, k).bitselect(INFINITE, rest)
        }))
    }

    /// The two cheapest edges.
    #[inline]
    pub fn single(&self) -> Least {
        let (mut value, mut second) = (self.seen[0], INFINITE);
        for seen in &self.seen[1..] {
            second = second.fast_min(value.fast_max(*seen));
            value = value.fast_min(*seen);
        }
        // As vectors to the end: a choice between numbers would be a branch.
        for across in [[2, 3, 0, 1], [1, 0, 3, 2]] {
            let [others, seconds] = [value, second].map(|own| permuted(own, across));
            second = second.fast_min(seconds).fast_min(value.fast_max(others));
            value = value.fast_min(others);
        }
        Least { value: value.as_array()[0], second: second.as_array()[0] }
    }
}

#[inline]
fn permuted(quad: f32x4, places: [usize; 4]) -> f32x4 {
    f32x4::new(places.map(|k| quad.as_array()[k]))
}

/// The value of lane `k` of a quad, in all of them.
#[inline]
fn splat(quad: f32x4, k: usize) -> f32x4 {
    f32x4::splat(quad.as_array()[k])
}

/// The value of lane `k`.
#[inline]
pub fn lane<const Q: usize>(quads: &Quads<Q>, k: usize) -> f32 {
    quads[k / 4].as_array()[k % 4]
}

/// Directions, of which only differences count.
#[inline]
pub fn cast(directions: [u32; 4]) -> i32x4 {
    i32x4::new(directions.map(|own| own as i32))
}

/// Which lane of quad `q` is lane `k`, as a mask.
#[inline]
fn is_lane(q: usize, k: usize) -> f32x4 {
    LANES[q].simd_eq(f32x4::splat(k as f32))
}

/// The first lane of a value that is in one of them.
#[inline]
fn place<const Q: usize>(quads: &Quads<Q>, value: f32) -> usize {
    let equal = |q: usize| quads[q].simd_eq(f32x4::splat(value)).to_bitmask() << (4 * q);
    let bits = (0..Q).fold(0, |bits, q| bits | equal(q));
    bits.trailing_zeros() as usize % (4 * Q)
}

#[inline]
fn least_of<const Q: usize>(quads: &Quads<Q>) -> f32 {
    let [a, b, c, d] = quads.iter().fold(INFINITE, |least, quad| least.fast_min(*quad)).to_array();
    least(least(a, c), least(b, d))
}

/// The two least of some costs.
#[derive(Clone, Copy)]
pub struct Least {
    value: f32,
    second: f32,
}

impl Least {
    /// These and one more.
    #[inline]
    pub fn meet(self, value: f32) -> Self {
        let more = if self.value < value { value } else { self.value };
        Self { value: least(self.value, value), second: least(self.second, more) }
    }

    /// For each of some of them, the least of the others.
    #[inline]
    fn without(self, values: f32x4) -> f32x4 {
        let least = f32x4::splat(self.value);
        least.simd_lt(values).bitselect(least, f32x4::splat(self.second))
    }

    /// On less off, for an edge that forms no pairs, given what an end costs and the point alone, and the cheapest pair.
    #[inline]
    pub fn message(self, [end, alone]: [f32; 2], seen: f32, pair: f32) -> f32x4 {
        let single = self.without(f32x4::splat(seen));
        let [end, alone, pair] = [end, alone, pair].map(f32x4::splat);
        end - alone.fast_min(end + single).fast_min(pair)
    }
}

/// The lesser number, without a thought of NaN: one instruction.
#[inline]
fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}
