//! The local feature size, estimated from samples and edges.
//!
//! The distance to the sampled medial axis (`medial_axis`) overestimates: Voronoi vertices stop short of the tips of the
//! axis. Here the axis is that of a smooth interpolant: for each sample the centers of the largest empty disks that touch the
//! interpolant there, linked along the curve, and the centers of curvature where the curvature is largest, at the tips.

mod axis;
mod bend;
mod disks;

mod stencil;

use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::memory;
use crate::parts::{GRAIN, try_each};
use crate::point::Point;
use crate::progress::{Progress, Stage};
use crate::space::tree::Tree;
use axis::axis;
pub use bend::Bend;
use bend::bends;
use std::sync::Arc;
use stencil::{Scale, stencil};

/// Memory for each vertex at the peak, about.
const BYTES: usize = 288;

/// The smooth interpolant of edges, its medial axis, and the local feature size at the vertices.
#[derive(Debug)]
pub struct Interpolant {
    curve: Arc<Adjacency>,
    bends: Vec<Option<Bend>>,
    tree: Tree,
    /// For each vertex the nearest segment of the axis, and the distance.
    nearest: Vec<(u32, f64)>,
}

impl Interpolant {
    /// Of `curve`, whose neighbors may be of use elsewhere. O(n log n).
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn new(delaunay: &Delaunay, curve: Arc<Adjacency>, progress: &Progress) -> Result<Self> {
        memory::check(delaunay.points().len(), BYTES)?;
        let scale = Scale::of(delaunay.points());
        let stencil = stencil(delaunay, &curve, &scale, progress)?;
        progress.enter(Stage::Interpolate, 3 * delaunay.points().len())?;
        let bends = bends(delaunay, &stencil, &scale, progress)?;
        let tree = Tree::new(axis(delaunay, &bends, progress)?, scale.bounds);
        let places = delaunay.points();
        let mut nearest = vec![(0, 0.0); places.len()];
        let parts = nearest.chunks_mut(GRAIN).zip(places.chunks(GRAIN)).collect();
        try_each(parts, |_, (nearest, places)| {
            nearest.copy_from_slice(&tree.nearest(places));
            progress.advance(places.len())
        })?;
        Ok(Self { curve, bends, tree, nearest })
    }

    /// The neighbors of each vertex along the curves.
    #[must_use]
    pub fn curve(&self) -> &Adjacency {
        &self.curve
    }

    /// The interpolant at each vertex; `None` at isolated points and branches.
    #[must_use]
    pub fn bends(&self) -> &[Option<Bend>] {
        &self.bends
    }

    /// The local feature size at each input row: not a number at isolated points, 0 at branches, infinite without an axis.
    #[must_use]
    pub fn at_rows(&self, delaunay: &Delaunay) -> Vec<f64> {
        let mut sizes = vec![f64::NAN; delaunay.input_len()];
        for (v, &(_, distance)) in self.nearest.iter().enumerate() {
            sizes[delaunay.rows()[v] as usize] = match self.curve.of(v as u32).len() {
                0 => f64::NAN,
                1 | 2 => distance / delaunay.scale(),
                _ => 0.0,
            };
        }
        for &[row, first] in delaunay.duplicates() {
            sizes[row as usize] = sizes[first as usize];
        }
        sizes
    }

    /// The local feature size at `place`, between `p` and `q`: the distance to the parts of the axis nearest to them.
    #[must_use]
    pub fn between(&self, p: u32, q: u32, place: Point) -> f64 {
        let to = |v: u32| self.tree.distance_to(self.nearest[v as usize].0, place);
        to(p).min(to(q))
    }
}
