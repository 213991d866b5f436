//! Trees that grow together: disjoint sets of numbers.
//!
//! B. A. Galler, M. J. Fischer, "An Improved Equivalence Algorithm", Communications of the ACM 7 (1964); paths are halved.

/// Disjoint sets of the numbers below some count; the smallest of each is its root.
pub struct Forest {
    parents: Vec<u32>,
}

impl Forest {
    /// Each number below `count` by itself.
    pub fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// Join the sets of `a` and `b`; were they different ones?
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// The smallest number of the set of `a`.
    pub fn root(&mut self, mut a: u32) -> u32 {
        while self.parents[a as usize] != a {
            let parent = self.parents[a as usize];
            self.parents[a as usize] = self.parents[parent as usize];
            a = self.parents[a as usize];
        }
        a
    }

    /// The root of each number.
    pub fn into_roots(mut self) -> Vec<u32> {
        // Parents are smaller, so theirs are known.
        for a in 0..self.parents.len() {
            self.parents[a] = self.parents[self.parents[a] as usize];
        }
        self.parents
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_known_by_their_smallest_number() {
        let mut forest = Forest::new(6);
        assert!(forest.join(4, 5) && forest.join(3, 1) && forest.join(5, 3));
        assert!(!forest.join(1, 4));
        assert_eq!(forest.root(5), 1);
        assert_eq!(forest.into_roots(), [0, 1, 2, 1, 1, 1]);
    }
}
