//! Whether teeth can follow pitch curves with many waves.

use super::GearPairError;
use crate::Rolling;

/// Maximum product of the waves per turn and the waves per tooth: every wave of a flank may cross every other wave of the tooth,
/// so that the work is proportional to this product.
pub(super) const MAX_WORK: usize = 25_000;

/// Minimum radius of curvature, modules, of pitch curves with as many waves as the work allows. Curves with a smaller
/// radius are limited by [`MAX_SWINGS`].
const MIN_ARC: f64 = 0.5;

/// Maximum number of waves per tooth of pitch curves with a smaller radius. Curves with more waves are refused.
pub(super) const MAX_SWINGS: usize = 4;

/// Checks that teeth can follow the pitch curves: these may have many waves or small arcs, but not both.
pub(super) fn follow(rolling: &Rolling, teeth: u32, module: f64) -> Result<(), GearPairError> {
    if !rolling.oscillates_per_tooth(teeth) {
        return Ok(());
    }
    let (swings, count) = (rolling.swings(), teeth as usize);
    if swings * swings > MAX_WORK * count {
        return Err(GearPairError::Waves { swings, teeth });
    }
    let radius = rolling.sharpest();
    if swings <= MAX_SWINGS * count || radius >= MIN_ARC * module {
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
    use crate::GearPair;
    use crate::design::GearPairDesign;
    use centrode_spec::DesignSpec as _;

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
        // Compared with the waves, the curvature of the circle is negligible: their curvature is about e n^2/r, and
        // that of the mate the same with the other sign. Their slope makes the pitch curve longer by a sixteenth.
        let r = 40.0 * module / (2.0 * 1.06);
        let expected = r / (1.0 + 0.001 * 503.0 * 503.0);
        assert!(
            (radius / expected - 1.0).abs() < 0.05,
            "{radius} {expected}"
        );
        // Waves of a nanometre are no arcs to speak of, but too many.
        let refused = resolved("1 + 0.00000001*cos(2003*phi)", 40);
        let Err(GearPairError::Waves { swings, .. }) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!(swings, 2003);
    }
}
