//! Disjoint sets.

/// Disjoint sets of the numbers below a count. The root of a set is its least member, so results do not depend on
/// the order of joining.
pub(crate) struct Forest(Vec<u32>);

impl Forest {
    /// Every number alone.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The least member of the set of `i`.
    #[inline]
    pub(crate) fn root(&mut self, mut i: u32) -> u32 {
        loop {
            let parent = self.0[i as usize];
            if parent == i {
                return i;
            }
            // Path halving (Tarjan and van Leeuwen 1984).
            let grandparent = self.0[parent as usize];
            self.0[i as usize] = grandparent;
            i = grandparent;
        }
    }

    /// Joins the sets of `i` and `j`.
    #[inline]
    pub(crate) fn join(&mut self, i: u32, j: u32) {
        let (i, j) = (self.root(i), self.root(j));
        if i != j {
            self.0[i.max(j) as usize] = i.min(j);
        }
    }

    /// Joins the sets of three numbers.
    #[inline]
    pub(crate) fn join_three(&mut self, [i, j, k]: [u32; 3]) {
        // Most triangles of a mesh lie between vertices whose parents are the root already.
        let [a, b, c] = [i, j, k].map(|number| self.0[number as usize]);
        if a != b || b != c {
            self.join(a, b);
            self.join(b, c);
        }
    }

    /// The root of every number.
    pub(crate) fn into_roots(mut self) -> Vec<u32> {
        // A parent is never larger than its child, so one sweep upwards is enough.
        for i in 0..self.0.len() {
            self.0[i] = self.0[self.0[i] as usize];
        }
        self.0
    }
}
