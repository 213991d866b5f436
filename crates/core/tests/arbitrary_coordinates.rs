//! What the fuzz target checks, on a fixed stream of bytes that stable Rust can run: coordinates from all of the
//! double range, few distinct ones, so that ties, lines and duplicates are common.

use crustline_core::{Delaunay, Error, Point, Progress, methods};

struct Bits(u64);

impl Bits {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A finite double with an exponent from `low` to `high` and few or many bits.
    fn double(&mut self, low: u64, high: u64) -> f64 {
        let exponent = low + self.next() % (high - low);
        let fraction = match self.next() % 4 {
            0 => 0,
            1 => self.next() % 4,
            2 => (self.next() % 8) << 49,
            _ => self.next() >> 12,
        };
        let magnitude = f64::from_bits(exponent << 52 | fraction);
        match self.next() % 8 {
            0 => 0.0,
            1..4 => -magnitude,
            _ => magnitude,
        }
    }

    fn points(&mut self, low: u64, high: u64) -> Vec<Point> {
        let values: Vec<f64> = (0..=self.next() % 12).map(|_| self.double(low, high)).collect();
        let count = self.next() % 40;
        let mut pick = || values[self.next() as usize % values.len()];
        (0..count).map(|_| [pick(), pick()]).collect()
    }
}

/// Whether the points could be triangulated; what is refused names a row that is there.
fn check(points: &[Point]) -> bool {
    let progress = Progress::default();
    let delaunay = match Delaunay::new(points, &progress) {
        Err(Error::Range { row, .. }) => {
            assert!(row < points.len());
            return false;
        }
        other => other.expect("finite points are triangulated or out of range"),
    };
    delaunay.sanity_check().unwrap_or_else(|fault| panic!("{fault} in {points:?}"));
    let crust = methods::crust(&delaunay, &progress).expect("no one cancels");
    let wider = methods::one_step_crust(&delaunay, &progress).expect("no one cancels");
    assert!(crust.iter().all(|edge| wider.binary_search(edge).is_ok()), "{points:?}");
    true
}

#[test]
fn any_finite_coordinates_are_triangulated_or_refused_by_row() {
    let mut bits = Bits(1);
    let refused = (0..3000).filter(|_| !check(&bits.points(0, 2047))).count();
    assert!(refused > 0, "the whole range of doubles cannot be scaled exactly");
}

#[test]
fn half_of_the_exponents_are_always_triangulated() {
    let mut bits = Bits(2);
    for start in [0, 300, 511, 900, 1046] {
        for _ in 0..600 {
            assert!(check(&bits.points(start, start + 1000)));
        }
    }
}

#[test]
fn coordinates_close_to_each_other_are_triangulated() {
    let mut bits = Bits(3);
    for _ in 0..3000 {
        assert!(check(&bits.points(1020, 1026)));
    }
}
