use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{COMPUTED, Recent};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::machine::motion::input_formula::expression;
use crate::machine::motion::table::{self, TableReading};
use crate::machine::{IntermittentSpec, TraverseSpec};
use centrode_gear::cam::design::MotionSpec;
use centrode_gear::cam::{Motion, MotionError};
use centrode_kinematics::machine::Linear;
use centrode_kinematics::transmission::{Chain, FromFn, Transmission, TransmissionError};
use centrode_spec::digits::stated;
use centrode_spec::rule::{Rule, broken, finite, in_range};
use centrode_spec::{SpecError, degrees};

/// Maximum speed of a body, rad or mm per rad of the input. A faster motion is taken for a pole.
const FASTEST: f64 = 1e4;
/// Inputs per turn at which the speed is sampled: half a step from a pole such as that of tan(phi) it is above the limit.
const SAMPLES: u32 = 720;

/// Maximum number of cached laws: a machine has a few.
const CACHED: usize = 32;

/// A law, or the reason why there is none.
type Made = Result<Arc<dyn Transmission>, MachineLawError>;

/// Motion of a body on the one that carries it, by the input: the sum of a start and at most one of the others.
///
/// Alone, a start is a constant; `ratio = 1` is the input itself.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachineLawSpec {
    /// Angle at the start of a body that turns, rad (degrees in the file).
    #[serde(rename = "start_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub start_angle: Option<f64>,
    /// Position at the start of a body that slides, mm.
    pub start: Option<f64>,
    /// Turns of the body for one of the input: a belt, a chain, round gears; below zero it turns in the opposite direction.
    pub ratio: Option<f64>,
    /// Formula of the input `phi` in rad: of an angle in rad for a body that turns and of a position in mm for one that slides.
    pub expression: Option<String>,
    /// Angles at equal steps of the period, interpolated by a smooth curve, rad (degrees in the file).
    #[serde(
        rename = "table_deg",
        with = "degrees",
        skip_serializing_if = "Vec::is_empty"
    )]
    #[schemars(with = "Vec<f64>")]
    pub table_angles: Vec<f64>,
    /// Whole turns of the body over `table_deg`: 1 turns on through 360 degrees, 0 swings back, -1 turns clockwise. By default
    /// those that make the last step small, at most twice the largest step of the table.
    pub turns: Option<i32>,
    /// Positions at equal steps of the period, interpolated by a smooth curve, mm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub table: Vec<f64>,
    /// Rises, returns and dwells over one turn of the input, as for a cam.
    pub cam: Option<MotionSpec>,
    /// Cam that moves the body as its follower.
    pub follows: Option<String>,
    /// Turning and rest, as of a gear that an intermittent gear drives.
    pub intermittent: Option<IntermittentSpec>,
    /// Strokes out and back, as of a slider in the groove of a spiral shaft.
    pub traverse: Option<TraverseSpec>,
    /// Body whose turn on its own pin replaces the input.
    pub by: Option<String>,
}

/// Reason why there is no such law.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MachineLawError {
    /// A formula that cannot be read.
    #[error("{0}")]
    Formula(String),
    /// A formula without a value.
    #[error("the formula has no value at an input of {degrees} deg")]
    NoValue {
        /// Input, deg.
        degrees: f64,
    },
    /// Segments that do not form a motion.
    #[error(transparent)]
    Cam(#[from] MotionError),
    /// A table that does not form a curve.
    #[error("{why}")]
    Table {
        /// Key of the table.
        key: &'static str,
        /// The violated rule.
        why: String,
    },
    /// A table of angles after which the body may either turn on or swing back.
    #[error(
        "its last step is ambiguous compared with its largest step of {} deg: {}; {}. Set law.turns to one of them",
        stated(.0[0].largest_step.to_degrees()), .0[0].words(), .0[1].words()
    )]
    UnclearTable([TableReading; 2]),
    /// An intermittent drive or a groove that is not possible.
    #[error("{why}")]
    Drive {
        /// Key of the drive.
        key: &'static str,
        /// The violated rule.
        why: String,
    },
    /// A motion that does not repeat together with the body that replaces the input.
    #[error(transparent)]
    By(#[from] TransmissionError),
    /// A turning body that is not back at its first position after a period.
    #[error(
        "turns the body by {turns} turns in the period of {period} turns of the input, and so is not back at its start: {}",
        match minimum {
            Some(minimum) => format!("set input.turns to {minimum} or a multiple of it"),
            None => "no input.turns up to 60 brings it back".into(),
        }
    )]
    NoWholeTurns {
        /// Turns of the body.
        turns: f64,
        /// Turns of the input.
        period: u32,
        /// Minimum turns of the input after which the body is back at its first position.
        minimum: Option<u32>,
        /// Key of the law.
        key: &'static str,
    },
    /// A motion that is too fast, as at a pole.
    #[error(
        "moves the body at {speed:.3e} {unit} per rad of the input at {degrees} deg; at most {FASTEST} is allowed"
    )]
    TooFast {
        /// Key of the law.
        key: &'static str,
        /// The speed.
        speed: f64,
        /// Unit of the body's position.
        unit: &'static str,
        /// Input, deg.
        degrees: f64,
    },
    /// A motion that is not periodic.
    #[error("{what} is {start} at the start of the period and {end} at its end")]
    Open {
        /// The motion or its derivative.
        what: &'static str,
        /// Value at the start.
        start: f64,
        /// Value at the end.
        end: f64,
    },
}

impl MachineLawError {
    /// Key within the law's table.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Formula(_) | Self::NoValue { .. } | Self::Open { .. } => "expression".into(),
            Self::Cam(error) => format!("cam.{}", error.key()),
            Self::UnclearTable(_) => "table_deg".into(),
            Self::Table { key, .. }
            | Self::Drive { key, .. }
            | Self::TooFast { key, .. }
            | Self::NoWholeTurns { key, .. } => (*key).into(),
            Self::By(_) => "by".into(),
        }
    }
}

impl MachineLawSpec {
    /// Keys of the given motions.
    fn motions(&self) -> impl Iterator<Item = &'static str> + use<> {
        let given = [
            ("ratio", self.ratio.is_some()),
            ("expression", self.expression.is_some()),
            ("table_deg", !self.table_angles.is_empty()),
            ("table", !self.table.is_empty()),
            ("cam", self.cam.is_some()),
            ("follows", self.follows.is_some()),
            ("intermittent", self.intermittent.is_some()),
            ("traverse", self.traverse.is_some()),
        ];
        let given = given.into_iter().filter(|(_, given)| *given);
        given.map(|(key, _)| key)
    }

    pub(in crate::machine) fn validate(&self, slides: bool) -> Result<(), SpecError> {
        let mut motions = self.motions();
        let first = motions.next();
        if let (Some(first), Some(key)) = (first, motions.next()) {
            return broken(key, Rule::Excludes(first));
        }
        if first.is_none() && self.start_angle.is_none() && self.start.is_none() {
            let key = if slides { "start" } else { "start_deg" };
            let keys = "start_deg, start, ratio, expression, table_deg, table, cam, intermittent, traverse and follows";
            return broken(key, Rule::NeedsOneOf(keys));
        }
        if first.is_none() && self.by.is_some() {
            return broken("by", Rule::Unused("except for a law that moves"));
        }
        if self.follows.is_some() && self.by.is_some() {
            return broken("by", Rule::Excludes("follows"));
        }
        let only = "except for a body that turns";
        let strange: &[(&str, bool)] = if slides {
            &[
                ("start_deg", self.start_angle.is_some()),
                ("ratio", self.ratio.is_some()),
                ("table_deg", !self.table_angles.is_empty()),
                ("intermittent", self.intermittent.is_some()),
            ]
        } else {
            &[
                ("start", self.start.is_some()),
                ("table", !self.table.is_empty()),
                ("traverse", self.traverse.is_some()),
            ]
        };
        if let Some((key, _)) = strange.iter().find(|(_, given)| *given) {
            let only = if slides {
                only
            } else {
                "except for a body that slides"
            };
            return broken(key, Rule::Unused(only));
        }
        if let Some(turns) = self.turns {
            if self.table_angles.is_empty() {
                return broken("turns", Rule::Unused("without table_deg"));
            }
            in_range("turns", turns.into(), [-1e3, 1e3], "")?;
        }
        for value in [self.start_angle, self.start].into_iter().flatten() {
            finite(if slides { "start" } else { "start_deg" }, value)?;
        }
        if let Some(ratio) = self.ratio {
            in_range("ratio", ratio, [-1e3, 1e3], "")?;
        }
        for &value in self.table.iter().chain(&self.table_angles) {
            finite(if slides { "table" } else { "table_deg" }, value)?;
        }
        if let Some(gears) = &self.intermittent {
            gears.validate().map_err(|e| e.inside("intermittent"))?;
        }
        if let Some(groove) = &self.traverse {
            groove.validate().map_err(|e| e.inside("traverse"))?;
        }
        let Some(cam) = &self.cam else {
            return Ok(());
        };
        cam.validate().map_err(|e| e.inside("cam"))?;
        match cam.swings() {
            Some(swings) if swings == slides => {
                let words = if slides { "lift" } else { "swing_deg" };
                broken("cam", Rule::Stroke(words))
            }
            _ => Ok(()),
        }
    }

    /// Reading of the law's table of angles; `None` if there is no table, or if its reading is not clear.
    #[must_use]
    pub fn table_reading(&self) -> Option<TableReading> {
        let given = !self.table_angles.is_empty();
        given.then(|| TableReading::of(&self.table_angles, self.turns).ok())?
    }

    /// Whether the law gives the body a motion of its own; false for a body at rest and for the follower of a cam.
    pub(in crate::machine) fn moves(&self) -> bool {
        let turns = self.ratio.is_some_and(|ratio| ratio != 0.0);
        let table = !self.table_angles.is_empty() || !self.table.is_empty();
        let drive = self.intermittent.is_some() || self.traverse.is_some();
        turns || table || drive || self.expression.is_some() || self.cam.is_some()
    }

    /// Start of the motion, rad or mm.
    pub(in crate::machine) fn offset(&self) -> f64 {
        self.start_angle.or(self.start).unwrap_or(0.0)
    }

    /// The law over a period of `turns` turns of the input, for a body that slides or turns and follows no cam; `by` is the
    /// turn of the body that replaces the input.
    ///
    /// A law of the input alone is cached, because cached trains are found by the laws that move them.
    ///
    /// # Errors
    /// [`MachineLawError`] if the law cannot be read, or is not periodic.
    pub(in crate::machine) fn resolve(
        &self,
        turns: u32,
        slides: bool,
        by: Option<Arc<dyn Transmission>>,
    ) -> Result<Arc<dyn Transmission>, MachineLawError> {
        static LAWS: Recent<(MachineLawSpec, u32, bool), Made, CACHED> = Recent::new();
        match by {
            None => LAWS.get(&(self.clone(), turns, slides), || {
                self.checked(self.motion(turns)?, turns, slides)
            }),
            Some(by) => {
                // A cycle of the body that replaces the input: its whole turns in the period, at least one.
                let period = TAU * f64::from(turns);
                let turned = by.advance() * period / (by.period() * TAU);
                let own = self.motion(turned.abs().round().max(1.0) as u32)?;
                self.checked(Arc::new(Chain::new(own, by)?), turns, slides)
            }
        }
    }

    /// Checks that a motion is slow enough and periodic, and returns it.
    fn checked(&self, law: Arc<dyn Transmission>, turns: u32, slides: bool) -> Made {
        let period = TAU * f64::from(turns);
        let key = self.motions().next().unwrap_or("ratio");
        let looks = SAMPLES * turns;
        let inputs = (0..looks).map(|i| period * f64::from(i) / f64::from(looks));
        let mut speeds = inputs.map(|input| (input, law.at(input).velocity.abs()));
        if let Some((input, speed)) = speeds.find(|(_, s)| s.is_nan() || *s > FASTEST) {
            return Err(MachineLawError::TooFast {
                key,
                speed,
                unit: if slides { "mm" } else { "rad" },
                degrees: input.to_degrees(),
            });
        }
        let advance = law.advance() * period / law.period();
        if slides && advance != 0.0 {
            let what = "its position";
            let start = law.at(0.0).position;
            let end = start + advance;
            return Err(MachineLawError::Open { what, start, end });
        }
        let turned = advance / TAU;
        let repeats = period / law.period();
        if (turned - turned.round()).abs() > COMPUTED
            || (repeats - repeats.round()).abs() > COMPUTED
        {
            return Err(MachineLawError::NoWholeTurns {
                turns: turned,
                period: turns,
                minimum: minimum_turns(law.as_ref()),
                key,
            });
        }
        Ok(law)
    }

    /// The law as a function of its own input, over a period of `turns` turns of this input.
    fn motion(&self, turns: u32) -> Result<Arc<dyn Transmission>, MachineLawError> {
        let start = self.offset();
        let drive = |key: &'static str| move |why: String| MachineLawError::Drive { key, why };
        if let Some(text) = &self.expression {
            return expression(text, start, TAU * f64::from(turns));
        }
        let shifted = |values: &[f64]| -> Vec<f64> { values.iter().map(|v| start + v).collect() };
        let period = TAU * f64::from(turns);
        if !self.table.is_empty() {
            return table::through("table", &shifted(&self.table), period, 0.0);
        }
        if !self.table_angles.is_empty() {
            let reading = TableReading::of(&self.table_angles, self.turns);
            let advance = TAU * f64::from(reading.map_err(MachineLawError::UnclearTable)?.turns);
            return table::through("table_deg", &shifted(&self.table_angles), period, advance);
        }
        let moved: Arc<dyn Transmission> = if let Some(cam) = &self.cam {
            Arc::new(Motion::resolve(cam)?)
        } else if let Some(gears) = &self.intermittent {
            gears.resolve().map_err(drive("intermittent"))?
        } else if let Some(groove) = &self.traverse {
            groove.resolve().map_err(drive("traverse"))?
        } else {
            let slope = self.ratio.unwrap_or(0.0);
            return Ok(Arc::new(Linear::new(start, slope)));
        };
        if start == 0.0 {
            return Ok(moved);
        }
        let [period, advance] = [moved.period(), moved.advance()];
        let shifted = FromFn::new(period, advance, moved.breaks(), move |input| {
            let mut jet = moved.at(input);
            jet.position += start;
            jet
        });
        Ok(Arc::new(shifted))
    }
}

/// Minimum number of turns of the input, up to a limit, after which a motion is back, apart from whole turns of the body.
fn minimum_turns(law: &dyn Transmission) -> Option<u32> {
    const MOST: u32 = 60;
    let whole = |x: f64| (x - x.round()).abs() <= COMPUTED;
    (1..=MOST).find(|&turns| {
        let repeats = TAU * f64::from(turns) / law.period();
        whole(repeats) && whole(repeats * law.advance() / TAU)
    })
}
