use std::sync::{Mutex, PoisonError};

/// Cache of the last few results of a long computation, each stored by its input. Default capacity: 4.
///
/// It serves the parts of a design that stay the same while other parts change. The result used longest ago is dropped
/// first. A cached result equals a new one, so the cache changes only the time. Two threads may compute the same result.
///
/// ```
/// use centrode_geometry::Recent;
///
/// static SQUARES: Recent<u32, u32> = Recent::new();
/// assert_eq!(SQUARES.get(&7, || 49), 49);
/// assert_eq!(SQUARES.get(&7, || unreachable!("it is cached")), 49);
/// ```
#[derive(Debug)]
pub struct Recent<K, V, const CAPACITY: usize = 4>(Mutex<Vec<(K, V)>>);

impl<K, V, const CAPACITY: usize> Recent<K, V, CAPACITY> {
    /// An empty cache.
    #[must_use]
    pub const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<K, V, const CAPACITY: usize> Default for Recent<K, V, CAPACITY> {
    fn default() -> Self {
        Self::new()
    }
}

impl<K: Clone + PartialEq, V: Clone, const CAPACITY: usize> Recent<K, V, CAPACITY> {
    /// The cached result of `key`; computes and stores it if there is none.
    pub fn get(&self, key: &K, make: impl FnOnce() -> V) -> V {
        // The most recently used result is first.
        let cached = |all: &mut Vec<(K, V)>| {
            let at = all.iter().position(|entry| entry.0 == *key)?;
            all[..=at].rotate_right(1);
            Some(all[0].1.clone())
        };
        if let Some(value) = cached(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner)) {
            return value;
        }
        // Computed without the lock: it takes long and may be cancelled.
        let value = make();
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if cached(&mut all).is_none() {
            all.truncate(CAPACITY - 1);
            all.insert(0, (key.clone(), value.clone()));
        }
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_result_used_longest_ago_is_dropped_first() {
        let recent: Recent<i32, ()> = Recent::new();
        let mut made = Vec::new();
        for key in [1, 2, 3, 4, 1, 5, 1, 3, 2] {
            recent.get(&key, || made.push(key));
        }
        assert_eq!(made, [1, 2, 3, 4, 5, 2]);
    }
}
