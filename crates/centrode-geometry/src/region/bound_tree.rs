//! Bounding volume hierarchy over items in a fixed order (Ericson, Real-time collision detection, 2005, chapter 6).

/// Run of neighbouring items with a bound around them.
#[derive(Clone, Copy, Debug)]
pub struct Run<B> {
    /// Bound around all items of the run.
    pub bound: B,
    first: u32,
    count: u32,
    /// Index in the tree.
    at: u32,
}

impl<B> Run<B> {
    /// Index of the first item.
    #[must_use]
    pub fn first(&self) -> usize {
        self.first as usize
    }

    /// Index of the last item.
    #[must_use]
    pub fn last(&self) -> usize {
        (self.first + self.count - 1) as usize
    }

    /// Number of items.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count as usize
    }

    /// The item, if it is the only one.
    #[must_use]
    pub fn single(&self) -> Option<usize> {
        (self.count == 1).then_some(self.first())
    }

    /// Index of the run in its tree.
    #[must_use]
    pub fn index(&self) -> u32 {
        self.at
    }

    /// The run with another bound.
    #[must_use]
    pub fn with_bound<C>(&self, bound: C) -> Run<C> {
        Run {
            bound,
            first: self.first,
            count: self.count,
            at: self.at,
        }
    }
}

/// Binary tree of runs, each with a bound around its items.
///
/// Each run is followed by those of its first half, then by those of its second half.
#[derive(Clone, Debug)]
pub struct BoundTree<B> {
    runs: Vec<Run<B>>,
}

impl<B: Copy> BoundTree<B> {
    /// Tree over the items, with a bound around each run of them.
    #[must_use]
    pub fn new<T>(items: &[T], bound: impl Fn(&[T]) -> B) -> Self {
        let mut tree = Self {
            runs: Vec::with_capacity(2 * items.len()),
        };
        if !items.is_empty() {
            tree.add(items, 0, &bound);
        }
        tree
    }

    fn add<T>(&mut self, items: &[T], first: usize, bound: &impl Fn(&[T]) -> B) {
        self.runs.push(Run {
            bound: bound(items),
            first: first as u32,
            count: items.len() as u32,
            at: self.runs.len() as u32,
        });
        if items.len() > 1 {
            let (low, high) = items.split_at(items.len() / 2);
            self.add(low, first, bound);
            self.add(high, first + low.len(), bound);
        }
    }

    /// The run of all items.
    #[must_use]
    pub fn root(&self) -> Option<Run<B>> {
        self.runs.first().copied()
    }

    /// The run with an index.
    #[must_use]
    pub fn run(&self, index: u32) -> &Run<B> {
        &self.runs[index as usize]
    }

    /// Both halves of a run of more than one item, with the bounds of the tree.
    #[must_use]
    pub fn halves<C>(&self, run: &Run<C>) -> [Run<B>; 2] {
        [run.at + 1, run.at + 2 * (run.count / 2)].map(|at| self.runs[at as usize])
    }

    /// Whether any item passes both tests: `may` for all runs that contain it, then `passes`.
    pub fn any(
        &self,
        may: &impl Fn(&Run<B>) -> bool,
        passes: &mut impl FnMut(usize) -> bool,
    ) -> bool {
        self.root()
            .is_some_and(|run| self.any_in(&run, may, passes))
    }

    fn any_in(
        &self,
        run: &Run<B>,
        may: &impl Fn(&Run<B>) -> bool,
        passes: &mut impl FnMut(usize) -> bool,
    ) -> bool {
        may(run)
            && match run.single() {
                Some(item) => passes(item),
                None => {
                    let halves = self.halves(run);
                    halves.iter().any(|half| self.any_in(half, may, passes))
                }
            }
    }

    /// Calls `found` with every item whose runs all pass a test.
    pub fn each(&self, may: &impl Fn(&Run<B>) -> bool, mut found: impl FnMut(usize)) {
        self.any(may, &mut |item| {
            found(item);
            false
        });
    }
}
