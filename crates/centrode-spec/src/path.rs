use std::fmt::Write;

/// Key of the current position in a traversal of a file, with the tables and lists around it: `pitch.radius[2]`.
#[derive(Debug, Default)]
pub(super) struct Path(String);

impl Path {
    /// The key as it is written.
    pub(super) fn written(&self) -> &str {
        &self.0
    }

    /// Runs `then` at a key of the current table.
    pub(super) fn name(&mut self, name: &str, then: impl FnOnce(&mut Self)) {
        let here = self.0.len();
        if here > 0 {
            self.0.push('.');
        }
        self.0.push_str(name);
        then(self);
        self.0.truncate(here);
    }

    /// Runs `then` at an entry of the current list.
    pub(super) fn index(&mut self, index: usize, then: impl FnOnce(&mut Self)) {
        let here = self.0.len();
        // Writing to a string does not fail.
        let _ = write!(self.0, "[{index}]");
        then(self);
        self.0.truncate(here);
    }
}

#[derive(Clone, Debug)]
pub(super) enum Step {
    Name(String),
    Index(usize),
}

/// The steps of a path; `None` if the text is no path.
pub(super) fn steps(path: &str) -> Option<Vec<Step>> {
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (name, rest) = part.split_at(part.find('[').unwrap_or(part.len()));
        if name.is_empty() {
            return None;
        }
        steps.push(Step::Name(name.into()));
        for index in rest.split_terminator(']') {
            steps.push(Step::Index(index.strip_prefix('[')?.parse().ok()?));
        }
    }
    Some(steps)
}

/// The value at a path.
pub(super) fn at<'v>(root: &'v toml::Value, path: &str) -> Option<&'v toml::Value> {
    steps(path)?.iter().try_fold(root, |here, step| match step {
        Step::Name(name) => here.get(name),
        Step::Index(index) => here.get(*index),
    })
}
