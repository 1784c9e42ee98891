//! Split of the total law into two stages of gears.

mod conjugacy;
mod fourier;
mod mildest;
mod one_pair;
mod powers;

use std::f64::consts::{PI, TAU};
use std::fmt;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

pub(super) use self::powers::SHARE;
use super::TwoBar;
use centrode_kinematics::transmission::TransmissionError;

/// Maximum bend, rad: beyond it the gears would be six times as large as the carrier is long.
const MAX_BEND: f64 = 170.0 / 180.0 * PI;

/// Maximum distance from a fraction that counts as rounding.
const EXACT: f64 = 1e-12;

/// Method by which the total law is split into two stages.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, Hash, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SplitKind {
    /// Two different pairs; each has half of the logarithm of the ratio. The intermediate shaft has two gears.
    #[default]
    Powers,
    /// Two different pairs that share the ratio so that the maximum curvature of their four pitch curves is minimum.
    Mildest,
    /// One pair used twice: sun and planet are equal parts, and one intermediate gear meshes with both.
    OnePair,
}

centrode_spec::words!(SplitKind {
    Powers = "powers",
    Mildest = "mildest",
    OnePair = "one-pair",
});

/// Driven angle of a stage by its driver's polar angle, rad: grows by one turn with each.
pub(super) type StageLaw = Arc<dyn Fn(f64) -> f64 + Send + Sync>;

/// Two stages of gears that make the total law of a chain.
///
/// The sun drives the intermediate by the law f, and the planet meshes with it by the law g. Each law is a function of the polar
/// angle of its own driver, sun or planet. With G the total law, psi the direction of the carrier and gamma the bend from the
/// carrier's first leg to its second, `g(G(psi) + planet offset) = f(psi) + idler offset - gamma - pi`.
#[derive(Clone)]
pub struct Split {
    kind: SplitKind,
    bend: f64,
    first: StageLaw,
    second: StageLaw,
    planet_offset: f64,
    idler_offset: f64,
    miss: f64,
}

impl fmt::Debug for Split {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Split")
            .field("kind", &self.kind)
            .field("bend", &self.bend)
            .field("planet_offset", &self.planet_offset)
            .field("idler_offset", &self.idler_offset)
            .finish_non_exhaustive()
    }
}

/// Reason why the total law cannot be split.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SplitError {
    /// A bend that leaves no room for the gears.
    #[error("the bend must be at most {maximum:.4} deg in either direction, not {bend:.4} deg")]
    Bend {
        /// Bend given, degrees.
        bend: f64,
        /// Maximum, degrees.
        maximum: f64,
    },
    /// The rotation number is at or near a fraction, so that no single pair follows.
    #[error(
        "the same pair twice does not work for this path: the planet must lag by {turns:.6} turns, {}{numerator}/{denominator}, at which the path does not determine one pair; use another bend, or split by powers",
        if *miss < EXACT { String::new() } else { format!("{miss:.1e} from ") }
    )]
    Resonance {
        /// Rotation number required, turns.
        turns: f64,
        /// Numerator of the fraction.
        numerator: i64,
        /// Its denominator.
        denominator: i64,
        /// Distance of the rotation number from it.
        miss: f64,
    },
    /// The law of one pair does not come out within its limit.
    #[error(
        "the same pair twice does not work for this path: the planet must lag by {turns:.6} turns, near {numerator}/{denominator}, and {}; use another bend, or split by powers",
        if miss.is_finite() { format!("the law found has a residual of {miss:.1e} rad") } else { "no law that always advances was found".to_owned() }
    )]
    Inexact {
        /// Rotation number required, turns.
        turns: f64,
        /// Maximum miss, rad; infinite if the law found turns back.
        miss: f64,
        /// Numerator of the nearest fraction.
        numerator: i64,
        /// Its denominator.
        denominator: i64,
    },
    /// Rounding stops the carrier or the arm.
    #[error(transparent)]
    Law(#[from] TransmissionError),
}

impl Split {
    /// Splits the total law of a chain; `bend` is the angle from the carrier's first leg to its second, rad.
    ///
    /// # Errors
    /// [`SplitError`] for a bend beyond 170 degrees, and for one pair twice at or near a resonance.
    pub fn new(chain: &TwoBar, kind: SplitKind, bend: f64) -> Result<Self, SplitError> {
        // NaN is refused, too.
        let is_bend = bend.abs() <= MAX_BEND;
        if !is_bend {
            return Err(SplitError::Bend {
                bend: bend.to_degrees(),
                maximum: MAX_BEND.to_degrees(),
            });
        }
        match kind {
            SplitKind::Powers => powers::split(chain, bend),
            SplitKind::Mildest => mildest::split(chain, bend),
            SplitKind::OnePair => one_pair::split(chain, bend),
        }
    }

    /// Method by which it was split.
    #[must_use]
    pub fn kind(&self) -> SplitKind {
        self.kind
    }

    /// Angle from the carrier's first leg to its second, rad.
    #[must_use]
    pub fn bend(&self) -> f64 {
        self.bend
    }

    /// Turn of the intermediate relative to the carrier by the sun's polar angle, which is the carrier's direction, rad.
    #[must_use]
    pub fn first(&self, polar: f64) -> f64 {
        (self.first)(polar)
    }

    /// Turn of the intermediate relative to the carrier by the planet's polar angle, rad.
    #[must_use]
    pub fn second(&self, polar: f64) -> f64 {
        (self.second)(polar)
    }

    /// Polar angle of the planet where the total law is zero, rad.
    #[must_use]
    pub fn planet_offset(&self) -> f64 {
        self.planet_offset
    }

    /// Angle of the intermediate's second gear on its first, rad.
    #[must_use]
    pub fn idler_offset(&self) -> f64 {
        self.idler_offset
    }

    /// Maximum error of the equation of one pair twice at 2,000 samples, rad; zero for two pairs, whose equation is solved
    /// exactly.
    #[must_use]
    pub fn miss(&self) -> f64 {
        self.miss
    }

    /// Driven angles of both stages at equal steps of a turn of their drivers, both ends included and the first zero, rad.
    #[must_use]
    pub fn tables(&self, steps: u32) -> [Vec<f64>; 2] {
        [&self.first, &self.second].map(|law| {
            let start = law(0.0);
            let at = |i: u32| law(TAU * f64::from(i) / f64::from(steps)) - start;
            let mut table: Vec<f64> = (0..steps).map(at).collect();
            table.push(TAU);
            table
        })
    }
}
