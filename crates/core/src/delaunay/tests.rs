use super::{Delaunay, leaf, stars};
use crate::point::Point;
use crate::progress::Progress;
use crate::space::order::order;
use crate::xorshift::Xorshift;
use std::collections::BTreeSet;

/// Points that look random.
struct Scatter(Xorshift);

impl Scatter {
    fn next(&mut self) -> f64 {
        (self.0.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn points(&mut self, count: usize) -> Vec<Point> {
        (0..count).map(|_| [self.next(), self.next()]).collect()
    }

    /// Points of an integer grid of `side` cells, ties and duplicates galore.
    fn lattice(&mut self, count: usize, side: f64) -> Vec<Point> {
        self.points(count).iter().map(|p| p.map(|x| (x * side).floor())).collect()
    }
}

fn triangulate(points: &[Point]) -> Delaunay {
    let delaunay = Delaunay::new(points, &Progress::default()).expect("valid points");
    delaunay.sanity_check().unwrap_or_else(|fault| panic!("{fault} in {points:?}"));
    delaunay
}

fn row_edges(delaunay: &Delaunay) -> BTreeSet<(u32, u32)> {
    let row = |v: u32| delaunay.rows()[v as usize];
    delaunay.edges().map(|e| (row(e.p).min(row(e.q)), row(e.p).max(row(e.q)))).collect()
}

#[test]
fn random_points_have_the_edges_that_another_triangulation_finds() {
    use spade::{DelaunayTriangulation, Point2, Triangulation};
    for seed in 1..20 {
        let points = Scatter(Xorshift(seed)).points(50 * seed as usize);
        let sites = points.iter().map(|p| Point2::new(p[0], p[1])).collect();
        let other = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(sites).unwrap();
        let expected = other
            .undirected_edges()
            .map(|e| e.vertices().map(|v| v.index() as u32))
            .map(|[a, b]| (a.min(b), a.max(b)))
            .collect();
        assert_eq!(row_edges(&triangulate(&points)), expected);
    }
}

#[test]
fn ties_duplicates_and_lines_are_triangulated() {
    for seed in 1..400 {
        let side = 1.0 + (seed % 9) as f64;
        triangulate(&Scatter(Xorshift(seed)).lattice(1 + seed as usize % 40, side));
    }
    for count in 0..30 {
        triangulate(&vec![[0.5, -0.25]; count]);
        triangulate(&(0..count).map(|k| [k as f64, 2.0 * k as f64]).collect::<Vec<_>>());
        triangulate(&(0..count).map(|k| [0.0, -(k as f64)]).collect::<Vec<_>>());
    }
}

#[test]
fn points_a_few_ulps_off_a_lattice_are_triangulated() {
    for seed in 1..300 {
        let mut scatter = Scatter(Xorshift(seed));
        let mut points = scatter.lattice(30, 5.0);
        for x in points.iter_mut().flatten() {
            *x = match (scatter.next() * 4.0) as u32 {
                0 => x.next_up(),
                1 => x.next_down(),
                _ => *x,
            };
        }
        triangulate(&points);
    }
}

#[test]
fn scaling_and_shifting_exactly_changes_no_edge() {
    for seed in 1..40 {
        let points = Scatter(Xorshift(seed)).lattice(40, 12.0);
        let expected = row_edges(&triangulate(&points));
        for exponent in [-1000, -300, 300, 1000] {
            let scaled: Vec<_> =
                points.iter().map(|p| p.map(|x| x * 2f64.powi(exponent))).collect();
            assert_eq!(row_edges(&triangulate(&scaled)), expected);
        }
        let shifted: Vec<_> = points.iter().map(|p| p.map(|x| x + 1e7)).collect();
        triangulate(&shifted);
    }
}

#[test]
fn the_order_of_rows_changes_no_edge() {
    for seed in 1..60 {
        let points = Scatter(Xorshift(seed)).lattice(60, 16.0);
        let delaunay = triangulate(&points);
        let reversed: Vec<_> = points.iter().rev().copied().collect();
        let other = triangulate(&reversed);
        assert_eq!(delaunay.points(), other.points());
        assert_eq!(delaunay.triangles(), other.triangles());
    }
}

#[test]
fn close_clusters_that_share_a_code_are_triangulated() {
    for seed in 1..30 {
        let mut points = Scatter(Xorshift(seed)).points(200);
        for p in &mut points[50..] {
            *p = p.map(|x| 0.75 + x * 2f64.powi(-40));
        }
        for p in &mut points[120..] {
            *p = p.map(|x| x + 2f64.powi(-49));
        }
        triangulate(&points);
    }
}

#[test]
fn a_leaf_too_small_for_a_cell_leaves_it_to_its_halves() {
    let mut scatter = Scatter(Xorshift(11));
    let rings = |k: u32| {
        let ((sin, cos), radius) = (f64::from(k).sin_cos(), 1.0 + f64::from(k % 7));
        [radius * cos + f64::from(k % 5), radius * sin]
    };
    let sets = [
        scatter.points(3000),
        scatter.points(8000),
        scatter.lattice(700, 30.0),
        scatter.lattice(8000, 90.0),
        (0..6000).map(rings).collect(),
    ];
    for points in sets {
        let sorted = order(&points, &Progress::default()).expect("points within range");
        let with = |leaf| {
            let memory = sorted.memory.clone().into_flattened();
            let (stars, hull) =
                stars(&sorted.points, &sorted.grid, leaf, memory, &Progress::default())
                    .expect("no one cancels");
            // Where a star starts depends on the memory; its round does not.
            let star = |v| {
                let mut neighbors = stars.star(v).neighbors.to_vec();
                let smallest = (0..neighbors.len()).min_by_key(|&k| neighbors[k]);
                neighbors.rotate_left(smallest.unwrap_or(0));
                neighbors
            };
            ((0..sorted.points.len() as u32).map(star).collect::<Vec<_>>(), hull)
        };
        let whole = with(leaf::MOST);
        for leaf in [1, 2, 3, 8, 30, 100, 500, 2000] {
            assert_eq!(whole, with(leaf));
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_triangulation() {
    let points = Scatter(Xorshift(7)).points(60_000);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| triangulate(&points).triangles())
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(7));
}
