use std::f64::consts::TAU;

use super::rolling::{Member, Rolling};
use centrode_kinematics::transmission::{MotionJet, Transmission};

impl Rolling {
    /// The driver's polar angle and the driven angle as functions of the pitch curve's parameter.
    ///
    /// phi' = w/r^2 and phi2' = w/(r (a - r)) with w the cross product of P and P'.
    fn along(&self, t: f64) -> [MotionJet; 2] {
        let (inside, turns) = self.wrapped(t);
        let jet = self.curve().at(inside);
        let angle = self.polar_angle(inside, &jet) + turns * TAU;
        let (p, d1, d2, d3) = (jet.point.coords, jet.first, jet.second, jet.third);
        let a = self.center_distance();
        let r = p.norm();
        let r1 = p.dot(&d1) / r;
        let r2 = (d1.norm_squared() + p.dot(&d2) - r1 * r1) / r;
        let w = [p.perp(&d1), p.perp(&d2), d1.perp(&d2) + p.perp(&d3)];
        let turn = |position: f64, v: [f64; 3]| {
            let velocity = w[0] / v[0];
            let acceleration = (w[1] - velocity * v[1]) / v[0];
            let jerk = (w[2] - 2.0 * acceleration * v[1] - velocity * v[2]) / v[0];
            MotionJet {
                position,
                velocity,
                acceleration,
                jerk,
            }
        };
        let own = [r * r, 2.0 * r * r1, 2.0 * (r1 * r1 + r * r2)];
        let mate = [
            r * (a - r),
            r1 * (a - 2.0 * r),
            r2 * (a - 2.0 * r) - 2.0 * r1 * r1,
        ];
        [turn(angle, own), turn(self.driven_angle_at(t), mate)]
    }

    /// Driven angle at a driver angle with its derivatives: the pair's transmission function.
    ///
    /// The first derivative is r/(a - r). Any real angle.
    #[must_use]
    pub fn driven_jet(&self, phi: f64) -> MotionJet {
        let t = self.parameter_at_angle(phi);
        let [driver, driven] = self.along(t);
        driven.after(&driver.inverse(t))
    }

    /// Driver angle at a driven angle with its derivatives: the inverse of [`Self::driven_jet`], from the
    /// same integral.
    ///
    /// The first derivative is (a - r)/r. Any real angle.
    #[must_use]
    pub fn driver_jet(&self, driven: f64) -> MotionJet {
        let t = self.parameter_at_driven_angle(driven);
        let [driver, driven] = self.along(t);
        driver.after(&driven.inverse(t))
    }
}

/// The transmission from the driver's polar angle to the driven angle.
impl Transmission for Rolling {
    fn at(&self, input: f64) -> MotionJet {
        self.driven_jet(input)
    }

    fn advance(&self) -> f64 {
        let (driver, driven) = self.mean_ratio();
        TAU * f64::from(driven) / f64::from(driver)
    }

    fn breaks(&self) -> Vec<f64> {
        let one = self.parameter(self.pitch_length(Member::Driver));
        let breaks = self.jumps_in(self.parameter(0.0), one);
        breaks.into_iter().map(|t| self.angle(t)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pitch::{Ellipse, PitchSpec, Polar};
    use std::f64::consts::PI;

    fn rolling(spec: &PitchSpec, ratio: (u32, u32)) -> Rolling {
        let pitch = spec.resolve().expect("a curve");
        Rolling::new(pitch.curve, ratio).expect("it rolls")
    }

    #[test]
    fn the_elliptic_pair_follows_its_closed_form() {
        let k = 0.25;
        let pair = rolling(
            &PitchSpec::Ellipse(Ellipse {
                eccentricity: k,
                module: Some(2.0),
                tooth_count: Some(30),
                ..Ellipse::default()
            }),
            (1, 1),
        );
        for i in -20..40 {
            let phi = 0.3 * f64::from(i) + 0.01;
            let jet = pair.driven_jet(phi);
            // tan(phi2/2) = (1 + k)/(1 - k) tan(phi/2), on the same turn.
            let half = ((1.0 + k) / (1.0 - k) * (0.5 * phi).tan()).atan();
            let exact = 2.0 * half + TAU * ((0.5 * phi) / PI).round();
            assert!((jet.position - exact).abs() < 1e-12, "{phi}");
            let ratio = (1.0 - k * k) / (1.0 - 2.0 * k * phi.cos() + k * k);
            assert!((jet.velocity - ratio).abs() < 1e-12);
            let slope = -ratio * ratio * 2.0 * k * phi.sin() / (1.0 - k * k);
            assert!((jet.acceleration - slope).abs() < 1e-11);
            let back = pair.driver_jet(jet.position);
            assert!((back.position - phi).abs() < 1e-12, "{phi}");
            assert!((back.velocity * ratio - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_function_both_ways() {
        let spec = PitchSpec::Polar(Polar {
            expression: Some("30 + 6*cos(2*phi) + 2*sin(4*phi)".into()),
            ..Polar::default()
        });
        let pair = rolling(&spec, (3, 2));
        let step = 1e-4;
        for i in -5..20 {
            let x = 0.41 * f64::from(i);
            for jet in [
                (&|x: f64| pair.driven_jet(x)) as &dyn Fn(f64) -> MotionJet,
                &|x: f64| pair.driver_jet(x),
            ] {
                let (low, here, high) = (jet(x - step), jet(x), jet(x + step));
                let slope = |f: fn(&MotionJet) -> f64| (f(&high) - f(&low)) / (2.0 * step);
                assert!((slope(|j| j.position) - here.velocity).abs() < 1e-6);
                assert!((slope(|j| j.velocity) - here.acceleration).abs() < 1e-5);
                assert!((slope(|j| j.acceleration) - here.jerk).abs() < 1e-3);
            }
        }
        assert!((Transmission::advance(&pair) - TAU * 2.0 / 3.0).abs() < 1e-12);
    }
}
