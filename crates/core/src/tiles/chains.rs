//! Curves across tiles: each tile sums up its runs of edges, and the sums are joined, level by level, into whole curves.
//!
//! An edge belongs to the tile of its smaller row. Ends of edges across tiles are cut vertices: there a tile cannot tell whether a
//! curve goes on, so its runs end. A chain says of a run what joining needs: its ends, and what settles where a ring starts and
//! which way it runs, namely its smallest row and its lexicographically smallest point, each with its neighbors.

use crate::exact::predicates::orientation;
use crate::point::{Point, lexicographic};
use std::cmp::Ordering::{Equal, Greater, Less};
use std::collections::HashMap;

/// A point of the whole, by its row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    /// The row in all of the points.
    pub row: i64,
    /// Where it is.
    pub at: Point,
}

/// A vertex inside a run: the one before it, itself, the one after it.
pub type Corner = [Site; 3];

/// What is known of a run of edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chain {
    /// The two ends.
    pub ends: [Site; 2],
    /// The vertex after the first end, and the one before the last.
    pub next: [Site; 2],
    /// The smallest row inside, without the ends.
    pub least: Option<Corner>,
    /// The lexicographically smallest point inside, without the ends.
    pub lowest: Option<Corner>,
    /// The number of edges.
    pub edges: i64,
}

/// A curve or a longer chain, made of chains.
#[derive(Debug, Clone, PartialEq)]
pub struct Joined {
    /// The numbers of the chains from end to end, each with whether it runs backward.
    pub members: Vec<(u32, bool)>,
    /// Is it a ring?
    pub closed: bool,
    /// What is known of it. A ring has one point at both ends, and runs counter-clockwise; a polyline starts at its end of
    /// smaller row.
    pub chain: Chain,
}

/// The chains of `runs` of local rows, whose sites are given.
///
/// # Panics
/// If a run has no edge.
#[must_use]
pub fn chains(runs: &[Vec<u32>], site: impl Fn(u32) -> Site) -> Vec<Chain> {
    let chain = |run: &Vec<u32>| {
        let steps = run.windows(2).map(|pair| Chain::step(site(pair[0]), site(pair[1])));
        steps.reduce(Chain::join).expect("a run has an edge")
    };
    runs.iter().map(chain).collect()
}

/// Edges between local rows as pairs of their `numbers` in the whole, smaller first, sorted.
#[must_use]
pub fn numbered(edges: &[[u32; 2]], numbers: &[i64]) -> Vec<[i64; 2]> {
    let number = |&[p, q]: &[u32; 2]| {
        let [i, j] = [p, q].map(|row| numbers[row as usize]);
        [i.min(j), i.max(j)]
    };
    let mut pairs: Vec<[i64; 2]> = edges.iter().map(number).collect();
    pairs.sort_unstable();
    pairs
}

impl Chain {
    fn step(from: Site, to: Site) -> Self {
        Self { ends: [from, to], next: [to, from], least: None, lowest: None, edges: 1 }
    }

    /// This chain, and `other` from its end on.
    fn join(self, other: Self) -> Self {
        let joint = Some([self.next[1], other.ends[0], other.next[0]]);
        Self {
            ends: [self.ends[0], other.ends[1]],
            next: [self.next[0], other.next[1]],
            least: [self.least, joint, other.least].into_iter().flatten().reduce(smaller_row),
            lowest: [self.lowest, joint, other.lowest].into_iter().flatten().reduce(lower),
            edges: self.edges + other.edges,
        }
    }

    fn reversed(self) -> Self {
        let turned = |corner: Option<Corner>| corner.map(|[before, at, after]| [after, at, before]);
        let ([a, b], [c, d]) = (self.ends, self.next);
        let (least, lowest) = (turned(self.least), turned(self.lowest));
        Self { ends: [b, a], next: [d, c], least, lowest, ..self }
    }

    /// Should the ring that this chain closes run the other way? As `trace` decides it.
    fn is_backward_ring(&self) -> bool {
        let joint = [self.next[1], self.ends[0], self.next[0]];
        let [before, at, after] = self.lowest.map_or(joint, |lowest| lower(lowest, joint));
        match orientation(before.at, at.at, after.at) {
            Greater => false,
            Less => true,
            Equal => {
                let [before, _, after] =
                    self.least.map_or(joint, |least| smaller_row(least, joint));
                after.row > before.row
            }
        }
    }
}

fn smaller_row(a: Corner, b: Corner) -> Corner {
    if b[1].row < a[1].row { b } else { a }
}

fn lower(a: Corner, b: Corner) -> Corner {
    if lexicographic(&b[1].at, &a[1].at).is_lt() { b } else { a }
}

/// Join `chains` at the cut vertices of degree two whose two ends are both here.
///
/// `degrees` are the rows of cut vertices with their degrees, as far as they are known here: by the tile that owns a vertex. The first list holds the
/// whole curves, the second what may go on elsewhere; each is in the order of its first member.
#[must_use]
pub fn join(chains: &[Chain], degrees: &[(i64, u32)]) -> (Vec<Joined>, Vec<Joined>) {
    let degrees: HashMap<i64, u32> = degrees.iter().copied().collect();
    let joints = Joints::new(chains, &degrees);
    let mut used = vec![false; chains.len()];
    let (mut whole, mut open) = (Vec::new(), Vec::new());
    for ends_only in [true, false] {
        for k in 0..chains.len() as u32 {
            let start = [false, true]
                .into_iter()
                .find(|&backward| !ends_only || joints.across(k, backward).is_none());
            if let Some(backward) = start.filter(|_| !used[k as usize]) {
                let joined = joints.follow((k, backward), &mut used);
                let stops = |site: &Site| degrees.get(&site.row).is_some_and(|&degree| degree != 2);
                let is_whole = !ends_only || joined.chain.ends.iter().all(stops);
                if is_whole { whole.push(joined.oriented()) } else { open.push(joined) }
            }
        }
    }
    whole.sort_unstable_by_key(|joined| joined.members[0]);
    (whole, open)
}

/// Which end of which chain meets which.
struct Joints<'a> {
    chains: &'a [Chain],
    /// For each chain and direction the chain and direction that it goes on with where it starts.
    across: Vec<[Option<(u32, bool)>; 2]>,
}

impl<'a> Joints<'a> {
    fn new(chains: &'a [Chain], degrees: &HashMap<i64, u32>) -> Self {
        let mut waiting: HashMap<i64, (u32, bool)> = HashMap::new();
        let mut across = vec![[None; 2]; chains.len()];
        for (k, chain) in (0..).zip(chains) {
            for (backward, end) in [false, true].into_iter().zip(chain.ends) {
                if degrees.get(&end.row) != Some(&2) {
                    continue;
                }
                if let Some((other, other_backward)) = waiting.remove(&end.row) {
                    across[k as usize][usize::from(backward)] = Some((other, other_backward));
                    across[other as usize][usize::from(other_backward)] = Some((k, backward));
                } else {
                    waiting.insert(end.row, (k, backward));
                }
            }
        }
        Self { chains, across }
    }

    /// What meets the start of chain `k`, run backward or not: another chain, as it starts there.
    fn across(&self, k: u32, backward: bool) -> Option<(u32, bool)> {
        self.across[k as usize][usize::from(backward)]
    }

    fn follow(&self, start: (u32, bool), used: &mut [bool]) -> Joined {
        let directed = |(k, backward): (u32, bool)| {
            let chain = self.chains[k as usize];
            if backward { chain.reversed() } else { chain }
        };
        let (mut members, mut chain) = (vec![start], directed(start));
        used[start.0 as usize] = true;
        let mut last = start;
        // Where a chain ends, its reverse starts.
        while let Some(next) = self.across(last.0, !last.1).filter(|&next| next != start) {
            used[next.0 as usize] = true;
            members.push(next);
            chain = chain.join(directed(next));
            last = next;
        }
        let closed = chain.ends[0].row == chain.ends[1].row;
        Joined { members, closed, chain }
    }
}

impl Joined {
    fn oriented(mut self) -> Self {
        let [first, last] = self.chain.ends.map(|end| end.row);
        let backward = if self.closed { self.chain.is_backward_ring() } else { first > last };
        if backward {
            self.members.reverse();
            self.members.iter_mut().for_each(|member| member.1 = !member.1);
            self.chain = self.chain.reversed();
        }
        self
    }
}
