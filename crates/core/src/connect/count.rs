//! A known number of curves is reached by the cheapest changes, by beliefs: one at a time, the cheapest of all.

use super::candidates::Candidates;
use super::features::half_edge;
use super::found::Found;
use super::prune::{components, drop_edges, is_kept};
use super::selection::Selection;
use crate::error::{Error, Result};

/// The edges that a change takes out and puts in, as half-edges.
#[derive(Debug, Clone, Default)]
struct Change {
    cost: f32,
    goes: Vec<usize>,
    comes: Vec<usize>,
}

/// No component.
const NONE: u32 = u32::MAX;

/// Join or split curves until there are `wanted` of them.
///
/// # Errors
/// No change leads there.
pub fn reach(found: &Found<'_>, wanted: usize, selection: &mut Selection) -> Result<()> {
    loop {
        let curves = components(&found.factors(), selection)?;
        let count = curves.len();
        if count == wanted {
            return Ok(());
        }
        let state = State::new(found, selection, &curves);
        let change =
            if count > wanted { state.cheapest_join() } else { state.cheapest_split(&curves) };
        let Some(change) = change else {
            let hints = if count > wanted { "joins" } else { "splits" };
            let message = format!(
                "components={wanted}: there are {count} curves, and no change that the other hints allow {hints} any"
            );
            return Err(Error::Argument { message });
        };
        let dropped = change.goes.is_empty() && change.comes.is_empty();
        if dropped {
            let least = state.cheapest_drop(&curves).map(|(_, k)| k).unwrap_or_default();
            drop_edges(&found.factors(), selection, &curves[least]);
        }
        for (edges, is_in) in [(&change.goes, false), (&change.comes, true)] {
            for &e in edges {
                selection.set(&found.candidates, e, is_in);
            }
        }
    }
}

/// Curves as they are now.
struct State<'a> {
    found: &'a Found<'a>,
    selection: &'a Selection,
    /// The curve of each vertex.
    curve: Vec<u32>,
    /// How many vertices each curve has.
    sizes: Vec<u32>,
    /// Is each curve a ring?
    is_ring: Vec<bool>,
    /// The place of each vertex along its curve.
    place: Vec<u32>,
    /// What dropping a whole curve costs, if one may be.
    drop: Option<(f32, usize)>,
}

impl<'a> State<'a> {
    fn new(found: &'a Found<'a>, selection: &'a Selection, curves: &[Vec<usize>]) -> Self {
        let vertices = found.candidates.vertices();
        let (mut curve, mut place) = (vec![NONE; vertices], vec![0; vertices]);
        let mut is_ring = Vec::with_capacity(curves.len());
        for (k, own) in curves.iter().enumerate() {
            is_ring.push(own.iter().all(|&v| selection.degrees[v] == 2));
            for (n, v) in walk(&found.candidates, selection, own).into_iter().enumerate() {
                (curve[v], place[v]) = (k as u32, n as u32);
            }
        }
        let sizes = curves.iter().map(|own| own.len() as u32).collect();
        let mut state = Self { found, selection, curve, sizes, is_ring, place, drop: None };
        state.drop = state.cheapest_drop(curves);
        state
    }

    /// What taking out costs: what is believed in the edge.
    fn out(&self, e: usize) -> f32 {
        (-self.found.beliefs[e]).max(0.0)
    }

    fn into(&self, e: usize) -> f32 {
        self.found.beliefs[e].max(0.0)
    }

    fn end(&self, e: usize) -> usize {
        self.found.candidates.ends[e] as usize
    }

    fn may_go(&self, e: usize) -> bool {
        !self.found.candidates.is_kept(e)
    }

    /// The half-edges chosen at `v` that may go.
    fn going(&self, v: usize) -> impl Iterator<Item = usize> + '_ {
        self.selection.from(&self.found.candidates, v).filter(|&e| self.may_go(e))
    }

    /// Half-edges that are not in, each once, with their ends.
    fn absent(&self) -> impl Iterator<Item = (usize, [usize; 2])> + '_ {
        let edges = self.found.candidates.edges().filter(|&(_, e)| !self.selection.chosen[e]);
        edges.map(|(v, e)| (e, [v, self.end(e)]))
    }

    /// May `v` take one more edge?
    fn is_open(&self, v: usize) -> bool {
        self.selection.degrees[v] < self.found.known.most(v)
    }

    fn cheapest_join(&self) -> Option<Change> {
        let apart = self.absent().filter(|&(_, [v, w])| {
            self.curve[v] != NONE && self.curve[w] != NONE && self.curve[v] != self.curve[w]
        });
        let joins = apart.flat_map(|(e, [v, w])| self.joins(e, v, w));
        let dropped = self.drop.map(|(cost, _)| Change { cost, ..Change::default() });
        least(joins.chain(dropped))
    }

    /// Changes that join the curves of `v` and `w` by edge `e`, which may open rings for it.
    fn joins(&self, e: usize, v: usize, w: usize) -> Vec<Change> {
        let mut changes = Vec::new();
        if !self.found.known.closed {
            let choices = [v, w].map(|u| self.openings(u));
            for a in &choices[0] {
                for b in &choices[1] {
                    let goes: Vec<usize> = [*a, *b].into_iter().flatten().collect();
                    let cost = self.into(e) + goes.iter().map(|&e| self.out(e)).sum::<f32>();
                    changes.push(Change { cost, goes, comes: vec![e] });
                }
            }
        }
        if self.is_ring[self.curve[v] as usize] || self.is_ring[self.curve[w] as usize] {
            changes.extend(self.exchanges(e, v, w));
        }
        for [v, w] in [[v, w], [w, v]] {
            if !self.found.known.closed && self.is_open(v) && !self.is_open(w) {
                changes.extend(self.insertions(e, v, w));
            }
        }
        changes
    }

    /// Changes that lead an end `v` into a curve at `w` along `e`, where the edge to the next point goes, which is joined to
    /// another end.
    fn insertions(&self, e: usize, v: usize, w: usize) -> Vec<Change> {
        let mut changes = Vec::new();
        for b in self.going(w) {
            let y = self.end(b);
            for f in self.found.candidates.from(y).filter(|&f| !self.selection.chosen[f]) {
                let z = self.end(f);
                if self.is_open(z) && z != v && self.curve[z] != NONE && self.is_fewer([w, y, z]) {
                    let cost = self.into(e) + self.into(f) + self.out(b);
                    changes.push(Change { cost, goes: vec![b], comes: vec![e, f] });
                }
            }
        }
        changes
    }

    /// Are curves fewer once w y is out and y z is in, and w on another curve, whose end it took?
    fn is_fewer(&self, [w, y, z]: [usize; 3]) -> bool {
        // Unless z is on the part that y is on, which would be a ring then.
        let beyond_w = (self.place[z] < self.place[w]) == (self.place[w] < self.place[y]);
        self.curve[z] != self.curve[w] || beyond_w
    }

    /// What may go at `u` so that it can take an edge and its curve stays whole: nothing at an end, an edge of a ring.
    fn openings(&self, u: usize) -> Vec<Option<usize>> {
        if self.is_open(u) {
            vec![None]
        } else if self.is_ring[self.curve[u] as usize] {
            self.going(u).map(Some).collect()
        } else {
            Vec::new()
        }
    }

    /// Changes that take v to w in along `e`, and beside it a second edge between the next points.
    fn exchanges(&self, e: usize, v: usize, w: usize) -> Vec<Change> {
        let mut changes = Vec::new();
        for a in self.going(v) {
            for b in self.going(w) {
                let second = half_edge(&self.found.candidates, self.end(a), self.end(b));
                if let Some(f) = second.filter(|&f| !self.selection.chosen[f]) {
                    let cost = self.into(e) + self.into(f) + self.out(a) + self.out(b);
                    changes.push(Change { cost, goes: vec![a, b], comes: vec![e, f] });
                }
            }
        }
        changes
    }

    /// The curve that is dropped at least cost, if any may be.
    fn cheapest_drop(&self, curves: &[Vec<usize>]) -> Option<(f32, usize)> {
        let may_go = |own: &[usize]| {
            own.iter().all(|&v| self.found.known.fits(v, 0)) && !is_kept(&self.found.factors(), own)
        };
        let cost = |own: &[usize]| {
            let edges = own.iter().flat_map(|&v| self.selection.from(&self.found.candidates, v));
            edges.map(|e| self.out(e)).sum::<f32>() / 2.0
        };
        let droppable = curves.iter().enumerate().filter(|(_, own)| may_go(own));
        droppable.map(|(k, own)| (cost(own), k)).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn cheapest_split(&self, curves: &[Vec<usize>]) -> Option<Change> {
        let closed = self.found.known.closed;
        let cuts = self.found.candidates.edges().filter(|&(v, e)| {
            let is_cut = self.selection.chosen[e] && self.may_go(e) && !closed;
            is_cut && self.stays(v) && self.stays(self.end(e))
        });
        let cuts = cuts.filter(|&(v, _)| !self.is_ring[self.curve[v] as usize]);
        let cut = cuts.map(|(_, e)| Change { cost: self.out(e), goes: vec![e], comes: Vec::new() });
        let lone =
            self.absent().filter(|&(_, ends)| !closed && ends.iter().all(|&v| self.is_lone(v)));
        let pair =
            lone.map(|(e, _)| Change { cost: self.into(e), goes: Vec::new(), comes: vec![e] });
        let within = self
            .absent()
            .filter(|&(_, [v, w])| self.curve[v] != NONE && self.curve[v] == self.curve[w]);
        let twist = within.flat_map(|(e, [v, w])| {
            let mut changes = self.exchanges(e, v, w);
            changes.retain(|change| self.is_split(change));
            changes
        });
        let rings = curves.iter().enumerate().filter(|&(k, _)| self.is_ring[k] && !closed);
        let twice = rings.filter_map(|(_, own)| self.two_cuts(own));
        least(cut.chain(pair).chain(twist).chain(twice))
    }

    /// Does `v` stay on a curve without one of its edges?
    fn stays(&self, v: usize) -> bool {
        self.selection.degrees[v] == 2
    }

    fn is_lone(&self, v: usize) -> bool {
        self.selection.degrees[v] == 0 && self.found.known.most(v) > 0
    }

    /// The two edges of a ring that go at least cost, no two of them at one point.
    fn two_cuts(&self, ring: &[usize]) -> Option<Change> {
        let own = ring.iter().flat_map(|&v| self.going(v).filter(move |&e| v < self.end(e)));
        let mut sorted: Vec<usize> = own.collect();
        sorted.sort_by(|&a, &b| self.out(a).total_cmp(&self.out(b)).then(a.cmp(&b)));
        let &first = sorted.first()?;
        let ends = |e: usize| [self.end(e), self.end(self.found.candidates.twins[e] as usize)];
        let is_apart = |&&e: &&usize| ends(e).iter().all(|v| !ends(first).contains(v));
        let &second = sorted.iter().find(is_apart)?;
        let cost = self.out(first) + self.out(second);
        Some(Change { cost, goes: vec![first, second], comes: Vec::new() })
    }

    /// Does an exchange within one curve make two of it: does it join both ends of the part between the edges that go?
    fn is_split(&self, change: &Change) -> bool {
        let [a, b] = [change.goes[0], change.goes[1]];
        let from = |e: usize| self.end(self.found.candidates.twins[e] as usize);
        let place = |v: usize| self.place[v];
        let length = self.sizes[self.curve[from(a)] as usize];
        // The exchange joins from(a) to from(b), and end(a) to end(b): a splits if one goes along and the other back.
        let forward = |e: usize| (place(from(e)) + 1) % length == place(self.end(e));
        if forward(a) == forward(b) {
            return false;
        }
        let inner = place(from(a))
            .abs_diff(place(from(b)))
            .min(place(self.end(a)).abs_diff(place(self.end(b))));
        inner >= 2 && length >= inner + 4
    }
}

/// The vertices of a curve in order.
fn walk(candidates: &Candidates, selection: &Selection, own: &[usize]) -> Vec<usize> {
    let start = own.iter().copied().find(|&v| selection.degrees[v] == 1).unwrap_or(own[0]);
    let mut order = vec![start];
    let mut next = selection.from(candidates, start).next();
    while let Some(e) = next {
        let v = candidates.ends[e] as usize;
        if v == start {
            break;
        }
        order.push(v);
        next = selection.next(candidates, e);
    }
    order
}

fn least(changes: impl Iterator<Item = Change>) -> Option<Change> {
    changes.min_by(|a, b| a.cost.total_cmp(&b.cost))
}
