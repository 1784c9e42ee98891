/// Turns and mirror image that leave a radius law unchanged.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Symmetry {
    /// Equal parts of a turn: `r(phi + 2 pi/folds) = r(phi)`. Zero if every turn leaves the law unchanged.
    pub(crate) folds: u32,
    /// Whether `r(-phi) = r(phi)`.
    pub(crate) mirrored: bool,
    /// Whether the curve that rolls on it one to one is the same curve, its minimum radius on the other's maximum.
    pub(crate) mates_itself: bool,
}

impl Symmetry {
    /// A law without any known symmetry.
    pub(crate) const NONE: Self = Self {
        folds: 1,
        mirrored: false,
        mates_itself: false,
    };

    /// Symmetry of a law in `cos(lobes phi)`; with a swing of zero, that of a circle.
    pub(crate) fn of_cosine(lobes: u32, swing: f64) -> Self {
        Self {
            folds: if swing == 0.0 { 0 } else { lobes },
            mirrored: true,
            mates_itself: swing == 0.0,
        }
    }
}

/// Greatest common divisor; if one number is zero, the other number.
pub fn gcd(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
