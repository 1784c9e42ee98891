use std::fmt;

/// Scale of a view, one of those ISO 5455 recommends.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Scale {
    drawn: u32,
    real: u32,
}

impl Scale {
    /// Recommended scales, the largest first.
    pub const RECOMMENDED: [Self; 19] = [
        Self::new(100, 1),
        Self::new(50, 1),
        Self::new(20, 1),
        Self::new(10, 1),
        Self::new(5, 1),
        Self::new(2, 1),
        Self::new(1, 1),
        Self::new(1, 2),
        Self::new(1, 5),
        Self::new(1, 10),
        Self::new(1, 20),
        Self::new(1, 50),
        Self::new(1, 100),
        Self::new(1, 200),
        Self::new(1, 500),
        Self::new(1, 1000),
        Self::new(1, 2000),
        Self::new(1, 5000),
        Self::new(1, 10_000),
    ];

    const fn new(drawn: u32, real: u32) -> Self {
        Self { drawn, real }
    }

    /// Millimetres on paper per millimetre of the part.
    #[must_use]
    pub fn factor(self) -> f64 {
        f64::from(self.drawn) / f64::from(self.real)
    }

    /// Largest scale at which a length takes at most `room` on paper, mm.
    #[must_use]
    pub fn largest(length: f64, room: f64) -> Self {
        Self::RECOMMENDED
            .into_iter()
            .find(|scale| length * scale.factor() <= room)
            .unwrap_or(Self::RECOMMENDED[18])
    }
}

impl fmt::Display for Scale {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.drawn, self.real)
    }
}
