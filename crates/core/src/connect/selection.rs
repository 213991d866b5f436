//! A set of candidate edges, by half-edge.

use super::candidates::Candidates;

/// The edges chosen.
#[derive(Debug, Clone, Default)]
pub struct Selection {
    /// Is the edge of each half-edge in?
    pub chosen: Vec<bool>,
    /// How many edges each vertex has.
    pub degrees: Vec<u8>,
}

impl Selection {
    /// No edges.
    #[must_use]
    pub fn empty(candidates: &Candidates) -> Self {
        Self { chosen: vec![false; candidates.ends.len()], degrees: vec![0; candidates.vertices()] }
    }

    /// Put the edge of `e` in or take it out.
    pub fn set(&mut self, candidates: &Candidates, e: usize, is_in: bool) {
        if self.chosen[e] == is_in {
            return;
        }
        let twin = candidates.twins[e] as usize;
        for (half, end) in [(e, candidates.ends[twin]), (twin, candidates.ends[e])] {
            self.chosen[half] = is_in;
            let degree = &mut self.degrees[end as usize];
            *degree = if is_in { *degree + 1 } else { *degree - 1 };
        }
    }

    /// The half-edges chosen at `v`.
    pub fn from<'a>(
        &'a self,
        candidates: &'a Candidates,
        v: usize,
    ) -> impl Iterator<Item = usize> + 'a {
        candidates.from(v).filter(|&e| self.chosen[e])
    }

    /// The other half-edge chosen where `e` leads, if there is one.
    #[must_use]
    pub fn next(&self, candidates: &Candidates, e: usize) -> Option<usize> {
        let back = candidates.twins[e] as usize;
        self.from(candidates, candidates.ends[e] as usize).find(|&next| next != back)
    }

    /// The two half-edges chosen at `v`, if there are two and they form a pair.
    #[must_use]
    pub fn pair(&self, candidates: &Candidates, v: usize) -> Option<[usize; 2]> {
        if self.degrees[v] != 2 {
            return None;
        }
        let mut found = self.from(candidates, v);
        let pair = [found.next()?, found.next()?];
        candidates.is_paired(v, pair[1]).then_some(pair)
    }
}
