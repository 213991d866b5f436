//! The disk that shows why an edge is in the crust, for pictures.

use super::crust::{Verdict, find_disk};
use super::one_step_crust;
use super::visit::Visit;
use crate::adjacency::vertices_of_rows;
use crate::delaunay::{Delaunay, Edge};
use crate::exact::pencil::{Circle, Pencil};
use crate::point::Point;

/// The center and the radius of the smallest disk that proves the edge between two rows to be in the crust: it touches both,
/// and holds no point and no Voronoi vertex inside. `None` for any other pair of rows.
#[must_use]
pub fn empty_disk(delaunay: &Delaunay, rows: [u32; 2]) -> Option<(Point, f64)> {
    let edge = edge_between(delaunay, rows)?;
    if !one_step_crust::is_in(delaunay, edge) {
        return None;
    }
    let Ok(Verdict::In(circle)) = find_disk(delaunay, edge, &mut Visit::default()) else {
        return None;
    };
    Some(unscaled(delaunay, edge, circle))
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
    use crate::Progress;

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

    fn scattered(k: f64) -> Point {
        [(k * 0.618_033_988_7).fract(), (k * 0.754_877_666_2).fract()]
    }
}
