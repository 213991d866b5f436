//! Min-sum message passing: every edge is a binary variable in the two factors of its ends.
//!
//! The message of a vertex to an edge is what the edge costs at that vertex beyond its absence, all else at its best
//! (J. Pearl, "Probabilistic Reasoning in Intelligent Systems", 1988). All are sent at once, and damped.

use super::approximation::HALF_TURN;
use super::candidates::{Candidates, GRAIN, each};
use super::constants::{CONVERGED, DAMPING, MOST_PAIRED};
use super::costs::Costs;
use super::geometry::{Spacing, Turns, root_turn};
use crate::error::Result;
use crate::parts::split;
use crate::progress::Progress;
use std::mem::swap;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// What the messages run on.
#[derive(Clone, Copy)]
pub struct Factors<'a> {
    /// The edges.
    pub candidates: &'a Candidates,
    /// Their lengths.
    pub spacing: &'a Spacing<'a>,
    /// The turns between them.
    pub turns: &'a Turns,
    /// Their costs.
    pub costs: &'a Costs,
}

/// One sweep: the messages sent before, and who sends now and next time.
struct Sweep<'a> {
    sent: &'a [f32],
    active: &'a [AtomicBool],
    later: &'a [AtomicBool],
    /// How much of a message's change is made.
    share: f32,
}

impl Factors<'_> {
    /// Send messages until none changes any more, in at most so many sweeps, starting from those in `sent`.
    ///
    /// Only vertices that a changed message reaches, and those whose own still move, send again.
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn converge(&self, sweeps: usize, sent: &mut Vec<f32>, progress: &Progress) -> Result<()> {
        let flags = |is_active: bool| -> Vec<AtomicBool> {
            (0..self.candidates.vertices()).map(|_| AtomicBool::new(is_active)).collect()
        };
        let (mut active, mut later) = (flags(true), flags(false));
        let mut fresh = sent.clone();
        for k in 0..sweeps {
            // Nothing swings yet in the first sweep.
            let share = if k == 0 { 1.0 } else { DAMPING };
            let sweep = Sweep { sent, active: &active, later: &later, share };
            let parts = split(&mut fresh, self.candidates.grains());
            each(parts, |(k, fresh)| self.write(k, &sweep, fresh));
            progress.advance(0)?;
            swap(sent, &mut fresh);
            swap(&mut active, &mut later);
            if !active.iter().any(|flag| flag.load(Relaxed)) {
                break;
            }
        }
        Ok(())
    }

    /// Write the messages of part `k`: new ones of its active vertices, which are not active any more.
    fn write(&self, k: usize, sweep: &Sweep<'_>, fresh: &mut [f32]) {
        let mut work = Work::default();
        let vertices = k * GRAIN..((k + 1) * GRAIN).min(self.candidates.vertices());
        let first = self.candidates.from(vertices.start).start;
        fresh.copy_from_slice(&sweep.sent[first..first + fresh.len()]);
        for v in vertices {
            if sweep.active[v].swap(false, Relaxed) {
                self.send(v, sweep.sent, &mut work);
                let range = self.candidates.from(v);
                let own = &mut fresh[range.start - first..range.end - first];
                self.damp(v, &work.messages, sweep, own);
            }
        }
    }

    /// Move the messages of `v` towards new ones; where one changed, both ends send again.
    fn damp(&self, v: usize, messages: &[f32], sweep: &Sweep<'_>, own: &mut [f32]) {
        let mut moves = false;
        for ((own, &message), &end) in
            own.iter_mut().zip(messages).zip(self.candidates.neighbors(v))
        {
            let change = sweep.share * (message - *own);
            *own = if sweep.share == 1.0 { message } else { *own + change };
            if change.abs() > CONVERGED {
                sweep.later[end as usize].store(true, Relaxed);
                moves = true;
            }
        }
        if moves {
            sweep.later[v].store(true, Relaxed);
        }
    }

    /// Put the messages of `v` into `work`.
    fn send(&self, v: usize, sent: &[f32], work: &mut Work) {
        let Self { candidates, spacing, turns, costs } = self;
        let range = candidates.from(v);
        work.incoming.clear();
        let twins = &candidates.twins[range.clone()];
        let edges = &costs.edges[range.clone()];
        work.incoming
            .extend(edges.iter().zip(twins).map(|(cost, &twin)| cost + sent[twin as usize]));
        let paired = range.start..range.start + candidates.pairs(v);
        let edges = Paired {
            directions: &turns.directions[paired.clone()],
            lengths: &spacing.lengths[paired],
            turn: costs.turns[v],
            step: costs.steps[v],
        };
        let prices = [costs.ends[v], costs.alone[v]];
        match edges.lengths.len() {
            0..=4 => work.answer(&Pairs::<4>::new(&edges, &work.incoming), prices),
            5..=8 => work.answer(&Pairs::<8>::new(&edges, &work.incoming), prices),
            _ => work.answer(&Pairs::<MOST_LANES>::new(&edges, &work.incoming), prices),
        }
    }

    /// The belief in each edge, by half-edge: what it costs beyond its absence, all else at its best.
    #[must_use]
    pub fn beliefs(&self, sent: &[f32]) -> Vec<f32> {
        self.candidates.map(0.0, |v, own| {
            for (own, e) in own.iter_mut().zip(self.candidates.from(v)) {
                let twin = self.candidates.twins[e] as usize;
                *own = self.costs.edges[e] + (sent[e] + sent[twin]);
            }
        })
    }
}

/// The two least of some costs, and what gave the least.
#[derive(Clone, Copy)]
struct Least {
    value: f32,
    second: f32,
    index: usize,
}

impl Least {
    const NONE: Self = Self { value: f32::INFINITY, second: f32::INFINITY, index: usize::MAX };

    /// Without branches: which is the least is hard to foretell.
    #[inline]
    fn meet(&mut self, value: f32, index: usize) {
        let is_less = value < self.value;
        self.second = least(self.second, if is_less { self.value } else { value });
        self.index = if is_less { index } else { self.index };
        self.value = least(self.value, value);
    }

    #[inline]
    fn without(&self, index: usize) -> f32 {
        if self.index == index { self.second } else { self.value }
    }
}

/// The lesser number, without a thought of NaN: one instruction.
#[inline]
fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The edges at a vertex that form pairs, and the weights of their turns and of their steps.
struct Paired<'a> {
    directions: &'a [u32],
    lengths: &'a [f32],
    turn: f32,
    step: f32,
}

/// What the edges at a vertex cost by two: a lane for each that forms pairs, and some empty ones, so that a row is a vector or
/// two of the processor's.
struct Pairs<const N: usize> {
    /// How many edges form pairs.
    count: usize,
    /// In row j, lane i: what edge j costs beside edge i, at the vertex and as seen from its own other end.
    rows: [[f32; N]; N],
    /// By lane: the least of its rows.
    beside: [f32; N],
    /// By lane: what the edge costs as seen from its other end.
    seen: [f32; N],
}

/// The fewest lanes that hold all edges that form pairs.
const MOST_LANES: usize = MOST_PAIRED.next_multiple_of(4);

impl<const N: usize> Pairs<N> {
    /// In row j, lane i: what keeps an edge from being a pair with itself.
    const SELF: [[f32; N]; N] = {
        let mut rows = [[0.0; N]; N];
        let mut k = 0;
        while k < N {
            rows[k][k] = f32::INFINITY;
            k += 1;
        }
        rows
    };

    #[inline]
    fn new(edges: &Paired<'_>, incoming: &[f32]) -> Self {
        let count = edges.lengths.len();
        let seen = padded(&incoming[..count], f32::INFINITY);
        let directions: [u32; N] = padded(edges.directions, 0);
        let lengths: [f32; N] = padded(edges.lengths, 0.0);
        let mut own = Self { count, rows: [[0.0; N]; N], beside: [f32::INFINITY; N], seen };
        for j in 0..count {
            let opposite = directions[j] ^ HALF_TURN;
            for i in 0..N {
                let turn = edges.turn * root_turn(directions[i], opposite);
                let step = edges.step * (lengths[i] - lengths[j]).abs();
                let cost = turn + step + (seen[j] + Self::SELF[j][i]);
                own.rows[j][i] = cost;
                own.beside[i] = least(own.beside[i], cost);
            }
        }
        own
    }

    /// What the cheapest pair costs, and its lanes.
    #[inline]
    fn best(&self) -> (f32, [usize; 2]) {
        let sums = sums(&self.seen, &self.beside);
        let best = sums.iter().copied().fold(f32::INFINITY, least);
        let i = sums.iter().position(|&sum| sum == best).unwrap_or_default();
        let j = self.rows[..self.count].iter().position(|row| row[i] == self.beside[i]);
        (best, [i, j.unwrap_or_default()])
    }

    /// What the cheapest pair without lane `k` costs.
    #[inline]
    fn without(&self, k: usize) -> f32 {
        let mut beside = Self::SELF[k];
        let mut rest = [f32::INFINITY; N];
        for row in self.rows[..k].iter().chain(&self.rows[k + 1..self.count]) {
            for (rest, &cost) in rest.iter_mut().zip(row) {
                *rest = least(*rest, cost);
            }
        }
        for (beside, rest) in beside.iter_mut().zip(rest) {
            *beside += rest;
        }
        sums(&self.seen, &beside).into_iter().fold(f32::INFINITY, least)
    }
}

fn sums<const N: usize>(a: &[f32; N], b: &[f32; N]) -> [f32; N] {
    std::array::from_fn(|k| a[k] + b[k])
}

/// Some values, and `empty` in further lanes.
fn padded<T: Copy, const N: usize>(values: &[T], empty: T) -> [T; N] {
    let mut lanes = [empty; N];
    lanes[..values.len()].copy_from_slice(values);
    lanes
}

/// The memory of one task.
#[derive(Default)]
struct Work {
    /// What each edge costs as seen from its other end.
    incoming: Vec<f32>,
    /// The answers.
    messages: Vec<f32>,
}

impl Work {
    /// On less off, for each edge, given what an end costs and the point alone.
    #[inline]
    fn answer<const N: usize>(&mut self, pairs: &Pairs<N>, [end, alone]: [f32; 2]) {
        let mut single = Least::NONE;
        for (k, &cost) in self.incoming.iter().enumerate() {
            single.meet(cost, k);
        }
        let (best, lanes) = pairs.best();
        let message = |k: usize, pair: f32| {
            let on = if k < pairs.count { least(end, pairs.beside[k]) } else { end };
            on - least(least(alone, end + single.without(k)), pair)
        };
        self.messages.clear();
        self.messages.extend((0..self.incoming.len()).map(|k| message(k, best)));
        if pairs.count > 1 {
            for k in lanes {
                self.messages[k] = message(k, pairs.without(k));
            }
        }
    }
}
