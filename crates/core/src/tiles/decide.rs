//! Which edges are decided for good by the points that a tile has seen, and what the others need.

use super::disk::Disk;
use super::reach::{Reach, are_near};
use super::rule::{Finding, Rule, Work};
use super::unseen::Unseen;
use crate::adjacency::vertices_of_rows;
use crate::delaunay::{Delaunay, Edge};
use crate::edges::{Edges, rows, select, sort};
use crate::error::Result;
use crate::parts::{GRAIN, in_parts, short};
use crate::point::{Point, length, sub};
use crate::progress::{Progress, Stage};
use crate::space::bounds::Bounds;
use std::ops::Range;

/// Sectors of direction around a vertex: a multiple of four, so that right angles are whole.
const SECTORS: usize = 64;

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
    let vertices = delaunay.points().len();
    let mut parts = in_parts(vertices, GRAIN, progress, |vertices| {
        let mut part = (Part::default(), R::Memory::default());
        for few in short(vertices, progress) {
            tile.part(few, &mut part);
        }
        part.0
    })?;
    parts.push(tile.pairs());
    parts.push(tile.late(&parts, progress)?);
    Ok(tile.collect(parts))
}

/// A call of [`decide`] whose rule is yet to be found.
#[derive(Debug, Clone, Copy)]
pub struct Decide<'a>(pub &'a Delaunay, pub Question<'a>, pub &'a Progress);

impl Work for Decide<'_> {
    type Result = Decision;
    fn by<R: Rule>(self, rule: &R) -> Result<Decision> {
        decide(self.0, rule, &self.1, self.2)
    }
}

/// A call of [`candidates`] whose rule is yet to be found.
#[derive(Debug, Clone, Copy)]
pub struct Candidates<'a>(pub &'a Delaunay, pub &'a Progress);

impl Work for Candidates<'_> {
    type Result = Edges;
    fn by<R: Rule>(self, rule: &R) -> Result<Edges> {
        candidates(self.0, rule, self.1)
    }
}

/// The edges of the points' own graph that holds all edges of the whole between them.
///
/// # Errors
/// A cancelled `progress`.
pub fn candidates(delaunay: &Delaunay, rule: &impl Rule, progress: &Progress) -> Result<Edges> {
    select(delaunay, progress, || (), |(), edge| rule.may_join(delaunay, edge))
}

/// The neighbors of each of `rows` in the triangulation, as rows.
#[must_use]
pub fn stars(delaunay: &Delaunay, rows: &[u32]) -> Vec<Vec<u32>> {
    let vertex = vertices_of_rows(delaunay);
    let star = |&row: &u32| {
        let neighbors = delaunay.star(vertex[row as usize]).neighbors;
        neighbors.iter().map(|&neighbor| delaunay.rows()[neighbor as usize]).collect()
    };
    rows.iter().map(star).collect()
}

/// A question, and what helps to answer it.
struct Tile<'a, R> {
    delaunay: &'a Delaunay,
    rule: &'a R,
    question: &'a Question<'a>,
    reach: Reach,
    /// For each vertex: is it own, and is it fresh?
    flags: Vec<[bool; 2]>,
}

/// The answer for some of the vertices.
#[derive(Default)]
struct Part {
    edges: Edges,
    open_edges: Vec<(Edge, [Option<Disk>; 2])>,
    open_vertices: Vec<(u32, Partners)>,
    /// The edges that take too long to decide one by one.
    late: Vec<Edge>,
}

/// Which unseen pieces may hold partners of a vertex.
struct Partners {
    farthest: f64,
    pieces: Vec<u32>,
}

impl<'a, R: Rule> Tile<'a, R> {
    fn new(delaunay: &'a Delaunay, rule: &'a R, question: &'a Question<'a>) -> Self {
        let reach = Reach::new(rule.partners(), SECTORS);
        let flags = |&row: &u32| [question.own[row as usize], question.fresh[row as usize]];
        let flags = delaunay.rows().iter().map(flags).collect();
        Self { delaunay, rule, question, reach, flags }
    }

    fn part(&self, vertices: Range<usize>, (part, memory): &mut (Part, R::Memory)) {
        for p in vertices.start as u32..vertices.end as u32 {
            let [p_own, p_fresh] = self.flags[p as usize];
            let wanted = |edge: &Edge| {
                let [q_own, q_fresh] = self.flags[edge.q as usize];
                p_own && q_fresh || q_own && p_fresh
            };
            for edge in self.delaunay.edges_from(p).filter(wanted) {
                self.decide_edge(edge, memory, part);
            }
            if p_own && let Some(partners) = self.unseen_partners(p) {
                part.open_vertices.push((p, partners));
            }
        }
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
        match self.rule.find(self.delaunay, edge, memory) {
            Some(finding) => self.settle(edge, &finding, part),
            None => part.late.push(edge),
        }
    }

    /// The edges of `parts` that were put off.
    fn late(&self, parts: &[Part], progress: &Progress) -> Result<Part> {
        let mut part = Part::default();
        let late: Vec<Edge> = parts.iter().flat_map(|part| &part.late).copied().collect();
        if !late.is_empty() {
            for (edge, finding) in self.rule.find_late(self.delaunay, &late, progress)? {
                self.settle(edge, &finding, &mut part);
            }
        }
        Ok(part)
    }

    fn settle(&self, edge: Edge, finding: &Finding, part: &mut Part) {
        let &Finding { is_in, rests_on } = finding;
        if rests_on.iter().flatten().any(|disk| self.question.unseen.hides(disk)) {
            part.open_edges.push((edge, rests_on));
        } else if is_in {
            part.edges.push(rows(self.delaunay, edge.p, edge.q));
        }
    }

    /// The unseen pieces that may hold partners of `p`, if any.
    fn unseen_partners(&self, p: u32) -> Option<Partners> {
        let (unseen, site) = (self.question.unseen, self.delaunay.point(p));
        let clearance = unseen.clearance(site);
        if are_near(self.rule.partners(), self.delaunay, p, clearance) {
            return None;
        }
        let [mut support, mut bounds] = [[0.0; SECTORS]; 2];
        self.reach.support(self.delaunay, p, &mut support);
        self.reach.bounds(&support, &mut bounds);
        let farthest = bounds.iter().copied().fold(0.0, f64::max);
        if farthest < clearance {
            return None;
        }
        let disk = Disk::new(site, [0.0; 2], farthest, 0.0);
        let pieces = unseen.unknown(|piece| {
            disk.meets(piece) && self.reach.may_hold(&bounds, &piece.seen_from(site))
        });
        (!pieces.is_empty()).then_some(Partners { farthest, pieces })
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
            for (p, partners) in part.open_vertices {
                requests.for_partners(self.delaunay, p, &partners);
                open.push((
                    self.delaunay.rows()[p as usize],
                    partners.farthest / self.delaunay.scale(),
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
    fn for_partners(&mut self, delaunay: &Delaunay, p: u32, partners: &Partners) {
        let site = delaunay.point(p);
        let neighbors = delaunay.star(p).neighbors.iter();
        let spacing = neighbors.map(|&q| length(sub(delaunay.point(q), site)));
        let spacing = spacing.fold(f64::INFINITY, f64::min);
        for (distance, piece) in self.nearest(site, partners.pieces.clone()) {
            let radius = partners.farthest.min(2.0 * distance.max(spacing));
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
