//! What the predicates alone cost: as many tests as a million uniform points, or samples of curves, ask for.
//!
//! `cargo run --release --example limits` prints JSON: a description, and seconds per million points.

use crustline_core::Point;
use crustline_core::predicates::{Base, in_circle};
use std::hint::black_box;
use std::time::Instant;

fn points(count: usize) -> Vec<Point> {
    let mut state = 42u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..count).map(|_| [next(), next()]).collect()
}

/// The shortest of five times of `work`.
fn best(work: impl Fn() -> usize) -> f64 {
    let time = |_| {
        let start = Instant::now();
        black_box(work());
        start.elapsed().as_secs_f64()
    };
    (0..5).map(time).fold(f64::INFINITY, f64::min)
}

fn main() {
    let points = points(1 << 12);
    let at = |k: usize| points[k % points.len()];
    let separate = |tests: usize| {
        best(|| {
            (0..tests).filter(|&k| in_circle(at(k), at(k + 7), at(k + 77), at(k + 777))).count()
        })
    };
    let shared = |tests: usize| {
        best(|| {
            let holds = |k: usize| {
                let base = Base { a: at(k / 3), b: at(k / 3 + 7) };
                let (c, d) = (at(k + 77), at(k + 777));
                base.in_circle([c, d], [&base.sight(c), &base.sight(d)])
            };
            (0..tests).filter(|&k| holds(k)).count()
        })
    };
    println!(
        "{{\"7.5 million in-circle tests (uniform), each alone\": {:.4}, \
         \"7.5 million in-circle tests (uniform), as the merge makes them\": {:.4}, \
         \"15.5 million in-circle tests (curves), as the merge makes them\": {:.4}}}",
        separate(7_500_000),
        shared(7_500_000),
        shared(15_500_000)
    );
}
