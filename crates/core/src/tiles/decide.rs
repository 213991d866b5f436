//! Which edges are decided for good by the points that a tile has seen, and what the others need.

use super::disk::Disk;
use super::reach::Sectors;
use super::rule::{Finding, Rule};
use super::unseen::Unseen;
use crate::adjacency::vertices_of_rows;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, select, sort};
use crate::error::Result;
use crate::point::{Point, length, sub};
use crate::progress::{Progress, Stage};
use crate::space::bounds::Bounds;
use rayon::prelude::*;

/// Vertices that one task takes at a time.
const GRAIN: usize = 1 << 12;
/// Sectors of the first look at a vertex, which is enough far from what is unseen.
const COARSE: usize = 8;
/// Sectors of the second: a multiple of four, so that right angles are whole.
const FINE: usize = 64;

/// What is asked of the points in a triangulation.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    /// For each row: are all edges of this point wanted?
    pub own: &'a [bool],
    /// For each row: may it be a new partner of own points? Else those edges have been decided on before.
    pub fresh: &'a [bool],
    /// Pairs of rows that are to be decided on whatever they are.
    pub pairs: &'a [[u32; 2]],
    /// Where unseen points may be.
    pub unseen: &'a Unseen,
    /// The most pieces of the unseen that one edge or vertex may ask for, the nearest ones.
    pub most: usize,
}

/// The answer: everything that is in none of the lists is decided, and out.
#[derive(Debug, Clone, Default)]
pub struct Decision {
    /// The edges that are in, whatever else there is.
    pub edges: Edges,
    /// The edges that unseen points may bring in or out, in order.
    pub open_edges: Edges,
    /// The rows of own points that may have unseen partners, in order.
    pub open_vertices: Vec<u32>,
    /// How far those partners can be, in the unit of the input.
    pub reach: Vec<f64>,
    /// Pieces of the unseen, each with the part to be seen next; in order.
    pub requests: Vec<(u32, Bounds)>,
}

/// Decide the edges of the own points, and the pairs, by a `rule`.
///
/// Whatever points there are in the unseen pieces: the edges are edges of the whole, and an edge of the whole between points of
/// this triangulation that is wanted is among the edges or the open edges; one from an own point to an unseen one ends at an
/// open vertex.
///
/// # Errors
/// A cancelled `progress`.
pub fn decide<R: Rule>(
    delaunay: &Delaunay,
    rule: &R,
    question: &Question<'_>,
    progress: &Progress,
) -> Result<Decision> {
    let tile = Tile::new(delaunay, rule, question);
    progress.enter(Stage::Select, delaunay.points().len())?;
    let starts: Vec<usize> = (0..delaunay.points().len()).step_by(GRAIN).collect();
    let parts = starts.into_par_iter().map(|start| {
        let part = tile.part(start);
        progress.advance(GRAIN)?;
        Ok(part)
    });
    let mut parts = parts.collect::<Result<Vec<Part>>>()?;
    parts.push(tile.pairs());
    Ok(tile.collect(parts))
}

/// The edges of the points' own graph that holds all edges of the whole between them.
///
/// # Errors
/// A cancelled `progress`.
pub fn candidates(delaunay: &Delaunay, rule: &impl Rule, progress: &Progress) -> Result<Edges> {
    select(delaunay, progress, || (), |(), edge| rule.may_join(delaunay, edge))
}

/// A question, and what helps to answer it.
struct Tile<'a, R> {
    delaunay: &'a Delaunay,
    rule: &'a R,
    question: &'a Question<'a>,
    coarse: Sectors,
    fine: Sectors,
}

/// The answer for some of the vertices.
#[derive(Default)]
struct Part {
    edges: Edges,
    open_edges: Vec<(Edge, [Option<Disk>; 2])>,
    open_vertices: Vec<(u32, Reach)>,
}

/// Which unseen pieces may hold partners of a vertex.
struct Reach {
    farthest: f64,
    pieces: Vec<u32>,
}

impl<'a, R: Rule> Tile<'a, R> {
    fn new(delaunay: &'a Delaunay, rule: &'a R, question: &'a Question<'a>) -> Self {
        let [coarse, fine] = [COARSE, FINE].map(Sectors::new);
        Self { delaunay, rule, question, coarse, fine }
    }

    fn flag(&self, flags: &[bool], vertex: u32) -> bool {
        flags[self.delaunay.rows()[vertex as usize] as usize]
    }

    fn part(&self, start: usize) -> Part {
        let end = (start + GRAIN).min(self.delaunay.points().len());
        let (mut part, mut memory) = (Part::default(), R::Memory::default());
        let Question { own, fresh, .. } = *self.question;
        for p in start as u32..end as u32 {
            let (p_own, p_fresh) = (self.flag(own, p), self.flag(fresh, p));
            let wanted = |edge: &Edge| {
                p_own && self.flag(fresh, edge.q) || p_fresh && self.flag(own, edge.q)
            };
            for edge in self.delaunay.edges_from(p).filter(wanted) {
                self.decide_edge(edge, &mut memory, &mut part);
            }
            if p_own && let Some(reach) = self.open(p) {
                part.open_vertices.push((p, reach));
            }
        }
        part
    }

    fn pairs(&self) -> Part {
        let (mut part, mut memory) = (Part::default(), R::Memory::default());
        if self.question.pairs.is_empty() {
            return part;
        }
        let vertex = vertices_of_rows(self.delaunay);
        for pair in self.question.pairs {
            let [p, q] = pair.map(|row| vertex[row as usize]);
            let (p, q) = (p.min(q), p.max(q));
            // Not in the triangulation: no edge, by the third lemma.
            if let Some(edge) = self.delaunay.edges_from(p).find(|edge| edge.q == q) {
                self.decide_edge(edge, &mut memory, &mut part);
            }
        }
        part
    }

    fn decide_edge(&self, edge: Edge, memory: &mut R::Memory, part: &mut Part) {
        let Finding { is_in, rests_on } = self.rule.find(self.delaunay, edge, memory);
        if rests_on.iter().flatten().any(|disk| self.question.unseen.hides(disk)) {
            part.open_edges.push((edge, rests_on));
        } else if is_in {
            part.edges.push(rows(self.delaunay, edge.p, edge.q));
        }
    }

    /// The unseen pieces that may hold partners of `p`, if any.
    fn open(&self, p: u32) -> Option<Reach> {
        let (unseen, site) = (self.question.unseen, self.delaunay.point(p));
        let clearance = unseen.clearance(site);
        let [mut support, mut reach] = [[0.0; FINE]; 2];
        for sectors in [&self.coarse, &self.fine] {
            let (support, reach) = (&mut support[..sectors.len()], &mut reach[..sectors.len()]);
            sectors.support(self.delaunay, p, support);
            self.rule.reach(sectors, support, reach);
            if reach.iter().all(|&reach| reach < clearance) {
                return None;
            }
        }
        let farthest = reach.iter().copied().fold(0.0, f64::max);
        let disk = Disk::new(site, [0.0; 2], farthest, 0.0);
        let pieces = unseen.unknown(|bounds| {
            disk.meets(bounds) && self.fine.may_reach(&reach, &bounds.seen_from(site))
        });
        (!pieces.is_empty()).then_some(Reach { farthest, pieces })
    }

    fn collect(&self, parts: Vec<Part>) -> Decision {
        let mut requests = Requests::new(self.question);
        let mut decision = Decision::default();
        let (mut edges, mut open_edges, mut open) = (Vec::new(), Edges::new(), Vec::new());
        for part in parts {
            edges.push(part.edges);
            for (edge, disks) in part.open_edges {
                open_edges.push(rows(self.delaunay, edge.p, edge.q));
                requests.for_disks(self.delaunay.point(edge.p), &disks);
            }
            for (p, reach) in part.open_vertices {
                requests.for_partners(self.delaunay, p, &reach);
                open.push((
                    self.delaunay.rows()[p as usize],
                    reach.farthest / self.delaunay.scale(),
                ));
            }
        }
        open.sort_unstable_by_key(|&(row, _)| row);
        (decision.open_vertices, decision.reach) = open.into_iter().unzip();
        decision.edges = sort(&edges, self.delaunay.input_len());
        decision.open_edges = sort(&[open_edges], self.delaunay.input_len());
        decision.requests = requests.in_order(self.delaunay.scale());
        decision
    }
}

/// The parts of the unseen to be seen next: for each piece a rectangle around all that is asked of it.
struct Requests<'a> {
    question: &'a Question<'a>,
    parts: Vec<Bounds>,
}

impl<'a> Requests<'a> {
    fn new(question: &'a Question<'a>) -> Self {
        Self { question, parts: vec![Bounds::EMPTY; question.unseen.len()] }
    }

    fn for_disks(&mut self, p: Point, disks: &[Option<Disk>; 2]) {
        for disk in disks.iter().flatten() {
            for (_, piece) in self.nearest(p, self.question.unseen.in_disk(disk)) {
                self.add(piece, disk);
            }
        }
    }

    /// Each piece is asked for twice as far as it is away: what is found there mostly hides the rest.
    fn for_partners(&mut self, delaunay: &Delaunay, p: u32, reach: &Reach) {
        let site = delaunay.point(p);
        let neighbors = delaunay.star(p).neighbors.iter();
        let spacing = neighbors.map(|&q| length(sub(delaunay.point(q), site)));
        let spacing = spacing.fold(f64::INFINITY, f64::min);
        for (distance, piece) in self.nearest(site, reach.pieces.clone()) {
            let radius = reach.farthest.min(2.0 * distance.max(spacing));
            self.add(piece, &Disk::new(site, [0.0; 2], radius, 0.0));
        }
    }

    /// The nearest `pieces`, with their distances from `p`.
    fn nearest(&self, p: Point, pieces: Vec<u32>) -> Vec<(f64, u32)> {
        let distance = |k: u32| self.question.unseen.piece(k).square_to(p).sqrt();
        let mut near: Vec<_> = pieces.into_iter().map(|k| (distance(k), k)).collect();
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(self.question.most);
        near
    }

    /// Ask for the part of a piece in the square around a disk.
    fn add(&mut self, piece: u32, disk: &Disk) {
        let (square, piece_bounds) = (disk.square(), self.question.unseen.piece(piece));
        let entry = &mut self.parts[piece as usize];
        *entry = entry.join(square.clamped(piece_bounds));
    }

    fn in_order(self, scale: f64) -> Vec<(u32, Bounds)> {
        let asked = |part: &Bounds| part.low[0] <= part.high[0];
        let numbered = (0u32..).zip(self.parts).filter(|(_, part)| asked(part));
        numbered.map(|(piece, part)| (piece, part.scaled(1.0 / scale))).collect()
    }
}
