//! What the fuzz targets check, on any bytes: run by `make fuzz` on bytes that cover more and more code, and by each run of the
//! tests on what was kept of these.

use crustline_core::certify::ratios;
use crustline_core::connect::{CONSTANTS, Hints, connect};
use crustline_core::edges::Edges;
use crustline_core::interpolant::Interpolant;
use crustline_core::medial_axis::medial_axis;
use crustline_core::nesting::shells;
use crustline_core::predicates::{in_circle, orientation};
use crustline_core::tiles::{Bounds, Crust, Question, Unseen, decide};
use crustline_core::trace::trace;
use crustline_core::{Adjacency, Delaunay, Error, Point, Progress, methods};
use std::cmp::Ordering;

/// A body by the name of its target.
pub type Body = (&'static str, fn(&[u8]));

/// All bodies.
pub const BODIES: [Body; 7] = [
    ("predicates", predicates),
    ("delaunay", delaunay),
    ("tracing", tracing),
    ("connecting", connecting),
    ("certifying", certifying),
    ("axis", axis),
    ("tiles", tiles),
];

/// Run the body called `name`.
#[allow(dead_code)]
pub fn run(name: &str, data: &[u8]) {
    let found = BODIES.iter().find(|(own, _)| *own == name);
    found.expect("a target has the name of a body").1(data);
}

/// Bytes read as numbers; there are always more, which are 0.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let mut taken = [0; N];
        let count = N.min(self.0.len());
        taken[..count].copy_from_slice(&self.0[..count]);
        self.0 = &self.0[count..];
        taken
    }

    fn byte(&mut self) -> u8 {
        self.take::<1>()[0]
    }

    /// Up to 64 points, of one of the kinds that are hard: of any size, on a lattice, and an ulp or some off it.
    fn points(&mut self) -> Vec<Point> {
        let kind = self.byte() % 3;
        let mut points = Vec::new();
        while !self.0.is_empty() && points.len() < 64 {
            let mut number = || match kind {
                0 => f64::from_bits(u64::from_le_bytes(self.take())),
                1 => f64::from(self.byte() % 16),
                _ => {
                    let [whole, ulps] = self.take::<2>();
                    let number = 1.0 + f64::from(whole % 16) / 16.0;
                    f64::from_bits(number.to_bits() + u64::from(ulps % 4))
                }
            };
            points.push([number(), number()]);
        }
        points.retain(|point| point.iter().all(|x| x.is_finite()));
        points
    }

    /// Canonical edges between `count` rows.
    fn edges(&mut self, count: usize) -> Edges {
        let mut edges = Edges::new();
        while count > 1 && !self.0.is_empty() && edges.len() < 64 {
            let [i, j] = self.take::<2>().map(|byte| u32::from(byte) % count as u32);
            edges.extend((i != j).then_some([i.min(j), i.max(j)]));
        }
        edges.sort_unstable();
        edges.dedup();
        edges
    }
}

/// The triangulation, unless the points are refused, by a row that is there.
fn triangulated(points: &[Point]) -> Option<Delaunay> {
    match Delaunay::new(points, &Progress::default()) {
        Err(Error::Range { row, .. }) => {
            assert!(row < points.len());
            None
        }
        other => Some(other.expect("finite points are triangulated or out of range")),
    }
}

/// The signs of both predicates, against integers.
fn predicates(data: &[u8]) {
    let mut bytes = Bytes(data);
    let unit = 2f64.powi(i32::from(bytes.byte()) - 128);
    let mut whole = || {
        let [a, b, c] = bytes.take::<3>();
        i128::from(i32::from_le_bytes([0, a, b, c]) >> 8)
    };
    let [a, b, c, d] = [0; 4].map(|_| [whole(), whole()]);
    let at = |p: [i128; 2]| p.map(|x| x as f64 * unit);
    let turn = |a: [i128; 2], b: [i128; 2], c: [i128; 2]| {
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).cmp(&0)
    };
    let found = orientation(at(a), at(b), at(c));
    assert_eq!(found, turn(a, b, c));
    assert_eq!(orientation(at(b), at(c), at(a)), found);
    assert_eq!(orientation(at(b), at(a), at(c)), found.reverse());
    if found == Ordering::Greater {
        let [u, v, w] = [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1]]);
        let lift = |p: [i128; 2]| p[0] * p[0] + p[1] * p[1];
        let cross = |p: [i128; 2], q: [i128; 2]| p[0] * q[1] - p[1] * q[0];
        let power = lift(u) * cross(v, w) + lift(v) * cross(w, u) + lift(w) * cross(u, v);
        assert_eq!(in_circle(at(a), at(b), at(c), at(d)), power > 0);
    }
}

/// The triangulation against its definition, and what is selected from it against the laws that hold for any points.
fn delaunay(data: &[u8]) {
    let points = Bytes(data).points();
    let Some(delaunay) = triangulated(&points) else { return };
    let progress = Progress::default();
    delaunay.sanity_check().expect("a Delaunay triangulation");
    let select = |name, parameters: &[f64]| {
        let edges = methods::select(&delaunay, name, parameters, &progress);
        let edges = edges.expect("the parameters are right");
        assert!(edges.is_sorted() && edges.iter().all(|[i, j]| i < j));
        edges
    };
    let within = |inner: &Edges, outer: &Edges| {
        assert!(inner.iter().all(|edge| outer.binary_search(edge).is_ok()));
    };
    within(&select("crust", &[]), &select("one-step-crust", &[]));
    let (gabriel, relative) = (select("gabriel", &[]), select("relative-neighborhood", &[]));
    within(&relative, &gabriel);
    within(&select("minimum-spanning-tree", &[]), &relative);
    within(&select("beta-skeleton", &[1.7, 0.0]), &gabriel);
    within(&gabriel, &select("beta-skeleton", &[0.9, 0.0]));
    select("conservative-crust", &[1.0]);
    select("nn-crust", &[]);
}

/// Every edge is on one curve, and rings lie in shells.
fn tracing(data: &[u8]) {
    let mut bytes = Bytes(data);
    let count = usize::from(bytes.byte() % 32);
    let points: Vec<Point> =
        (0..count).map(|_| bytes.take::<2>().map(|byte| f64::from(byte % 8))).collect();
    let edges = bytes.edges(count);
    let curves = trace(&points, &edges, &Progress::default()).expect("no one cancels");
    let mut found = Edges::new();
    for (k, &closed) in curves.closed.iter().enumerate() {
        let rows = curves.curve(k);
        let back = closed.then(|| [rows[rows.len() - 1], rows[0]]);
        let steps = rows.windows(2).map(|pair| [pair[0], pair[1]]).chain(back);
        found.extend(steps.map(|[i, j]| [i.min(j), i.max(j)]));
    }
    found.sort_unstable();
    assert_eq!(found, edges);
    let shells = shells(&points, &curves, &Progress::default()).expect("no one cancels");
    assert_eq!(shells.len(), curves.closed.len());
    for (shell, closed) in shells.iter().zip(&curves.closed) {
        assert_eq!(shell.is_some(), *closed);
        assert!(shell.is_none_or(|shell| (shell as usize) < shells.len()));
    }
}

/// At most two edges a point, the same for the points in another order.
fn connecting(data: &[u8]) {
    let points = Bytes(data).points();
    let joined = |points: &[Point]| {
        let delaunay = triangulated(points)?;
        let edges = connect(&delaunay, &CONSTANTS, &Hints::default(), &Progress::default());
        Some(edges.expect("no one cancels"))
    };
    let Some(edges) = joined(&points) else { return };
    let mut degrees = vec![0; points.len()];
    edges.iter().flatten().for_each(|&row| degrees[row as usize] += 1);
    assert!(degrees.iter().all(|&degree| degree <= 2));
    let backward: Vec<Point> = points.iter().rev().copied().collect();
    let ends = |edges: Edges, points: &[Point]| {
        let mut ends: Vec<_> = edges
            .iter()
            .map(|edge| edge.map(|row| points[row as usize].map(|x| (x + 0.0).to_bits())))
            .map(|[p, q]| if p < q { [p, q] } else { [q, p] })
            .collect();
        ends.sort_unstable();
        ends
    };
    let turned = joined(&backward).expect("the same points");
    assert_eq!(ends(edges, &points), ends(turned, &backward));
}

/// Points with their crust, or with any edges.
fn with_edges(data: &[u8]) -> Option<(Delaunay, Edges)> {
    let mut bytes = Bytes(data);
    let own = bytes.byte() % 2 == 0;
    let points = bytes.points();
    let delaunay = triangulated(&points)?;
    let edges = if own {
        methods::crust(&delaunay, &Progress::default()).expect("no one cancels")
    } else {
        Bytes(data).edges(points.len())
    };
    Some((delaunay, edges))
}

/// Measures are numbers, or infinite, and none is negative.
fn certifying(data: &[u8]) {
    let Some((delaunay, edges)) = with_edges(data) else { return };
    let progress = Progress::default();
    let interpolant = Interpolant::new(
        &delaunay,
        Adjacency::new(&delaunay, &edges).expect("memory").into(),
        &progress,
    )
    .expect("no one cancels");
    let ratios = ratios(&delaunay, &edges, &interpolant, &progress).expect("no one cancels");
    assert_eq!(ratios.len(), edges.len());
    assert!(ratios.iter().all(|ratio| ratio.is_nan() || *ratio >= 0.0));
    assert!(interpolant.at_rows(&delaunay).iter().all(|size| size.is_nan() || *size >= 0.0));
}

/// Finite vertices, each edge between two of them and two rows.
fn axis(data: &[u8]) {
    let Some((delaunay, edges)) = with_edges(data) else { return };
    let progress = Progress::default();
    let axis =
        medial_axis(&delaunay, &Adjacency::new(&delaunay, &edges).expect("memory"), &progress)
            .expect("no one cancels");
    assert!(axis.vertices.iter().flatten().chain(&axis.radii).all(|x| x.is_finite()));
    let count = axis.vertices.len() as u32;
    let ends = axis.edges.iter().flat_map(|edge| edge.ends);
    assert!(ends.chain(axis.ray_origins).all(|v| v < count));
    assert!(axis.edges.is_sorted_by_key(|edge| edge.samples) && axis.ray_samples.is_sorted());
    assert!(axis.edges.iter().all(|edge| edges.binary_search(&edge.samples).is_err()));
}

/// What a tile decides for good, before it has seen the rest, is so in the whole; and what it leaves out is not.
fn tiles(data: &[u8]) {
    let mut bytes = Bytes(data);
    let seen = 1 + usize::from(bytes.byte() % 32);
    let points = bytes.points();
    if points.len() <= seen {
        return;
    }
    let (own, rest) = points.split_at(seen);
    let (Some(whole), Some(part)) = (triangulated(&points), triangulated(own)) else { return };
    if whole.duplicates().len() + part.duplicates().len() > 0 {
        return;
    }
    let progress = Progress::default();
    let crust = methods::crust(&whole, &progress).expect("no one cancels");
    let least = |axis: usize| rest.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| rest.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
    let piece = Bounds { low: [least(0), least(1)], high: [most(0), most(1)] };
    let clear = Bounds { low: own[0], high: own[0] };
    let unseen = Unseen::new(&[piece], &[false], clear, part.scale());
    let flags = vec![true; seen];
    let question = Question { own: &flags, fresh: &flags, pairs: &[], unseen: &unseen, most: 1 };
    let decision = decide(&part, &Crust, &question, &progress).expect("no one cancels");
    assert!(decision.edges.iter().all(|edge| crust.binary_search(edge).is_ok()));
    let is_told = |edge: &[u32; 2]| {
        let lists = [&decision.edges, &decision.open_edges];
        lists.iter().any(|list| list.binary_search(edge).is_ok())
    };
    assert!(crust.iter().filter(|edge| (edge[1] as usize) < seen).all(is_told));
}
