/// Turns and the mirror that leave a radius law as it is.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Symmetry {
    /// Equal parts of a turn: `r(phi + 2 pi/folds) = r(phi)`. Zero where any turn leaves it as it is.
    pub(crate) folds: u32,
    /// Whether `r(-phi) = r(phi)`.
    pub(crate) mirrored: bool,
    /// Whether the curve that rolls on it one to one is the same curve, its minimum radius on the other's maximum.
    pub(crate) mates_itself: bool,
}

impl Symmetry {
    /// A law that nothing is known of.
    pub(crate) const NONE: Self = Self {
        folds: 1,
        mirrored: false,
        mates_itself: false,
    };

    /// A law of `cos(lobes phi)`; of no swing it is a circle's.
    pub(crate) fn of_cosine(lobes: u32, swing: f64) -> Self {
        Self {
            folds: if swing == 0.0 { 0 } else { lobes },
            mirrored: true,
            mates_itself: swing == 0.0,
        }
    }
}

/// Greatest common divisor; of zero and another the other.
pub fn gcd(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
