//! What each method that tiles can decide asks of the points: what a verdict rests on, and how far a partner can be.

use super::disk::Disk;
use super::reach::Partners;
use crate::delaunay::{Delaunay, Edge};
use crate::error::{Error, Result};
use crate::exact::angle_bound::AngleBound;
use crate::exact::pencil::{Pencil, Vertex};
use crate::methods::{
    Crossing, Verdict, Visit, find_disk, find_late, has_angles, is_in_one_step_crust,
};
use crate::point::{Point, cross, dot, sub};
use crate::progress::Progress;
use std::f64::consts::{FRAC_PI_2, PI};

/// The verdict on an edge, by the points that were seen: final if no point in the disks is unseen.
#[derive(Debug, Clone, Copy)]
pub struct Finding {
    /// Is the edge in?
    pub is_in: bool,
    /// What that rests on; "out" often rests on nothing.
    pub rests_on: [Option<Disk>; 2],
}

impl Finding {
    /// More points do not bring the edge back.
    const OUT: Self = Self { is_in: false, rests_on: [None; 2] };
}

/// A method that can be decided tile by tile.
pub trait Rule: Sync {
    /// The working memory of one task.
    type Memory: Default;

    /// The verdict on an edge of the triangulation, unless it takes too long.
    fn find(&self, delaunay: &Delaunay, edge: Edge, memory: &mut Self::Memory) -> Option<Finding>;

    /// The verdicts on the edges that took too long.
    ///
    /// # Errors
    /// Too little memory, or a cancelled `progress`.
    fn find_late(
        &self,
        _delaunay: &Delaunay,
        late: &[Edge],
        _progress: &Progress,
    ) -> Result<Vec<(Edge, Finding)>> {
        // No verdict by a fixed number of disks does.
        assert!(late.is_empty());
        Ok(Vec::new())
    }

    /// Is the edge in the graph of these points that holds the method's edges between them, whatever other points there are?
    fn may_join(&self, delaunay: &Delaunay, edge: Edge) -> bool;

    /// Where partners can be.
    fn partners(&self) -> Partners;
}

/// The rule of a method, found by the name and the parameters that `methods::select` takes, and what is done with it.
///
/// # Errors
/// That tiles cannot decide this method, or an error of the work.
pub fn with_rule<W: Work>(name: &str, parameters: &[f64], work: W) -> Result<W::Result> {
    match (name, parameters) {
        ("crust", []) => work.by(&Crust),
        ("one-step-crust", []) => work.by(&OneStepCrust),
        ("beta-skeleton", &[beta, 0.0]) => work.by(&BetaSkeleton::new(beta)?),
        ("crossing-angle-graph", &[cotangent]) => work.by(&CrossingAngle::new(cotangent)?),
        _ => Err(Error::Argument {
            message: format!(
                "{name} cannot be decided tile by tile, for its edges can rest on points anywhere: use crust, one-step-crust, crossing-angle-graph, or beta-skeleton of circles with beta above 1"
            ),
        }),
    }
}

/// What is done with a rule, whichever it is.
pub trait Work {
    /// What it gives.
    type Result;
    /// Do it.
    ///
    /// # Errors
    /// Those of the work.
    fn by<R: Rule>(self, rule: &R) -> Result<Self::Result>;
}

/// The crust.
#[derive(Debug, Clone, Copy)]
pub struct Crust;

impl Rule for Crust {
    type Memory = Visit;

    fn find(&self, delaunay: &Delaunay, edge: Edge, visit: &mut Visit) -> Option<Finding> {
        if !is_in_one_step_crust(delaunay, edge) {
            return Some(Finding::OUT);
        }
        let verdict = find_disk(delaunay, edge, visit).ok()?;
        Some(by_disks(delaunay, edge, &verdict))
    }

    fn find_late(
        &self,
        delaunay: &Delaunay,
        late: &[Edge],
        progress: &Progress,
    ) -> Result<Vec<(Edge, Finding)>> {
        let make = |edge, verdict: &_| Some((edge, by_disks(delaunay, edge, verdict)));
        Ok(find_late(delaunay, late, progress, make)?.concat())
    }

    fn may_join(&self, delaunay: &Delaunay, edge: Edge) -> bool {
        is_in_one_step_crust(delaunay, edge)
    }

    fn partners(&self) -> Partners {
        Partners::SeenUnder(FRAC_PI_2)
    }
}

/// In by a disk: final once all of its influence is seen. Out by Voronoi vertices: once each is seen to be one.
fn by_disks(delaunay: &Delaunay, edge: Edge, verdict: &Verdict) -> Finding {
    let pencil = pencil(delaunay, edge);
    match verdict {
        Verdict::In(circle) => {
            let influence = Disk::influence(&pencil, *circle);
            Finding { is_in: true, rests_on: [Some(influence), None] }
        }
        Verdict::Out(vertices) => {
            let disk = |vertex: Option<Vertex>| vertex.and_then(|v| disk_of(&pencil, &v));
            Finding { is_in: false, rests_on: vertices.map(disk) }
        }
    }
}

fn pencil(delaunay: &Delaunay, edge: Edge) -> Pencil {
    Pencil::new(delaunay.point(edge.p), delaunay.point(edge.q))
}

/// The circumdisk of a Voronoi vertex; none for an end of the edge's own dual, which more points only move inward.
fn disk_of(pencil: &Pencil, vertex: &Vertex) -> Option<Disk> {
    let corners = vertex.triangle();
    let is_end = corners.contains(&pencil.p) && corners.contains(&pencil.q);
    (!is_end).then(|| Disk::around(vertex))
}

/// The one-step crust.
#[derive(Debug, Clone, Copy)]
pub struct OneStepCrust;

impl Rule for OneStepCrust {
    type Memory = ();

    fn find(&self, delaunay: &Delaunay, edge: Edge, (): &mut ()) -> Option<Finding> {
        let is_in = is_in_one_step_crust(delaunay, edge);
        Some(if is_in { by_two_disks(delaunay, edge, FRAC_PI_2) } else { Finding::OUT })
    }

    fn may_join(&self, delaunay: &Delaunay, edge: Edge) -> bool {
        is_in_one_step_crust(delaunay, edge)
    }

    fn partners(&self) -> Partners {
        Partners::SeenUnder(FRAC_PI_2)
    }
}

/// The γ-graph of two empty disks whose circles cross at a fixed angle or more.
#[derive(Debug)]
pub struct CrossingAngle {
    crossing: Crossing,
    angle: f64,
}

impl CrossingAngle {
    /// The rule for the angle of this `cotangent`.
    ///
    /// # Errors
    /// A `cotangent` that is not finite.
    pub fn new(cotangent: f64) -> Result<Self> {
        Ok(Self { crossing: Crossing::new(cotangent)?, angle: 1f64.atan2(cotangent) })
    }
}

impl Rule for CrossingAngle {
    type Memory = ();

    fn find(&self, delaunay: &Delaunay, edge: Edge, (): &mut ()) -> Option<Finding> {
        let is_in = self.crossing.holds(delaunay, edge);
        Some(if is_in { by_two_disks(delaunay, edge, self.angle) } else { Finding::OUT })
    }

    fn may_join(&self, delaunay: &Delaunay, edge: Edge) -> bool {
        self.crossing.holds(delaunay, edge)
    }

    fn partners(&self) -> Partners {
        Partners::SeenUnder(self.angle)
    }
}

/// In because the dual Voronoi edge is seen under `angle`: two empty disks centered so far apart, the smallest such, prove it.
fn by_two_disks(delaunay: &Delaunay, edge: Edge, angle: f64) -> Finding {
    let pencil = pencil(delaunay, edge);
    // The center at the left is seen from p, above p q, under 90° less the angle opposite to the edge.
    let end = |apex: Option<u32>| {
        apex.map_or(FRAC_PI_2, |apex| FRAC_PI_2 - opposite(&pencil, delaunay.point(apex)))
    };
    let (low, high) = (-end(edge.right), end(edge.left));
    let first = (-angle / 2.0).max(low).min(high - angle);
    let disk = |direction: f64| {
        let (sin, cos) = direction.sin_cos();
        // The direction is right to some roundings, and the height turns with it by its derivative.
        Disk::at_height(&pencil, sin / cos, 32.0 * f64::EPSILON / (cos * cos))
    };
    Finding { is_in: true, rests_on: [Some(disk(first)), Some(disk(first + angle))] }
}

/// The angle opposite to the pencil's chord at `apex`.
fn opposite(pencil: &Pencil, apex: Point) -> f64 {
    let (u, v) = (sub(pencil.p, apex), sub(pencil.q, apex));
    cross(u, v).abs().atan2(dot(u, v)).clamp(0.0, PI)
}

/// The β-skeleton of circles, for β > 1.
#[derive(Debug)]
pub struct BetaSkeleton {
    beta: f64,
    bound: AngleBound,
}

impl BetaSkeleton {
    /// The rule for `beta`.
    ///
    /// # Errors
    /// A `beta` of at most 1, where a partner can be anywhere, or not finite.
    pub fn new(beta: f64) -> Result<Self> {
        if !(beta > 1.0 && beta.is_finite()) {
            let message =
                format!("tiles decide the β-skeleton for a finite beta above 1, not {beta}");
            return Err(Error::Argument { message });
        }
        Ok(Self { beta, bound: AngleBound::of_beta(beta) })
    }
}

impl Rule for BetaSkeleton {
    type Memory = ();

    /// In by its two disks.
    fn find(&self, delaunay: &Delaunay, edge: Edge, (): &mut ()) -> Option<Finding> {
        if !self.may_join(delaunay, edge) {
            return Some(Finding::OUT);
        }
        let (pencil, height) = (pencil(delaunay, edge), self.bound.cotangent());
        let disk = |height: f64| Some(Disk::at_height(&pencil, height, f64::EPSILON * self.beta));
        Some(Finding { is_in: true, rests_on: [height, -height].map(disk) })
    }

    fn may_join(&self, delaunay: &Delaunay, edge: Edge) -> bool {
        has_angles(delaunay, edge, &self.bound, &self.bound)
    }

    fn partners(&self) -> Partners {
        Partners::ByDisks(self.beta)
    }
}
