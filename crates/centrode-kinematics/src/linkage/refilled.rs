use std::ops::Deref;

/// List that is filled again and again from its start; its entries stay allocated.
pub(super) struct Refilled<T> {
    list: Vec<T>,
    next: usize,
}

impl<T> Default for Refilled<T> {
    fn default() -> Self {
        Self {
            list: Vec::new(),
            next: 0,
        }
    }
}

impl<T> Refilled<T> {
    /// Begins anew.
    #[inline(always)]
    pub(super) fn restart(&mut self) {
        self.next = 0;
    }

    /// Number of the next element.
    #[inline(always)]
    pub(super) fn next(&self) -> usize {
        self.next
    }

    #[inline(always)]
    pub(super) fn push(&mut self, element: T) {
        match self.list.get_mut(self.next) {
            Some(room) => *room = element,
            None => self.list.push(element),
        }
        self.next += 1;
    }

    /// Skips the next element, which stays as it is; if there is none yet, appends `first`.
    #[inline(always)]
    pub(super) fn leave(&mut self, first: T) {
        if self.next == self.list.len() {
            self.list.push(first);
        }
        self.next += 1;
    }
}

impl<T> Deref for Refilled<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.list
    }
}
