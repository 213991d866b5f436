//! The edges that a curve may take: the Delaunay edges and all diagonals of cocircular groups, as half-edges by vertex.

use super::approximation::half_turns;
use super::constants::MOST_PAIRED;
use crate::cocircular::diagonals;
use crate::delaunay::{Delaunay, Edge};
use crate::error::{Error, Result};
use crate::parts::{sort_by, split};
use crate::point::sub;
use crate::progress::Progress;
use rayon::prelude::*;

/// Vertices that one task takes at a time.
pub const GRAIN: usize = 1 << 10;

/// Vertices between two looks at whether to stop, where one after another takes little.
const SELDOM: usize = 1 << 16;

/// The candidate edges, seen from their vertices.
#[derive(Debug, Default)]
pub struct Candidates {
    /// The half-edges from v are numbers `offsets[v]` to `offsets[v + 1]`.
    offsets: Vec<u32>,
    /// Where each half-edge leads.
    pub ends: Vec<u32>,
    /// The half-edge back.
    pub twins: Vec<u32>,
    /// How many of the half-edges from v, the first ones, form pairs.
    pub paired: Vec<u8>,
    /// The angles opposite to the edge, summed, in half turns; rounded, so that it does not show which of several
    /// cocircular points was the apex.
    pub sights: Vec<f32>,
    /// Is the edge to be in the answer, whatever it costs? Empty if none is.
    pub kept: Vec<bool>,
    /// Whether to stop: what is made after that is of no use, and not whole.
    progress: Progress,
}

impl Candidates {
    /// The edges of a triangulation and those to `keep`, pairs of vertices both ways. Linear, but for diagonals of cocircular
    /// points.
    ///
    /// # Errors
    /// More half-edges than 32 bits can number, or a cancelled `progress`.
    pub fn new(delaunay: &Delaunay, keep: &[[u32; 2]], progress: &Progress) -> Result<Self> {
        let tied = tied(delaunay, keep, progress)?;
        progress.advance(0)?;
        let vertices = delaunay.points().len();
        let offsets = offsets(delaunay, &tied)?;
        let count = offsets[vertices] as usize;
        let mut own = Self {
            offsets,
            ends: vec![0; count],
            sights: vec![0.0; count],
            progress: progress.quiet(),
            ..Self::default()
        };
        own.fill(delaunay, &tied);
        progress.advance(0)?;
        own.link()?;
        if !keep.is_empty() {
            own.kept = own.map(false, |v, kept| {
                for (kept, &end) in kept.iter_mut().zip(own.neighbors(v)) {
                    *kept = keep.binary_search(&[v as u32, end]).is_ok();
                }
            });
        }
        Ok(own)
    }

    /// Keep the half-edges, twins alike, that are to be kept, with their `values`; then see which form pairs.
    ///
    /// # Errors
    /// The call is cancelled.
    pub fn retain(&mut self, values: &mut Vec<f32>, keep: &[bool]) -> Result<()> {
        let mut place = 0;
        for v in 0..self.vertices() {
            self.look(v)?;
            let range = self.from(v);
            self.offsets[v] = place as u32;
            for e in range.filter(|&e| keep[e]) {
                self.ends[place] = self.ends[e];
                self.sights[place] = self.sights[e];
                values[place] = values[e];
                if let Some(&kept) = self.kept.get(e) {
                    self.kept[place] = kept;
                }
                place += 1;
            }
        }
        if let Some(last) = self.offsets.last_mut() {
            *last = place as u32;
        }
        self.ends.truncate(place);
        for values in [&mut self.sights, values] {
            values.truncate(place);
            values.shrink_to_fit();
        }
        self.ends.shrink_to_fit();
        self.kept.truncate(place);
        self.link()?;
        self.limit_pairs(values)
    }

    /// Look whether to stop, at one of very many vertices.
    ///
    /// # Errors
    /// The call is cancelled.
    pub fn look(&self, v: usize) -> Result<()> {
        if v.is_multiple_of(SELDOM) { self.progress.advance(0) } else { Ok(()) }
    }

    /// The number of vertices.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The half-edges from `v`.
    #[inline]
    #[must_use]
    pub fn from(&self, v: usize) -> std::ops::Range<usize> {
        self.offsets[v] as usize..self.offsets[v + 1] as usize
    }

    /// Both ends of the edge of half-edge `e`, the one to which it leads last.
    #[inline]
    #[must_use]
    pub fn both_ends(&self, e: usize) -> [usize; 2] {
        [self.ends[self.twins[e] as usize] as usize, self.ends[e] as usize]
    }

    /// Is the edge of half-edge `e` to be in the answer?
    #[inline]
    #[must_use]
    pub fn is_kept(&self, e: usize) -> bool {
        self.kept.get(e).copied().unwrap_or_default()
    }

    /// The neighbors of `v`.
    #[inline]
    #[must_use]
    pub fn neighbors(&self, v: usize) -> &[u32] {
        &self.ends[self.from(v)]
    }

    /// The half-edges that form pairs at `v`, the first ones from there.
    #[inline]
    #[must_use]
    pub fn pairs(&self, v: usize) -> usize {
        self.paired[v] as usize
    }

    /// Does half-edge `e` from `v` form pairs?
    #[must_use]
    pub fn is_paired(&self, v: usize, e: usize) -> bool {
        e < self.from(v).start + self.pairs(v)
    }

    /// Every edge once, as the half-edge from its smaller end, and that end.
    pub fn edges(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.vertices())
            .flat_map(|v| self.from(v).map(move |e| (v, e)))
            .filter(|&(v, e)| v < self.ends[e] as usize)
    }

    /// The lengths of the parts of a row of values by half-edge that belong to `GRAIN` successive vertices each.
    pub fn grains(&self) -> impl Iterator<Item = usize> {
        let vertices = self.vertices();
        let start = move |v: usize| self.offsets[v.min(vertices)] as usize;
        (0..vertices).step_by(GRAIN).map(move |v| start(v + GRAIN) - start(v))
    }

    /// One value for each half-edge: `write` gets a vertex and its part of them.
    pub fn map<T: Copy + Send>(&self, empty: T, write: impl Fn(usize, &mut [T]) + Sync) -> Vec<T> {
        let mut values = vec![empty; self.ends.len()];
        let parts = split(&mut values, self.grains());
        self.each(parts, |(k, mut part)| {
            for v in k * GRAIN..((k + 1) * GRAIN).min(self.vertices()) {
                let (own, rest) = part.split_at_mut(self.from(v).len());
                write(v, own);
                part = rest;
            }
        });
        values
    }

    /// One value for each vertex.
    pub fn by_vertex<T: Copy + Default + Send>(&self, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
        let mut values = vec![T::default(); self.vertices()];
        self.each(values.chunks_mut(GRAIN), |(k, part)| {
            for (i, own) in part.iter_mut().enumerate() {
                *own = value(k * GRAIN + i);
            }
        });
        values
    }

    /// Do `work` on numbered parts until the call is cancelled, as `each` does.
    pub fn each<T: Send>(
        &self,
        parts: impl IntoIterator<Item = T>,
        work: impl Fn((usize, T)) + Sync + Send,
    ) {
        each(parts, &self.progress, work);
    }

    fn fill(&mut self, delaunay: &Delaunay, tied: &[(u32, Edge)]) {
        let lengths: Vec<usize> = self.grains().collect();
        let ends = split(&mut self.ends, lengths.iter().copied());
        let sights = split(&mut self.sights, lengths);
        each(ends.into_iter().zip(sights), &self.progress, |(k, (ends, sights))| {
            let last = delaunay.points().len();
            let mut place = 0;
            let mut star = Vec::new();
            let mut next = tied.partition_point(|&(v, _)| (v as usize) < k * GRAIN);
            for v in k * GRAIN..((k + 1) * GRAIN).min(last) {
                let count =
                    tied[next..].iter().take_while(|&&(from, _)| from as usize == v).count();
                collect(delaunay, v as u32, &tied[next..next + count], &mut star);
                next += count;
                for &(end, sight) in &star {
                    (ends[place], sights[place]) = (end, sight);
                    place += 1;
                }
            }
        });
    }

    /// Find the twins; what is known of an edge at its smaller end is told to the larger.
    fn link(&mut self) -> Result<()> {
        self.twins = vec![0; self.ends.len()];
        let mut next: Vec<u32> = self.offsets.clone();
        // Ends ascend, so each vertex is met by its neighbors in the order of its own half-edges.
        for v in 0..self.vertices() {
            self.look(v)?;
            for e in self.from(v) {
                let slot = &mut next[self.ends[e] as usize];
                let twin = *slot;
                *slot += 1;
                self.twins[e] = twin;
                if (twin as usize) < e {
                    self.sights[e] = self.sights[twin as usize];
                }
            }
        }
        Ok(())
    }

    /// Let only the half-edges of least value at hubs form pairs, and put them first.
    ///
    /// Those of the same value as the first one too many are out as well, so that the order of ties does not matter.
    fn limit_pairs(&mut self, values: &mut [f32]) -> Result<()> {
        self.paired = vec![0; self.vertices()];
        for v in 0..self.vertices() {
            self.look(v)?;
            let range = self.from(v);
            if range.len() <= MOST_PAIRED {
                self.paired[v] = range.len() as u8;
                continue;
            }
            let key = |own: &Self, values: &[f32], e: usize| {
                if own.is_kept(e) { f32::NEG_INFINITY } else { values[e] }
            };
            let mut sorted: Vec<f32> = range.clone().map(|e| key(self, values, e)).collect();
            let (_, &mut limit, _) = sorted.select_nth_unstable_by(MOST_PAIRED, f32::total_cmp);
            let mut place = range.start;
            for e in range.clone() {
                if key(self, values, e) < limit {
                    self.swap(e, place);
                    values.swap(e, place);
                    place += 1;
                }
            }
            self.paired[v] = (place - range.start) as u8;
        }
        Ok(())
    }

    /// Exchange two half-edges of one vertex.
    fn swap(&mut self, a: usize, b: usize) {
        self.ends.swap(a, b);
        self.sights.swap(a, b);
        self.twins.swap(a, b);
        if !self.kept.is_empty() {
            self.kept.swap(a, b);
        }
        for e in [a, b] {
            let twin = self.twins[e] as usize;
            self.twins[twin] = e as u32;
        }
    }
}

/// Do `work` on numbered parts until the call is cancelled, in parallel if there are several: small calls need not wake other threads.
fn each<T: Send>(
    parts: impl IntoIterator<Item = T>,
    progress: &Progress,
    work: impl Fn((usize, T)) + Sync + Send,
) {
    let mut parts: Vec<(usize, T)> = parts.into_iter().enumerate().collect();
    let work = |part| {
        if progress.goes_on() {
            work(part);
        }
    };
    match parts.len() {
        0 => (),
        1 => work(parts.swap_remove(0)),
        _ => parts.into_par_iter().for_each(work),
    }
}

/// The diagonals of cocircular points and the edges to keep that are not in the triangulation, from both of their ends,
/// sorted.
fn tied(delaunay: &Delaunay, keep: &[[u32; 2]], progress: &Progress) -> Result<Vec<(u32, Edge)>> {
    let is_new = |edge: &Edge| delaunay.position(edge.p, edge.q).is_none();
    let both = |edge: Edge| [(edge.p, edge), (edge.q, edge)];
    let kept = keep.iter().filter(|pair| pair[0] < pair[1]);
    let kept = kept.map(|&[p, q]| Edge { p, q, left: None, right: None });
    let all = diagonals(delaunay, progress)?.into_iter().chain(kept);
    let mut tied: Vec<_> = all.filter(is_new).flat_map(both).collect();
    progress.advance(0)?;
    let key = |&(v, edge): &(u32, Edge)| (v, edge.p, edge.q);
    sort_by(&mut tied, progress, |a, b| key(a).cmp(&key(b)))?;
    tied.dedup_by_key(|own| key(own));
    Ok(tied)
}

fn offsets(delaunay: &Delaunay, tied: &[(u32, Edge)]) -> Result<Vec<u32>> {
    let vertices = delaunay.points().len();
    let limit = u32::MAX as usize;
    if delaunay.stars().half_edges() + tied.len() > limit {
        return Err(Error::TooManyPoints { count: vertices, limit: limit / 8 });
    }
    let mut offsets = vec![0; vertices + 1];
    for v in 0..vertices {
        offsets[v + 1] = delaunay.star(v as u32).neighbors.len() as u32;
    }
    for &(v, _) in tied {
        offsets[v as usize + 1] += 1;
    }
    for v in 0..vertices {
        offsets[v + 1] += offsets[v];
    }
    Ok(offsets)
}

/// Put the candidates from `v` into `star`, by ascending end; sights only at the smaller end.
fn collect(delaunay: &Delaunay, v: u32, tied: &[(u32, Edge)], star: &mut Vec<(u32, f32)>) {
    star.clear();
    let own = delaunay.star(v);
    for (k, &end) in own.neighbors.iter().enumerate() {
        let apexes = [own.left(k), own.right(k)];
        star.push((end, if v < end { sight(delaunay, v, end, apexes) } else { 0.0 }));
    }
    // The opposite angles of a diagonal of cocircular points sum to half a turn, those of other edges to keep to more.
    star.extend(tied.iter().map(|&(_, edge)| (edge.p ^ edge.q ^ v, 1.0)));
    star.sort_unstable_by_key(|&(end, _)| end);
}

/// The angles at `apexes` opposite to the edge p q, summed, in half turns.
fn sight(delaunay: &Delaunay, p: u32, q: u32, apexes: [Option<u32>; 2]) -> f32 {
    let [p, q] = [p, q].map(|v| delaunay.point(v));
    let angles = apexes.map(|apex| {
        apex.map_or(0.0, |apex| {
            let at = delaunay.point(apex);
            half_turns(sub(p, at), sub(q, at))
        })
    });
    (angles[0] + angles[1]) as f32
}
