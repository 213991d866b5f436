//! From beliefs to edges: the surest first, at most two a point.

use super::candidates::Candidates;
use super::selection::Selection;
use rayon::prelude::*;

/// Take the edges that are believed in, the surest first, while both ends have fewer than `most`, two or one.
///
/// Equally sure edges that compete for a point are all left out, and the point takes no further ones: nothing in the
/// points tells them apart, so no order of theirs may.
#[must_use]
pub fn decode(
    candidates: &Candidates,
    beliefs: &[f32],
    most: impl Fn(usize) -> u8 + Sync,
) -> Selection {
    // Where no more are believed in than there is room for, all are in, whatever their order.
    let has_room = candidates.by_vertex(|v| {
        let believed = candidates.from(v).filter(|&e| beliefs[e] < 0.0).count();
        believed <= usize::from(most(v))
    });
    let mut selection = Selection::empty(candidates);
    let mut sorted: Vec<(f32, u32, u32)> = Vec::new();
    for (v, e) in candidates.edges().filter(|&(_, e)| beliefs[e] < 0.0) {
        if has_room[v] && has_room[candidates.ends[e] as usize] {
            selection.set(candidates, e, true);
        } else {
            sorted.push((beliefs[e], v as u32, e as u32));
        }
    }
    sorted.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let mut wanted = selection.degrees.clone();
    for equal in sorted.chunk_by(|a, b| a.0 == b.0) {
        take(candidates, equal, &most, &mut selection, &mut wanted);
    }
    selection
}

/// Take those of the equally sure edges that do not compete. `wanted` is by vertex: edges taken, or one more than the most.
fn take(
    candidates: &Candidates,
    equal: &[(f32, u32, u32)],
    most: &impl Fn(usize) -> u8,
    selection: &mut Selection,
    wanted: &mut [u8],
) {
    let ends = |&(_, v, e): &(f32, u32, u32)| [v as usize, candidates.ends[e as usize] as usize];
    let is_free = |wanted: &[u8], v: usize| wanted[v] < most(v);
    let open: Vec<_> =
        equal.iter().filter(|edge| ends(edge).iter().all(|&v| is_free(wanted, v))).collect();
    for v in open.iter().flat_map(|edge| ends(edge)) {
        wanted[v] = (wanted[v] + 1).min(most(v) + 1);
    }
    for edge in &open {
        let is_alone = ends(edge).iter().all(|&v| wanted[v] <= most(v));
        if is_alone {
            selection.set(candidates, edge.2 as usize, true);
        }
    }
    // An edge that its other end could not take leaves its place to others.
    for v in open.iter().flat_map(|edge| ends(edge)) {
        if wanted[v] <= most(v) {
            wanted[v] = selection.degrees[v];
        }
    }
}
