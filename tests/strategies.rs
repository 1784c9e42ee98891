//! Random designs for property tests: every one of them valid.

use std::f64::consts::TAU;

use centrode_gear::design::{Addendum, GearPairDesign, Phase, Rack, ToolSpec};
use centrode_gear::pitch::{
    Bspline, Circle, EccentricCircle, Ellipse, Limacon, LobedEllipse, PitchSpec, Plane, Polar,
    Transmission,
};
use centrode_gear::{GearPair, Member};
use centrode_geometry::Crossing;
use proptest::prelude::{Just, Strategy, any, prop_oneof};

/// A pair whose pitch curves bear full-depth teeth: as many teeth as it takes.
pub fn sound_pair() -> impl Strategy<Value = GearPairDesign> {
    let lobed = (1..4_u32, 1..3_u32, 0.0..0.15_f64).prop_map(|(n1, n2, eccentricity)| {
        let divisor = if n1 == n2 { n1 } else { 1 };
        let (n1, n2) = (n1 / divisor, n2 / divisor);
        let curve = LobedEllipse {
            lobes: n2,
            eccentricity,
            ..LobedEllipse::default()
        };
        (PitchSpec::LobedEllipse(curve), [n1, n2])
    });
    let any_curve = shape().prop_map(|shape| (shape, [1, 1]));
    let finish = (0.0..0.1_f64, 0.44..0.56_f64, 0.0..1.0_f64);
    (prop_oneof![lobed, any_curve], 0.5..4.0_f64, finish).prop_map(
        |((mut shape, mut ratio), module, finish)| {
            let (backlash, split, phase) = finish;
            let mut z = 24 * ratio[1];
            loop {
                let mut design = GearPairDesign::new(sized(shape.clone(), module, z));
                // Unequal teeth leave a space too narrow for the standard rounding.
                design.tool = ToolSpec::Rack(Rack {
                    tip_radius_coefficient: 0.25,
                    ..Rack::default()
                });
                design.mean_ratio = ratio;
                let pair = match GearPair::resolve(&design) {
                    Ok(pair) => pair,
                    // So few teeth can be too large for a wild curve.
                    Err(_) if z < 5000 => {
                        z *= 2;
                        continue;
                    }
                    Err(error) => panic!("no pair: {error} {design:?}"),
                };
                let limits = pair.limits();
                if limits.concave_curvature > 0.0 {
                    // Full-depth teeth may run into each other there, however small.
                    shape = PitchSpec::Ellipse(Ellipse {
                        eccentricity: 0.3,
                        ..Ellipse::default()
                    });
                    ratio = [1, 1];
                    continue;
                }
                let needed = module / limits.largest_module;
                if needed <= 1.0 {
                    design.teeth.backlash = backlash * module;
                    design.teeth.thickness_split = split;
                    design.teeth.phase = Phase::Pitches(phase);
                    return design;
                }
                z = ((f64::from(z) * needed * 1.02 / f64::from(ratio[1])).ceil() as u32) * ratio[1];
            }
        },
    )
}

/// A module and a tooth count of ordinary size.
pub fn size() -> impl Strategy<Value = (f64, u32)> {
    (0.2..8.0_f64, 12..90_u32)
}

/// A pitch curve of any kind that has a closed form, scaled by module and tooth count.
pub fn pitch() -> impl Strategy<Value = PitchSpec> {
    (shape(), size()).prop_map(|(shape, (m, z))| sized(shape, m, z))
}

fn sized(mut shape: PitchSpec, m: f64, z: u32) -> PitchSpec {
    let (module, tooth_count) = match &mut shape {
        PitchSpec::Circle(spec) => (&mut spec.module, &mut spec.tooth_count),
        PitchSpec::EccentricCircle(spec) => (&mut spec.module, &mut spec.tooth_count),
        PitchSpec::Ellipse(spec) => (&mut spec.module, &mut spec.tooth_count),
        PitchSpec::LobedEllipse(spec) => (&mut spec.module, &mut spec.tooth_count),
        PitchSpec::Limacon(spec) => (&mut spec.module, &mut spec.tooth_count),
        PitchSpec::Bspline(spec) => (&mut spec.module, &mut spec.tooth_count),
        PitchSpec::Polar(spec) => (&mut spec.module, &mut spec.tooth_count),
        PitchSpec::Transmission(spec) => (&mut spec.module, &mut spec.tooth_count),
        other => unreachable!("no strategy makes {other:?}"),
    };
    (*module, *tooth_count) = (Some(m), Some(z));
    shape
}

fn shape() -> impl Strategy<Value = PitchSpec> {
    prop_oneof![
        Just(PitchSpec::Circle(Circle::default())),
        (0.0..0.6_f64).prop_map(|eccentricity| {
            PitchSpec::EccentricCircle(EccentricCircle {
                eccentricity,
                ..EccentricCircle::default()
            })
        }),
        (0.0..0.7_f64).prop_map(|eccentricity| {
            PitchSpec::Ellipse(Ellipse {
                eccentricity,
                ..Ellipse::default()
            })
        }),
        (1..6_u32, 0.0..0.2_f64).prop_map(|(lobes, eccentricity)| {
            PitchSpec::LobedEllipse(LobedEllipse {
                lobes,
                eccentricity,
                ..LobedEllipse::default()
            })
        }),
        (10.0..30.0_f64, 0.0..0.3_f64, 1..4_u32).prop_map(|(mean_radius, swing, lobes)| {
            PitchSpec::Limacon(Limacon {
                mean_radius,
                amplitude: swing * mean_radius,
                lobes,
                module: None,
                diametral_pitch: None,
                tooth_count: None,
            })
        }),
        (0.0..0.15_f64, 0.0..0.1_f64, 1..5_u32).prop_map(|(a, b, n)| {
            PitchSpec::Polar(Polar {
                expression: Some(format!("1 + {a}*cos({n}*phi) - {b}*sin(phi)")),
                ..Polar::default()
            })
        }),
        (0.0..0.3_f64, 1..4_u32).prop_map(|(swing, n)| {
            let amplitude = swing / f64::from(n * n);
            PitchSpec::Transmission(Transmission {
                expression: Some(format!("phi - {amplitude}*sin({n}*phi)")),
                ..Transmission::default()
            })
        }),
        polar_spline(),
    ]
}

/// How the points of a closed B-spline lie round the shaft.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Points {
    /// As a person writes them: from angle zero on, evenly or nearly so, radii within a tenth of their mean.
    Gentle,
    /// Radii that differ threefold, unevenly spaced.
    Wild,
}

/// A closed B-spline of a degree, through points or towards them.
fn bspline(points: Points, degree: u32, interpolate: bool) -> impl Strategy<Value = Bspline> {
    let (spread, uneven, count) = match points {
        Points::Gentle => (0.1, 0.15, 6..14_usize),
        Points::Wild => (0.5, 0.25, 6..14),
    };
    let point = (-1.0..1.0_f64, -1.0..1.0_f64);
    let place = (
        10.0..40.0_f64,
        prop_oneof![Just(0.0), Just(uneven)],
        prop_oneof![3 => Just(0.0), 1 => 0.0..0.1_f64],
        prop_oneof![Just(Plane::Polar), Just(Plane::Cartesian)],
    );
    (proptest::collection::vec(point, count), place).prop_map(
        move |(points, (mean, uneven, first, plane))| {
            let steps: Vec<f64> = points.iter().map(|p| 1.0 + uneven * p.1).collect();
            let whole: f64 = steps.iter().sum();
            // A file holds angles to the thousandth of a degree.
            let written = |turns: f64| (turns * 360e3).round() / 360e3 * TAU;
            let mut turned = first;
            let mut angle = Vec::with_capacity(points.len());
            for step in &steps {
                angle.push(written(turned));
                turned += step / whole * (1.0 - first);
            }
            let radius: Vec<f64> = points.iter().map(|p| mean * (1.0 + spread * p.0)).collect();
            let along = |f: fn(f64) -> f64| {
                let places = radius.iter().zip(&angle);
                places.map(|(r, a)| r * f(*a)).collect()
            };
            let base = Bspline {
                plane,
                degree,
                interpolate,
                ..Bspline::default()
            };
            match plane {
                Plane::Cartesian => Bspline {
                    x: along(f64::cos),
                    y: along(f64::sin),
                    ..base
                },
                Plane::Polar => Bspline {
                    radius,
                    angle,
                    ..base
                },
            }
        },
    )
}

/// A pair on a closed B-spline with teeth of any number from 12 to 60.
pub fn bspline_pair(
    points: Points,
    degree: u32,
    interpolate: bool,
) -> impl Strategy<Value = GearPairDesign> {
    let teeth = (
        12..=60_u32,
        any::<bool>(),
        prop_oneof![Just(0.0), Just(0.02)],
    );
    (bspline(points, degree, interpolate), teeth).prop_map(|(curve, (z, fitted, backlash))| {
        let mut design = GearPairDesign::new(sized(PitchSpec::Bspline(curve), 1.0, z));
        design.teeth.backlash = backlash;
        if fitted {
            design.teeth.addendum = Addendum::Fitted;
        }
        design
    })
}

/// A B-spline towards unevenly spaced points round the shaft, which it does not overshoot.
fn polar_spline() -> impl Strategy<Value = PitchSpec> {
    let point = (10.0..30.0_f64, 0.6..1.0_f64);
    (proptest::collection::vec(point, 6..14), 2..=5_u32).prop_map(|(points, degree)| {
        let whole: f64 = points.iter().map(|(_, step)| step).sum();
        let mut turned = 0.0;
        let angle = points
            .iter()
            .map(|(_, step)| {
                turned += step;
                TAU * (turned / whole - 0.02)
            })
            .collect();
        PitchSpec::Bspline(Bspline {
            plane: Plane::Polar,
            degree,
            radius: points.iter().map(|(radius, _)| *radius).collect(),
            angle,
            ..Bspline::default()
        })
    })
}

/// Where a contour of a pair crosses itself; a loop at a joint or a cusp, smaller than `speck` modules, is let pass, and one
/// at a cusp that is thinner than the tolerances of its two sides, 2e-10 mm.
pub fn crossing(pair: &GearPair, speck: f64) -> Option<(Member, Crossing)> {
    [pair.driver(), pair.driven()].into_iter().find_map(|gear| {
        let found = gear
            .outline()
            .crossing_ignoring(speck * pair.module(), 2e-10)?;
        Some((gear.member(), found))
    })
}

/// Text that is near a design file: lines of keys and values, some of them wrong, or anything at all.
pub fn near_design() -> impl Strategy<Value = String> {
    let key = prop_oneof![
        Just("name"),
        Just("mean_ratio"),
        Just("tooth_count"),
        Just("kind"),
        Just("eccentricity"),
        Just("module"),
        Just("radius"),
        Just("angle_deg"),
        Just("degree"),
        Just("[pitch]"),
        Just("[tool]"),
        Just("[teeth]"),
        Just("[driver]"),
        Just("pressure_angle_deg"),
        Just("phase"),
        Just("backlash"),
        Just("width"),
        Just("nonsense"),
    ];
    let value = prop_oneof![
        any::<f64>().prop_map(|v| format!("{v:?}")),
        any::<i64>().prop_map(|v| v.to_string()),
        Just("nan".to_owned()),
        Just("-inf".to_owned()),
        Just("[1, 1]".to_owned()),
        Just("[]".to_owned()),
        Just("\"ellipse\"".to_owned()),
        Just("\"bspline\"".to_owned()),
        Just("{ width = 1 }".to_owned()),
        "\\PC{0,12}".prop_map(|text| format!("\"{text}\"")),
    ];
    let line = (key, value).prop_map(|(key, value)| {
        if key.starts_with('[') {
            key.to_owned()
        } else {
            format!("{key} = {value}")
        }
    });
    prop_oneof![
        4 => proptest::collection::vec(line, 0..12).prop_map(|lines| lines.join("\n")),
        1 => any::<String>(),
    ]
}
