use centrode_geometry::{Curve, Jet, Point, Vector};

use super::rolling::Rolling;

/// Driven pitch curve as a curve of its own, from which a further gear, or a drawing, is made.
///
/// Turned so that its point in mesh at phi = 0 lies on the x axis, and traversed counter-clockwise like a driver's curve. The
/// conjugate of this curve, at the inverse mean ratio, is the original.
#[derive(Clone, Debug)]
pub struct ConjugateCurve {
    rolling: Rolling,
}

impl ConjugateCurve {
    /// The driven curve of a rolling pair.
    #[must_use]
    pub fn new(rolling: Rolling) -> Self {
        Self { rolling }
    }
}

impl Curve for ConjugateCurve {
    fn period(&self) -> f64 {
        let (n1, n2) = self.rolling.mean_ratio();
        self.rolling.curve().period() * f64::from(n1) / f64::from(n2)
    }

    fn breaks(&self) -> Vec<f64> {
        let period = self.period();
        // The curve is traversed backwards: a jump at b is a break at -b.
        let mut out: Vec<f64> = self
            .rolling
            .jumps_in(-period, 0.0)
            .into_iter()
            .map(|b| (-b).rem_euclid(period))
            .collect();
        out.sort_by(f64::total_cmp);
        out.dedup();
        out
    }

    fn at(&self, u: f64) -> Jet {
        // At a break the right limit of this curve is the left limit of the driver's.
        let t = -u;
        let t = if self.rolling.is_jump(t) {
            t.next_down()
        } else {
            t
        };
        let driver = self.rolling.curve().at(t);
        let (p, d1, d2, d3) = (
            driver.point.coords,
            driver.first,
            driver.second,
            driver.third,
        );
        let r = p.norm();
        let r1 = p.dot(&d1) / r;
        let r2 = (d1.norm_squared() + p.dot(&d2) - r1 * r1) / r;
        let r3 = (3.0 * d1.dot(&d2) + p.dot(&d3) - 3.0 * r1 * r2) / r;
        let radius = [self.rolling.center_distance() - r, -r1, -r2, -r3];
        // The driven angle's first derivative is w/v.
        let w = [p.perp(&d1), p.perp(&d2), d1.perp(&d2) + p.perp(&d3)];
        let a = self.rolling.center_distance();
        let v = [
            r * (a - r),
            r1 * (a - 2.0 * r),
            r2 * (a - 2.0 * r) - 2.0 * r1 * r1,
        ];
        let f1 = w[0] / v[0];
        let f2 = (w[1] - f1 * v[1]) / v[0];
        let f3 = (w[2] - 2.0 * f2 * v[1] - f1 * v[2]) / v[0];
        // Turned back by the driven angle; every odd derivative changes sign with the parameter.
        let (sin, cos) = self.rolling.driven_angle_at(t).sin_cos();
        let (e, n) = (Vector::new(cos, -sin), Vector::new(-sin, -cos));
        let e1 = n * f1;
        let e2 = n * f2 - e * (f1 * f1);
        let e3 = n * (f3 - f1 * f1 * f1) - e * (3.0 * f1 * f2);
        Jet {
            point: Point::from(e * radius[0]),
            first: -(e * radius[1] + e1 * radius[0]),
            second: e * radius[2] + e1 * (2.0 * radius[1]) + e2 * radius[0],
            third: -(e * radius[3]
                + e1 * (3.0 * radius[2])
                + e2 * (3.0 * radius[1])
                + e3 * radius[0]),
        }
    }
}
