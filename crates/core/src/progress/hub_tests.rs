//! Points with very many neighbors: a closed curve and a point within, which all of its samples are neighbors of.

use super::Progress;
use super::looks_tests::{Call, calls, processor_time};
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::methods;
use crate::point::Point;
use std::f64::consts::TAU;
use std::time::Duration;

const SIZE: usize = 50_000;

/// How many times as long a call may take for the one point more, and what is too short to tell.
const MOST: u32 = 3;
const SHORT: Duration = Duration::from_millis(30);

/// Samples of a closed curve; with a `hub`, the point in its middle as well.
fn ring(hub: bool) -> Vec<Point> {
    let at = |k: usize| {
        let turn = TAU * k as f64 / SIZE as f64;
        let radius = 1.0 + 0.1 * (5.0 * turn).cos();
        [radius * turn.cos(), radius * turn.sin()]
    };
    (0..SIZE).map(at).chain(hub.then_some([0.0; 2])).collect()
}

/// Points, their triangulation and their crust.
struct Samples {
    points: Vec<Point>,
    delaunay: Delaunay,
    edges: Edges,
}

impl Samples {
    fn new(points: Vec<Point>) -> Self {
        let quiet = Progress::default();
        let delaunay = Delaunay::new(&points, &quiet).expect("points");
        let edges = methods::crust(&delaunay, &quiet).expect("no one cancels");
        Self { points, delaunay, edges }
    }

    fn calls(&self) -> Vec<Call<'_>> {
        let mut calls = calls(&self.points, &self.delaunay, &self.edges);
        let twins = |_: &Progress| {
            drop(self.delaunay.twins());
            Ok(())
        };
        calls.push(("twins", Box::new(twins)));
        calls
    }
}

fn time(call: &Call<'_>) -> Duration {
    let start = processor_time();
    call.1(&Progress::default()).expect("no one cancels");
    processor_time().saturating_sub(start)
}

/// Where each edge of a point costs a walk over all of its neighbors, this takes fifty thousand times fifty thousand steps.
#[test]
fn no_call_takes_three_times_as_long_for_one_point_with_very_many_neighbors() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let [with, without] = [true, false].map(|hub| Samples::new(ring(hub)));
    let is_late = |(with, without): &(&Call<'_>, &Call<'_>)| {
        // Another program may have had the caches: what is quadratic is late each time.
        (0..3).all(|_| time(with) > MOST * time(without) + SHORT)
    };
    let late: Vec<&str> = pool.install(|| {
        let (with, without) = (with.calls(), without.calls());
        with.iter().zip(&without).filter(is_late).map(|(call, _)| call.0).collect()
    });
    assert!(late.is_empty(), "{late:?}");
}
