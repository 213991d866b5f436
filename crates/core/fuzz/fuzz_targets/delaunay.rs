//! The triangulation of arbitrary coordinates, denormals and extremes included, against its own definition; and what is
//! selected from it against the laws that hold for any points.

#![no_main]

use crustline_core::{Delaunay, Error, Progress, methods};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let number = |bytes: &[u8]| f64::from_bits(u64::from_le_bytes(bytes.try_into().expect("eight bytes")));
    let points: Vec<[f64; 2]> = data
        .chunks_exact(16)
        .map(|pair| [number(&pair[..8]), number(&pair[8..])])
        .filter(|point| point.iter().all(|x| x.is_finite()))
        .collect();
    let progress = Progress::default();
    let delaunay = match Delaunay::new(&points, &progress) {
        Err(Error::Range { row, .. }) => return assert!(row < points.len()),
        other => other.expect("finite points are triangulated or out of range"),
    };
    delaunay.sanity_check().expect("a Delaunay triangulation");
    let crust = methods::crust(&delaunay, &progress).expect("no one cancels");
    let wider = methods::one_step_crust(&delaunay, &progress).expect("no one cancels");
    assert!(crust.iter().all(|edge| wider.binary_search(edge).is_ok()));
    assert!(crust.is_sorted() && crust.iter().all(|[i, j]| i < j));
});
