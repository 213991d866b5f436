//! The medial axis of the interpolant: centers of largest empty disks, linked along the curve.

use super::bend::Bend;
use super::disks::{Disk, Disks, disks};
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::parts::{GRAIN, in_parts};
use crate::point::{dot, sub};
use crate::progress::Progress;
use crate::space::segment::{Segment, push};

/// Centers farther apart than this part of the smaller radius are not linked: the axis may turn in between.
const LINK: f64 = 1.0;
/// Nor are those farther apart than this many times the samples that they belong to: rounding moved them.
const LEAP: f64 = 32.0;

/// The segments of the axis, in parts of successive vertices.
///
/// # Errors
/// A cancelled `progress`.
pub fn axis(
    delaunay: &Delaunay,
    bends: &[Option<Bend>],
    progress: &Progress,
) -> Result<Vec<Vec<Segment>>> {
    in_parts(bends.len(), GRAIN, progress, |vertices| {
        let vertices = vertices.start as u32..vertices.end as u32;
        let mut segments = Vec::with_capacity(2 * vertices.len());
        Part::new(delaunay, bends, vertices).collect(&mut segments);
        // What is not used is given back at once: the part stays.
        segments.shrink_to_fit();
        segments
    })
}

/// The part of the axis that successive vertices answer for.
struct Part<'a> {
    delaunay: &'a Delaunay,
    bends: &'a [Option<Bend>],
    vertices: std::ops::Range<u32>,
    disks: Vec<Disks>,
}

impl<'a> Part<'a> {
    fn new(
        delaunay: &'a Delaunay,
        bends: &'a [Option<Bend>],
        vertices: std::ops::Range<u32>,
    ) -> Self {
        let mut others = Vec::new();
        let disks = vertices.clone().map(|v| disks(delaunay, bends, v, &mut others)).collect();
        Self { delaunay, bends, vertices, disks }
    }

    fn disk(&self, v: u32, side: usize) -> Option<Disk> {
        if self.vertices.contains(&v) {
            self.disks[(v - self.vertices.start) as usize].sides[side]
        } else {
            disks(self.delaunay, self.bends, v, &mut Vec::new()).sides[side]
        }
    }

    fn collect(&self, segments: &mut Vec<Segment>) {
        for (v, here) in self.vertices.clone().zip(&self.disks) {
            let Some(bend) = &self.bends[v as usize] else { continue };
            if let Some((side, tip)) = here.tip {
                let linked = here.sides[side].and_then(|disk| link(disk, tip, bend.longest()));
                push(segments, linked.unwrap_or_else(|| alone(tip)), Segment::continued);
            }
            for side in 0..2 {
                self.collect_side(v, bend, side, segments);
            }
        }
    }

    /// The links to the centers of later adjacent vertices; a center that nothing is linked with is a segment of its own.
    fn collect_side(&self, v: u32, bend: &Bend, side: usize, segments: &mut Vec<Segment>) {
        let Some(disk) = self.disk(v, side) else { return };
        let link = |&end: &usize| self.link((v, disk), bend, side, end);
        let is_later = |end: &usize| bend.adjacent[*end] > Some(v);
        let mut is_alone = true;
        for link in [0, 1].iter().filter(|end| is_later(end)).filter_map(link) {
            push(segments, link, Segment::continued);
            is_alone = false;
        }
        if is_alone && ![0, 1].iter().filter(|end| !is_later(end)).any(|end| link(end).is_some()) {
            push(segments, alone(disk), Segment::continued);
        }
    }

    /// The link on a side of `v` to the center of the adjacent vertex at one end.
    fn link(
        &self,
        (v, disk): (u32, Disk),
        bend: &Bend,
        side: usize,
        end: usize,
    ) -> Option<Segment> {
        let next = bend.adjacent[end]?;
        let other = self.bends[next as usize].as_ref()?;
        let agrees = bend.direction(next) == -other.direction(v);
        let beyond = self.disk(next, if agrees { side } else { 1 - side })?;
        link(disk, beyond, bend.reach[end])
    }
}

/// A center by itself.
fn alone(disk: Disk) -> Segment {
    Segment::new([disk.center; 2], disk.radius)
}

/// The segment between two centers whose disks overlap well, of samples `reach` apart.
fn link(a: Disk, b: Disk, reach: f64) -> Option<Segment> {
    let step = sub(b.center, a.center);
    let radius = a.radius.min(b.radius);
    (dot(step, step) <= (LINK * radius).min(LEAP * reach).powi(2))
        .then(|| Segment::new([a.center, b.center], radius))
}
