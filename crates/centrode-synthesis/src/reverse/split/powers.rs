use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{Antiderivative, piece_ends};

use super::{Split, SplitError, SplitKind, StageLaw};
use crate::reverse::TwoBar;
use centrode_kinematics::transmission::{Inverse, Transmission as _};

/// Exponent of the ratio in the first stage: each takes half of its logarithm.
pub(in crate::reverse) const SHARE: f64 = 0.5;
/// Size of the values from which an integrand's rounding error follows, as a multiple of the mean speed of a body.
const NOISE: f64 = 100.0;

/// Logarithm of a factor of the first stage's ratio by the carrier's direction.
pub(super) type Bow = Box<dyn Fn(f64) -> f64 + Send + Sync>;

/// Splits by `f' = c (G')^k`, g = f o G^-1.
///
/// Both laws are one integral over the path: with psi and chi the turns of carrier and planet by its parameter,
/// `f = g = c * integral of chi'^k psi'^(1 - k)`, and c makes the integral one turn.
pub(super) fn split(chain: &TwoBar, bend: f64) -> Result<Split, SplitError> {
    split_with(chain, SplitKind::Powers, bend, Box::new(|_| 0.0))
}

/// Splits by powers with a factor e^bow of the first stage's ratio; the integrand contains this factor, too.
pub(super) fn split_with(
    chain: &TwoBar,
    kind: SplitKind,
    bend: f64,
    bow: Bow,
) -> Result<Split, SplitError> {
    let (from, period) = (chain.stretched(), chain.path().period());
    let to = from + period;
    let breaks = chain.path().breaks_between(from, to);
    let rate = {
        let chain = chain.clone();
        move |t: f64| {
            let [carrier, planet] = chain.speeds(t, &chain.path().at(t));
            let bow = bow(chain.at(t).carrier[0]);
            (SHARE * planet.ln() + (1.0 - SHARE) * carrier.ln() + bow).exp()
        }
    };
    let size = NOISE * TAU / period;
    let turned = Arc::new(Antiderivative::with_scale(
        rate,
        &piece_ends(from, to, 1, &breaks),
        size,
    ));
    let sense = chain.sense();
    let law = |inverse: Inverse| -> StageLaw {
        let turned = Arc::clone(&turned);
        Arc::new(move |angle: f64| {
            let t = inverse.at(angle).position;
            let turns = ((t - from) / period).floor();
            let inside = (t - turns * period).clamp(from, to);
            sense * TAU * (turned.at(inside) / turned.total() + turns)
        })
    };
    let (first, second) = (law(chain.by_carrier()?), law(chain.by_planet()?));
    Ok(Split {
        kind,
        bend,
        first,
        second,
        planet_offset: 0.0,
        // Both laws are the same function of the path's parameter.
        idler_offset: bend + PI,
        miss: 0.0,
    })
}
