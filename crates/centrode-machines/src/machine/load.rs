//! Loads on the bodies of a composed machine.

use std::f64::consts::TAU;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::motion::input_formula::formula_of;
use super::resolve::Builder;
use super::{BodyPoint, MachineError, MachineLawError};
use centrode_kinematics::machine::{Axes, Constant, Load, Quantity};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};
use centrode_spec::rule::{Rule, broken, finite};
use centrode_spec::{SpecError, degrees};

/// A force at a point of a body, or a torque on it, over the cycle or an arc of it.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineLoadSpec {
    /// Point of a body on which it acts, `ram.tool`; or the body alone for its origin.
    pub on: String,
    /// Components of the force along x and y, N.
    pub force: Option<[f64; 2]>,
    /// Axes of the force's components.
    #[serde(default, skip_serializing_if = "LoadAxes::is_world")]
    pub axes: LoadAxes,
    /// Torque, counter-clockwise positive, N mm.
    pub torque: Option<f64>,
    /// Formula of the input `phi` in rad by which force and torque are multiplied.
    pub expression: Option<String>,
    /// Arc of the input over which it acts, from the first to the second, past the end of the cycle where the second is less,
    /// rad (degrees in the file); by default it acts always.
    #[serde(default, rename = "over_deg", with = "degrees")]
    #[schemars(with = "Option<[f64; 2]>")]
    pub over: Option<[f64; 2]>,
}

/// Axes of a load's components.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LoadAxes {
    /// Those of the frame.
    #[default]
    World,
    /// Those of the loaded body.
    Body,
}

impl LoadAxes {
    #[allow(
        clippy::trivially_copy_pass_by_ref,
        reason = "the signature serde calls"
    )]
    fn is_world(&self) -> bool {
        *self == Self::World
    }
}

/// A load on a body.
#[derive(Clone, Debug)]
pub(super) struct MachineLoad {
    on: BodyPoint,
    force: [f64; 2],
    torque: f64,
    axes: Axes,
    factor: Arc<dyn Transmission>,
}

impl MachineLoadSpec {
    pub(super) fn validate(&self) -> Result<(), SpecError> {
        if self.force.is_none() && self.torque.is_none() {
            return broken("force", Rule::NeedsOneOf("force and torque"));
        }
        for component in self.force.iter().flatten() {
            finite("force", *component)?;
        }
        finite("torque", self.torque.unwrap_or(0.0))?;
        for end in self.over.iter().flatten() {
            finite("over_deg", *end)?;
        }
        Ok(())
    }

    /// Factor of force and torque as a function of the input.
    fn factor(&self, key: &str, turns: u32) -> Result<Arc<dyn Transmission>, MachineError> {
        let period = TAU * f64::from(turns);
        let wrong = |of: &str, why: String| MachineError::refused(format!("{key}.{of}"), why);
        let size = self.expression.as_deref().unwrap_or("1");
        let formula = formula_of(size, period);
        let formula =
            formula.map_err(|error: MachineLawError| wrong("expression", error.to_string()))?;
        let mut breaks = Vec::new();
        // The values of a formula at the two ends of the period may differ.
        if formula(0.0) != formula(period) {
            breaks.push(0.0);
        }
        let Some([from, to]) = self.over else {
            let at = move |input: f64| formula(input.rem_euclid(period));
            return Ok(Arc::new(FromFn::new(period, 0.0, breaks, at)));
        };
        let length = (to - from).rem_euclid(period);
        if length == 0.0 {
            let why = "the arc must end at another input than it starts at; omit it for a load that always acts";
            return Err(wrong("over_deg", why.into()));
        }
        breaks.extend([from, to].map(|end| end.rem_euclid(period)));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        let [from, to] = [from, to].map(|end| end.rem_euclid(period));
        let acts = move |input: f64| match from < to {
            true => (from..to).contains(&input),
            false => input >= from || input < to,
        };
        let at = move |input: f64| {
            let input = input.rem_euclid(period);
            if acts(input) {
                formula(input)
            } else {
                MotionJet::default()
            }
        };
        Ok(Arc::new(FromFn::new(period, 0.0, breaks, at)))
    }
}

impl Builder<'_> {
    /// The loads of the design.
    pub(super) fn loads(&self) -> Result<Vec<MachineLoad>, MachineError> {
        let load = |(name, spec): (&String, &MachineLoadSpec)| {
            let key = format!("loads.{name}");
            let on = format!("{key}.on");
            Ok(MachineLoad {
                on: self.place(&on, &spec.on)?,
                force: spec.force.unwrap_or_default(),
                torque: spec.torque.unwrap_or_default(),
                axes: match spec.axes {
                    LoadAxes::World => Axes::World,
                    LoadAxes::Body => Axes::Link,
                },
                factor: self.ahead_of(&key, spec.factor(&key, self.design.input.turns)?),
            })
        };
        self.design.loads.iter().map(load).collect()
    }
}

impl MachineLoad {
    /// Inputs at which the load may jump.
    pub(super) fn breaks(&self) -> Vec<f64> {
        self.factor.breaks()
    }

    /// Force and torque of the load as loads of the linked machine.
    pub(super) fn parts(&self) -> Vec<Load> {
        let mut parts = Vec::new();
        let [x, y] = self.force;
        if self.force != [0.0; 2] {
            parts.push(Load::Force {
                link: self.on.body,
                at: [self.on.at.x, self.on.at.y, 0.0],
                force: [x, y, 0.0].map(|size| self.times(size)),
                axes: self.axes,
            });
        }
        if self.torque != 0.0 {
            parts.push(Load::Torque {
                link: self.on.body,
                torque: [0.0, 0.0, self.torque].map(|size| self.times(size)),
                axes: self.axes,
            });
        }
        parts
    }

    /// A component of the given size, N or N mm, times the factor.
    fn times(&self, size: f64) -> Quantity {
        if size == 0.0 {
            return Quantity::Law(Arc::new(Constant(0.0)));
        }
        let factor = Arc::clone(&self.factor);
        let (period, breaks) = (factor.period(), factor.breaks());
        let at = move |input: f64| MotionJet::default().plus(size, &factor.at(input));
        Quantity::Law(Arc::new(FromFn::new(period, 0.0, breaks, at)))
    }
}
