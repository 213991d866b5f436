//! Tiles: which decisions of a method are local, and final, although the triangulation is not.
//!
//! A tile sees a part A of the points S. For each of its own points it asks which edges of S it has: the Voronoi cells and
//! disks of A say so, or say what must still be seen. Three lemmas carry that (docs/scale.md has the proofs).
//!
//! 1. *Reach.* An edge p q of the one-step crust is dual to a Voronoi edge that p sees under at least 90°. That edge lies in the
//!    cell of p, and the cell over A holds the one over S; so q is no farther than a bound that the cell over A gives.
//! 2. *Influence.* What the Voronoi diagram is inside a disk through p and q depends only on points near it, [`Disk::influence`].
//! 3. *Monotone.* More points only shrink Voronoi edges and empty disks, so "not in the one-step crust of A" holds for S.
//!
//! [`Rule`] says what each method asks of them, [`decide`] applies it, [`chains`] joins what tiles have traced.

mod chains;
mod decide;
mod disk;
mod reach;
mod rule;
mod unseen;

pub use chains::{Chain, Joined, Site, chains, join, numbered};
pub use decide::{Candidates, Decide, Decision, Question, candidates, decide, stars};
pub use disk::Disk;
pub use reach::Partners;
pub use rule::{BetaSkeleton, CrossingAngle, Crust, OneStepCrust, Rule, Work, with_rule};
pub use unseen::Unseen;

pub use crate::space::bounds::Bounds;
pub use crate::space::order::{Order, order};

#[cfg(test)]
mod tests;
