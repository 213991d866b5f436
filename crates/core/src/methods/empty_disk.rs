//! The disk that shows why an edge is in the crust, for pictures.

use super::one_step_crust;
use super::search::{Verdict, find_disk, find_disks};
use super::visit::Visit;
use crate::adjacency::vertices_of_rows;
use crate::delaunay::{Delaunay, Edge};
use crate::exact::pencil::{Circle, Pencil};
use crate::point::Point;
use crate::progress::Progress;
use crate::voronoi::VoronoiVertices;

/// The center and the radius of the smallest disk that proves the edge between two rows to be in the crust: it touches both,
/// and holds no point and no Voronoi vertex inside. `None` for any other pair of rows.
#[must_use]
pub fn empty_disk(delaunay: &Delaunay, rows: [u32; 2]) -> Option<(Point, f64)> {
    let edge = edge_between(delaunay, rows)?;
    if !one_step_crust::is_in(delaunay, edge) {
        return None;
    }
    let verdict = find_disk(delaunay, edge, &mut Visit::default()).ok();
    match verdict.or_else(|| find_by_place(delaunay, edge)) {
        Some(Verdict::In(circle)) => Some(unscaled(delaunay, edge, circle)),
        _ => None,
    }
}

/// The search where the disk meets very many cells; by a walk all the same, if there is no memory for the index.
#[cold]
fn find_by_place(delaunay: &Delaunay, edge: Edge) -> Option<Verdict> {
    match VoronoiVertices::new(delaunay, &Progress::default()) {
        Ok(index) => {
            let mut found = None;
            find_disks(delaunay, &[edge], &index, |_, verdict| found = Some(*verdict));
            found
        }
        Err(_) => find_disk(delaunay, edge, &mut Visit::without_limit()).ok(),
    }
}

/// The edge of the triangulation between two rows.
fn edge_between(delaunay: &Delaunay, rows: [u32; 2]) -> Option<Edge> {
    let vertex = vertices_of_rows(delaunay);
    let ends = rows.map(|row| vertex.get(row as usize).copied());
    let [Some(p), Some(q)] = ends else { return None };
    let (p, q) = (p.min(q), p.max(q));
    delaunay.edges_from(p).find(|edge| edge.q == q)
}

fn unscaled(delaunay: &Delaunay, edge: Edge, circle: Circle) -> (Point, f64) {
    let pencil = Pencil::new(delaunay.point(edge.p), delaunay.point(edge.q));
    let disk = pencil.disk(circle);
    let center = [0, 1].map(|k| (pencil.p[k] + disk.center[k]) / delaunay.scale());
    (center, disk.radius / delaunay.scale())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_side_of_a_square_has_its_own_diameter_and_the_diagonal_no_disk() {
        let points = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let delaunay = Delaunay::new(&points, &Progress::default()).expect("four points");
        assert_eq!(empty_disk(&delaunay, [1, 0]), Some(([1.0, 0.0], 1.0)));
        assert_eq!(empty_disk(&delaunay, [0, 2]), None);
        assert_eq!(empty_disk(&delaunay, [0, 9]), None);
    }

    #[test]
    fn every_edge_of_the_crust_has_a_disk_that_holds_no_point() {
        let points: Vec<Point> = (0..200).map(|k| scattered(f64::from(k))).collect();
        let delaunay = Delaunay::new(&points, &Progress::default()).expect("points");
        let crust = super::super::crust(&delaunay, &Progress::default()).expect("a crust");
        assert!(crust.len() > 50);
        for rows in crust {
            let (center, radius) = empty_disk(&delaunay, rows).expect("an edge of the crust");
            let distance = |p: &Point| (p[0] - center[0]).hypot(p[1] - center[1]);
            assert!(points.iter().all(|p| distance(p) > radius * (1.0 - 1e-9)));
            assert!(
                rows.iter().all(|&row| distance(&points[row as usize]) < radius * (1.0 + 1e-9))
            );
        }
    }

    #[test]
    fn a_disk_that_meets_very_many_cells_is_found() {
        let count = 10_000;
        let circle = |k: u32| (std::f64::consts::TAU * f64::from(k) / f64::from(count)).sin_cos();
        let on = |k: u32| {
            let ((sin, cos), radius) = (circle(k / 2), 1.0 + 1e-10 * f64::from(k % 2));
            [radius * cos, radius * sin]
        };
        let points: Vec<Point> = (0..2 * count).map(on).collect();
        let delaunay = Delaunay::new(&points, &Progress::default()).expect("points");
        let crust = super::super::crust(&delaunay, &Progress::default()).expect("a crust");
        let disk = |rows: &[u32; 2]| empty_disk(&delaunay, *rows).expect("an edge of the crust");
        let far = crust.iter().step_by(500).filter(|rows| disk(rows).1 > 0.1);
        assert!(far.count() > 5);
    }

    fn scattered(k: f64) -> Point {
        [(k * 0.618_033_988_7).fract(), (k * 0.754_877_666_2).fract()]
    }
}
