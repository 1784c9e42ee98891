use crate::words;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use crate::SpecError;
use crate::rule::single_line;

/// Entries of the title block of a design's drawing sheets, and their layout.
///
/// An empty entry stays empty on the sheet.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct DrawingSpec {
    /// Drawing number; the name of the part is added to it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub number: String,
    /// Revision.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub revision: String,
    /// Date of issue, printed as written; a TOML date is printed as `2026-11-30`.
    #[serde(skip_serializing_if = "String::is_empty", deserialize_with = "date")]
    pub date: String,
    /// Legal owner.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub owner: String,
    /// Name of the person who made the drawing.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub drawn_by: String,
    /// Name of the person who approved the drawing.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub approved_by: String,
    /// Size of the sheets; default: the smallest on which the part fits.
    pub sheet: Option<SheetSize>,
    /// Arrangement of the views.
    pub projection: Projection,
    /// General tolerances.
    pub general_tolerance: String,
    /// State of the edges.
    pub edges: String,
    /// Surface texture (ISO 21920) of all surfaces without their own symbol.
    pub surface: String,
    /// Surface texture (ISO 21920) of surfaces with a tolerance class up to grade 8, and of flanks and profiles; if empty, `surface` applies to them.
    pub fitted_surface: String,
}

/// Text of a date, written as text or as a date.
fn date<'de, D: Deserializer<'de>>(from: D) -> Result<String, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "must be a date or text")]
    enum Written {
        Text(String),
        Date(toml::value::Datetime),
    }
    Ok(match Written::deserialize(from)? {
        Written::Text(text) => text,
        Written::Date(date) if date.date.is_some() => date.to_string(),
        Written::Date(_) => return Err(serde::de::Error::custom("must be a date or text")),
    })
}

/// Size of a drawing sheet, ISO 5457.
#[derive(
    Clone, Copy, Debug, Deserialize, Eq, JsonSchema, Ord, PartialEq, PartialOrd, Serialize,
)]
pub enum SheetSize {
    /// 210 x 297 mm, portrait.
    A4,
    /// 420 x 297 mm.
    A3,
    /// 594 x 420 mm.
    A2,
    /// 841 x 594 mm.
    A1,
    /// 1189 x 841 mm.
    A0,
}

/// Arrangement of the views of a part, ISO 5456-2.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Projection {
    /// A view is placed on the far side of the object: the view from the left is on the right.
    #[default]
    FirstAngle,
    /// A view is placed on the side from which the object is viewed.
    ThirdAngle,
}

impl Default for DrawingSpec {
    fn default() -> Self {
        Self {
            number: String::new(),
            revision: String::new(),
            date: String::new(),
            owner: String::new(),
            drawn_by: String::new(),
            approved_by: String::new(),
            sheet: None,
            projection: Projection::default(),
            general_tolerance: "ISO 2768-mK".into(),
            edges: "ISO 13715, -0.2 / +0.1".into(),
            surface: "Ra 3.2".into(),
            fitted_surface: "Ra 1.6".into(),
        }
    }
}

impl DrawingSpec {
    /// Checks that every entry is one line of a drawing.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        let words = [
            ("number", &self.number),
            ("revision", &self.revision),
            ("date", &self.date),
            ("owner", &self.owner),
            ("drawn_by", &self.drawn_by),
            ("approved_by", &self.approved_by),
            ("general_tolerance", &self.general_tolerance),
            ("edges", &self.edges),
            ("surface", &self.surface),
            ("fitted_surface", &self.fitted_surface),
        ];
        words
            .iter()
            .try_for_each(|(key, word)| single_line(key, word))
    }

    /// Whether every value is the default.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

words!(Projection {
    FirstAngle = "first-angle",
    ThirdAngle = "third-angle",
});

words!(SheetSize {
    A4 = "A4",
    A3 = "A3",
    A2 = "A2",
    A1 = "A1",
    A0 = "A0",
});

impl SheetSize {
    /// Width and height of the trimmed sheet, mm.
    #[must_use]
    pub fn size(self) -> [f64; 2] {
        match self {
            Self::A4 => [210.0, 297.0],
            Self::A3 => [420.0, 297.0],
            Self::A2 => [594.0, 420.0],
            Self::A1 => [841.0, 594.0],
            Self::A0 => [1189.0, 841.0],
        }
    }
}
