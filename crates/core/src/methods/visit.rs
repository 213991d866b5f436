//! Voronoi vertices inside a disk that touches two points: the search that the crust rests on.

use crate::delaunay::{Delaunay, Edge};
use crate::exact::filter::UNDERFLOW;
use crate::exact::pencil::{Disk, Pencil, Vertex};
use crate::point::{Point, cross, dot, sub};
use std::collections::HashSet;

/// A search for a Voronoi vertex inside a disk: a walk over the cells that meet it, and its memory.
pub struct Visit {
    cells: Vec<u32>,
    many: HashSet<u32>,
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
        let (mut next, mut found) = (0, None);
        while next < self.cells.len() && found.is_none() && next < most {
            let cell = self.cells[next];
            #[cfg(test)]
            crate::progress::work_tests::count(crate::progress::work_tests::CELL);
            let other = [edge.q, edge.p].get(next).map(|&end| delaunay.point(end));
            let part = Part::new(disk, pencil, delaunay.point(cell), other);
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
        let side = |k: usize| Side::new(part, star.neighbors[k], delaunay.point(star.neighbors[k]));
        let last = side(count.checked_sub(1)?);
        let (mut before, mut this) = (last, if count > 1 { side(0) } else { last });
        for k in 0..count {
            let after = if k + 1 < count { side(k + 1) } else { side(0) };
            if this.is_near {
                let is_corner = before.is_near && (k > 0 || !star.on_hull);
                if is_corner && !self.was_at(number, before.neighbor, this.neighbor) {
                    let vertex = pencil.vertex([part.site, before.point, this.point]);
                    if pencil.holds(part.disk, &vertex) {
                        return Some(vertex);
                    }
                }
                if part.may_cross(&this, [&before, &after]) {
                    self.add(this.neighbor);
                }
            }
            (before, this) = (this, after);
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
    half: Option<Half>,
    /// The apex of the edge's own triangle whose center the circle goes through.
    apex: Option<Point>,
}

/// The bisector of a cell's site and a neighbor.
#[derive(Clone, Copy)]
struct Side {
    neighbor: u32,
    point: Point,
    /// Can a point of the part be nearer to the neighbor than to the site?
    is_near: bool,
}

impl Side {
    #[inline]
    fn new(part: &Part<'_>, neighbor: u32, point: Point) -> Self {
        Self { neighbor, point, is_near: part.may_reach(point) }
    }
}

/// The half of a disk that is nearer to one end of the edge.
struct Half {
    /// The vector to the other end.
    chord: Point,
    /// The disk's radius over the length of the chord.
    ratio: f64,
}

impl<'a> Part<'a> {
    /// The part of `disk` in the cell of `site`; `other` is the other end of the edge, if `site` is one.
    fn new(disk: &'a Disk, pencil: &Pencil, site: Point, other: Option<Point>) -> Self {
        let center = sub(disk.center, sub(site, pencil.p));
        let size = center[0].abs() + center[1].abs() + disk.radius;
        let half = other.map(|other| {
            let chord = sub(other, site);
            Half { chord, ratio: disk.radius / dot(chord, chord).sqrt() }
        });
        let apex = pencil.own_apex(disk);
        Self { disk, site, center, doubt: 1e-14 * size + 2.0 * disk.error, half, apex }
    }

    /// Can the disk cross the cell's `side`, given that it holds none of its ends? False only if it certainly does not.
    ///
    /// It meets the line of the side around the foot of its center, so if the foot is beyond an end, on the other side of the
    /// bisector `beside` it, all between that end and the disk's part of the line is outside of the cell.
    #[inline]
    fn may_cross(&self, side: &Side, beside: [&Side; 2]) -> bool {
        let g = sub(side.point, self.site);
        let far = dot(g, g);
        if far < UNDERFLOW {
            return true;
        }
        let step = (far / 2.0 - dot(self.center, g)) / far;
        let foot = [self.center[0] + step * g[0], self.center[1] + step * g[1]];
        let doubt = 4.0 * self.doubt + 1e-13 * (g[0].abs() + g[1].abs());
        beside.iter().all(|other| {
            let h = sub(other.point, self.site);
            let span = h[0].abs() + h[1].abs();
            let beyond = dot(foot, h) - dot(h, h) / 2.0 - (doubt + 1e-13 * span) * span;
            // An unknown (not a number) counts as crossing.
            beyond.is_nan() || beyond <= UNDERFLOW
        })
    }

    /// Can a point of this part be nearer to `neighbor` than to the site? False only if certainly none is.
    #[inline]
    fn may_reach(&self, neighbor: Point) -> bool {
        let g = sub(neighbor, self.site);
        let span = g[0].abs() + g[1].abs();
        let far = dot(g, g);
        let ahead = self.half.as_ref().filter(|half| half.faces(g, span));
        if ahead.is_some() && self.apex == Some(neighbor) {
            // The half disk ends on the bisector of p and q, there at that center, which is on this bisector, too.
            return false;
        }
        let width = match ahead {
            Some(half) => half.ratio * cross(half.chord, g).abs(),
            // Where the direction is in doubt the whole disk serves, for it reaches no less.
            None => self.disk.radius * far.sqrt(),
        };
        let reach = dot(self.center, g) + width + (self.doubt + 1e-14 * span) * span + UNDERFLOW;
        // An unknown (not a number) counts as reaching.
        reach.is_nan() || reach > far / 2.0
    }
}

impl Half {
    /// Does `g`, whose coordinates sum to `span`, certainly point to the other half?
    #[inline]
    fn faces(&self, g: Point, span: f64) -> bool {
        dot(self.chord, g) > 1e-14 * span * (self.chord[0].abs() + self.chord[1].abs())
    }
}
