use std::sync::Arc;

use serde::Serialize;

use super::fault::nearest;
use super::path::{Path, Step, steps};
use super::{Design, DesignError, DesignFamily, DesignFault, DesignFile};

/// A design in which some numbers can be replaced.
#[derive(Clone, Debug)]
pub struct NumberedDesign {
    family: DesignFamily,
    /// Content of the file without the key `family`.
    root: toml::Value,
    numbers: Vec<Number>,
}

/// A number that can be replaced.
#[derive(Clone, Debug)]
struct Number {
    key: String,
    steps: Vec<Step>,
    is_whole: bool,
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
    written(design).map_or(Vec::new(), |root| all_numbers(&root))
}

/// Every number in the content of a file by its key.
fn all_numbers(root: &toml::Value) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    numbers(root, &mut Path::default(), &mut |key, number| {
        found.push((key.to_owned(), number));
    });
    found
}

impl NumberedDesign {
    /// Finds the numbers at keys of a design's file.
    pub(super) fn new(
        family: DesignFamily,
        root: toml::Value,
        keys: &[&str],
    ) -> Result<Self, DesignError> {
        let mut known = Vec::new();
        numbers(&root, &mut Path::default(), &mut |key, _| {
            known.push(key.to_owned())
        });
        let mut numbered = Self {
            family,
            root,
            numbers: Vec::new(),
        };
        for (at, key) in keys.iter().enumerate() {
            if keys[..at].contains(key) {
                let fault = DesignFault::WrongType("is given twice".into());
                return Err(numbered.error(key, fault));
            }
            let number = numbered.find(key, &known)?;
            numbered.numbers.push(number);
        }
        Ok(numbered)
    }

    /// The number at a key, of which all `known` ones are in the file.
    fn find(&self, key: &str, known: &[String]) -> Result<Number, DesignError> {
        let unknown = || DesignError {
            key: key.chars().take(80).collect(),
            ..DesignError::at_start(DesignFault::UnknownKey {
                near: nearest(key, known),
                known: known.to_vec(),
                elsewhere: Vec::new(),
            })
        };
        let no_number = || self.error(key, DesignFault::WrongType("is not a number".into()));
        if key == "family" {
            return Err(no_number());
        }
        let steps = steps(key).ok_or_else(unknown)?;
        let mut root = self.root.clone();
        let is_whole = match place(&mut root, &steps).ok_or_else(unknown)? {
            toml::Value::Integer(_) => true,
            toml::Value::Float(_) => false,
            _ => return Err(no_number()),
        };
        let mut alone = Self {
            numbers: vec![Number {
                key: key.to_owned(),
                steps,
                is_whole,
            }],
            ..self.clone()
        };
        // A key that the file omits must be a known key, too. If it refuses the float 1.0, it is a count.
        if !known.iter().any(|k| k == key)
            && let Err(error) = alone.with(&[1.0])
        {
            match error.fault {
                DesignFault::UnknownKey { .. } => return Err(unknown()),
                DesignFault::WrongType(_) => alone.numbers[0].is_whole = true,
                _ => {}
            }
            let again = alone.with(&[1.0]).map_err(|error| error.fault);
            if let Err(DesignFault::WrongType(_)) = again {
                return Err(no_number());
            }
        }
        Ok(alone.numbers.remove(0))
    }

    fn error(&self, key: &str, fault: DesignFault) -> DesignError {
        DesignError {
            key: key.to_owned(),
            ..DesignError::at_start(fault)
        }
    }

    /// Every number of the design by its key, in the file's units.
    pub(super) fn all(&self) -> Vec<(String, f64)> {
        all_numbers(&self.root)
    }

    /// A number as it is written, in the file's unit; zero if the file omits it.
    #[must_use]
    pub fn value(&self, at: usize) -> Option<f64> {
        let mut root = self.root.clone();
        let value = place(&mut root, &self.numbers.get(at)?.steps)?;
        value
            .as_float()
            .or(value.as_integer().map(|whole| whole as f64))
    }

    /// A value of a number as the design takes it, in the file's unit: a count is rounded.
    #[must_use]
    pub fn taken(&self, at: usize, value: f64) -> f64 {
        let is_whole = self.numbers.get(at).is_some_and(|number| number.is_whole);
        if is_whole { value.round() } else { value }
    }

    /// Sets the numbers, in the file's units and in the order of their keys; counts are rounded.
    ///
    /// # Errors
    /// [`DesignError`] if a number breaks a rule.
    pub fn with(&self, values: &[f64]) -> Result<Arc<dyn Design>, DesignError> {
        let mut root = self.root.clone();
        for (at, (number, &value)) in self.numbers.iter().zip(values).enumerate() {
            if let Some(place) = place(&mut root, &number.steps) {
                *place = match number.is_whole && value.is_finite() {
                    true => toml::Value::Integer(self.taken(at, value) as i64),
                    false => toml::Value::Float(value),
                };
            }
        }
        if let Some(design) = (self.family.take)(root.clone()) {
            return Ok(design);
        }
        // The file of the design gives the reason in the words of its keys.
        let text = toml::to_string(&root)
            .map_err(|e| DesignError::at_start(DesignFault::NotWritable(e.to_string())))?;
        let text = format!("family = \"{}\"\n{text}", self.family.word);
        match DesignFile::read(text.as_bytes(), &[self.family]) {
            Ok((file, _)) => Ok(Arc::clone(file.design())),
            Err(error) if error.key.is_empty() => Err(DesignError {
                key: self
                    .numbers
                    .first()
                    .map_or(String::new(), |number| number.key.clone()),
                ..error
            }),
            // The rule that a number breaks may belong to another key.
            Err(error) => Err(error),
        }
    }
}

/// The number at a path. A key that is omitted takes a number like one that is written.
fn place<'v>(root: &'v mut toml::Value, steps: &[Step]) -> Option<&'v mut toml::Value> {
    let (last, tables) = steps.split_last()?;
    let mut here = root;
    for step in tables {
        here = match step {
            Step::Name(name) => here.get_mut(name.as_str())?,
            Step::Index(index) => here.get_mut(*index)?,
        };
    }
    match last {
        Step::Name(name) => {
            let table = here.as_table_mut()?;
            Some(table.entry(name.clone()).or_insert(toml::Value::Float(0.0)))
        }
        Step::Index(index) => here.get_mut(*index),
    }
}
