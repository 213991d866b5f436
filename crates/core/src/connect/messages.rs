//! Min-sum message passing: every edge is a binary variable in the two factors of its ends.
//!
//! The message of a vertex to an edge is what the edge costs at that vertex beyond its absence, all else at its best
//! (J. Pearl, "Probabilistic Reasoning in Intelligent Systems", 1988). All are sent at once and damped by half.

use super::candidates::{Candidates, GRAIN, each};
use super::constants::{CONVERGED, MOST_PAIRED, SWEEPS};
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
    pub spacing: &'a Spacing,
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
        let mut work = Work::default();
        mail.clear();
        for v in k * GRAIN..((k + 1) * GRAIN).min(self.candidates.vertices()) {
            if active[v].swap(false, Relaxed) {
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

/// The two least of some values, and which is the least.
#[derive(Clone, Copy)]
struct Least {
    value: f32,
    second: f32,
    index: usize,
}

impl Least {
    fn of(values: &[f32]) -> Self {
        let mut least = Self { value: f32::INFINITY, second: f32::INFINITY, index: usize::MAX };
        for (index, &value) in values.iter().enumerate() {
            if value < least.value {
                least = Self { value, second: least.value, index };
            } else if value < least.second {
                least.second = value;
            }
        }
        least
    }

    fn without(&self, index: usize) -> f32 {
        if self.index == index { self.second } else { self.value }
    }
}

/// The memory of one task.
#[derive(Default)]
struct Work {
    /// What each edge costs as seen from its other end.
    incoming: Vec<f32>,
    /// The cost of each pair beside what comes in, row after row, square; infinite on the diagonal.
    pairs: Vec<f32>,
    /// The least cost of a second edge beside each.
    seconds: Vec<f32>,
    /// How many edges form pairs.
    count: usize,
    /// The answers.
    messages: Vec<f32>,
}

impl Work {
    /// What each edge finds at `v` as the second of a pair, and all pairs.
    fn pair_up(&mut self, factors: &Factors<'_>, v: usize) {
        let Factors { candidates, spacing, turns, costs } = factors;
        let count = candidates.pairs(v);
        debug_assert!(count <= MOST_PAIRED);
        let lengths = &spacing.lengths[candidates.from(v)][..count];
        let mut turns = turns.at(v).iter();
        self.count = count;
        self.seconds.clear();
        self.seconds.resize(self.incoming.len(), f32::INFINITY);
        self.pairs.resize(MOST_PAIRED * MOST_PAIRED, f32::INFINITY);
        for i in 0..count {
            for j in i + 1..count {
                let &turn = turns.next().expect("a turn for each pair");
                let cost = costs.pair(v, turn, [lengths[i], lengths[j]]);
                self.seconds[i] = self.seconds[i].min(cost + self.incoming[j]);
                self.seconds[j] = self.seconds[j].min(cost + self.incoming[i]);
                self.pairs[i * MOST_PAIRED + j] = cost + (self.incoming[i] + self.incoming[j]);
            }
        }
    }

    /// On less off, for each edge.
    fn answer(&mut self, end: f32, alone: f32) {
        let single = Least::of(&self.incoming);
        let (pair, first, second) = self.best_pair(usize::MAX);
        self.messages.clear();
        for k in 0..self.incoming.len() {
            let on = end.min(self.seconds[k]);
            let paired = if k == first || k == second { self.best_pair(k).0 } else { pair };
            let off = alone.min(end + single.without(k)).min(paired);
            self.messages.push(on - off);
        }
    }

    /// The cheapest pair without edge `k`, and what it is made of.
    fn best_pair(&self, k: usize) -> (f32, usize, usize) {
        let mut best = (f32::INFINITY, usize::MAX, usize::MAX);
        for i in (0..self.count).filter(|&i| i != k) {
            let row = &self.pairs[i * MOST_PAIRED..][..self.count];
            for j in (i + 1..self.count).filter(|&j| j != k) {
                if row[j] < best.0 {
                    best = (row[j], i, j);
                }
            }
        }
        best
    }
}
