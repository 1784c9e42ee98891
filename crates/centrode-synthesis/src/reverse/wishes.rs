//! Wishes about a machine that is made from its path.

use std::collections::BTreeMap;

use centrode_geometry::{Outline, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_spec::rule::{
    Rule, broken, finite, in_range, is_zero, not_negative, part_name, positive,
};
use centrode_spec::{SpecError, degrees};

/// Maximum coordinate of a shape, mm.
const FARTHEST: f64 = 1e6;
/// Maximum number of directions that may be required along a path.
const MAX_DIRECTIONS: usize = 200;

/// Requirements for a machine other than the path of its tip.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Wishes {
    /// Length of the carrier, mm.
    #[serde(skip_serializing_if = "RequiredRange::is_free")]
    pub carrier: RequiredRange,
    /// Length of the arm, mm.
    #[serde(skip_serializing_if = "RequiredRange::is_free")]
    pub arm: RequiredRange,
    /// Centre distance of the gears, mm.
    #[serde(skip_serializing_if = "RequiredRange::is_free")]
    pub center_distance: RequiredRange,
    /// Ratio of planet to carrier.
    #[serde(skip_serializing_if = "RequiredRange::is_free")]
    pub ratio: RequiredRange,
    /// Angle from the arm to the clamp, rad (degrees in the file); default: the angle that fits the required directions best.
    #[serde(
        rename = "clamp_deg",
        with = "degrees",
        skip_serializing_if = "Option::is_none"
    )]
    #[schemars(with = "Option<f64>")]
    pub clamp: Option<f64>,
    /// Directions of the clamp at points of the path.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub directions: Vec<RequiredDirection>,
    /// Turn of the carrier between two points of the path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn: Option<RequiredTurn>,
    /// Shapes that the machine must not enter, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub keep_out: BTreeMap<String, KeepOut>,
}

/// Minimum and maximum value required of a figure.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct RequiredRange {
    /// Minimum; default: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub minimum: Option<f64>,
    /// Maximum; default: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub maximum: Option<f64>,
}

/// Direction of the clamp required at a point.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RequiredDirection {
    /// Number of the point, from one.
    pub point: usize,
    /// Direction, counter-clockwise from x, rad (degrees in the file).
    #[serde(rename = "direction_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub direction: f64,
    /// Tolerance of the direction, rad (degrees in the file).
    #[serde(
        default = "RequiredDirection::usual_tolerance",
        rename = "tolerance_deg",
        with = "degrees"
    )]
    #[schemars(with = "f64")]
    pub tolerance: f64,
}

/// Turn of the carrier required between two points of the path.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RequiredTurn {
    /// Number of the point at which the turn begins, counted from one.
    pub from: usize,
    /// Number of the point at which the turn ends.
    pub to: usize,
    /// Minimum and maximum turn, rad (degrees in the file).
    #[serde(rename = "between_deg", with = "degrees")]
    #[schemars(with = "[f64; 2]")]
    pub between: [f64; 2],
}

/// Shape that the machine must not enter: a polygon, a circle or the ground.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct KeepOut {
    /// Corners of a polygon in order, mm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub corners: Vec<[f64; 2]>,
    /// Centre of a circle, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 2]>,
    /// Radius of the circle, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// Height of the ground (y), mm; the ground fills everything below it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub below: Option<f64>,
    /// Minimum distance from the shape, mm.
    #[serde(skip_serializing_if = "is_zero")]
    pub clearance: f64,
}

impl RequiredRange {
    /// Whether nothing is required.
    #[must_use]
    pub fn is_free(&self) -> bool {
        *self == Self::default()
    }

    /// Minimum and maximum value.
    #[must_use]
    pub fn ends(&self) -> [Option<f64>; 2] {
        [self.minimum, self.maximum]
    }

    fn validate(&self, key: &str) -> Result<(), SpecError> {
        for (end, value) in [("minimum", self.minimum), ("maximum", self.maximum)] {
            if let Some(value) = value {
                not_negative(&format!("{key}.{end}"), value)?;
            }
        }
        match self.ends() {
            [Some(minimum), Some(maximum)] if minimum > maximum => broken(
                &format!("{key}.maximum"),
                Rule::NotInOrder(minimum, maximum),
            ),
            _ => Ok(()),
        }
    }
}

impl RequiredDirection {
    /// Default tolerance: 2 degrees, in rad.
    #[must_use]
    pub fn usual_tolerance() -> f64 {
        2.0_f64.to_radians()
    }
}

impl Wishes {
    /// Whether nothing is required.
    #[must_use]
    pub fn is_free(&self) -> bool {
        *self == Self::default()
    }

    /// Checks the rules for a path of `points` points.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self, points: usize) -> Result<(), SpecError> {
        self.carrier.validate("carrier")?;
        self.arm.validate("arm")?;
        self.center_distance.validate("center_distance")?;
        self.ratio.validate("ratio")?;
        finite("clamp_deg", self.clamp.unwrap_or(0.0))?;
        if self.directions.len() > MAX_DIRECTIONS {
            let rule = Rule::OutOfRange {
                value: self.directions.len() as f64,
                minimum: 0.0,
                maximum: MAX_DIRECTIONS as f64,
                unit: " directions",
            };
            return broken("directions", rule);
        }
        // The number of points in a file is not known before it is read.
        let is_point = |key: &str, number: usize| match points {
            usize::MAX => positive(key, number as f64),
            points => in_range(key, number as f64, [1.0, points as f64], ""),
        };
        for (i, required) in self.directions.iter().enumerate() {
            let key = |word: &str| format!("directions[{i}].{word}");
            is_point(&key("point"), required.point)?;
            let before = &self.directions[..i];
            if before.iter().any(|other| other.point == required.point) {
                return broken(&key("point"), Rule::Twice(required.point as f64));
            }
            finite(&key("direction_deg"), required.direction)?;
            positive(&key("tolerance_deg"), degrees::rounded(required.tolerance))?;
        }
        if let Some(turn) = self.turn {
            is_point("turn.from", turn.from)?;
            is_point("turn.to", turn.to)?;
            let [minimum, maximum] = turn.between;
            for end in turn.between {
                in_range(
                    "turn.between_deg",
                    degrees::rounded(end),
                    [0.0, 360.0],
                    " deg",
                )?;
            }
            if minimum > maximum {
                let rule = Rule::NotInOrder(degrees::rounded(minimum), degrees::rounded(maximum));
                return broken("turn.between_deg", rule);
            }
        }
        self.keep_out.iter().try_for_each(|(name, shape)| {
            let key = format!("keep_out.{name}");
            part_name(&key, name)?;
            let is_body = |body: &&str| name.split('-').next() == Some(*body);
            if name == "frame" || KeepOut::BODIES.iter().any(is_body) {
                return broken(&key, Rule::Excludes("a body of the same name"));
            }
            shape.validate().map_err(|e| e.inside(&key))
        })
    }
}

impl KeepOut {
    /// Bodies of the machine that must not enter the shape.
    pub(crate) const BODIES: [&'static str; 4] = ["arm", "carrier", "idler", "planet"];

    fn validate(&self) -> Result<(), SpecError> {
        not_negative("clearance", self.clearance)?;
        let is_circle = self.center.is_some() || self.radius.is_some();
        let kinds = [!self.corners.is_empty(), is_circle, self.below.is_some()];
        match kinds.iter().filter(|is| **is).count() {
            0 => return broken("corners", Rule::NeedsOneOf("corners, center and below")),
            1 => {}
            _ if is_circle => return broken("center", Rule::Excludes("another shape")),
            _ => return broken("below", Rule::Excludes("corners")),
        }
        let below = self.below.unwrap_or(0.0);
        in_range("below", below, [-FARTHEST, FARTHEST], " mm")?;
        if is_circle {
            let Some(center) = self.center else {
                return broken("center", Rule::Needed("with a radius"));
            };
            let Some(radius) = self.radius else {
                return broken("radius", Rule::Needed("with a center"));
            };
            for x in center {
                in_range("center", x, [-FARTHEST, FARTHEST], " mm")?;
            }
            return in_range("radius", radius, [f64::MIN_POSITIVE, FARTHEST], " mm");
        }
        if !self.corners.is_empty() && self.corners.len() < 3 {
            return broken("corners", Rule::Needed("with three corners or more"));
        }
        for x in self.corners.iter().flatten() {
            in_range("corners", *x, [-FARTHEST, FARTHEST], " mm")?;
        }
        let corners: Vec<Point> = self.corners.iter().map(|c| Point::from(*c)).collect();
        if !corners.is_empty() && Outline::polygon(&corners).crossing().is_some() {
            return broken(
                "corners",
                Rule::Needed("in order round the shape: two of its sides cross"),
            );
        }
        Ok(())
    }
}
