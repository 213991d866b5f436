//! Min-sum message passing: every edge is a binary variable in the two factors of its ends.
//!
//! The message of a vertex to an edge is what the edge costs at that vertex beyond its absence, all else at its best
//! (J. Pearl, "Probabilistic Reasoning in Intelligent Systems", 1988). All are sent at once and damped by half.

use super::candidates::{Candidates, GRAIN, each};
use super::constants::{CONVERGED, SWEEPS};
use super::costs::Costs;
use super::geometry::{Spacing, Turns};
use crate::error::Result;
use crate::parts::split;
use crate::progress::Progress;
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

/// The new messages of the active vertices of a part.
type Mail = Vec<(u32, f32)>;

impl Factors<'_> {
    /// Send messages until none changes any more, starting from those in `sent`.
    ///
    /// Only vertices that a changed message reaches, and those whose own still move, send again.
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn converge(&self, sent: &mut [f32], progress: &Progress) -> Result<()> {
        let active: Vec<AtomicBool> =
            (0..self.candidates.vertices()).map(|_| AtomicBool::new(true)).collect();
        let mut mail = vec![Mail::new(); self.candidates.vertices().div_ceil(GRAIN)];
        for _ in 0..SWEEPS {
            each(&mut mail, |(k, mail)| self.write(k, sent, &active, mail));
            progress.advance(0)?;
            if mail.iter().all(Vec::is_empty) {
                break;
            }
            self.deliver(&mail, sent, &active);
        }
        Ok(())
    }

    /// Write the messages of the active vertices of part `k`, which are not active any more.
    fn write(&self, k: usize, sent: &[f32], active: &[AtomicBool], mail: &mut Mail) {
        let mut work = Work::new();
        mail.clear();
        let first = k * GRAIN;
        let last = (first + GRAIN).min(self.candidates.vertices());
        for (v, active) in (first..last).zip(&active[first..last]) {
            if active.swap(false, Relaxed) {
                self.send(v, sent, &mut work);
                let numbers = self.candidates.from(v).map(|e| e as u32);
                mail.extend(numbers.zip(work.messages.iter().copied()));
            }
        }
    }

    /// Damp the new messages into `sent`; where one changed, both of its ends are active.
    fn deliver(&self, mail: &[Mail], sent: &mut [f32], active: &[AtomicBool]) {
        let mut firsts = Vec::with_capacity(mail.len());
        let mut first = 0;
        for length in self.candidates.grains() {
            firsts.push(first);
            first += length;
        }
        let parts = split(sent, self.candidates.grains());
        each(parts.into_iter().zip(mail), |(k, (sent, mail))| {
            for &(e, message) in mail {
                let own = &mut sent[e as usize - firsts[k]];
                let change = (message - *own) / 2.0;
                *own = f32::midpoint(*own, message);
                if change.abs() > CONVERGED {
                    let twin = self.candidates.twins[e as usize] as usize;
                    for v in [self.candidates.ends[e as usize], self.candidates.ends[twin]] {
                        active[v as usize].store(true, Relaxed);
                    }
                }
            }
        });
    }

    /// Put the messages of `v` into `work`.
    fn send(&self, v: usize, sent: &[f32], work: &mut Work) {
        let candidates = self.candidates;
        let incoming = |e: usize| self.costs.edges[e] + sent[candidates.twins[e] as usize];
        work.incoming.clear();
        work.incoming.extend(candidates.from(v).map(incoming));
        work.pair_up(self, v);
        work.answer(self.costs.ends[v], self.costs.alone[v]);
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
        let greater = if is_less { self.value } else { value };
        self.second = if greater < self.second { greater } else { self.second };
        self.index = if is_less { index } else { self.index };
        self.value = if is_less { value } else { self.value };
    }

    #[inline]
    fn without(&self, index: usize) -> f32 {
        if self.index == index { self.second } else { self.value }
    }
}

/// Pairs at one vertex, padded so that a row of sums is a few vector instructions.
const WIDTH: usize = 16;
/// The width where few edges form pairs, as at most vertices.
const HALF: usize = WIDTH / 2;
/// Sums that one instruction adds.
const LANES: usize = 4;

/// The memory of one task.
struct Work {
    /// What each edge costs as seen from its other end.
    incoming: Vec<f32>,
    /// The same for those that form pairs, and infinity.
    seen: [f32; WIDTH],
    /// What each pair costs at the vertex; infinite for an edge and itself.
    pairs: [[f32; WIDTH]; WIDTH],
    /// How many edges form pairs.
    count: usize,
    /// The answers.
    messages: Vec<f32>,
}

impl Work {
    fn new() -> Self {
        Self {
            incoming: Vec::new(),
            seen: [f32::INFINITY; WIDTH],
            pairs: [[f32::INFINITY; WIDTH]; WIDTH],
            count: 0,
            messages: Vec::new(),
        }
    }

    /// Put down what pairs cost at `v`.
    fn pair_up(&mut self, factors: &Factors<'_>, v: usize) {
        let Factors { candidates, spacing, turns, costs } = factors;
        self.count = candidates.pairs(v);
        let lengths = &spacing.lengths[candidates.from(v)][..self.count];
        let mut turns = turns.at(v).iter();
        for (i, &a) in lengths.iter().enumerate() {
            for (j, &b) in lengths.iter().enumerate().skip(i + 1) {
                let &turn = turns.next().expect("a turn for each pair");
                let cost = costs.pair(v, turn, [a, b]);
                self.pairs[i][j] = cost;
                self.pairs[j][i] = cost;
            }
        }
        // What is left of other vertices in the rows is beside an infinity.
        self.seen = [f32::INFINITY; WIDTH];
        self.seen[..self.count].copy_from_slice(&self.incoming[..self.count]);
    }

    /// On less off, for each edge.
    fn answer(&mut self, end: f32, alone: f32) {
        let mut single = Least::NONE;
        for (k, &cost) in self.incoming.iter().enumerate() {
            single.meet(cost, k);
        }
        let seconds = self.seconds(&self.seen);
        let mut pair = Least::NONE;
        for (k, second) in seconds[..self.count].iter().enumerate() {
            pair.meet(self.seen[k] + second, k);
        }
        let both = self.both(pair);
        self.messages.clear();
        for k in 0..self.incoming.len() {
            let on = seconds[..self.count].get(k).map_or(end, |&second| end.min(second));
            let pair = if both.contains(&k) { self.best_without(k) } else { pair.value };
            self.messages.push(on - alone.min(end + single.without(k)).min(pair));
        }
    }

    /// For each edge the least cost of a second one beside it.
    fn seconds(&self, seen: &[f32; WIDTH]) -> [f32; WIDTH] {
        let mut seconds = [f32::INFINITY; WIDTH];
        for (second, row) in seconds.iter_mut().zip(&self.pairs[..self.count]) {
            let width = if self.count <= HALF { HALF } else { WIDTH };
            *second = least_sum(&row[..width], &seen[..width]);
        }
        seconds
    }

    /// The two edges of the best pair, given the first.
    fn both(&self, pair: Least) -> [usize; 2] {
        if pair.index >= self.count {
            return [usize::MAX; 2];
        }
        let mut second = Least::NONE;
        for (k, cost) in self.pairs[pair.index][..self.count].iter().enumerate() {
            second.meet(cost + self.seen[k], k);
        }
        [pair.index, second.index]
    }

    /// The cost of the best pair without edge `k`.
    fn best_without(&self, k: usize) -> f32 {
        let mut seen = self.seen;
        seen[k] = f32::INFINITY;
        let seconds = self.seconds(&seen);
        least_sum(&seconds[..WIDTH], &seen[..WIDTH])
    }
}

/// The least sum of two values at one place.
#[inline]
fn least_sum(a: &[f32], b: &[f32]) -> f32 {
    let mut least = [f32::INFINITY; LANES];
    for (a, b) in a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0) {
        for lane in 0..LANES {
            let sum = a[lane] + b[lane];
            least[lane] = if sum < least[lane] { sum } else { least[lane] };
        }
    }
    least.into_iter().fold(f32::INFINITY, f32::min)
}
