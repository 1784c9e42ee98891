use std::f64::consts::TAU;

/// Table of cosines and sines of a turn: the rest of an angle is so small that a few terms give it to 1e-14.
#[derive(Clone, Debug)]
pub(super) struct Circle(Vec<[f64; 2]>);

/// Number of entries of the table.
const COUNT: usize = 256;

impl Circle {
    pub(super) fn new() -> Self {
        let turn = |i: usize| TAU * i as f64 / COUNT as f64;
        let places = 0..COUNT;
        Self(places.map(|i| [turn(i).cos(), turn(i).sin()]).collect())
    }

    /// Cosine and sine of an angle of less than some thousand turns.
    #[inline]
    pub(super) fn at(&self, angle: f64) -> [f64; 2] {
        // The sum's last digit is a whole number of places.
        const WHOLE: f64 = 6_755_399_441_055_744.0;
        let places = angle * (COUNT as f64 / TAU) + WHOLE;
        let index = places.to_bits() as usize & (COUNT - 1);
        let d = angle - (places - WHOLE) * (TAU / COUNT as f64);
        let dd = d * d;
        let sin = d * (1.0 - dd * (1.0 / 6.0) * (1.0 - dd * 0.05));
        let cos = 1.0 - dd * (0.5 - dd * (1.0 / 24.0) * (1.0 - dd * (1.0 / 30.0)));
        let [c, s] = self.0[index];
        [c * cos - s * sin, s * cos + c * sin]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_circle() {
        let circle = Circle::new();
        for i in -5000..5000 {
            let angle = 0.0213 * f64::from(i);
            let [cos, sin] = circle.at(angle);
            assert!((cos - angle.cos()).abs() < 3e-14 && (sin - angle.sin()).abs() < 3e-14);
        }
    }
}
