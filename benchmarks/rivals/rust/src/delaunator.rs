use std::error::Error;

use delaunator::{Point, Triangulation};

use crate::rival::{Edges, Rival, edges_of_triangles};

pub struct Delaunator;

impl Rival for Delaunator {
    type Point = Point;
    type Answer = Triangulation;

    fn point(x: f64, y: f64) -> Point {
        Point { x, y }
    }

    fn triangulate(points: &[Point]) -> Result<Triangulation, Box<dyn Error>> {
        Ok(delaunator::triangulate(points))
    }

    fn edges(points: &[Point]) -> Result<Edges, Box<dyn Error>> {
        let triangles = Self::triangulate(points)?.triangles;
        Ok(edges_of_triangles(triangles.chunks_exact(3).map(|t| [t[0], t[1], t[2]])))
    }
}
