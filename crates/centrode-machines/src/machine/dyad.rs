use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Side;
use centrode_spec::rule::{Rule, broken, finite, part_name, positive};
use centrode_spec::{SpecError, degrees};

/// Kind of a dyad: two bodies and three joints, R a pin and P a slide, in the order in which they follow each other.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub enum DyadKind {
    /// Two bars: pinned to both ends and to each other.
    #[serde(rename = "RRR")]
    TwoBars,
    /// A bar and a block that slides on a line of another body.
    #[serde(rename = "RRP")]
    BarAndSlider,
    /// A block that turns on a pin, and a guide through it that turns on another one.
    #[serde(rename = "RPR")]
    GuideThroughBlock,
    /// Two blocks pinned to each other, each sliding on a line.
    #[serde(rename = "PRP")]
    TwoSliders,
    /// A block on a pin that slides in the slot of a yoke, which slides on a line.
    #[serde(rename = "RPP")]
    Yoke,
}

/// A dyad: two bodies that close a loop between two others.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineDyadSpec {
    /// Type, by its joints.
    #[serde(rename = "type")]
    pub kind: DyadKind,
    /// Names of the two bodies that it makes, in the order of the type's letters.
    pub bodies: [String; 2],
    /// Pin at which it begins: `crank.A`; of all types but PRP.
    pub from: Option<String>,
    /// Pin at which it ends: `frame.P`; of RRR and RPR.
    pub to: Option<String>,
    /// Name of the joint between its bodies, a point of both; not of RPR.
    pub joint: Option<String>,
    /// Lengths of the bars, mm: two of RRR, one of RRP.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lengths: Vec<f64>,
    /// Assembly: left or right for RRR, the joint's side of the line from `from` to `to`; forward or backward for RRP, the
    /// slider's position along its line, and for RPR, the direction of the guide from its pin towards the block.
    pub side: Option<Side>,
    /// Point through which the line of the slide passes: `frame.O`; of RRP, PRP and RPP.
    pub line: Option<String>,
    /// Direction of that line in the axes of its body, rad (degrees in the file).
    #[serde(default, rename = "line_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub direction: Option<f64>,
    /// Point through which the line of the second block passes; of PRP.
    pub second_line: Option<String>,
    /// Direction of that line in the axes of its body, rad (degrees in the file).
    #[serde(default, rename = "second_line_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub second_direction: Option<f64>,
    /// Distance at which the guide passes its own pin, to the left of its direction, mm; of RPR.
    pub offset: Option<f64>,
    /// Direction of the yoke's slot against its line, rad (degrees in the file); of RPP.
    #[serde(default, rename = "slot_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub slot: Option<f64>,
}

/// Whether a kind of dyad takes a key.
#[derive(Clone, Copy, Eq, PartialEq)]
enum Takes {
    Needs,
    May,
    No,
}

impl DyadKind {
    /// Letters of the kind.
    #[must_use]
    pub fn letters(self) -> &'static str {
        match self {
            Self::TwoBars => "RRR",
            Self::BarAndSlider => "RRP",
            Self::GuideThroughBlock => "RPR",
            Self::TwoSliders => "PRP",
            Self::Yoke => "RPP",
        }
    }

    /// For each of `from`, `to`, `joint`, `lengths`, `side`, `line` with `line_deg`, the second line, `offset` and `slot_deg`:
    /// whether the kind takes it.
    fn takes(self) -> [Takes; 9] {
        use Takes::{May, Needs, No};
        match self {
            Self::TwoBars => [Needs, Needs, Needs, Needs, Needs, No, No, No, No],
            Self::BarAndSlider => [Needs, No, Needs, Needs, Needs, Needs, No, No, No],
            Self::GuideThroughBlock => [Needs, Needs, No, No, Needs, No, No, May, No],
            Self::TwoSliders => [No, No, Needs, No, No, Needs, Needs, No, No],
            Self::Yoke => [Needs, No, May, No, No, Needs, No, No, Needs],
        }
    }

    /// Text for the rule that the kind takes a key, or does not.
    fn words(self, takes: Takes) -> &'static str {
        match (self, takes) {
            (Self::TwoBars, Takes::No) => "in a dyad RRR",
            (Self::BarAndSlider, Takes::No) => "in a dyad RRP",
            (Self::GuideThroughBlock, Takes::No) => "in a dyad RPR",
            (Self::TwoSliders, Takes::No) => "in a dyad PRP",
            (Self::Yoke, Takes::No) => "in a dyad RPP",
            (Self::TwoBars, _) => "for a dyad RRR",
            (Self::BarAndSlider, _) => "for a dyad RRP",
            (Self::GuideThroughBlock, _) => "for a dyad RPR",
            (Self::TwoSliders, _) => "for a dyad PRP",
            (Self::Yoke, _) => "for a dyad RPP",
        }
    }
}

impl MachineDyadSpec {
    pub(super) fn validate(&self) -> Result<(), SpecError> {
        let [from, to, joint, lengths, side, line, second, offset, slot] = self.kind.takes();
        for (key, given, takes) in [
            ("from", self.from.is_some(), from),
            ("to", self.to.is_some(), to),
            ("joint", self.joint.is_some(), joint),
            ("lengths", !self.lengths.is_empty(), lengths),
            ("side", self.side.is_some(), side),
            ("line", self.line.is_some(), line),
            ("line_deg", self.direction.is_some(), line),
            ("second_line", self.second_line.is_some(), second),
            ("second_line_deg", self.second_direction.is_some(), second),
            ("offset", self.offset.is_some(), offset),
            ("slot_deg", self.slot.is_some(), slot),
        ] {
            match takes {
                Takes::Needs if !given => {
                    return broken(key, Rule::Needed(self.kind.words(takes)));
                }
                Takes::No if given => return broken(key, Rule::Unused(self.kind.words(takes))),
                _ => {}
            }
        }
        self.values()
    }

    /// Checks the values of the keys that are given.
    fn values(&self) -> Result<(), SpecError> {
        for name in self.bodies.iter().chain(&self.joint) {
            part_name(
                if self.joint.as_ref() == Some(name) {
                    "joint"
                } else {
                    "bodies"
                },
                name,
            )?;
        }
        if self.bodies[0] == self.bodies[1] {
            return broken("bodies", Rule::Needed("with two different names"));
        }
        let count = usize::from(self.kind == DyadKind::TwoBars) + 1;
        if !self.lengths.is_empty() && self.lengths.len() != count {
            let words = [
                "with one number for a dyad RRP",
                "with two numbers for a dyad RRR",
            ];
            return broken("lengths", Rule::Needed(words[count - 1]));
        }
        for &length in &self.lengths {
            positive("lengths", length)?;
        }
        for (key, value) in [
            ("line_deg", self.direction),
            ("second_line_deg", self.second_direction),
            ("offset", self.offset),
            ("slot_deg", self.slot),
        ] {
            finite(key, value.unwrap_or(0.0))?;
        }
        match self.side {
            Some(side) if side.is_across() != (self.kind == DyadKind::TwoBars) => {
                let words = match self.kind {
                    DyadKind::TwoBars => "as left or right for a dyad RRR",
                    _ => "as forward or backward for a dyad with a slide",
                };
                broken("side", Rule::Needed(words))
            }
            _ => Ok(()),
        }
    }
}
