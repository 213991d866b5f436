//! The axis, and vertices that no double holds: three points that are nearly in line have a center farther away than the largest number.
//! They count as infinitely far away, so their edges are rays, or lines.

use crate::point::{Point, sub};

/// The medial axis of samples.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MedialAxis {
    /// Voronoi vertices, in the scale of the input; triangles on one circle share one.
    pub vertices: Vec<Point>,
    /// The distance from each vertex to the samples nearest to it.
    pub radii: Vec<f64>,
    /// The edges, sorted by their samples.
    pub edges: Vec<Edge>,
    /// The vertex that each unbounded edge starts at.
    pub ray_origins: Vec<u32>,
    /// Its unit direction.
    pub ray_directions: Vec<Point>,
    /// The two rows that it separates, i < j, sorted.
    pub ray_samples: Vec<[u32; 2]>,
}

/// An edge of the axis: the Voronoi edge between two samples.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Edge {
    /// The two rows that it separates, i < j.
    pub samples: [u32; 2],
    /// The vertices to the left and to the right of the step from i to j.
    pub ends: [u32; 2],
    /// Is it inside an odd number of rings?
    pub is_inner: bool,
}

impl Edge {
    /// The edge between two samples, in any order, with its ends to the left and to the right of the step from one to the other.
    #[must_use]
    pub fn new(samples: [u32; 2], ends: [u32; 2], is_inner: bool) -> Self {
        if samples[0] < samples[1] {
            return Self { samples, ends, is_inner };
        }
        let turned = |[a, b]: [u32; 2]| [b, a];
        Self { samples: turned(samples), ends: turned(ends), is_inner }
    }
}

/// The same axis with finite vertices alone; `place` gives the points by row.
pub fn at_infinity(axis: MedialAxis, place: impl Fn(u32) -> Point) -> MedialAxis {
    let is_known = |(vertex, radius): (&Point, &f64)| {
        vertex[0].is_finite() & vertex[1].is_finite() & radius.is_finite()
    };
    let is_known: Vec<bool> = axis.vertices.iter().zip(&axis.radii).map(is_known).collect();
    let mut near = Near { axis: MedialAxis::default(), rays: Vec::new() };
    let mut numbers = vec![0; is_known.len()];
    for v in (0..is_known.len()).filter(|&v| is_known[v]) {
        numbers[v] = near.vertex(axis.vertices[v], axis.radii[v]);
    }
    let known = |v: u32| is_known[v as usize].then(|| numbers[v as usize]);
    let ahead = |v: u32, direction: Point| is_ahead(axis.vertices[v as usize], direction);
    for edge in &axis.edges {
        let (samples, [left, right]) = (edge.samples, edge.ends);
        let ends = samples.map(&place);
        let (to_left, to_right) = (direction(ends, 1.0), direction(ends, -1.0));
        match (known(left), known(right)) {
            (Some(left), Some(right)) => {
                near.axis.edges.push(Edge { ends: [left, right], ..*edge });
            }
            (None, Some(right)) => near.rays.push((samples, right, to_left)),
            (Some(left), None) => near.rays.push((samples, left, to_right)),
            (None, None) if ahead(left, to_left) && ahead(right, to_right) => {
                near.line(samples, ends, to_left);
            }
            (None, None) => {}
        }
    }
    for (k, &samples) in axis.ray_samples.iter().enumerate() {
        let (origin, outward) = (axis.ray_origins[k], axis.ray_directions[k]);
        match known(origin) {
            Some(origin) => near.rays.push((samples, origin, outward)),
            None if ahead(origin, outward) => {}
            None => near.line(samples, samples.map(&place), outward),
        }
    }
    near.finished()
}

/// The axis as far as it is near: rays are samples, the vertex and the direction.
struct Near {
    axis: MedialAxis,
    rays: Vec<([u32; 2], u32, Point)>,
}

impl Near {
    fn vertex(&mut self, vertex: Point, radius: f64) -> u32 {
        self.axis.vertices.push(vertex);
        self.axis.radii.push(radius);
        self.axis.vertices.len() as u32 - 1
    }

    /// Two opposite rays from the midpoint of two points.
    fn line(&mut self, samples: [u32; 2], [p, q]: [Point; 2], direction: Point) {
        let half = [0, 1].map(|k| q[k] / 2.0 - p[k] / 2.0);
        let middle = self.vertex([0, 1].map(|k| p[k] + half[k]), half[0].hypot(half[1]));
        self.rays.push((samples, middle, direction));
        self.rays.push((samples, middle, direction.map(|x| -x)));
    }

    fn finished(mut self) -> MedialAxis {
        // Stable: the two rays of a line stay in order.
        self.rays.sort_by_key(|&(samples, _, _)| samples);
        for (samples, origin, direction) in self.rays {
            self.axis.ray_samples.push(samples);
            self.axis.ray_origins.push(origin);
            self.axis.ray_directions.push(direction);
        }
        self.axis
    }
}

/// The unit vector to the left of p → q, times `sign`.
fn direction([p, q]: [Point; 2], sign: f64) -> Point {
    let [x, y] = sub(q.map(|x| x / 2.0), p.map(|x| x / 2.0));
    let length = x.hypot(y);
    [-sign * y / length, sign * x / length]
}

/// Is a far vertex in this direction, rather than behind?
fn is_ahead(vertex: Point, direction: Point) -> bool {
    let along = |k: usize| if direction[k] == 0.0 { 0.0 } else { direction[k] * vertex[k] };
    along(0) + along(1) > 0.0
}

#[cfg(test)]
mod tests {
    use crate::adjacency::Adjacency;
    use crate::delaunay::Delaunay;
    use crate::medial_axis::medial_axis;
    use crate::progress::Progress;

    #[test]
    fn a_vertex_beyond_the_largest_number_is_infinitely_far() {
        let tiny = 5e-324;
        let points = [[-tiny, tiny], [-tiny, 1.0 + f64::EPSILON], [tiny, 2.0 + 2.0 * f64::EPSILON]];
        let delaunay = Delaunay::new(&points, &Progress::default()).expect("points");
        let axis = medial_axis(
            &delaunay,
            &Adjacency::new(&delaunay, &Vec::new()).expect("memory"),
            &Progress::default(),
        )
        .expect("an axis");
        assert!(axis.vertices.iter().flatten().chain(&axis.radii).all(|x| x.is_finite()));
        // A line between the first two and one between the last two, as for points in line.
        assert_eq!(axis.ray_samples, [[0, 1], [0, 1], [1, 2], [1, 2]]);
        assert_eq!(axis.edges.len(), 0);
        assert_eq!(axis.vertices.len(), 2);
    }
}
