use std::error::Error;

/// Pairs of rows, each edge once.
pub type Edges = Vec<[i32; 2]>;

/// A triangulation of points; the answer is what the library itself calls the result.
pub trait Rival {
    type Point;
    type Answer;

    fn point(x: f64, y: f64) -> Self::Point;
    fn triangulate(points: &[Self::Point]) -> Result<Self::Answer, Box<dyn Error>>;
    fn edges(points: &[Self::Point]) -> Result<Edges, Box<dyn Error>>;
}

/// The edges of counter-clockwise triangles of rows: an inner edge is met twice, once in each direction.
pub fn edges_of_triangles(triangles: impl Iterator<Item = [usize; 3]>) -> Edges {
    let mut edges: Edges = triangles
        .flat_map(|[i, j, k]| [[i, j], [j, k], [k, i]])
        .map(|[i, j]| [i.min(j) as i32, i.max(j) as i32])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}
