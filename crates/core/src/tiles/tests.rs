//! Small sets of integers, where every tie lives, in random tiles: no final decision contradicts the whole, and none is missing.

use super::{
    BetaSkeleton, CrossingAngle, Crust, Joined, OneStepCrust, Question, Rule, Site, Unseen,
    candidates, chains, decide, join,
};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::methods;
use crate::point::Point;
use crate::progress::Progress;
use crate::space::bounds::Bounds;
use crate::trace::{trace, trace_between};
use crate::xorshift::Xorshift;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Numbers that look random.
struct Random(Xorshift);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        (self.0.next() >> 33) as usize % limit
    }
}

/// Distinct points, in tiles, in groups.
struct World {
    points: Vec<Point>,
    tile: Vec<usize>,
    tiles: usize,
    /// The tile and the rows of each group.
    groups: Vec<(usize, Vec<u32>)>,
}

impl World {
    fn new(points: Vec<Point>, random: &mut Random) -> Self {
        let mut tiles = vec![(0..points.len() as u32).collect::<Vec<_>>()];
        for _ in 0..random.below(6) {
            let k = random.below(tiles.len());
            let (axis, rows) = (random.below(2), tiles.swap_remove(k));
            let cut = points[rows[random.below(rows.len())] as usize][axis];
            let (low, high): (Vec<u32>, _) =
                rows.into_iter().partition(|&row| points[row as usize][axis] < cut);
            tiles.extend([low, high].into_iter().filter(|rows| !rows.is_empty()));
        }
        let mut tile = vec![0; points.len()];
        let mut groups = Vec::new();
        let size = 1 + random.below(5);
        for (k, rows) in tiles.iter().enumerate() {
            for &row in rows {
                tile[row as usize] = k;
            }
            groups.extend(rows.chunks(size).map(|rows| (k, rows.to_vec())));
        }
        Self { points, tile, tiles: tiles.len(), groups }
    }

    fn at(&self, row: u32) -> Point {
        self.points[row as usize]
    }

    fn bounds(&self, rows: &[u32]) -> Bounds {
        Bounds::of(&rows.iter().map(|&row| self.at(row)).collect::<Vec<_>>())
    }

    fn square(&self, i: u32, j: u32) -> f64 {
        (0..2).map(|axis| (self.at(i)[axis] - self.at(j)[axis]).powi(2)).sum()
    }
}

/// A part of a group that may hold unseen points.
#[derive(Clone, Copy)]
struct Piece {
    bounds: Bounds,
    group: usize,
    known: bool,
}

fn holds(bounds: &Bounds, p: Point) -> bool {
    (0..2).all(|axis| bounds.low[axis] <= p[axis] && p[axis] <= bounds.high[axis])
}

/// What is left of `piece` without `part`, which lies in it.
fn rest(piece: &Bounds, part: &Bounds) -> Vec<Bounds> {
    let Bounds { low: [left, bottom], high: [right, top] } = *piece;
    let ([a, b], [c, d]) = (part.low, part.high);
    let rest = [
        Bounds { low: [left, bottom], high: [a.next_down(), top] },
        Bounds { low: [c.next_up(), bottom], high: [right, top] },
        Bounds { low: [a, bottom], high: [c, b.next_down()] },
        Bounds { low: [a, d.next_up()], high: [c, top] },
    ];
    rest.into_iter().filter(|b| b.low[0] <= b.high[0] && b.low[1] <= b.high[1]).collect()
}

/// What of the world has not been seen.
struct Sight<'a> {
    world: &'a World,
    pieces: Vec<Piece>,
}

impl<'a> Sight<'a> {
    fn new(world: &'a World, groups: impl Fn(usize) -> Option<bool>) -> Self {
        let piece = |(group, (tile, rows)): (usize, &(usize, Vec<u32>))| {
            groups(*tile).map(|known| Piece { bounds: world.bounds(rows), group, known })
        };
        Self { world, pieces: world.groups.iter().enumerate().filter_map(piece).collect() }
    }

    /// Cut the parts out, and return the rows in them with whether they were known.
    fn read(&mut self, requests: &[(u32, Bounds)]) -> Vec<(u32, bool)> {
        let mut found = Vec::new();
        for (k, part) in requests {
            let Piece { bounds, group, known } = self.pieces[*k as usize];
            self.pieces[*k as usize].bounds = Bounds::EMPTY;
            let rows = self.world.groups[group].1.iter();
            let inside =
                |row: u32| holds(&bounds, self.world.at(row)) && holds(part, self.world.at(row));
            found.extend(rows.filter(|&&row| inside(row)).map(|&row| (row, known)));
            self.pieces.extend(rest(&bounds, part).into_iter().map(|bounds| Piece {
                bounds,
                group,
                known,
            }));
        }
        self.pieces.retain(|piece| piece.bounds.low[0] <= piece.bounds.high[0]);
        found
    }

    /// The part of each piece that is in `bounds`.
    fn within(&self, bounds: &Bounds) -> Vec<(u32, Bounds)> {
        let clip = |(k, piece): (u32, &Piece)| {
            let b = &piece.bounds;
            let low = [0, 1].map(|axis| b.low[axis].max(bounds.low[axis]));
            let high = [0, 1].map(|axis| b.high[axis].min(bounds.high[axis]));
            (low[0] <= high[0] && low[1] <= high[1]).then_some((k, Bounds { low, high }))
        };
        (0..).zip(&self.pieces).filter_map(clip).collect()
    }

    fn unseen(&self, clear: Bounds, scale: f64) -> Unseen {
        let bounds: Vec<Bounds> = self.pieces.iter().map(|piece| piece.bounds).collect();
        let known: Vec<bool> = self.pieces.iter().map(|piece| piece.known).collect();
        Unseen::new(&bounds, &known, clear, scale)
    }
}

/// What is open, with the points that come along.
#[derive(Default)]
struct Open {
    vertices: BTreeMap<u32, f64>,
    edges: BTreeSet<[u32; 2]>,
    rows: BTreeSet<u32>,
}

/// One run: the world, its edges in one piece, and those found so far.
struct Run<'a, R> {
    world: &'a World,
    rule: &'a R,
    whole: &'a BTreeSet<[u32; 2]>,
    found: BTreeSet<[u32; 2]>,
    most: usize,
}

impl<R: Rule> Run<'_, R> {
    /// Decide, and compare with the whole; `rows` are what is seen.
    fn decide(
        &mut self,
        rows: &[u32],
        own: &BTreeSet<u32>,
        fresh: &BTreeSet<u32>,
        pairs: &BTreeSet<[u32; 2]>,
        (sight, clear): (&Sight<'_>, Bounds),
    ) -> (Open, Vec<(u32, Bounds)>) {
        let points: Vec<Point> = rows.iter().map(|&row| self.world.at(row)).collect();
        let delaunay = Delaunay::new(&points, &Progress::default()).unwrap();
        let unseen = sight.unseen(clear, delaunay.scale());
        let local: HashMap<u32, u32> = rows.iter().zip(0..).map(|(&row, k)| (row, k)).collect();
        let local_pairs: Edges = pairs.iter().map(|pair| pair.map(|row| local[&row])).collect();
        let [own_flags, fresh_flags] =
            [own, fresh].map(|set| rows.iter().map(|row| set.contains(row)).collect::<Vec<_>>());
        let question = Question {
            own: &own_flags,
            fresh: &fresh_flags,
            pairs: &local_pairs,
            unseen: &unseen,
            most: self.most,
        };
        let decision = decide(&delaunay, self.rule, &question, &Progress::default()).unwrap();
        let row = |k: u32| rows[k as usize];
        let edge = |edge: &[u32; 2]| {
            let [i, j] = edge.map(row);
            [i.min(j), i.max(j)]
        };
        let mut open = Open::default();
        self.found.extend(decision.edges.iter().map(edge));
        assert!(self.found.is_subset(self.whole), "an edge is final that is none of the whole");
        open.edges.extend(decision.open_edges.iter().map(edge));
        let rows_reach = decision.open_vertices.iter().map(|&k| row(k)).zip(decision.reach);
        open.vertices.extend(rows_reach);
        for &k in decision.open_edges.as_flattened().iter().chain(&decision.open_vertices) {
            open.rows.insert(row(k));
            let vertex = delaunay.rows().iter().position(|&row| row == k).unwrap() as u32;
            let star = delaunay.star(vertex).neighbors.iter();
            open.rows.extend(star.map(|&v| row(delaunay.rows()[v as usize])));
        }
        self.none_is_missing(&local, own, fresh, pairs, &open);
        assert_eq!(open.edges.is_empty() && open.vertices.is_empty(), decision.requests.is_empty());
        (open, decision.requests)
    }

    fn none_is_missing(
        &self,
        local: &HashMap<u32, u32>,
        own: &BTreeSet<u32>,
        fresh: &BTreeSet<u32>,
        pairs: &BTreeSet<[u32; 2]>,
        open: &Open,
    ) {
        for &[i, j] in self.whole {
            for (p, q) in [(i, j), (j, i)] {
                let is_wanted = own.contains(&p) && fresh.contains(&q) || pairs.contains(&[i, j]);
                if local.contains_key(&i) && local.contains_key(&j) && is_wanted {
                    let is_there = self.found.contains(&[i, j]) || open.edges.contains(&[i, j]);
                    assert!(is_there, "an edge of the whole was decided out");
                }
                if own.contains(&p) && !local.contains_key(&q) && !self.found.contains(&[i, j]) {
                    let reach =
                        open.vertices.get(&p).expect("a vertex with unseen partners is open");
                    assert!(reach * reach >= self.world.square(i, j));
                }
            }
        }
    }

    fn tile(&mut self, tile: usize, halo: f64, rounds: usize) -> Open {
        let world = self.world;
        let rows: Vec<u32> = (0..world.points.len() as u32)
            .filter(|&row| world.tile[row as usize] == tile)
            .collect();
        let Bounds { low, high } = world.bounds(&rows);
        let clear = Bounds { low: low.map(|x| x - halo), high: high.map(|x| x + halo) };
        let mut sight = Sight::new(world, |other| (other != tile).then_some(false));
        let halo = sight.within(&clear);
        let seen = sight.read(&halo).into_iter().map(|(row, _)| row);
        let own: BTreeSet<u32> = rows.iter().copied().collect();
        let rows: Vec<u32> = rows.into_iter().chain(seen).collect();
        let all = rows.iter().copied().collect();
        let (open, _) = self.decide(&rows, &own, &all, &BTreeSet::new(), (&sight, clear));
        self.rounds(tile, &clear, open, rounds)
    }

    /// Read what open edges and vertices ask for, and decide those again, up to `rounds` times.
    fn rounds(&mut self, tile: usize, clear: &Bounds, mut open: Open, rounds: usize) -> Open {
        let mut sight = Sight::new(self.world, |other| Some(other == tile));
        for piece in sight.within(clear) {
            let Piece { bounds, group, known } = sight.pieces[piece.0 as usize];
            if !known {
                sight.pieces[piece.0 as usize].bounds = Bounds::EMPTY;
                let rest = rest(&bounds, &piece.1).into_iter();
                sight.pieces.extend(rest.map(|bounds| Piece { bounds, group, known }));
                sight.pieces.push(Piece { bounds: piece.1, group, known: true });
            }
        }
        sight.pieces.retain(|piece| piece.bounds.low[0] <= piece.bounds.high[0]);
        let mut rows = open.rows.clone();
        let mut fresh = BTreeSet::new();
        for _ in 0..rounds {
            let own = open.vertices.keys().copied().collect();
            let all: Vec<u32> = rows.iter().copied().collect();
            let (still, requests) =
                self.decide(&all, &own, &fresh, &open.edges, (&sight, Bounds::EMPTY));
            open = still;
            let read = sight.read(&requests);
            fresh = read
                .iter()
                .filter(|(row, known)| !known && !rows.contains(row))
                .map(|&(row, _)| row)
                .collect();
            rows.extend(read.iter().map(|&(row, _)| row));
        }
        // What was read last has not been decided on.
        if !fresh.is_empty() {
            let own = open.vertices.keys().copied().collect();
            let all: Vec<u32> = rows.iter().copied().collect();
            open = self.decide(&all, &own, &fresh, &open.edges, (&sight, Bounds::EMPTY)).0;
        }
        open
    }

    /// Find the edges between open vertices of different tiles, and settle everything.
    fn coordinate(&mut self, parts: &[Open]) {
        let mut rows: BTreeSet<u32> =
            parts.iter().flat_map(|open| open.rows.iter().copied()).collect();
        let all: Vec<u32> = rows.iter().copied().collect();
        let points: Vec<Point> = all.iter().map(|&row| self.world.at(row)).collect();
        let delaunay = Delaunay::new(&points, &Progress::default()).unwrap();
        let reach: HashMap<u32, f64> =
            parts.iter().flat_map(|open| open.vertices.clone()).collect();
        let mut pairs: BTreeSet<[u32; 2]> =
            parts.iter().flat_map(|open| open.edges.iter().copied()).collect();
        for edge in candidates(&delaunay, self.rule, &Progress::default()).unwrap() {
            let [i, j] = edge.map(|k| all[k as usize]);
            let near = |row| reach.get(&row).is_some_and(|r| r * r >= self.world.square(i, j));
            if near(i) && near(j) && self.world.tile[i as usize] != self.world.tile[j as usize] {
                pairs.insert([i, j]);
            }
        }
        let mut sight = Sight::new(self.world, |_| Some(true));
        let none = BTreeSet::new();
        while !pairs.is_empty() {
            let all: Vec<u32> = rows.iter().copied().collect();
            let (open, requests) = self.decide(&all, &none, &none, &pairs, (&sight, Bounds::EMPTY));
            pairs = open.edges;
            rows.extend(sight.read(&requests).into_iter().map(|(row, _)| row));
        }
    }
}

fn check<R: Rule>(world: &World, rule: &R, whole: Edges, random: &mut Random) {
    let whole: BTreeSet<[u32; 2]> = whole.into_iter().collect();
    let halo = [0.0, 1.0, 2.5][random.below(3)];
    let rounds = [0, 1, 2, 8][random.below(4)];
    let most = [1, 2, 1000][random.below(3)];
    let mut run = Run { world, rule, whole: &whole, found: BTreeSet::new(), most };
    let parts: Vec<Open> = (0..world.tiles).map(|tile| run.tile(tile, halo, rounds)).collect();
    run.coordinate(&parts);
    assert_eq!(run.found, whole);
}

/// Distinct points, the first at a power of two away from the origin, so that exact ties stay exact.
fn points(random: &mut Random) -> Vec<Point> {
    let (width, height) = (1 + random.below(12), 1 + random.below(12));
    let offset = [0.0, 6_000_000.0, -1e15][random.below(3)];
    let wanted = 1 + random.below(30);
    let place = |random: &mut Random| match random.below(4) {
        0 => [random.below(width), 0],
        _ => [random.below(width), random.below(height)],
    };
    let distinct: BTreeSet<[usize; 2]> = (0..wanted).map(|_| place(random)).collect();
    let mut points: Vec<Point> =
        distinct.into_iter().map(|p| p.map(|x| x as f64 + offset)).collect();
    for k in (1..points.len()).rev() {
        points.swap(k, random.below(k + 1));
    }
    points
}

#[test]
fn decisions_of_tiles_are_those_of_the_whole() {
    let mut random = Random(Xorshift(15));
    let progress = Progress::default();
    for _ in 0..1500 {
        let world = World::new(points(&mut random), &mut random);
        let delaunay = Delaunay::new(&world.points, &progress).unwrap();
        let crust = methods::crust(&delaunay, &progress).unwrap();
        check(&world, &Crust, crust, &mut random);
        let one_step = methods::one_step_crust(&delaunay, &progress).unwrap();
        check(&world, &OneStepCrust, one_step, &mut random);
        let beta = [1.001, 1.25, 2f64.sqrt(), 1.7, 5.0][random.below(5)];
        let kind = methods::Kind::Circle;
        let skeleton = methods::beta_skeleton(&delaunay, beta, kind, &progress).unwrap();
        check(&world, &BetaSkeleton::new(beta).unwrap(), skeleton, &mut random);
        let cotangent = [0.0, 1.0, -1.0, 0.4, 3.0][random.below(5)];
        let crossing = methods::crossing_angle_graph(&delaunay, cotangent, &progress).unwrap();
        check(&world, &CrossingAngle::new(cotangent).unwrap(), crossing, &mut random);
    }
}

/// Each point a group of its own, and a random part of them seen: where a verdict can change, it must say so.
#[test]
fn a_verdict_is_final_only_if_no_unseen_point_can_change_it() {
    let mut random = Random(Xorshift(17));
    let progress = Progress::default();
    let mut changed = 0;
    for _ in 0..20_000 {
        let points = points(&mut random);
        let count = points.len();
        let groups = (0..count as u32).map(|row| (0, vec![row])).collect();
        let world = World { points, tile: vec![0; count], tiles: 1, groups };
        let whole = Delaunay::new(&world.points, &progress).unwrap();
        let whole = methods::crust(&whole, &progress).unwrap().into_iter().collect();
        let share = 2 + random.below(8);
        let seen: Vec<u32> = (0..count as u32).filter(|_| random.below(share) > 0).collect();
        let mut sight = Sight::new(&world, |_| Some(false));
        sight.pieces.retain(|piece| !seen.contains(&(piece.group as u32)));
        let mut run =
            Run { world: &world, rule: &Crust, whole: &whole, found: BTreeSet::new(), most: 9 };
        let all = seen.iter().copied().collect();
        let (open, _) = run.decide(&seen, &all, &all, &BTreeSet::new(), (&sight, Bounds::EMPTY));
        changed += open.edges.intersection(&whole).count();
    }
    assert!(changed > 1000);
}

/// Curves across tiles as `trace` gives them: rows, and whether they are rings.
fn traced(world: &World, edges: &Edges) -> Vec<(Vec<u32>, bool)> {
    let progress = Progress::default();
    let tile = |row: u32| world.tile[row as usize];
    let mut degrees: HashMap<i64, u32> = HashMap::new();
    let mut cut = BTreeSet::new();
    for edge in edges {
        for &row in edge {
            *degrees.entry(row.into()).or_default() += 1;
        }
        if tile(edge[0]) != tile(edge[1]) {
            cut.extend(*edge);
        }
    }
    let site = |row: u32| Site { row: row.into(), at: world.at(row) };
    let (mut found, mut runs, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..world.tiles {
        let own: Edges = edges.iter().copied().filter(|edge| tile(edge[0]) == k).collect();
        let is_cut = |row: u32| cut.contains(&row);
        let (curves, more) =
            trace_between(&world.points, &own, is_cut, |row| row, &progress).unwrap();
        let run = |k: usize| curves.indices[curves.offsets[k]..curves.offsets[k + 1]].to_vec();
        found.extend((0..curves.closed.len()).map(|k| (run(k), curves.closed[k])));
        all.extend(chains(&more, site));
        runs.extend(more);
    }
    let degrees: Vec<(i64, u32)> = degrees.into_iter().collect();
    let (whole, open) = join(&all, &degrees);
    assert!(open.is_empty());
    found.extend(whole.iter().map(|joined| materialized(joined, &runs)));
    found.sort_unstable();
    found
}

/// The rows of a curve made of runs.
fn materialized(joined: &Joined, runs: &[Vec<u32>]) -> (Vec<u32>, bool) {
    let mut rows: Vec<u32> = Vec::new();
    for &(k, backward) in &joined.members {
        let mut run = runs[k as usize].clone();
        if backward {
            run.reverse();
        }
        rows.pop();
        rows.extend(run);
    }
    assert_eq!(rows.len() as i64, joined.chain.edges + 1);
    if joined.closed {
        rows.pop();
        let start = (0..rows.len()).min_by_key(|&k| rows[k]).unwrap();
        rows.rotate_left(start);
    }
    (rows, joined.closed)
}

/// Edges of no method, among them rings that run to and fro on a line.
fn any_edges(points: usize, random: &mut Random) -> Edges {
    let mut edges = BTreeSet::new();
    let few = points.min(2 + random.below(6));
    for _ in 0..random.below(2 * points) {
        let (i, j) = (random.below(few) as u32, random.below(few) as u32);
        if i != j {
            edges.insert([i.min(j), i.max(j)]);
        }
    }
    edges.into_iter().collect()
}

#[test]
fn curves_across_tiles_are_those_of_the_whole() {
    let mut random = Random(Xorshift(16));
    let progress = Progress::default();
    for _ in 0..3000 {
        let world = World::new(points(&mut random), &mut random);
        let delaunay = Delaunay::new(&world.points, &progress).unwrap();
        let edges = match random.below(5) {
            0 => methods::crust(&delaunay, &progress).unwrap(),
            1 => methods::beta_skeleton(&delaunay, 1.5, methods::Kind::Circle, &progress).unwrap(),
            2 => methods::gabriel(&delaunay, &progress).unwrap(),
            3 => any_edges(world.points.len(), &mut random),
            _ => methods::minimum_spanning_tree(&delaunay, &progress).unwrap(),
        };
        let curves = trace(&world.points, &edges, &progress).unwrap();
        let run = |k: usize| curves.indices[curves.offsets[k]..curves.offsets[k + 1]].to_vec();
        let mut expected: Vec<_> =
            (0..curves.closed.len()).map(|k| (run(k), curves.closed[k])).collect();
        expected.sort_unstable();
        assert_eq!(traced(&world, &edges), expected);
    }
}
