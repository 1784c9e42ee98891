/// Curvatures of the pitch curves of driver and driven gear of a pair of centre distance 1, with their derivatives.
///
/// The arguments are w, the logarithm of the ratio, and its first two derivatives by the driver's angle. The derivatives of each
/// curvature are by these three.
pub(super) fn curvatures([w, w1, w2]: [f64; 3]) -> [(f64, [f64; 3]); 2] {
    let p = 1.0 / (1.0 + (-w).exp());
    let q = 1.0 / (1.0 + w.exp());
    let d = 1.0 + q * q * w1 * w1;
    let root = d * d.sqrt();
    let tilt = 3.0 * p * q * q * w1 * w1 / d;
    let bent = w1 * w1 - w2;
    let of_driver = 1.0 + q * bent;
    let driver = of_driver / (p * root);
    let driven = (1.0 + q * q / p * w2) / (q * root);
    [
        (
            driver,
            [
                (tilt - q) * driver - q * bent / root,
                q * w1 / (p * root) * (2.0 - 3.0 * q * of_driver / d),
                -q / (p * root),
            ],
        ),
        (
            driven,
            [
                (tilt + p) * driven - q / p * (1.0 + p) * w2 / root,
                -3.0 * driven * q * q * w1 / d,
                q / (p * root),
            ],
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::curvatures;

    /// Curvatures of the polar curves r1 = a i/(1 + i) and r2 = a/(1 + i), by differences.
    #[test]
    fn curvatures_are_those_of_the_pitch_curves() {
        // w = ln i as a function of the driver's angle. The driven angle is the integral of i = exp(w).
        let w = |x: f64| 0.4 * x.cos() + 0.1 * (2.0 * x).sin();
        let x = 0.7_f64;
        let jet = [
            w(x),
            -0.4 * x.sin() + 0.2 * (2.0 * x).cos(),
            -0.4 * x.cos() - 0.4 * (2.0 * x).sin(),
        ];
        let driven_angle = |h: f64| {
            let n = 200;
            let step = h / f64::from(n);
            let at = |i: i32| w(x + (f64::from(i) + 0.5) * step).exp();
            (0..n).map(at).sum::<f64>() * step
        };
        let circle = |p: [[f64; 2]; 3]| {
            let side = |i: usize, j: usize| {
                ((p[i][0] - p[j][0]).powi(2) + (p[i][1] - p[j][1]).powi(2)).sqrt()
            };
            let area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1])
                - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
            2.0 * area / (side(0, 1) * side(1, 2) * side(2, 0))
        };
        let h = 1e-3;
        let polar = |r: f64, angle: f64| [r * angle.cos(), r * angle.sin()];
        let driver = [-h, 0.0, h].map(|d| {
            let i = w(x + d).exp();
            polar(i / (1.0 + i), x + d)
        });
        let driven = [-h, 0.0, h].map(|d| polar(1.0 / (1.0 + w(x + d).exp()), driven_angle(d)));
        let [(one, _), (other, _)] = curvatures(jet);
        assert!((one - circle(driver)).abs() < 1e-5 * one.abs());
        assert!((other - circle(driven)).abs() < 1e-5 * other.abs());
    }
}
