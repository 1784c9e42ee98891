//! Whether teeth can follow pitch curves that swing.

use super::GearPairError;
use crate::gear::Rolling;

/// Least radius of curvature, modules, of pitch curves that may swing as often as they like.
const LEAST_ARC: f64 = 0.5;

/// Most swings a tooth of sharper ones.
pub(super) const MOST_SWINGS: u32 = 2;

/// Checks that teeth can follow the pitch curves: these may swing often, and have small arcs, but not both.
///
/// What a tool leaves of such teeth are crossings of every wave of a flank with every other, which grow with the square of the
/// waves a tooth.
pub(super) fn follow(rolling: &Rolling, teeth: u32, module: f64) -> Result<(), GearPairError> {
    let swings = rolling.turns() / 2;
    if swings <= MOST_SWINGS as usize * teeth as usize {
        return Ok(());
    }
    let radius = rolling.sharpest();
    if radius >= LEAST_ARC * module {
        return Ok(());
    }
    Err(GearPairError::Swings {
        swings,
        teeth,
        radius,
        module,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::DesignSpec as _;
    use crate::gear::{GearPair, design::GearPairDesign};

    fn resolved(expression: &str, teeth: u32) -> Result<GearPair, GearPairError> {
        let text = format!(
            "family = \"gear-pair\"\n[pitch]\nkind = \"polar\"\nmodule = 2\nexpression = \"{expression}\"\ntooth_count = {teeth}\n[teeth]\naddendum = \"fitted\"\n"
        );
        GearPair::resolve(&GearPairDesign::from_toml(&text).expect("a design"))
    }

    #[test]
    fn pitch_curves_may_swing_often_or_have_small_arcs_but_not_both() {
        // Often: waves of half a micrometre, twelve a tooth. Small arcs: a rounded triangle.
        for (expression, teeth) in [
            ("1 + 0.00001*cos(501*phi)", 40),
            ("1/(1 - 0.11*cos(3*phi))", 12),
        ] {
            assert!(resolved(expression, teeth).is_ok(), "{expression}");
        }
        let refused = resolved("1 + 0.001*cos(503*phi)", 40);
        let Err(error) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!(error.key(), "pitch");
        let GearPairError::Swings {
            swings,
            teeth,
            radius,
            module,
        } = error
        else {
            panic!("{error}");
        };
        assert_eq!((swings, teeth), (503, 40));
        // Where the radius is least, a quarter of a wave on from where the pitch curve is steepest, the curvature is about
        // (1 + e n^2)/r, and that of the mate the same with the other sign.
        let r = 40.0 * module / (2.0 * 1.06);
        let expected = r / (1.0 + 0.001 * 503.0 * 503.0);
        assert!(
            (radius / expected - 1.0).abs() < 0.05,
            "{radius} {expected}"
        );
    }
}
