//! Build one triangulation and crust of a generated set, and what is asked for after it, and print how long each took.
//!
//! `cargo run --release --example crust_once -- curves 1000000 [threads] [axis] [certificate] [tile]`

use crustline_core::certify::ratios;
use crustline_core::interpolant::Interpolant;
use crustline_core::medial_axis::medial_axis;
use crustline_core::methods::crust;
use crustline_core::tiles::{self, Bounds, Question, Unseen};
use crustline_core::{Adjacency, Delaunay, Point, Progress};
use std::time::Instant;

struct Scatter(u64);

impl Scatter {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Samples of closed curves of 500 points each, on a grid of cells, in random order.
fn curves(count: usize, random: &mut Scatter) -> Vec<Point> {
    let side = ((count / 500).max(1) as f64).sqrt().ceil();
    let mut points = Vec::with_capacity(count);
    let mut phase = [0.0; 3];
    for k in 0..count {
        if k % 500 == 0 {
            phase =
                [random.next(), random.next(), random.next()].map(|x| x * std::f64::consts::TAU);
        }
        let cell = (k / 500) as f64;
        let t = (k % 500) as f64 / 500.0 * std::f64::consts::TAU;
        let wave = |f: f64, p: f64| (f * t + p).sin();
        let radius = 0.3
            + 0.05 * wave(2.0, phase[0])
            + 0.04 * wave(3.0, phase[1])
            + 0.02 * wave(5.0, phase[2]);
        points.push([cell % side + radius * t.cos(), (cell / side).floor() + radius * t.sin()]);
    }
    for k in (1..points.len()).rev() {
        points.swap(k, (random.next() * (k + 1) as f64) as usize);
    }
    points
}

/// Raw pairs of little-endian doubles.
fn read(path: &str) -> Vec<Point> {
    let bytes = std::fs::read(path).expect("a kind of points, or a file of raw doubles");
    let number = |b: &[u8]| f64::from_le_bytes(b.try_into().expect("eight bytes"));
    bytes.chunks_exact(16).map(|pair| [number(&pair[..8]), number(&pair[8..])]).collect()
}

fn points(kind: &str, count: usize) -> Vec<Point> {
    let mut random = Scatter(42);
    let side = (count as f64).sqrt().ceil();
    let circle = |k: usize| k as f64 / count as f64 * std::f64::consts::TAU;
    match kind {
        "uniform" => (0..count).map(|_| [random.next(), random.next()]).collect(),
        "lattice" => (0..count).map(|k| [k as f64 % side, (k as f64 / side).floor()]).collect(),
        "circle" => (0..count).map(|k| [circle(k).cos(), circle(k).sin()]).collect(),
        "line" => (0..count).map(|k| [k as f64, k as f64]).collect(),
        "parabola" => (0..count).map(|k| [k as f64, (k as f64).powi(2)]).collect(),
        "equal" => vec![[1.0, 2.0]; count],
        "curves" => curves(count, &mut random),
        path => read(path),
    }
}

/// Do `work` and print how long it took, and how large `size` says that its result is.
fn timed<T>(name: &str, work: impl FnOnce() -> T, size: impl FnOnce(&T) -> usize) -> T {
    let start = Instant::now();
    let result = work();
    println!("{name} {:.3} s, {}", start.elapsed().as_secs_f64(), size(&result));
    result
}

fn run(points: &[Point], wanted: &[String]) {
    let progress = Progress::default();
    let wants = |name: &str| wanted.iter().any(|given| given == name);
    let delaunay = timed(
        "delaunay",
        || Delaunay::new(points, &progress).expect("finite points"),
        |delaunay| delaunay.stars().half_edges(),
    );
    let edges = timed("crust", || crust(&delaunay, &progress).expect("no one cancels"), Vec::len);
    if wants("axis") {
        let axis = || {
            medial_axis(&delaunay, &Adjacency::new(&delaunay, &edges).expect("memory"), &progress)
                .expect("no one cancels")
        };
        timed("axis", axis, |axis| axis.edges.len());
    }
    if wants("tile") {
        let size = |decision: &tiles::Decision| decision.open_edges.len();
        timed("tile", || decide(&delaunay, points), size);
    }
    if wants("certificate") {
        let certificate = || {
            let interpolant = Interpolant::new(
                &delaunay,
                Adjacency::new(&delaunay, &edges).expect("memory").into(),
                &progress,
            )
            .expect("no one cancels");
            ratios(&delaunay, &edges, &interpolant, &progress).expect("no one cancels")
        };
        timed("certificate", certificate, Vec::len);
    }
}

/// The crust of the points as of a tile that more points surround on all sides.
fn decide(delaunay: &Delaunay, points: &[Point]) -> tiles::Decision {
    let fold = |f: fn(f64, f64) -> f64, axis: usize| {
        points.iter().map(|p| p[axis]).reduce(f).expect("there are points")
    };
    let [[x, y], [z, w]] = [f64::min, f64::max].map(|f| [fold(f, 0), fold(f, 1)]);
    let (width, height) = (z - x, w - y);
    let piece = |dx: f64, dy: f64| {
        let by = [dx * width * 1.000_001, dy * height * 1.000_001];
        Bounds { low: [x + by[0], y + by[1]], high: [z + by[0], w + by[1]] }
    };
    let pieces = [piece(-1.0, 0.0), piece(1.0, 0.0), piece(0.0, -1.0), piece(0.0, 1.0)];
    let clear = Bounds { low: [x, y], high: [z, w] };
    let unseen = Unseen::new(&pieces, &[false; 4], clear, delaunay.scale());
    let flags = vec![true; points.len()];
    let question = Question { own: &flags, fresh: &flags, pairs: &[], unseen: &unseen, most: 4 };
    tiles::decide(delaunay, &tiles::Crust, &question, &Progress::default()).expect("no one cancels")
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let points = points(&arguments[1], arguments[2].parse().expect("a number of points"));
    let threads = arguments.get(3).map_or(1, |n| n.parse().expect("a number of threads"));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| run(&points, arguments.get(4..).unwrap_or_default()));
}
