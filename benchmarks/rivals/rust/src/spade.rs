use std::error::Error;

use spade::{DelaunayTriangulation, Point2, Triangulation};

use crate::rival::{Edges, Rival};

pub struct Spade;

impl Rival for Spade {
    type Point = Point2<f64>;
    type Answer = DelaunayTriangulation<Point2<f64>>;

    fn point(x: f64, y: f64) -> Self::Point {
        Point2::new(x, y)
    }

    fn triangulate(points: &[Self::Point]) -> Result<Self::Answer, Box<dyn Error>> {
        Ok(DelaunayTriangulation::bulk_load(points.to_vec())?)
    }

    /// The stable form keeps the rows; it is a little slower, so it is not the one that is timed.
    fn edges(points: &[Self::Point]) -> Result<Edges, Box<dyn Error>> {
        let triangulation = Self::Answer::bulk_load_stable(points.to_vec())?;
        let edges = triangulation.undirected_edges();
        Ok(edges.map(|edge| edge.vertices().map(|vertex| vertex.index() as i32)).collect())
    }
}
