//! Voronoi vertices inside a disk that touches two points: the search that the crust rests on.

use crate::delaunay::{Delaunay, Edge, NONE};
use crate::exact::filter::UNDERFLOW;
use crate::exact::pencil::{Disk, Pencil, Vertex};
use crate::point::{Point, cross, dot, sub};
use std::collections::HashSet;

/// A search for a Voronoi vertex inside a disk: a walk over the cells that meet it, and its memory.
pub struct Visit {
    cells: Vec<u32>,
    many: HashSet<u32>,
    /// Which neighbors of a cell a part of the disk may be nearer to.
    near: Vec<u32>,
    /// How many cells more than usual the walks to come may pass, if that is limited.
    allowance: Option<usize>,
    /// How many searches have been given up since the last walk, and how many are before another walk is tried.
    given_up: usize,
    patience: usize,
}

/// A walk was given up.
#[derive(Debug)]
pub struct TooLong;

/// Cells up to which a list is searched faster than a hash table.
const FEW: usize = 24;

/// Cells that a walk may always pass.
const USUAL: usize = 4;
/// Cells beyond that, for one walk or for many.
const ALLOWANCE: usize = 1 << 10;
/// With fewer cells left a search is given up before it begins.
const LEAST: usize = 16;

impl Default for Visit {
    /// One whose walks are given up where they pass more cells than pays.
    fn default() -> Self {
        Self {
            cells: Vec::new(),
            many: HashSet::new(),
            near: Vec::new(),
            allowance: Some(ALLOWANCE),
            given_up: 0,
            patience: LEAST,
        }
    }
}

impl Visit {
    /// One whose walks are never given up.
    pub fn without_limit() -> Self {
        Self { allowance: None, ..Self::default() }
    }

    /// To be asked before the search for the disk of an edge: is there an allowance for it?
    #[inline]
    pub fn begin(&mut self) -> Result<(), TooLong> {
        match &mut self.allowance {
            Some(allowance) if *allowance < LEAST => {
                self.given_up += 1;
                if self.given_up <= self.patience {
                    return Err(TooLong);
                }
                // If it, too, is given up, the next ones are likely to be: wait for twice as long.
                (*allowance, self.given_up, self.patience) = (LEAST, 0, 2 * self.patience);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// A Voronoi vertex strictly inside `disk`, if there is one.
    ///
    /// Visits the cells of p and q and crosses each Voronoi edge that may meet the disk. The disk is connected, so this
    /// reaches every cell that meets it, and with them every Voronoi vertex inside.
    pub fn find(
        &mut self,
        delaunay: &Delaunay,
        edge: Edge,
        pencil: &Pencil,
        disk: &Disk,
    ) -> Result<Option<Vertex>, TooLong> {
        let most = self.allowance.map_or(usize::MAX, |allowance| USUAL + allowance);
        self.cells.clear();
        self.many.clear();
        self.cells.extend([edge.p, edge.q]);
        let ratio = disk.radius / dot(pencil.chord(), pencil.chord()).sqrt();
        let apex = own_apex(delaunay, edge, pencil, disk);
        let known_at_end = |other| [if apex == NONE { NONE } else { other }; 2];
        let (mut next, mut found) = (0, None);
        while next < self.cells.len() && found.is_none() && next < most {
            let cell = self.cells[next];
            #[cfg(test)]
            crate::progress::work_tests::count(crate::progress::work_tests::CELL);
            let site = delaunay.point(cell);
            let (chord, known) = match next {
                0 => (pencil.chord(), known_at_end(edge.q)),
                1 => (sub(pencil.p, pencil.q), known_at_end(edge.p)),
                // Nothing is ahead.
                _ => ([0.0; 2], [edge.p, edge.q]),
            };
            let part = Part::new(disk, pencil, site, Half { chord, ratio }, apex, known);
            found = self.search_cell(delaunay, next, pencil, &part);
            next += 1;
        }
        if let Some(allowance) = &mut self.allowance {
            *allowance = (*allowance + USUAL).saturating_sub(next).min(ALLOWANCE);
        }
        if found.is_none() && next < self.cells.len() { Err(TooLong) } else { Ok(found) }
    }

    /// Look at the corners of cell number `number` of the visit; add the cells behind the sides that the disk crosses.
    ///
    /// A corner is on two bisectors, so both must meet the disk; and it is of three cells: those of earlier cells are known.
    fn search_cell(
        &mut self,
        delaunay: &Delaunay,
        number: usize,
        pencil: &Pencil,
        part: &Part<'_>,
    ) -> Option<Vertex> {
        let star = delaunay.star(self.cells[number]);
        let count = star.neighbors.len();
        let near = part.near(delaunay, star.neighbors, &mut self.near);
        for i in 0..near {
            let k = self.near[i] as usize;
            let before = if k > 0 { k - 1 } else { count - 1 };
            let after = if k + 1 < count { k + 1 } else { 0 };
            let this = star.neighbors[k];
            let [at_before, at, at_after] =
                [before, k, after].map(|k| delaunay.point(star.neighbors[k]));
            let is_before_near = self.near[if i > 0 { i - 1 } else { near - 1 }] as usize == before;
            if is_before_near
                && (k > 0 || !star.on_hull)
                && !self.was_at(number, star.neighbors[before], this)
            {
                let vertex = pencil.vertex([part.site, at_before, at]);
                if pencil.holds(part.disk, &vertex) {
                    return Some(vertex);
                }
            }
            if part.may_cross(at, [at_before, at_after]) {
                self.add(this);
            }
        }
        None
    }

    /// Was one of two cells visited before cell number `number`?
    fn was_at(&self, number: usize, one: u32, other: u32) -> bool {
        number <= FEW && self.cells[..number].iter().any(|&cell| cell == one || cell == other)
    }

    fn add(&mut self, cell: u32) {
        let is_new = if self.cells.len() <= FEW {
            !self.cells.contains(&cell)
        } else {
            if self.many.is_empty() {
                self.many.extend(&self.cells);
            }
            self.many.insert(cell)
        };
        if is_new {
            self.cells.push(cell);
        }
    }
}

/// The part of a disk that can be in the cell of `site`: all of it, or in the cells of p and q the nearer half.
struct Part<'a> {
    disk: &'a Disk,
    site: Point,
    /// The center relative to the site.
    center: Point,
    /// More than the rounding errors of the distances below.
    doubt: f64,
    half: Half,
    /// The apex of the edge's own triangle whose center the circle goes through, if that is so.
    apex: u32,
    /// Neighbors at whose sides nothing is to be found: where they have been visited, and where the ends are the edge's own centers, of which
    /// then neither is inside.
    known: [u32; 2],
}

/// The half of a disk that is nearer to one end of the edge.
struct Half {
    /// The vector to the other end.
    chord: Point,
    /// The disk's radius over the length of the chord.
    ratio: f64,
}

impl<'a> Part<'a> {
    /// The part of `disk` in the cell of `site`, and in the half of it that `half` tells.
    fn new(
        disk: &'a Disk,
        pencil: &Pencil,
        site: Point,
        half: Half,
        apex: u32,
        known: [u32; 2],
    ) -> Self {
        let center = sub(disk.center, sub(site, pencil.p));
        let size = center[0].abs() + center[1].abs() + disk.radius;
        Self { disk, site, center, doubt: 1e-14 * size + 2.0 * disk.error, half, apex, known }
    }

    /// Can the disk cross the side of the cell to the neighbor at `this`, given that it holds none of its ends? False only if it certainly
    /// does not.
    ///
    /// It meets the line of the side around the foot of its center, so if the foot is beyond an end, on the other side of the
    /// bisector `beside` it, all between that end and the disk's part of the line is outside of the cell.
    #[inline]
    fn may_cross(&self, this: Point, beside: [Point; 2]) -> bool {
        let g = sub(this, self.site);
        let far = dot(g, g);
        if far < UNDERFLOW {
            return true;
        }
        let step = (far / 2.0 - dot(self.center, g)) / far;
        let foot = [self.center[0] + step * g[0], self.center[1] + step * g[1]];
        let doubt = 4.0 * self.doubt + 1e-13 * (g[0].abs() + g[1].abs());
        beside.iter().all(|&other| {
            let h = sub(other, self.site);
            let span = h[0].abs() + h[1].abs();
            let beyond = dot(foot, h) - dot(h, h) / 2.0 - (doubt + 1e-13 * span) * span;
            // An unknown (not a number) counts as crossing.
            beyond.is_nan() || beyond <= UNDERFLOW
        })
    }

    /// Write the numbers of the neighbors that a point of this part may be nearer to than to the site to the front of `near`; return how
    /// many these are.
    ///
    /// Without branches: most neighbors are far, but which ones are not no processor foresees.
    #[inline]
    fn near(&self, delaunay: &Delaunay, neighbors: &[u32], near: &mut Vec<u32>) -> usize {
        if near.len() < neighbors.len() {
            near.resize(neighbors.len(), 0);
        }
        let mut count = 0;
        for (k, &neighbor) in neighbors.iter().enumerate() {
            near[count] = k as u32;
            count += usize::from(self.may_reach(neighbor, delaunay.point(neighbor)));
        }
        count
    }

    /// Can a point of this part be nearer to `neighbor` than to the site? False only if certainly none is, or nothing is to be
    /// found at that side.
    ///
    /// The half disk ends on the bisector of p and q, there at the center of the own triangle, which is on the apex's bisector, too.
    #[inline]
    fn may_reach(&self, neighbor: u32, at: Point) -> bool {
        let g = sub(at, self.site);
        let span = g[0].abs() + g[1].abs();
        let far = dot(g, g);
        let Half { chord, ratio } = self.half;
        let is_ahead = dot(chord, g) > 1e-14 * span * (chord[0].abs() + chord[1].abs());
        // Where the direction is in doubt the whole disk serves, for it reaches no less.
        let [ahead, whole] = [ratio * cross(chord, g).abs(), self.disk.radius * far.sqrt()];
        let width = if is_ahead { ahead } else { whole };
        let reach = dot(self.center, g) + width + (self.doubt + 1e-14 * span) * span + UNDERFLOW;
        let is_known = self.known.contains(&neighbor) || neighbor == self.apex && is_ahead;
        // An unknown (not a number) counts as reaching.
        !is_known && (reach.is_nan() || reach > far / 2.0)
    }
}

/// The apex of the edge's own triangle whose center the circle of `disk` goes through, if that is so.
#[inline]
fn own_apex(delaunay: &Delaunay, edge: Edge, pencil: &Pencil, disk: &Disk) -> u32 {
    let Some(apex) = pencil.own_apex(disk) else { return NONE };
    let is_apex = |&vertex: &u32| delaunay.point(vertex) == apex;
    edge.left.filter(is_apex).or(edge.right).unwrap_or(NONE)
}
