//! When calls look whether to stop: often, and no look is in vain.

use super::Progress;
use crate::adjacency::Adjacency;
use crate::connect::{self, Hints};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::{Error, Result};
use crate::interpolant::Interpolant;
use crate::point::Point;
use crate::ridge::ridge;
use crate::{certify, medial_axis, methods, nesting, trace};
use std::panic::Location;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{LazyLock, Mutex, OnceLock};
use std::time::{Duration, Instant};

/// What this thread has used of a processor, to some milliseconds; where that is not told, the time.
pub fn processor_time() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let used = told.and_then(|numbers| numbers.split(' ').next()?.parse().ok());
    used.map_or_else(|| START.elapsed(), Duration::from_nanos)
}

/// The longest work between two looks, and where the second was.
#[derive(Debug, Clone, Copy)]
struct Longest {
    last: Duration,
    /// When that was: the time of the processor is asked for at most once in a millisecond.
    asked: Instant,
    time: Duration,
    place: Option<&'static Location<'static>>,
}

/// The looks of a call: how many, and, if that is asked for, the longest work between them.
#[derive(Debug, Default)]
pub struct Looks {
    count: AtomicUsize,
    longest: OnceLock<Mutex<Longest>>,
}

impl Looks {
    #[track_caller]
    pub fn note(&self) {
        self.count.fetch_add(1, Relaxed);
        let Some(longest) = self.longest.get() else { return };
        let mut state = longest.lock().expect("no one panics");
        if state.asked.elapsed() < Duration::from_millis(1) {
            return;
        }
        let now = processor_time();
        let gap = now.saturating_sub(state.last);
        if gap > state.time {
            (state.time, state.place) = (gap, Some(Location::caller()));
        }
        (state.last, state.asked) = (now, Instant::now());
    }

    fn measure(&self) {
        let (last, asked) = (processor_time(), Instant::now());
        let state = Longest { last, asked, time: Duration::ZERO, place: None };
        self.longest.set(Mutex::new(state)).expect("measured once");
    }

    fn longest(&self) -> Longest {
        *self.longest.get().expect("it is measured").lock().expect("no one panics")
    }

    fn count(&self) -> usize {
        self.count.load(Relaxed)
    }
}

/// The longest that `call` works without a look, on one thread, and where that ended.
fn longest(call: &impl Fn(&Progress) -> Result<()>) -> (Duration, String) {
    let progress = Progress::default();
    progress.looks.measure();
    call(&progress).expect("no one cancels");
    progress.looks.note();
    let state = progress.looks.longest();
    (state.time, format!("{:?}", state.place))
}

const SIZE: usize = 100_000;

/// Points of two kinds: at random, with a curve of the same number around them, and a lattice, which is all ties.
fn points(lattice: bool, count: usize) -> Vec<Point> {
    let random = |k: usize, prime: usize| (k * prime % 1_000_003) as f64 / 1_000_003.0;
    let (half, side) = (count / 2, count.isqrt());
    let at = |k: usize| match (lattice, k < half) {
        (true, _) => [(k % side) as f64, (k / side) as f64],
        (false, true) => [random(k, 611_953), random(k, 379_721)],
        (false, false) => {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / half as f64).sin_cos();
            [3.0 * cos, 2.0 * sin]
        }
    };
    (0..count).map(at).collect()
}

pub type Call<'a> = (&'static str, Box<dyn Fn(&Progress) -> Result<()> + Sync + 'a>);

const METHODS: [(&str, &[f64]); 18] = [
    ("alpha-shape", &[0.01]),
    ("beta-skeleton", &[1.7, 0.0]),
    ("beta-skeleton", &[1.7, 1.0]),
    ("compatible-crust", &[-1.0]),
    ("conservative-crust", &[1.0]),
    ("crawl", &[]),
    ("crossing-angle-graph", &[0.5]),
    ("crust", &[]),
    ("gabriel", &[]),
    ("gathan", &[0.5, 1.0]),
    ("hnn-crust", &[]),
    ("minimum-spanning-tree", &[]),
    ("nn-crust", &[]),
    ("one-step-crust", &[]),
    ("peel", &[]),
    ("rcgh", &[]),
    ("relative-neighborhood", &[]),
    ("sig-delaunay", &[]),
];

/// All calls on a triangulation of these points, and edges of it.
pub fn calls<'a>(points: &'a [Point], delaunay: &'a Delaunay, edges: &'a Edges) -> Vec<Call<'a>> {
    let mut calls: Vec<Call<'a>> = Vec::new();
    for (name, parameters) in METHODS {
        let call = |p: &Progress| methods::select(delaunay, name, parameters, p).map(|_| ());
        calls.push((name, Box::new(call)));
    }
    let curve = Adjacency::new(delaunay, edges).expect("memory");
    let compare =
        move |p: &Progress| methods::is_beta_skeleton(delaunay, 1.7, &curve, p).map(|_| ());
    calls.push(("is-beta-skeleton", Box::new(compare)));
    calls.push(("triangulate", Box::new(move |p: &Progress| Delaunay::new(points, p).map(|_| ()))));
    calls.push((
        "medial-axis",
        Box::new(move |p: &Progress| {
            medial_axis::medial_axis(delaunay, &Adjacency::new(delaunay, edges)?, p).map(|_| ())
        }),
    ));
    calls.push((
        "certify",
        Box::new(move |p: &Progress| {
            let interpolant =
                Interpolant::new(delaunay, Adjacency::new(delaunay, edges)?.into(), p)?;
            certify::ratios(delaunay, edges, &interpolant, p).map(|_| ())
        }),
    ));
    let constants = &connect::CONSTANTS;
    let hints = Hints::default;
    let call = move |p: &Progress| connect::connect(delaunay, constants, &hints(), p).map(|_| ());
    calls.push(("connect", Box::new(call)));
    calls.push(("ridge", Box::new(move |p: &Progress| ridge(delaunay, None, p).map(|_| ()))));
    calls.push((
        "trace",
        Box::new(move |p: &Progress| {
            let curves = trace::trace(points, edges, p)?;
            nesting::shells(points, &curves, p).map(|_| ())
        }),
    ));
    calls
}

/// Ctrl-C is heard within 0.2 s at two million points: no call works longer than half of that, so that a core shared with another
/// program suffices.
#[test]
#[ignore = "two million points, many times"]
fn no_call_works_long_between_two_looks_at_whether_to_stop() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let late: Vec<String> = pool.install(|| [false, true].into_iter().flat_map(late).collect());
    assert!(late.is_empty(), "{}", late.join("\n"));
}

/// The calls that work longer, and where.
fn late(lattice: bool) -> Vec<String> {
    let (points, quiet) = (points(lattice, 2_000_000), Progress::default());
    let delaunay = Delaunay::new(&points, &quiet).expect("points");
    let edges = methods::crust(&delaunay, &quiet).expect("no one cancels");
    let told = |(name, call): Call<'_>| {
        let (time, place) = longest(&call);
        let told = format!("{name}: {:.0} ms at {place}", 1e3 * time.as_secs_f64());
        println!("{told}");
        (time.as_secs_f64() > 0.1).then_some(told)
    };
    calls(&points, &delaunay, &edges).into_iter().filter_map(told).collect()
}

#[test]
fn every_call_looks_often() {
    let points = &points(false, SIZE)[SIZE / 2 - 20_000..SIZE / 2 + 20_000];
    let quiet = Progress::default();
    let delaunay = Delaunay::new(points, &quiet).expect("points");
    let edges = methods::crust(&delaunay, &quiet).expect("no one cancels");
    for (name, call) in calls(points, &delaunay, &edges) {
        let progress = Progress::default();
        call(&progress).expect("no one cancels");
        let looks = progress.looks.count();
        // Curves are traced in passes of half a million.
        let least = if name == "trace" { 3 } else { points.len() / crate::parts::GRAIN };
        assert!(looks >= least, "{name} looks {looks} times");
    }
}

#[test]
fn every_call_stops_when_asked_to() {
    let points = &points(false, SIZE)[..20_000];
    let quiet = Progress::default();
    let delaunay = Delaunay::new(points, &quiet).expect("points");
    let edges = methods::crust(&delaunay, &quiet).expect("no one cancels");
    for (name, call) in calls(points, &delaunay, &edges) {
        let progress = Progress::default();
        progress.cancel();
        assert_eq!(call(&progress), Err(Error::Cancelled), "{name}");
    }
}
