use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer, ValueDeserializer};

use super::family::{Family, Tagged};
use super::fault::nearest;
use super::keys::{Keys, line_and_column};
use super::{Design, DesignError, DesignFault};
use crate::feeder::{FeederDesign, FeederError};
use crate::gear::GearPairError;
use crate::gear::design::{GearPairDesign, SpecError};
use crate::mechanism::{Mechanism, MechanismError};
use crate::shaft::{MovingBoxDesign, ShaftError, SpiralShaftDesign};
use crate::three_arm::ThreeArmError;
use crate::three_arm::design::ThreeArmDesign;

/// A design together with the places of its keys, so that later errors find their line.
#[derive(Clone, Debug)]
pub struct DesignFile {
    design: Design,
    text: String,
    keys: Keys,
}

impl DesignFile {
    /// Greatest size of a design file, bytes.
    pub const LARGEST: usize = 1 << 20;

    /// Reads a design file and checks every rule that needs no geometry.
    ///
    /// # Errors
    /// [`DesignError`] naming key, line and column.
    pub fn read(bytes: &[u8]) -> Result<Self, DesignError> {
        let text = Self::text_of(bytes)?;
        let reader = Reader {
            text,
            keys: Keys::default(),
        };
        reader.read()
    }

    fn text_of(bytes: &[u8]) -> Result<&str, DesignError> {
        let at_start = |fault| DesignError {
            fault,
            key: String::new(),
            line: 1,
            column: 1,
        };
        if bytes.len() > Self::LARGEST {
            let (bytes, limit) = (bytes.len(), Self::LARGEST);
            return Err(at_start(DesignFault::TooLarge { bytes, limit }));
        }
        std::str::from_utf8(bytes).map_err(|e| {
            let good = std::str::from_utf8(&bytes[..e.valid_up_to()]).unwrap_or_default();
            let (line, column) = line_and_column(good, good.len());
            DesignError {
                line,
                column,
                ..at_start(DesignFault::NotText)
            }
        })
    }

    /// The design.
    #[must_use]
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// The design without its file.
    #[must_use]
    pub fn into_design(self) -> Design {
        self.design
    }

    /// Line and column of a key, `teeth.backlash`, or of the innermost table around it that is written;
    /// the first line where none is.
    #[must_use]
    pub fn place(&self, key: &str) -> (usize, usize) {
        let offset = self.keys.offset(key).unwrap_or(0);
        line_and_column(&self.text, offset)
    }

    /// The mechanism of the design.
    ///
    /// # Errors
    /// [`DesignError`] at the key to blame.
    pub fn mechanism(&self) -> Result<Mechanism, DesignError> {
        Mechanism::resolve(&self.design).map_err(|error| self.blame(error))
    }

    fn blame(&self, error: MechanismError) -> DesignError {
        let key = error.key();
        let fault = match error {
            MechanismError::GearPair(e) | MechanismError::ThreeArm(ThreeArmError::Gears(e)) => {
                match e {
                    GearPairError::Spec(SpecError { rule, .. }) => DesignFault::Value(rule),
                    GearPairError::Pitch(e) => DesignFault::Pitch(e),
                    other => DesignFault::GearPair(Box::new(other)),
                }
            }
            MechanismError::Shaft(ShaftError::Spec(SpecError { rule, .. }))
            | MechanismError::Feeder(FeederError::Spec(SpecError { rule, .. })) => {
                DesignFault::Value(rule)
            }
            other => DesignFault::Mechanism(Box::new(other)),
        };
        let (line, column) = self.place(&key);
        DesignError {
            fault,
            key,
            line,
            column,
        }
    }
}

/// A file while it is read.
struct Reader<'a> {
    text: &'a str,
    keys: Keys,
}

impl<'a> Reader<'a> {
    fn read(mut self) -> Result<DesignFile, DesignError> {
        let root = DeTable::parse(self.text).map_err(|e| self.syntax(&e))?;
        self.keys = Keys::of(root.get_ref());
        let span = root.span();
        let mut root = root.into_inner();
        if root.is_empty() {
            return Err(self.error(DesignFault::Empty, String::new(), 0));
        }
        let families = Design::FAMILIES.map(String::from);
        let family = self.word(&root, "family", "family", 0)?;
        if !families.contains(&family) {
            return Err(self.unknown_word("family", family, &families));
        }
        root.remove("family");
        let design = match family.as_str() {
            "three-arm" => self.family::<ThreeArmDesign>(root, span),
            "spiral-shaft" => self.family::<SpiralShaftDesign>(root, span),
            "moving-box" => self.family::<MovingBoxDesign>(root, span),
            "feeder" => self.family::<FeederDesign>(root, span),
            _ => self.family::<GearPairDesign>(root, span),
        }?;
        Ok(DesignFile {
            design,
            text: self.text.into(),
            keys: self.keys,
        })
    }

    fn family<F: Family>(
        &self,
        root: DeTable<'a>,
        span: std::ops::Range<usize>,
    ) -> Result<Design, DesignError> {
        self.tables(&root, F::TABLES)?;
        for tagged in F::TAGGED {
            self.tagged(&root, tagged)?;
        }
        let document = Deserializer::from(Spanned::new(span, root));
        let design = F::deserialize(document).map_err(|e| self.shape(&e))?;
        design.validate().map_err(|SpecError { key, rule }| {
            let offset = self.keys.offset(&key).unwrap_or(0);
            self.error(DesignFault::Value(rule), key, offset)
        })?;
        Ok(design.into())
    }

    /// Refuses anything but a table at the keys; serde would read a list as a table's values in order.
    fn tables(&self, root: &DeTable<'_>, keys: &[&str]) -> Result<(), DesignError> {
        for &key in keys {
            if root.get(key).is_some_and(|v| !v.get_ref().is_table()) {
                let fault = DesignFault::WrongType(format!("must be a table: write [{key}]"));
                let offset = self.keys.offset(key).unwrap_or(0);
                return Err(self.error(fault, key.into(), offset));
            }
        }
        Ok(())
    }

    /// Reads a table whose key `kind` says what else is in it, for the places of its errors.
    ///
    /// Serde gathers such a table before it looks at its keys, and loses their places on the way.
    fn tagged(&self, root: &DeTable<'a>, tagged: &Tagged) -> Result<(), DesignError> {
        let Tagged { key, kinds, read } = *tagged;
        let Some(value) = root.get(key) else {
            return Ok(());
        };
        let DeValue::Table(table) = value.get_ref() else {
            return Ok(());
        };
        let path = format!("{key}.kind");
        let offset = self.keys.offset(key).unwrap_or(0);
        let kind = self.word(table, "kind", &path, offset)?;
        if !kinds.contains(&kind.as_str()) {
            let kinds: Vec<String> = kinds.iter().map(|&k| k.into()).collect();
            return Err(self.unknown_word(&path, kind, &kinds));
        }
        let mut rest = table.clone();
        rest.remove("kind");
        let rest = Spanned::new(value.span(), DeValue::Table(rest));
        read(&kind, ValueDeserializer::from(rest)).map_err(|e| self.shape(&e))
    }

    /// The string at a key that must be there.
    fn word(
        &self,
        table: &DeTable<'_>,
        key: &str,
        path: &str,
        around: usize,
    ) -> Result<String, DesignError> {
        let Some(value) = table.get(key) else {
            let fault = DesignFault::MissingKey(key.into());
            return Err(self.error(fault, path.into(), around));
        };
        match value.get_ref() {
            DeValue::String(word) => Ok(word.to_string()),
            _ => {
                let fault = DesignFault::WrongType("must be a word in quotes".into());
                let offset = self.keys.offset(path).unwrap_or(around);
                Err(self.error(fault, path.into(), offset))
            }
        }
    }

    fn unknown_word(&self, path: &str, word: String, known: &[String]) -> DesignError {
        let fault = DesignFault::UnknownWord {
            near: nearest(&word, known),
            word,
            known: known.to_vec(),
        };
        let offset = self.keys.offset(path).unwrap_or(0);
        self.error(fault, path.into(), offset)
    }

    fn error(&self, fault: DesignFault, key: String, offset: usize) -> DesignError {
        let (line, column) = line_and_column(self.text, offset);
        DesignError {
            fault,
            key,
            line,
            column,
        }
    }

    fn syntax(&self, error: &toml::de::Error) -> DesignError {
        let offset = error.span().map_or(self.text.len(), |s| s.start);
        let fault = DesignFault::Syntax(error.message().into());
        self.error(fault, String::new(), offset)
    }

    /// Names the key of an error serde has found, in the words of the file rather than of Rust.
    fn shape(&self, error: &toml::de::Error) -> DesignError {
        let offset = error.span().map_or(0, |s| s.start);
        let key = self.keys.around(offset).unwrap_or_default().to_owned();
        let message = error.message();
        let names = quoted(message);
        if message.starts_with("unknown field") {
            let known: Vec<String> = names.iter().skip(1).cloned().collect();
            let near = names.first().and_then(|name| nearest(name, &known));
            return self.error(DesignFault::UnknownKey { near, known }, key, offset);
        }
        if message.starts_with("unknown variant") {
            let known: Vec<String> = names.iter().skip(1).cloned().collect();
            let word = names.first().cloned().unwrap_or_default();
            let near = nearest(&word, &known);
            return self.error(DesignFault::UnknownWord { word, near, known }, key, offset);
        }
        if let (true, Some(name)) = (message.starts_with("missing field"), names.first()) {
            let fault = DesignFault::MissingKey(name.clone());
            // What lacks it begins with the text itself: no table has been opened, whatever key comes first.
            let path = if key.is_empty() || offset == 0 {
                name.clone()
            } else {
                format!("{key}.{name}")
            };
            let offset = self.keys.offset(&path).unwrap_or(0);
            return self.error(fault, path, offset);
        }
        let plain = message
            .replace("floating point", "number")
            .replace("expected f64", "expected a number")
            .replace("expected u32", "expected a whole number, not negative")
            .replace("expected struct ", "expected a table: ");
        self.error(DesignFault::WrongType(plain), key, offset)
    }
}

/// The parts of a message in backticks.
fn quoted(message: &str) -> Vec<String> {
    let parts = message.split('`').skip(1).step_by(2);
    parts.map(String::from).collect()
}
