use centrode_geometry::{Outline, Segment};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::LinkedMachine;
use centrode_spec::DrawingSpec;

/// Contents of the general arrangement that are not in links, joints and figures.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Arrangement {
    /// Title: the kind of machine.
    pub title: String,
    /// Words for the title block, as in the design.
    pub drawing: DrawingSpec,
    /// Input at which the machine is drawn, rad.
    pub input: f64,
    /// Dimensions in addition to those of shafts and travel.
    pub dimensions: Vec<Dimension>,
    /// Texts with a leader to a point.
    pub callouts: Vec<Callout>,
    /// Data of the machine, in the order of the list.
    pub data: Vec<Datum>,
    /// Lines of notes.
    pub notes: Vec<String>,
    /// Further tables, such as one per axis.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<ArrangementTable>,
    /// Indices of the figures that are drawn as adjacent parts, so that what they cover is seen.
    pub seen_through: Vec<usize>,
    /// Indices of the columns of motion that the sheet has a table of.
    pub columns: Vec<usize>,
}

/// Table of words.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ArrangementTable {
    /// Title.
    pub title: String,
    /// Heading of each column.
    pub headings: Vec<String>,
    /// Rows, each with a cell per column.
    pub rows: Vec<Vec<String>>,
}

/// Place in the picture: a point of a figure's sketch.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Index of the figure.
    pub figure: usize,
    /// x and y in the figure's sketch, mm.
    pub at: [f64; 2],
}

/// Distance of two places, measured along an axis of the sheet.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Dimension {
    /// The places.
    pub ends: [Place; 2],
    /// Direction in which it is measured.
    pub along: Axis,
}

/// Axis of the sheet.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// To the right.
    X,
    /// Upwards.
    Y,
}

/// Words about a place.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Callout {
    /// The place.
    pub place: Place,
    /// Lines of words.
    pub words: Vec<String>,
}

/// One line of data.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Datum {
    /// Name.
    pub name: String,
    /// Symbol; may be empty.
    pub symbol: String,
    /// Value with its unit, as it is printed.
    pub value: String,
}

impl Datum {
    /// A value under a name and a symbol.
    #[must_use]
    pub fn new(name: &str, symbol: &str, value: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            symbol: symbol.into(),
            value: value.into(),
        }
    }
}

impl LinkedMachine {
    /// A point in the sketch of a figure by its name, mm; `None` if there is no such figure.
    #[must_use]
    pub fn place_on(&self, figure: &str, at: [f64; 2]) -> Option<Place> {
        let figure = self.figures.iter().position(|known| known.name == figure)?;
        Some(Place { figure, at })
    }

    /// A point on the edge of a contour in the sketch of a figure: the middle of its longest segment.
    #[must_use]
    pub fn place_on_edge(&self, figure: &str, outline: &Outline) -> Option<Place> {
        let length = |s: &&Segment| (s.end() - s.start()).norm_squared();
        let segments = outline.segments().iter();
        let longest = segments.max_by(|a, b| length(a).total_cmp(&length(b)))?;
        self.place_on(figure, longest.at(0.0).point.coords.into())
    }
}
