use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::DeTable;

use super::number::{NumberedDesign, written};
use super::reader::Reader;
use super::{DesignError, DesignFault, DesignFile};
use crate::SpecError;

/// A design as written in a file: of one of the families, named by the key `family`.
pub trait Design: Any + Debug + Send + Sync {
    /// Family of the design.
    fn family(&self) -> DesignFamily;

    /// Short name.
    fn name(&self) -> &str;

    /// One line for drawings and reports.
    fn title(&self) -> &str;

    /// Checks every rule that needs no geometry.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    fn validate(&self) -> Result<(), SpecError>;

    /// The design as a file; reads back as the same design.
    ///
    /// # Errors
    /// [`DesignFault::NotWritable`] for a number that no file can hold, such as a tooth count above the maximum whole number of
    /// TOML.
    fn to_toml(&self) -> Result<String, DesignError>;

    /// Key in the design file for a word: a parameter's name, `r1`, or the key itself.
    fn key_of(&self, word: &str) -> String;

    /// The design with replaceable numbers, at keys of its file: `arm.tip_distance` or `pitch.radius[3]`.
    ///
    /// A number that the file omits, but may have, can be set by [`NumberedDesign::with`] too, if its table is in the file.
    ///
    /// # Errors
    /// [`DesignFault::UnknownKey`] if a key cannot have a number.
    fn numbered(&self, keys: &[&str]) -> Result<NumberedDesign, DesignError>;

    /// Whether another design equals this one.
    fn equals(&self, other: &dyn Design) -> bool;
}

impl dyn Design {
    /// Casts to the design of a family; `None` for another family.
    #[must_use]
    pub fn downcast_ref<D: DesignSpec>(&self) -> Option<&D> {
        (self as &dyn Any).downcast_ref()
    }
}

impl PartialEq for dyn Design {
    fn eq(&self, other: &Self) -> bool {
        self.equals(other)
    }
}

/// Design file of one family: its word, template, tables and rules.
pub trait DesignSpec:
    Clone + Debug + DeserializeOwned + JsonSchema + PartialEq + Send + Serialize + Sync + 'static
{
    /// Word of the family, as written at the key `family`.
    const FAMILY: &'static str;
    /// Sentence that describes the mechanism.
    const ABOUT: &'static str;
    /// Commented design file to start from, a valid design itself.
    const TEMPLATE: &'static str;
    /// Keys at the root that hold a table.
    const TABLES: &'static [&'static str];

    /// Name and title, as written.
    fn words(&self) -> [&str; 2];

    /// Checks the rules that need no geometry.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    fn rules(&self) -> Result<(), SpecError>;

    /// Key for a word of this family.
    #[must_use]
    fn key_of(_word: &str) -> Option<String> {
        None
    }

    /// Reads a design file of this family and checks every rule that needs no geometry.
    ///
    /// # Errors
    /// [`DesignError`] with key, line and column.
    fn from_toml(text: &str) -> Result<Self, DesignError> {
        let mut reader = Reader::new(DesignFile::text_of(text.as_bytes())?);
        let (root, _) = reader.root(&[DesignFamily::new::<Self>()])?;
        reader.design(root)
    }
}

impl<D: DesignSpec> Design for D {
    fn family(&self) -> DesignFamily {
        DesignFamily::new::<D>()
    }

    fn name(&self) -> &str {
        self.words()[0]
    }

    fn title(&self) -> &str {
        self.words()[1]
    }

    fn validate(&self) -> Result<(), SpecError> {
        self.rules()
    }

    fn to_toml(&self) -> Result<String, DesignError> {
        let keys = written(self).and_then(|root| toml::to_string(&root));
        let keys = keys.map_err(|e| DesignError::at_start(DesignFault::NotWritable(e.to_string())));
        Ok(format!("family = \"{}\"\n{}", D::FAMILY, keys?))
    }

    fn numbered(&self, keys: &[&str]) -> Result<NumberedDesign, DesignError> {
        let root = written(self)
            .map_err(|e| DesignError::at_start(DesignFault::NotWritable(e.to_string())))?;
        NumberedDesign::new(Design::family(self), root, keys)
    }

    fn key_of(&self, word: &str) -> String {
        <D as DesignSpec>::key_of(word).unwrap_or_else(|| word.to_owned())
    }

    fn equals(&self, other: &dyn Design) -> bool {
        other.downcast_ref::<D>() == Some(self)
    }
}

/// Family of mechanism, as needed to read and write its design files.
#[derive(Clone, Copy, Debug)]
pub struct DesignFamily {
    /// Word of the family, as written at the key `family`.
    pub word: &'static str,
    /// Sentence that describes the mechanism.
    pub about: &'static str,
    /// Commented design file to start from, a valid design itself.
    pub template: &'static str,
    pub(super) read: Read,
    /// Design of a file's content; `None` if it breaks a rule. Quicker than `read`, which names the rule.
    pub(super) take: fn(toml::Value) -> Option<Arc<dyn Design>>,
    pub(super) schema: fn(&mut SchemaGenerator) -> Schema,
    pub(super) title: fn() -> std::borrow::Cow<'static, str>,
}

type Read = for<'a> fn(&Reader<'a>, Spanned<DeTable<'a>>) -> Result<Arc<dyn Design>, DesignError>;

impl DesignFamily {
    /// The family of a design.
    #[must_use]
    pub const fn new<D: DesignSpec>() -> Self {
        Self {
            word: D::FAMILY,
            about: D::ABOUT,
            template: D::TEMPLATE,
            read: |reader, root| Ok(Arc::new(reader.design::<D>(root)?)),
            take: |root| {
                let design = D::deserialize(root).ok()?;
                design
                    .rules()
                    .is_ok()
                    .then(|| Arc::new(design) as Arc<dyn Design>)
            },
            schema: D::json_schema,
            title: D::schema_name,
        }
    }
}

impl AsRef<DesignFamily> for DesignFamily {
    fn as_ref(&self) -> &Self {
        self
    }
}
