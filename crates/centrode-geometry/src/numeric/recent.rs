use std::sync::{Mutex, PoisonError};

/// The last few results of a long computation, 4 where nothing else is said, each by what it was made of.
///
/// For what stays as it is while something else of a design is changed many times: the result that nobody has asked for
/// longest is forgotten first. Made anew, a result is the same: remembering it changes nothing but the time. While one thread makes a result, others may make the same one.
///
/// ```
/// use centrode_geometry::Recent;
///
/// static SQUARES: Recent<u32, u32> = Recent::new();
/// assert_eq!(SQUARES.get(&7, || 49), 49);
/// assert_eq!(SQUARES.get(&7, || unreachable!("it is remembered")), 49);
/// ```
#[derive(Debug)]
pub struct Recent<K, V, const MOST: usize = 4>(Mutex<Vec<(K, V)>>);

impl<K, V, const MOST: usize> Recent<K, V, MOST> {
    /// Nothing remembered yet.
    #[must_use]
    pub const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<K, V, const MOST: usize> Default for Recent<K, V, MOST> {
    fn default() -> Self {
        Self::new()
    }
}

impl<K: Clone + PartialEq, V: Clone, const MOST: usize> Recent<K, V, MOST> {
    /// The remembered result of `key`, or the one made now.
    pub fn get(&self, key: &K, make: impl FnOnce() -> V) -> V {
        // The last one asked for stands first.
        let known = |all: &mut Vec<(K, V)>| {
            let at = all.iter().position(|known| known.0 == *key)?;
            all[..=at].rotate_right(1);
            Some(all[0].1.clone())
        };
        if let Some(value) = known(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner)) {
            return value;
        }
        // Not under the lock: it takes long, and may be cancelled.
        let value = make();
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if known(&mut all).is_none() {
            all.truncate(MOST - 1);
            all.insert(0, (key.clone(), value.clone()));
        }
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_has_asked_for_longest_is_forgotten_first() {
        let recent: Recent<i32, ()> = Recent::new();
        let mut made = Vec::new();
        for key in [1, 2, 3, 4, 1, 5, 1, 3, 2] {
            recent.get(&key, || made.push(key));
        }
        assert_eq!(made, [1, 2, 3, 4, 5, 2]);
    }
}
