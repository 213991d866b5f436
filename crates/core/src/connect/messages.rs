//! Min-sum message passing: every edge is a binary variable in the two factors of its ends.
//!
//! The message of a vertex to an edge is what the edge costs at that vertex beyond its absence, all else at its best
//! (J. Pearl, "Probabilistic Reasoning in Intelligent Systems", 1988). All are sent at once, and damped.

use super::candidates::{Candidates, GRAIN, each};
use super::constants::{CONVERGED, DAMPING, MOST_PAIRED};
use super::costs::Costs;
use super::geometry::{Spacing, Turns};
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
        let mut work = Work::new();
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
        let pairs = candidates.pairs(v);
        let lengths = &spacing.lengths[range.start..range.start + pairs];
        work.pair_up(turns.at(v), lengths, [costs.turns[v], costs.steps[v]]);
        work.answer(costs.ends[v], costs.alone[v]);
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

/// Numbers i < j of edges that form pairs, by j, then by i.
const PAIRS: [[u8; 2]; MOST_PAIRS] = {
    let mut pairs = [[0; 2]; MOST_PAIRS];
    let (mut next, mut j) = (0, 1);
    while j < MOST_PAIRED {
        let mut i = 0;
        while i < j {
            pairs[next] = [i as u8, j as u8];
            (next, i) = (next + 1, i + 1);
        }
        j += 1;
    }
    pairs
};
/// For each edge what a pair that it is in is to cost beside: infinity, so that it is out.
const OUT: [[f32; MOST_PAIRS]; MOST_PAIRED] = {
    let mut out = [[0.0; MOST_PAIRS]; MOST_PAIRED];
    let mut next = 0;
    while next < MOST_PAIRS {
        let [i, j] = PAIRS[next];
        out[i as usize][next] = f32::INFINITY;
        out[j as usize][next] = f32::INFINITY;
        next += 1;
    }
    out
};
const MOST_PAIRS: usize = MOST_PAIRED * (MOST_PAIRED - 1) / 2;

/// The memory of one task.
struct Work {
    /// What each edge costs as seen from its other end.
    incoming: Vec<f32>,
    /// For each edge that forms pairs: the least cost of a second one beside it.
    beside: [f32; MOST_PAIRED],
    /// What each pair costs, at the vertex and as seen from both other ends.
    both: [f32; MOST_PAIRS],
    /// How many edges form pairs.
    count: usize,
    /// The answers.
    messages: Vec<f32>,
}

impl Work {
    fn new() -> Self {
        let (beside, both) = ([f32::INFINITY; MOST_PAIRED], [f32::INFINITY; MOST_PAIRS]);
        Self { incoming: Vec::new(), beside, both, count: 0, messages: Vec::new() }
    }

    /// Meet all pairs of the edges of these lengths, given their turns and the weights of turns and of steps.
    fn pair_up(&mut self, turns: &[f32], lengths: &[f32], [turn, step]: [f32; 2]) {
        self.count = lengths.len();
        self.beside = [f32::INFINITY; MOST_PAIRED];
        let mut start = 0;
        for j in 1..self.count {
            let (length, other, mut least_beside) = (lengths[j], self.incoming[j], f32::INFINITY);
            let pairs = turns[start..start + j].iter().zip(&mut self.both[start..start + j]);
            let firsts = lengths[..j].iter().zip(&self.incoming[..j]).zip(&mut self.beside[..j]);
            for ((&root, both), ((&own, &seen), beside)) in pairs.zip(firsts) {
                let cost = turn * root + step * (own - length).abs();
                *beside = least(*beside, cost + other);
                least_beside = least(least_beside, cost + seen);
                *both = cost + (seen + other);
            }
            self.beside[j] = least_beside;
            start += j;
        }
    }

    /// On less off, for each edge.
    fn answer(&mut self, end: f32, alone: f32) {
        let mut single = Least::NONE;
        for (k, &cost) in self.incoming.iter().enumerate() {
            single.meet(cost, k);
        }
        let both = &self.both[..self.count * self.count.saturating_sub(1) / 2];
        let best = both.iter().copied().fold(f32::INFINITY, least);
        let pair = both.iter().position(|&cost| cost == best).map_or([u8::MAX; 2], |k| PAIRS[k]);
        let without = |k: usize| {
            let others = both.iter().zip(&OUT[k]).map(|(cost, out)| cost + out);
            others.fold(f32::INFINITY, least)
        };
        self.messages.clear();
        for k in 0..self.incoming.len() {
            let on = if k < self.count { least(end, self.beside[k]) } else { end };
            let pair = if pair.contains(&(k as u8)) && k < self.count { without(k) } else { best };
            self.messages.push(on - least(least(alone, end + single.without(k)), pair));
        }
    }
}
