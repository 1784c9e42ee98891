use std::f64::consts::{PI, TAU};

use centrode_gear::cam::law::LawSpec;
use centrode_geometry::Tolerance;
use centrode_groove::{
    GrooveSpec, RotatedSine, ShaftBody, Sine, SliderSpec, SpeedFormula, SpeedLaw, SpiralShaft,
    SpiralShaftDesign, Wall,
};
use centrode_kinematics::transmission::Transmission;
use nalgebra::Vector3;
use proptest::prelude::{ProptestConfig, Strategy, prop_assert, prop_oneof, proptest};

fn law() -> impl Strategy<Value = SpeedLaw> {
    let share = 0.0..0.7_f64;
    let harmonic = 1..3_u32;
    prop_oneof![
        (share.clone(), harmonic.clone(), -PI..PI).prop_map(|(share, harmonic, phase)| {
            SpeedLaw::Sine(Sine {
                amplitude: share * 20.0 / TAU / f64::from(harmonic),
                harmonic,
                phase,
            })
        }),
        (share.clone(), harmonic, -PI..PI).prop_map(|(share, harmonic, phase)| {
            SpeedLaw::RotatedSine(RotatedSine {
                amplitude: share * 20.0 / TAU / f64::from(harmonic),
                harmonic,
                phase,
            })
        }),
        share.prop_map(|share| {
            SpeedLaw::Formula(SpeedFormula {
                expression: format!("1 - {share}*cos(phi) + 0.1*sin(2*phi)"),
            })
        }),
    ]
}

/// A shaft that exists: a groove narrow enough for its bends.
fn shaft() -> impl Strategy<Value = SpiralShaftDesign> {
    let sizes = (12.0..30.0_f64, 3.0..6.0_f64, 0.2..0.4_f64);
    let reversal = (1..4_u32, 0..2_usize);
    (law(), 2..6_u32, sizes, reversal, -2.0..2.0_f64).prop_filter_map(
        "exists",
        |(law, holes, (radius, width, depth), (turns, kind), offset)| {
            let depth = depth * width;
            let mut design = SpiralShaftDesign {
                law,
                holes,
                radius,
                return_offset: offset,
                groove: GrooveSpec { width, depth },
                slider: SliderSpec {
                    clearance: 0.1,
                    reach: 0.9 * depth,
                    pin_diameter: 0.3 * width,
                    ..SliderSpec::default()
                },
                body: ShaftBody {
                    fillet: 0.0,
                    ..ShaftBody::default()
                },
                ..SpiralShaftDesign::default()
            };
            design.reversal.angle = PI * f64::from(turns);
            design.reversal.law = [LawSpec::Harmonic, LawSpec::Cycloidal][kind].clone();
            SpiralShaft::resolve(&design).is_ok().then_some(design)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn walls_are_offsets_that_wrap_and_unwrap_and_the_way_closes(
        design in shaft(), at in 0.0..1.0_f64,
    ) {
        let shaft = SpiralShaft::resolve(&design).expect("filtered");
        let groove = shaft.groove();
        let (traverse, period) = (groove.traverse(), shaft.cycle());
        let theta = at * period;
        for k in [-1.0, 1.0] {
            let (a, b) = (traverse.at(theta), traverse.at(theta + k * period));
            prop_assert!((a.position - b.position).abs() < 1e-9);
            prop_assert!((a.velocity - b.velocity).abs() < 1e-9);
        }
        let (start, end) = (traverse.at(0.0), traverse.at(period.next_down()));
        prop_assert!((start.position - end.position).abs() < 1e-12 * period);
        for wall in Wall::BOTH {
            let point = groove.wall(theta, wall);
            let there = groove.wrapped(point, groove.radius());
            let back = groove.unwrapped(there, point.x);
            // A turn's worth of rounding.
            prop_assert!((back - point).norm() < 1e-12 * (1.0 + point.x.abs()));
            // No place of the centre line is nearer than half the width, and this one is as near.
            let half = 0.5 * groove.width();
            let reach = half / groove.radius();
            let nearest = (-400..=400)
                .map(|i| groove.center(theta + 3.0 * reach * f64::from(i) / 400.0))
                .map(|center| (center - point).norm())
                .fold(f64::INFINITY, f64::min);
            prop_assert!((nearest - half).abs() < 1e-12 * (1.0 + point.x.abs()), "{nearest} {half}");
        }
    }

    #[test]
    fn a_shaft_scaled_by_k_is_k_times_as_large(design in shaft(), k in 0.1..10.0_f64) {
        // Formulas and shares stay; lengths grow.
        let mut scaled = design.clone();
        scaled.lead *= k;
        scaled.radius *= k;
        scaled.return_offset *= k;
        scaled.groove.width *= k;
        scaled.groove.depth *= k;
        scaled.slider.length *= k;
        scaled.slider.clearance *= k;
        scaled.slider.reach *= k;
        scaled.slider.pin_diameter *= k;
        for length in [
            &mut scaled.body.margin,
            &mut scaled.body.journal_diameter,
            &mut scaled.body.journal_length,
            &mut scaled.body.chamfer,
            &mut scaled.body.keyway_length,
        ] {
            *length *= k;
        }
        if let Some(key) = &mut scaled.body.keyway {
            key.width *= k;
            key.depth *= k;
        }
        match &mut scaled.law {
            SpeedLaw::Sine(law) => law.amplitude *= k,
            SpeedLaw::RotatedSine(law) => law.amplitude *= k,
            _ => {}
        }
        let one = SpiralShaft::resolve(&design).expect("filtered");
        let other = SpiralShaft::resolve(&scaled).expect("as sound");
        for i in 0..20 {
            let theta = one.cycle() * f64::from(i) / 20.0;
            let (a, b) = (one.groove().wall(theta, Wall::Left), other.groove().wall(theta, Wall::Left));
            prop_assert!((a.coords * k - b.coords).norm() < 1e-9 * (1.0 + b.coords.norm()));
        }
        let tolerance = |mm: f64| Tolerance::new(mm).expect("positive");
        let volume = one.mesh(tolerance(0.05)).expect("fits").volume();
        let grown = other.mesh(tolerance(0.05 * k)).expect("fits").volume();
        prop_assert!((grown / (volume * k.powi(3)) - 1.0).abs() < 1e-6);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn meshes_are_watertight_and_exact_boundaries_close(design in shaft()) {
        let shaft = SpiralShaft::resolve(&design).expect("filtered");
        let tolerance = 0.02;
        let mesh = shaft.mesh(Tolerance::new(tolerance).expect("positive")).expect("fits");
        prop_assert!(mesh.is_watertight());
        let area = |face: &[u32; 3]| {
            let [a, b, c] = mesh.triangle(face).map(Vector3::from);
            0.5 * (b - a).cross(&(c - a)).norm()
        };
        let area: f64 = mesh.faces.iter().map(area).sum();
        let exact = shaft.mass_properties().expect("fits").mass / (shaft.body().density * 1e-9);
        let off = (mesh.volume() - exact).abs();
        prop_assert!(off < tolerance * area, "{off} mm3 of {exact}");
        prop_assert!(shaft.shell().expect("smooth").is_closed());
    }
}
