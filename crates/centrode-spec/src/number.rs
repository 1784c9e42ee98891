use std::sync::Arc;

use serde::Serialize;

use super::fault::nearest;
use super::path::{Path, Step, steps};
use super::{Design, DesignError, DesignFamily, DesignFault, DesignFile};

/// A design in which one number can be replaced.
#[derive(Clone, Debug)]
pub struct NumberedDesign {
    family: DesignFamily,
    root: toml::Value,
    key: String,
    steps: Vec<Step>,
    whole: bool,
}

/// Visits all numbers at and below a value, each by its key.
fn numbers(value: &toml::Value, key: &mut Path, visit: &mut impl FnMut(&str, f64)) {
    match value {
        toml::Value::Integer(whole) => visit(key.written(), *whole as f64),
        toml::Value::Float(number) => visit(key.written(), *number),
        toml::Value::Array(list) => {
            for (i, value) in list.iter().enumerate() {
                key.index(i, |key| numbers(value, key, visit));
            }
        }
        toml::Value::Table(table) => {
            for (name, value) in table {
                key.name(name, |key| numbers(value, key, visit));
            }
        }
        _ => {}
    }
}

/// Content of a design's file. Every output of a design uses this function: any other path would be compiled again for every
/// table that a design can have.
pub(super) fn written(design: &impl Serialize) -> Result<toml::Value, toml::ser::Error> {
    toml::Value::try_from(design)
}

/// Every number of a design by its key, in the file's units; empty if the design cannot be written.
pub fn numbers_of(design: &impl Serialize) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    if let Ok(root) = written(design) {
        numbers(&root, &mut Path::default(), &mut |key, number| {
            found.push((key.to_owned(), number));
        });
    }
    found
}

/// Every number of a design's text by its key; empty if it is no TOML.
pub(super) fn numbers_in(text: &str) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    if let Ok(root) = toml::from_str(text) {
        numbers(&root, &mut Path::default(), &mut |key, number| {
            found.push((key.to_owned(), number));
        });
    }
    found
}

impl NumberedDesign {
    /// Finds the number at a key of a design's text.
    pub(super) fn new(family: DesignFamily, text: &str, key: &str) -> Result<Self, DesignError> {
        let root: toml::Value = toml::from_str(text)
            .map_err(|e| DesignError::at_start(DesignFault::NotWritable(e.to_string())))?;
        let mut known = Vec::new();
        numbers(&root, &mut Path::default(), &mut |key, _| {
            known.push(key.to_owned())
        });
        let unknown = || DesignError {
            key: key.chars().take(80).collect(),
            ..DesignError::at_start(DesignFault::UnknownKey {
                near: nearest(key, &known),
                known: known.clone(),
                elsewhere: Vec::new(),
            })
        };
        let no_number = || DesignError {
            key: key.to_owned(),
            ..DesignError::at_start(DesignFault::WrongType("is not a number".into()))
        };
        let steps = steps(key).ok_or_else(unknown)?;
        let mut numbered = Self {
            family,
            root,
            key: key.to_owned(),
            steps,
            whole: false,
        };
        numbered.whole = match numbered.place().ok_or_else(unknown)? {
            toml::Value::Integer(_) => true,
            toml::Value::Float(_) => false,
            _ => return Err(no_number()),
        };
        // A key that the file omits must be a known key, too. If it refuses the float 1.0, it is a count.
        if !known.iter().any(|k| k == key)
            && let Err(error) = numbered.with(1.0)
        {
            match error.fault {
                DesignFault::UnknownKey { .. } => return Err(unknown()),
                DesignFault::WrongType(_) => numbered.whole = true,
                _ => {}
            }
            let again = numbered.with(1.0).map_err(|error| error.fault);
            if let Err(DesignFault::WrongType(_)) = again {
                return Err(no_number());
            }
        }
        Ok(numbered)
    }

    fn place(&mut self) -> Option<&mut toml::Value> {
        let (last, tables) = self.steps.split_last()?;
        let mut here = &mut self.root;
        for step in tables {
            here = match step {
                Step::Name(name) => here.get_mut(name.as_str())?,
                Step::Index(index) => here.get_mut(*index)?,
            };
        }
        match last {
            // A key that is omitted takes a number like one that is written.
            Step::Name(name) => {
                let table = here.as_table_mut()?;
                Some(table.entry(name.clone()).or_insert(toml::Value::Float(0.0)))
            }
            Step::Index(index) => here.get_mut(*index),
        }
    }

    /// Number as it is written, in the file's unit.
    #[must_use]
    pub fn value(&self) -> Option<f64> {
        let mut copy = self.clone();
        let value = copy.place()?;
        value
            .as_float()
            .or(value.as_integer().map(|whole| whole as f64))
    }

    /// A value as the design takes it, in the file's unit: a count is rounded.
    #[must_use]
    pub fn taken(&self, value: f64) -> f64 {
        if self.whole { value.round() } else { value }
    }

    /// Sets the number, in the file's unit; a count is rounded.
    ///
    /// # Errors
    /// [`DesignError`] if the number breaks a rule.
    pub fn with(&self, value: f64) -> Result<Arc<dyn Design>, DesignError> {
        let mut copy = self.clone();
        let number = if self.whole {
            toml::Value::Integer(self.taken(value) as i64)
        } else {
            toml::Value::Float(value)
        };
        if let Some(place) = copy.place() {
            *place = number;
        }
        let text = toml::to_string(&copy.root)
            .map_err(|e| DesignError::at_start(DesignFault::NotWritable(e.to_string())))?;
        match DesignFile::read(text.as_bytes(), &[self.family]) {
            Ok((file, _)) => Ok(Arc::clone(file.design())),
            Err(error) if error.key.is_empty() => Err(DesignError {
                key: self.key.clone(),
                ..error
            }),
            // The rule that the number breaks may belong to another key.
            Err(error) => Err(error),
        }
    }
}
