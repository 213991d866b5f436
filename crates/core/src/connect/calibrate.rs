//! From what describes an edge to the probability that it is right: a logistic curve.
//!
//! Fitted by `benchmarks/accuracy/calibrate.py` on one half of the generated cases, and on clouds, lattices and filled disks,
//! of which every edge counts as wrong; judged on the other half.

use super::features::FEATURES;

/// What each of the numbers that describe an edge adds.
const EDGE: [f64; FEATURES] = [
    2.486, -2.558, -0.09855, -2.979, 1.381, 0.3356, -1.323, 2.621, 1.857, -4.33, -6.363, 3.082,
    0.0036, -3.41, 2.583, 1.976, 0.1367, 0.783, 1.953, -11.19, -9.703,
];
/// What those that describe an answer add: 1, the logarithms of the expected number of wrong edges and of the doubt in the
/// worst edge, the share of isolated points, the logarithm of the number of edges, that of the mean doubt, and its square.
const ANSWER: [f64; ABOUT] = [-17.78, -1.357, -4.087, 0.4035, 3.791, -1.515, -0.4129];
/// How many numbers describe an answer.
pub const ABOUT: usize = 7;
/// An edge that the theorem put in place of what the messages found.
const PROVEN: f64 = 0.999;
/// Doubts below this count as this.
const LEAST: f64 = 1e-4;

/// How likely the edge is right; `None` describes an edge of the theorem.
#[must_use]
pub fn edge(features: Option<&[f64; FEATURES]>) -> f64 {
    features.map_or(PROVEN, |features| logistic(&EDGE, features))
}

/// What describes an answer.
#[must_use]
pub fn describe(confidences: &[f64], isolated: f64) -> [f64; ABOUT] {
    // In order, so that the sum does not depend on that of the rows.
    let mut doubts: Vec<f64> = confidences.iter().map(|p| 1.0 - p).collect();
    doubts.sort_unstable_by(f64::total_cmp);
    let doubts: f64 = doubts.into_iter().sum();
    let worst = confidences.iter().fold(1.0, |least: f64, &p| least.min(p));
    let [doubts, worst] = [doubts, 1.0 - worst].map(|doubt| libm::log(doubt.max(LEAST)));
    let count = libm::log1p(confidences.len() as f64);
    let mean = doubts - count;
    [1.0, doubts, worst, isolated, count, mean, mean * mean]
}

/// How likely the whole answer is right.
#[must_use]
pub fn answer(description: &[f64; ABOUT]) -> f64 {
    logistic(&ANSWER, description)
}

fn logistic<const N: usize>(weights: &[f64; N], values: &[f64; N]) -> f64 {
    let sum: f64 = weights.iter().zip(values).map(|(weight, value)| weight * value).sum();
    1.0 / (1.0 + libm::exp(-sum))
}
