//! Work counted where it is done, in about nanoseconds, so that speed can be tested on any machine; and nearly degenerate points, on
//! which no method may work more than ten times as much as on points in general position.

use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::interpolant::Interpolant;
use crate::point::Point;
use crate::progress::Progress;
use crate::space::bounds::Bounds;
use crate::tiles::{self, Decision, Question, Unseen};
use crate::{certify, medial_axis, methods};
use std::cell::Cell;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Looking at a Voronoi cell.
pub const CELL: usize = 100;
/// Putting a Voronoi vertex into boxes.
pub const PLACE: usize = 150;
/// Looking at a box.
pub const BOX: usize = 10;
/// Comparing two lengths.
pub const COMPARISON: usize = 10;
/// A sign that a first filter cannot tell, for each bit of the integers it may take.
pub const BIT: usize = 1;
/// The same in integers of any size.
pub const BIG_BIT: usize = 10;

thread_local! {
    static DONE: Cell<usize> = const { Cell::new(0) };
}

pub fn count(work: usize) {
    DONE.set(DONE.get() + work);
}

const SIZE: usize = 3000;

/// A number between −1 and 1, a different one for each `k`.
fn random(k: usize) -> f64 {
    let mut x = (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// `p` moved by up to `noise` of its coordinates.
fn moved(k: usize, [x, y]: Point, noise: f64) -> Point {
    [x * (1.0 + noise * random(2 * k)), y * (1.0 + noise * random(2 * k + 1))]
}

fn circle(k: usize, count: usize, radius: f64) -> Point {
    let (sin, cos) = (TAU * (k % count) as f64 / count as f64).sin_cos();
    [radius * cos, radius * sin]
}

fn flower(k: usize, count: usize) -> Point {
    circle(k, count, 30.0 + 5.0 * (5.0 * TAU * (k % count) as f64 / count as f64).sin())
}

/// Point `k` of a family at relative distance `d`.
type Family = (&'static str, fn(usize, f64) -> Point);

const FAMILIES: [Family; 11] = [
    ("pairs", |k, d| {
        let (number, turn) = (k / 2, (k % 2) as f64);
        moved(k, [2.0 + random(7 * number), 2.0 + random(7 * number + 3)], d * turn)
    }),
    ("two exports of an outline", |k, d| moved(k, flower(k / 2, SIZE / 2), d * (k % 2) as f64)),
    ("two scales of an outline", |k, d| {
        flower(k / 2, SIZE / 2).map(|x| x * (1.0 + d * (k % 2) as f64))
    }),
    ("lattice", |k, d| moved(k, [(1 + k % 54) as f64, (1 + k / 54) as f64], d)),
    ("one circle", |k, d| moved(k, circle(k, SIZE, 1.0), d)),
    ("concentric circles", |k, d| circle(k / 2, SIZE / 2, 1.0 + d * (k % 2) as f64)),
    ("clusters", |k, d| {
        let center = k / 10;
        moved(k, [2.0 + random(5 * center), 2.0 + random(5 * center + 2)], d)
    }),
    ("rings", |k, d| {
        let ([x, y], ring) = (circle(k % 100, 100, 1.0), k / 100);
        moved(k, [x + 3.0 * (ring % 8) as f64, y + 3.0 * (ring / 8) as f64], d)
    }),
    ("one line", |k, d| {
        let x = 2.0 + random(3 * k);
        [x, x * (1.0 + d * random(3 * k + 1))]
    }),
    ("few lines", |k, d| {
        let x = 2.0 + random(3 * k);
        [x, (x + (k % 5) as f64) * (1.0 + d * random(3 * k + 1))]
    }),
    ("parallel strands", |k, d| {
        let x = 1.0 + (k / 3) as f64 / (SIZE / 3) as f64;
        [x, x * (1.0 + d * (k % 3) as f64)]
    }),
];

/// The work of each call on these points, by name.
fn works(points: &[Point]) -> Vec<(&'static str, usize)> {
    const NAMES: [(&str, &[f64]); 8] = [
        ("crust", &[]),
        ("one-step-crust", &[]),
        ("beta-skeleton", &[1.7, 0.0]),
        ("relative-neighborhood", &[]),
        ("conservative-crust", &[1.0]),
        ("gathan", &[0.5, 1.0]),
        ("minimum-spanning-tree", &[]),
        ("nn-crust", &[]),
    ];
    let quiet = Progress::default();
    let delaunay = Delaunay::new(points, &quiet).expect("points");
    let edges = methods::crust(&delaunay, &quiet).expect("no one cancels");
    let mut works = Vec::new();
    let mut measure = |name, call: &dyn Fn()| {
        DONE.set(0);
        call();
        works.push((name, DONE.get()));
    };
    measure("triangulation", &|| drop(Delaunay::new(points, &quiet)));
    for (name, parameters) in NAMES {
        measure(name, &|| drop(methods::select(&delaunay, name, parameters, &quiet)));
    }
    measure("medial axis", &|| {
        let curve = Adjacency::new(&delaunay, &edges).expect("memory");
        medial_axis::medial_axis(&delaunay, &curve, &quiet).expect("no one cancels");
    });
    measure("tiles", &|| drop(tile(&delaunay)));
    measure("certificate", &|| {
        let curve = Arc::new(Adjacency::new(&delaunay, &edges).expect("memory"));
        let interpolant =
            Interpolant::new(&delaunay, curve.clone(), &quiet).expect("no one cancels");
        certify::ratios(&delaunay, &edges, &interpolant, &quiet).expect("no one cancels");
        methods::is_beta_skeleton(&delaunay, 1.7, &curve, &quiet).expect("no one cancels");
    });
    works
}

/// The crust of a tile that holds all points.
fn tile(delaunay: &Delaunay) -> Decision {
    let own = vec![true; delaunay.input_len()];
    let bounds = Bounds { low: [-1e9; 2], high: [1e9; 2] };
    let unseen = Unseen::new(&[], &[], bounds, delaunay.scale());
    let question = Question { own: &own, fresh: &own, pairs: &[], unseen: &unseen, most: 4 };
    tiles::decide(delaunay, &tiles::Crust, &question, &Progress::default()).expect("no one cancels")
}

#[test]
fn a_tile_puts_long_walks_off_and_decides_them_as_the_whole_does() {
    for d in [1e-12, 1e-10, 1e-8] {
        let point = |k: usize| circle(k / 2, SIZE / 2, 1.0 + d * (k % 2) as f64);
        let points: Vec<Point> = (0..SIZE).map(point).collect();
        let delaunay = Delaunay::new(&points, &Progress::default()).expect("points");
        let Decision { edges, open_edges, open_vertices, .. } = tile(&delaunay);
        let crust = methods::crust(&delaunay, &Progress::default()).expect("no one cancels");
        assert!(open_edges.is_empty() && open_vertices.is_empty());
        assert_eq!(edges, crust);
    }
}

/// What a call does for a point at least, in about nanoseconds.
const LEAST: usize = 400;
/// How many times as much a nearly degenerate call may take.
const MOST: usize = 10;

#[test]
fn nearly_degenerate_points_take_at_most_ten_times_the_work() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut late = Vec::new();
    pool.install(|| {
        for (family, point) in FAMILIES {
            let at = |d: f64| works(&(0..SIZE).map(|k| point(k, d)).collect::<Vec<_>>());
            let general = at(1e-2);
            for exponent in [-16, -15, -14, -13, -12, -10, -8, -6] {
                let d = if exponent == -16 { f64::EPSILON } else { 10f64.powi(exponent) };
                for ((name, work), (_, usual)) in at(d).into_iter().zip(&general) {
                    if work + LEAST * SIZE > MOST * (usual + LEAST * SIZE) {
                        late.push(format!("{family} at {d:e}: {name} {work} over {usual}"));
                    }
                }
            }
        }
    });
    assert!(late.is_empty(), "{}", late.join("\n"));
}

/// What the crust does for a point of a well sampled curve.
const LEAST_CRUST: usize = 130;

/// How many times as much the crust of concentric circles may take: five times, and seven where each disk is looked up by itself.
const MOST_OF_CIRCLES: usize = 6;

/// The farther apart the circles are for their spacing, the less the crust in general position has to do, so this shows at many points.
#[test]
fn the_crust_of_many_points_on_concentric_circles_takes_at_most_six_times_the_work() {
    const MANY: usize = 30_000;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let work = |d: f64| {
        let point = |k: usize| circle(k / 2, MANY / 2, 1.0 + d * (k % 2) as f64);
        let points: Vec<Point> = (0..MANY).map(point).collect();
        let delaunay = Delaunay::new(&points, &Progress::default()).expect("points");
        DONE.set(0);
        methods::crust(&delaunay, &Progress::default()).expect("no one cancels");
        DONE.get() / MANY + LEAST_CRUST
    };
    pool.install(|| {
        let general = work(1e-2);
        for d in [1e-10, 1e-8, 1e-6] {
            let work = work(d);
            assert!(work <= MOST_OF_CIRCLES * general, "{d:e}: {work} over {general}");
        }
    });
}
