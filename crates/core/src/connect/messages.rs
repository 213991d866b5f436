//! Min-sum message passing: every edge is a binary variable in the two factors of its ends.
//!
//! The message of a vertex to an edge is what the edge costs at that vertex beyond its absence, all else at its best
//! (J. Pearl, "Probabilistic Reasoning in Intelligent Systems", 1988). All are sent at once, and damped.

use super::candidates::{Candidates, GRAIN};
use super::constants::{CONVERGED, DAMPING};
use super::costs::Costs;
use super::geometry::{Spacing, Turns};
use super::pairs::{INFINITE, LANES, Least, MOST_QUADS, Paired, Pairs, Quads, cast, lane};
use crate::error::Result;
use crate::parts::split;
use crate::progress::Progress;
use std::array;
use std::mem::swap;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use wide::f32x4;

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
        if sent.is_empty() {
            return Ok(());
        }
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
            self.candidates.each(parts, |(k, fresh)| self.write(k, &sweep, fresh));
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
        let vertices = k * GRAIN..((k + 1) * GRAIN).min(self.candidates.vertices());
        let first = self.candidates.from(vertices.start).start;
        for v in vertices {
            let range = self.candidates.from(v);
            let own = &mut fresh[range.start - first..];
            if !sweep.active[v].load(Relaxed) {
                own[..range.len()].copy_from_slice(&sweep.sent[range]);
                continue;
            }
            sweep.active[v].store(false, Relaxed);
            match self.candidates.pairs(v) {
                0..=4 => self.send::<1>(v, sweep, own),
                5..=8 => self.send::<2>(v, sweep, own),
                9..=12 => self.send::<3>(v, sweep, own),
                _ => self.send::<MOST_QUADS>(v, sweep, own),
            }
        }
    }

    /// Write the messages of `v`, whose pairs take `Q` quads, where `own` begins; those of later vertices, beyond, come later.
    #[inline]
    fn send<const Q: usize>(&self, v: usize, sweep: &Sweep<'_>, own: &mut [f32]) {
        let Self { candidates, turns, costs, .. } = self;
        let (range, count) = (candidates.from(v), candidates.pairs(v));
        let pairs = Pairs::new(&Paired {
            count,
            seen: self.seen::<Q>(range.start, count, sweep.sent),
            directions: quads(&turns.directions, range.start).map(cast),
            lengths: quads(&self.spacing.lengths, range.start).map(f32x4::new),
            turn: f32x4::splat(costs.turns[v]),
            step: f32x4::splat(costs.steps[v]),
        });
        let others = range.start + count..range.end;
        let seen = |e: usize| costs.edges[e] + sweep.sent[candidates.twins[e] as usize];
        let single = others.clone().map(seen).fold(pairs.single(), Least::meet);
        let (best, messages) = pairs.messages([costs.ends[v], costs.alone[v]], single);
        let before: Quads<Q> = quads(sweep.sent, range.start).map(f32x4::new);
        let (after, moves) = sweep.step(&messages, &before);
        put(own, count, &after);
        sweep.tell(v, moves & ((1 << count) - 1), &quads::<_, Q>(&candidates.ends, range.start));
        for e in others {
            let message = single.message([costs.ends[v], costs.alone[v]], seen(e), best);
            let (after, moves) = sweep.step(&[message], &[f32x4::splat(sweep.sent[e])]);
            own[e - range.start] = lane(&after, 0);
            sweep.tell(v, moves & 1, &[[candidates.ends[e]; 4]]);
        }
    }

    /// What the `count` half-edges from `start` on cost as seen from their other ends; infinite in further lanes.
    #[inline]
    fn seen<const Q: usize>(&self, start: usize, count: usize, sent: &[f32]) -> Quads<Q> {
        let prices: [_; Q] = quads(&self.costs.edges, start);
        let twins: [_; Q] = quads(&self.candidates.twins, start);
        array::from_fn(|q| {
            let sent = twins[q].map(|twin: u32| sent[twin as usize]);
            let is_edge = LANES[q].simd_lt(f32x4::splat(count as f32));
            is_edge.bitselect(f32x4::new(prices[q]) + f32x4::new(sent), INFINITE)
        })
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

impl Sweep<'_> {
    /// Messages on their way to new ones, and a bit for each that changes.
    #[inline]
    fn step<const Q: usize>(&self, messages: &Quads<Q>, before: &Quads<Q>) -> (Quads<Q>, u32) {
        let (mut after, mut moves) = (*messages, 0);
        for q in 0..Q {
            let change = f32x4::splat(self.share) * (messages[q] - before[q]);
            if self.share < 1.0 {
                after[q] = before[q] + change;
            }
            moves |= change.abs().simd_gt(f32x4::splat(CONVERGED)).to_bitmask() << (4 * q);
        }
        (after, moves)
    }

    /// Where a message of `v` changed, both ends send again.
    #[inline]
    fn tell<const Q: usize>(&self, v: usize, moves: u32, ends: &[[u32; 4]; Q]) {
        if moves == 0 {
            return;
        }
        for (k, &end) in ends.as_flattened().iter().enumerate() {
            // Which of them changed is hard to foretell, so something is written for each.
            let end = if moves >> k & 1 == 1 { end as usize } else { v };
            self.later[end].store(true, Relaxed);
        }
        self.later[v].store(true, Relaxed);
    }
}

/// The values from `start` on in quads; beyond the last there may be any.
#[inline]
fn quads<T: Copy + Default, const Q: usize>(values: &[T], start: usize) -> [[T; 4]; Q] {
    let values = &values[start..];
    values.as_chunks().0.first_chunk().copied().unwrap_or_else(|| {
        let mut quads = [[T::default(); 4]; Q];
        for (own, &value) in quads.as_flattened_mut().iter_mut().zip(values) {
            *own = value;
        }
        quads
    })
}

/// Put quads, of which `count` lanes count, where `values` begin.
#[inline]
fn put<const Q: usize>(values: &mut [f32], count: usize, quads: &Quads<Q>) {
    if let Some(chunks) = values.as_chunks_mut().0.first_chunk_mut::<Q>() {
        for (chunk, quad) in chunks.iter_mut().zip(quads) {
            *chunk = quad.to_array();
        }
    } else {
        for (k, own) in values[..count].iter_mut().enumerate() {
            *own = lane(quads, k);
        }
    }
}
