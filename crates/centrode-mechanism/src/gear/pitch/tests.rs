use super::*;

const ANGLE: [f64; 12] = [
    20., 45., 76., 105., 132., 165., 195., 225., 255., 285., 316., 345.,
];
const RADIUS: [f64; 12] = [21., 28., 50., 49., 58., 47., 18., 12., 28., 60., 48., 24.];

fn length(pitch: &Pitch) -> f64 {
    perimeter(pitch.curve.as_ref())
}

#[test]
fn the_elliptic_pair_of_2018() {
    let spec = PitchSpec::Ellipse(Ellipse {
        eccentricity: 1.0 / (2.0 + 3.0_f64.sqrt()),
        module: Some(2.25),
        tooth_count: Some(23),
        ..Ellipse::default()
    });
    let pitch = spec.resolve().expect("a published design");
    assert!((length(&pitch) - 162.577_420).abs() < 5e-7);
    let far = pitch.curve.at(0.0).point;
    let near = pitch.curve.at(PI).point;
    assert!((far.x - 33.416_307).abs() < 5e-7 && (near.x + 19.292_914).abs() < 5e-7);
}

#[test]
fn the_control_points_of_2021() {
    let bspline = |degree, interpolate| {
        PitchSpec::Bspline(Bspline {
            degree,
            interpolate,
            radius: RADIUS.to_vec(),
            angle: ANGLE.map(f64::to_radians).to_vec(),
            ..Bspline::default()
        })
    };
    let quadratic = bspline(2, false).resolve().expect("published");
    assert!((length(&quadratic) - 291.330_811).abs() < 5e-7);
    let cubic = bspline(3, false).resolve().expect("published");
    assert!((length(&cubic) - 285.018_587).abs() < 5e-7);
    let (x, y) = ANGLE
        .iter()
        .zip(RADIUS)
        .map(|(a, r)| (r * a.to_radians().cos(), r * a.to_radians().sin()))
        .unzip();
    let cartesian = PitchSpec::Bspline(Bspline {
        plane: Plane::Cartesian,
        x,
        y,
        ..Bspline::default()
    });
    assert!((length(&cartesian.resolve().expect("published")) - 264.237).abs() < 5e-4);
}
