//! The local feature size, estimated from samples and edges.
//!
//! The distance to the sampled medial axis (`medial_axis`) overestimates: Voronoi vertices stop short of the tips of the
//! axis. Here the axis is that of a smooth interpolant: for each sample the centers of the largest empty disks that touch the
//! interpolant there, linked along the curve, and the centers of curvature where the curvature is largest, at the tips.

mod disks;
mod interpolant;
mod segments;
mod stencil;

use crate::adjacency::Adjacency;
use crate::delaunay::Delaunay;
use crate::edges::Edges;
use crate::error::Result;
use crate::point::{Point, dot, sub};
use crate::progress::Progress;
use disks::{Disk, Disks, disks};
pub use interpolant::Bend;
use interpolant::bends;
use rayon::prelude::*;
use segments::{Query, Segment, Tree};
use stencil::{Scale, stencil};

/// Centers farther apart than this part of the smaller radius are not linked: the axis may turn in between.
const LINK: f64 = 1.0;
/// Nor are those farther apart than this many times the samples that they belong to: rounding moved them.
const LEAP: f64 = 32.0;
/// Queries that one task takes at a time.
const GRAIN: usize = 1 << 10;

/// The smooth interpolant of edges, its medial axis, and the local feature size at the vertices.
#[derive(Debug)]
pub struct FeatureSize {
    curve: Adjacency,
    bends: Vec<Option<Bend>>,
    tree: Tree,
    /// For each vertex the nearest segment of the axis, and the distance.
    nearest: Vec<(u32, f64)>,
}

impl FeatureSize {
    /// Of the curves along `edges`, which are canonical. O(n log n).
    ///
    /// # Errors
    /// A cancelled `progress`.
    pub fn new(delaunay: &Delaunay, edges: &Edges, progress: &Progress) -> Result<Self> {
        let curve = Adjacency::new(delaunay, edges);
        let scale = Scale::of(delaunay.points());
        let bends = bends(delaunay, &*stencil(delaunay, &curve, &scale, progress)?, &scale);
        progress.advance(0)?;
        let vertices = 0..delaunay.points().len() as u32;
        let disks: Vec<Disks> =
            vertices.clone().into_par_iter().map(|v| disks(delaunay, &bends, v)).collect();
        progress.advance(0)?;
        let axis: Vec<Segment> =
            vertices.into_par_iter().flat_map_iter(|v| segments(&bends, &disks, v)).collect();
        progress.advance(0)?;
        let tree = Tree::new(&axis, scale.bounds);
        let nearest = nearest(&tree, delaunay.points(), progress)?;
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

/// For each place the nearest segment and the distance, infinite if there is none.
fn nearest(tree: &Tree, places: &[Point], progress: &Progress) -> Result<Vec<(u32, f64)>> {
    let part = |places: &[Point]| {
        let mut query = Query::default();
        let found: Vec<_> = places.iter().map(|&place| tree.nearest(place, &mut query)).collect();
        progress.advance(0)?;
        Ok(found)
    };
    Ok(places.par_chunks(GRAIN).map(part).collect::<Result<Vec<_>>>()?.concat())
}

/// The segments of the axis that vertex `v` answers for: to its tip, and to the centers of later adjacent vertices.
///
/// A center that nothing is linked with is a segment of its own.
fn segments(bends: &[Option<Bend>], disks: &[Disks], v: u32) -> impl Iterator<Item = Segment> {
    // A tip, and on each side two links or a center.
    let mut segments = [None; 5];
    if let Some(bend) = &bends[v as usize] {
        let here = &disks[v as usize];
        segments[4] = here.tip.map(|(side, tip)| {
            let linked = here.sides[side].and_then(|disk| link(disk, tip, bend.longest()));
            linked.unwrap_or_else(|| alone(tip))
        });
        for side in 0..2 {
            let links = [0, 1].map(|end| next_link(bends, disks, v, (side, end)));
            for end in 0..2 {
                segments[2 * side + end] = links[end].filter(|_| bend.adjacent[end] > Some(v));
            }
            if links == [None; 2] {
                segments[2 * side] = here.sides[side].map(alone);
            }
        }
    }
    segments.into_iter().flatten()
}

/// The link on a side of `v` to the center of the adjacent vertex at one end.
fn next_link(
    bends: &[Option<Bend>],
    disks: &[Disks],
    v: u32,
    (side, end): (usize, usize),
) -> Option<Segment> {
    let bend = bends[v as usize].as_ref()?;
    let next = bend.adjacent[end]?;
    let other = bends[next as usize].as_ref()?;
    let agrees = bend.direction(next) == -other.direction(v);
    let beyond = disks[next as usize].sides[if agrees { side } else { 1 - side }]?;
    link(disks[v as usize].sides[side]?, beyond, bend.reach[end])
}

/// A center by itself.
fn alone(disk: Disk) -> Segment {
    Segment { ends: [disk.center; 2], radius: disk.radius }
}

/// The segment between two centers whose disks overlap well, of samples `reach` apart.
fn link(a: Disk, b: Disk, reach: f64) -> Option<Segment> {
    let step = sub(b.center, a.center);
    let radius = a.radius.min(b.radius);
    (dot(step, step) <= (LINK * radius).min(LEAP * reach).powi(2))
        .then_some(Segment { ends: [a.center, b.center], radius })
}
