//! Inside or outside of the rings: a flood over the vertices.

use super::mesh::Mesh;
use crate::delaunay::NONE;
use crate::error::Result;
use crate::parts::map;
use crate::progress::{PACE, Progress};

/// For each vertex: is the place to the right of its first half-edge inside an odd number of rings?
///
/// Every vertex but the leftmost has a neighbor that comes before it from left to right, so steps to such neighbors lead
/// from each vertex to the leftmost, whose first half-edge has the outside to its right.
pub fn inside(mesh: &Mesh<'_>, progress: &Progress) -> Result<Vec<bool>> {
    let count = mesh.delaunay.points().len();
    let steps = map(count, (NONE, false), progress, |v| step_left(mesh, v as u32))?;
    let mut inside = vec![None; steps.len()];
    let mut path = Vec::new();
    for v in 0..steps.len() {
        if v % PACE == 0 {
            progress.advance(0)?;
        }
        let mut at = v;
        while inside[at].is_none() && steps[at].0 != NONE {
            path.push(at);
            at = steps[at].0 as usize;
        }
        let mut is_inside = inside[at].unwrap_or(false);
        inside[at] = Some(is_inside);
        while let Some(back) = path.pop() {
            is_inside ^= steps[back].1;
            inside[back] = Some(is_inside);
        }
    }
    Ok(inside.into_iter().map(|inside| inside == Some(true)).collect())
}

/// A neighbor of `v` before it from left to right, and whether only one of their first half-edges has the inside to its right.
///
/// Around a vertex the inside begins and ends at the edges that flip.
fn step_left(mesh: &Mesh<'_>, v: u32) -> (u32, bool) {
    let star = mesh.delaunay.star(v);
    let at = mesh.delaunay.point(v);
    let is_before = |q: u32| {
        let [x, y] = mesh.delaunay.point(q);
        x < at[0] || x == at[0] && y < at[1]
    };
    let Some(k) = star.neighbors.iter().position(|&q| is_before(q)) else { return (NONE, false) };
    let q = star.neighbors[k];
    let back = mesh.delaunay.position(q, v).expect("stars are symmetric");
    // What is to the left of v → q is to the right of q → v.
    let right = back.checked_sub(1).is_some_and(|before| mesh.marks_at(q)[before].is_odd);
    (q, mesh.marks_at(v)[k].is_odd != right)
}
