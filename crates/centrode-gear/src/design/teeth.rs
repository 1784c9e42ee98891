use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use centrode_spec::degrees;
use centrode_spec::rule::{Rule, SpecError, broken, finite, in_range, not_negative, positive};

/// The teeth of both gears.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct TeethSpec {
    /// Height of the teeth: "full", the height of the tool, or "fitted", each of the largest height that works.
    pub addendum: Addendum,
    /// Parameters to optimise for the contact ratio, instead of those written: the driver's share of the pitch, the tool's
    /// pressure angle, the phase; "addendum" is fitted teeth; any of the others implies it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fit: Vec<Fit>,
    /// Change of every addendum: "keep-clearance", as much as keeps the clearance of the tool at the centre distance of shifted
    /// circular gears, "none", or a coefficient k in modules, negative for shorter teeth.
    #[serde(skip_serializing_if = "TipShortening::is_usual")]
    pub tip_shortening: TipShortening,
    /// Position of the teeth on the driver's pitch curve.
    pub phase: Phase,
    /// Total backlash of the pair along the normal, mm.
    pub backlash: f64,
    /// Total backlash as a bound on the free angle of the driven gear, rad (degrees in the file).
    #[serde(rename = "backlash_angle_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub backlash_angle: Option<f64>,
    /// The driver's share of the pitch: its tooth thickness over the circular pitch.
    pub thickness_split: f64,
    /// Minimum width of a tooth at its tip, as a multiple of the module, before it is reported.
    pub minimum_tip_width_coefficient: f64,
    /// Upper and lower deviation of the thickness of every finished tooth along its pitch curve from the tooth as designed, mm,
    /// each within half a module: limits for the shop. An upper one above zero takes backlash. Default: zero and minus the
    /// tolerance of DIN 3967 for the accuracy class.
    pub thickness_deviations: Option<[f64; 2]>,
    /// Diameter of the measuring pins, mm; default: a pin that touches near the pitch curve.
    pub pin_diameter: Option<f64>,
}

impl Default for TeethSpec {
    fn default() -> Self {
        Self {
            addendum: Addendum::Full,
            fit: Vec::new(),
            tip_shortening: TipShortening::KeepClearance,
            phase: Phase::Auto,
            backlash: 0.0,
            backlash_angle: None,
            thickness_split: 0.5,
            minimum_tip_width_coefficient: 0.2,
            thickness_deviations: None,
            pin_diameter: None,
        }
    }
}

/// Height of the teeth.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Addendum {
    /// Full height, by the tool's data.
    #[default]
    Full,
    /// Trimmed tooth by tooth to what works, at most to the dedendum.
    Fitted,
}

/// Number of the teeth that is chosen so that the minimum contact ratio from one flank to the next becomes largest.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fit {
    /// Height of every tooth: with any choice the teeth are fitted.
    Addendum,
    /// The driver's share of the pitch, from 0.35 to 0.65.
    ThicknessSplit,
    /// Pressure angle of the tool, from 14.5 to 30 degrees.
    PressureAngle,
    /// Position of the teeth on the driver's pitch curve.
    Phase,
}

/// Position of the teeth on the driver's pitch curve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Phase {
    /// Congruent where both gears are the same curve, else a tooth at the polar angle zero.
    #[default]
    Auto,
    /// The middle of a tooth at the polar angle zero.
    Tooth,
    /// The middle of a space at the polar angle zero.
    Space,
    /// Chosen so that driver and driven gear come out the same part.
    Congruent,
    /// The middle of a tooth this many pitches after the polar angle zero.
    Pitches(f64),
}

const WORDS: [(&str, Phase); 4] = [
    ("auto", Phase::Auto),
    ("tooth", Phase::Tooth),
    ("space", Phase::Space),
    ("congruent", Phase::Congruent),
];

impl Serialize for Phase {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Auto => s.serialize_str("auto"),
            Self::Tooth => s.serialize_str("tooth"),
            Self::Space => s.serialize_str("space"),
            Self::Congruent => s.serialize_str("congruent"),
            Self::Pitches(p) => s.serialize_f64(*p),
        }
    }
}

impl<'de> Deserialize<'de> for Phase {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        d.deserialize_any(WordOrNumber {
            expected: "\"auto\", \"tooth\", \"space\", \"congruent\" or a number of pitches",
            words: &WORDS,
            number: Self::Pitches,
        })
    }
}

/// Change of every addendum, in modules.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TipShortening {
    /// Change that keeps the clearance of the tool: k = a/m - (z1 + z2)/2 - x1 - x2.
    #[default]
    KeepClearance,
    /// No change.
    None,
    /// A coefficient k: the addendum is longer by k modules, shorter if k is negative.
    By(f64),
}

const SHORTENINGS: [(&str, TipShortening); 2] = [
    ("keep-clearance", TipShortening::KeepClearance),
    ("none", TipShortening::None),
];

impl TipShortening {
    fn is_usual(&self) -> bool {
        *self == Self::KeepClearance
    }
}

impl Serialize for TipShortening {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::KeepClearance => s.serialize_str("keep-clearance"),
            Self::None => s.serialize_str("none"),
            Self::By(k) => s.serialize_f64(*k),
        }
    }
}

impl<'de> Deserialize<'de> for TipShortening {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        d.deserialize_any(WordOrNumber {
            expected: "\"keep-clearance\", \"none\" or a coefficient",
            words: &SHORTENINGS,
            number: Self::By,
        })
    }
}

impl JsonSchema for TipShortening {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "TipShortening".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Change of every addendum: a word, or the coefficient k in modules.",
            "anyOf": [
                { "enum": SHORTENINGS.map(|(word, _)| word) },
                { "type": "number" }
            ]
        })
    }
}

/// Reader of a value that is a number or one of some words.
struct WordOrNumber<T: 'static> {
    expected: &'static str,
    words: &'static [(&'static str, T)],
    number: fn(f64) -> T,
}

impl<T: Copy> de::Visitor<'_> for WordOrNumber<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<T, E> {
        let found = self.words.iter().find(|(w, _)| *w == word);
        found
            .map(|(_, value)| *value)
            .ok_or_else(|| E::invalid_value(de::Unexpected::Str(word), &self))
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<T, E> {
        Ok((self.number)(number))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<T, E> {
        Ok((self.number)(number as f64))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<T, E> {
        Ok((self.number)(number as f64))
    }
}

impl JsonSchema for Phase {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Phase".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Position of the teeth on the driver's pitch curve: a word, or the pitches from the polar angle zero to the middle of a tooth.",
            "anyOf": [
                { "enum": WORDS.map(|(word, _)| word) },
                { "type": "number" }
            ]
        })
    }
}

impl TeethSpec {
    /// Checks the ranges, and that backlash is given only once.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        if let TipShortening::By(k) = self.tip_shortening {
            in_range("tip_shortening", k, [-1.0, 1.0], "")?;
        }
        if let Phase::Pitches(p) = self.phase {
            finite("phase", p)?;
            in_range("phase", p, [-1.0, 1.0], "")?;
        }
        not_negative("backlash", self.backlash)?;
        if let Some(angle) = self.backlash_angle {
            not_negative("backlash_angle_deg", angle.to_degrees())?;
            if self.backlash != 0.0 {
                return broken("backlash_angle_deg", Rule::Excludes("backlash"));
            }
        }
        if let Some([upper, lower]) = self.thickness_deviations {
            finite("thickness_deviations", lower)?;
            in_range("thickness_deviations", upper, [lower, f64::INFINITY], " mm")?;
        }
        if let Some(diameter) = self.pin_diameter {
            positive("pin_diameter", diameter)?;
        }
        in_range("thickness_split", self.thickness_split, [0.2, 0.8], "")?;
        not_negative(
            "minimum_tip_width_coefficient",
            self.minimum_tip_width_coefficient,
        )
    }

    /// Checks that the deviations of thickness are at most a length, mm.
    pub(crate) fn thickness_within(&self, limit: f64) -> Result<(), SpecError> {
        let mut deviations = self.thickness_deviations.into_iter().flatten();
        let inside = |deviation| {
            let key = "teeth.thickness_deviations";
            in_range(key, deviation, [-limit, limit], " mm")
        };
        deviations.try_for_each(inside)
    }
}
