use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use proptest::prelude::{ProptestConfig, Strategy, prop_assert, prop_oneof, proptest};

use super::{
    AmplitudeFor, EllipticDrive, EllipticGears, Groove, Load, MovingBox, MovingBoxDesign, Reversal,
    RotatedSine, Scheme, ShaftError, ShaftLaw, Sine, SpeedFormula, SpeedKnots, SpeedLaw,
    SpeedTable, SpiralShaft, SpiralShaftDesign, Traverse,
};
use centrode_gear::cam::law::LawSpec;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::{Design, DesignSpec};

const LEAD: f64 = 20.0;
const RADIUS: f64 = 15.0;

fn law(spec: &SpeedLaw) -> ShaftLaw {
    spec.resolve(LEAD, RADIUS).expect("runs one way")
}

fn any_law() -> impl Strategy<Value = SpeedLaw> {
    let wave = || (0.0..0.9_f64, 1..4_u32, -7.0..7.0_f64);
    prop_oneof![
        wave().prop_map(|(share, harmonic, phase)| {
            let amplitude = share * LEAD / TAU / f64::from(harmonic);
            SpeedLaw::Sine(Sine {
                amplitude,
                harmonic,
                phase,
            })
        }),
        wave().prop_map(|(share, harmonic, phase)| {
            let amplitude = 0.9 * share * LEAD / TAU / f64::from(harmonic);
            SpeedLaw::RotatedSine(RotatedSine {
                amplitude,
                harmonic,
                phase,
            })
        }),
        (0.2..2.0_f64, 0.1..3.0_f64, 3.2..6.0_f64).prop_map(|(slow, a, b)| {
            SpeedLaw::Knots(SpeedKnots {
                angle: vec![0.0, a, b],
                speed: vec![slow, slow, 1.5],
                law: LawSpec::Cycloidal,
            })
        }),
        (0.3..2.0_f64).prop_map(|slow| {
            SpeedLaw::Table(SpeedTable {
                speed: vec![slow, 0.9, 1.0, 1.1, 1.2, 1.0, 0.9, 0.8],
                interpolation: None,
            })
        }),
        (0.0..0.8_f64).prop_map(|b| {
            SpeedLaw::Formula(SpeedFormula {
                expression: format!("exp(-{b}*cos(phi))"),
            })
        }),
    ]
}

fn reversal(halves: u32, law: LawSpec) -> Reversal {
    Reversal {
        angle: PI * f64::from(halves),
        law,
    }
}

/// The derivative of `f` at `x` by Richardson's extrapolation of central differences.
fn slope(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    let central = |h: f64| (f(x + h) - f(x - h)) / (2.0 * h);
    (4.0 * central(5e-4) - central(1e-3)) / 3.0
}

/// The jerk's and the acceleration's jumps across `x`.
fn across(motion: &dyn Transmission, x: f64) -> [f64; 3] {
    let h = 1e-9;
    let (before, after) = (motion.at(x - h), motion.at(x + h));
    [
        after.position - before.position,
        after.velocity - before.velocity,
        after.acceleration - before.acceleration,
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn every_law_advances_by_the_lead_and_knows_its_derivatives(
        spec in any_law(),
        theta in -20.0..20.0_f64,
    ) {
        let law = law(&spec);
        let (here, later) = (law.at(theta), law.at(theta + TAU));
        prop_assert!((later.position - here.position - LEAD).abs() < 1e-11);
        prop_assert!((later.velocity - here.velocity).abs() < 1e-10);
        prop_assert!(here.velocity >= law.slowest().value - 1e-9);
        prop_assert!(here.velocity <= law.fastest().value + 1e-9);
        let clear = law.breaks().iter().all(|b| {
            let off = (theta - b).rem_euclid(TAU);
            off > 2e-3 && off < TAU - 2e-3
        });
        if clear {
            let off = slope(|x| law.at(x).position, theta) - here.velocity;
            prop_assert!(off.abs() < 1e-8, "velocity {off}");
            let off = slope(|x| law.at(x).velocity, theta) - here.acceleration;
            prop_assert!(off.abs() < 1e-6, "acceleration {off}");
            let off = slope(|x| law.at(x).acceleration, theta) - here.jerk;
            prop_assert!(off.abs() < 1e-3 * (1.0 + here.jerk.abs()), "jerk {off}");
        }
    }

    #[test]
    fn out_and_back_is_smooth_closes_and_turns_round_twice(
        spec in any_law(),
        holes in 2..16_u32,
        halves in 1..6_u32,
        which in 0..3_usize,
        offset in 0.0..0.5_f64,
    ) {
        let by = [LawSpec::Harmonic, LawSpec::Cycloidal, LawSpec::Polynomial345];
        let reversal = reversal(halves, by[which].clone());
        let Ok(traverse) = Traverse::new(law(&spec), holes, &reversal, offset) else {
            // A law far from even at the joint may reverse the slider more than once. Then there is an error.
            return Ok(());
        };
        let period = traverse.period();
        prop_assert!((period / TAU - f64::from(traverse.turns())).abs() < 1e-9);
        prop_assert!((traverse.at(period).position - traverse.at(0.0).position).abs() < 1e-12);
        let size = f64::from(holes) * LEAD;
        for at in traverse.breaks() {
            let [s, v, a] = across(&traverse, at);
            prop_assert!(s.abs() < 1e-7 && v.abs() < 1e-6, "{s} {v} at {at}");
            prop_assert!(a.abs() < 1e-5 * (1.0 + size), "{a} at {at}");
        }
        // The speed changes its sign at the tips and nowhere else.
        let tips = traverse.tips();
        for i in 0..4000 {
            let theta = period * (f64::from(i) + 0.5) / 4000.0;
            let rising = theta < tips[0] || theta > tips[1];
            let clear = tips.iter().all(|tip| (theta - tip).abs() > 1e-6);
            prop_assert!(!clear || (traverse.at(theta).velocity > 0.0) == rising, "{theta}");
        }
    }

    #[test]
    fn a_shaft_scaled_by_k_moves_k_times_as_far(share in 0.0..0.9_f64, k in 0.1..10.0_f64) {
        let of = |size: f64| {
            let spec = SpeedLaw::Sine(Sine {
                amplitude: share * size * LEAD / TAU,
                ..Sine::default()
            });
            let law = spec.resolve(size * LEAD, size * RADIUS).expect("runs one way");
            let traverse = Traverse::new(law, 5, &Reversal::default(), 0.0).expect("closes");
            Groove::new(traverse, size * RADIUS, size * 8.0, size * 4.0).expect("fits")
        };
        let (one, other) = (of(1.0), of(k));
        for i in 0..50 {
            let theta = f64::from(i);
            let (a, b) = (one.center(theta), other.center(theta));
            prop_assert!((b - a * k).norm() < 1e-10 * k * (1.0 + a.coords.norm()));
            prop_assert!((one.lead_angle(theta) - other.lead_angle(theta)).abs() < 1e-12);
            prop_assert!((one.curvature(theta) - k * other.curvature(theta)).abs() < 1e-12);
        }
        let gaps = one.minimum_slider_length() * k / other.minimum_slider_length();
        prop_assert!((gaps - 1.0).abs() < 1e-9);
    }

    #[test]
    fn forces_balance_and_do_the_work(
        velocity in -8.0..8.0_f64,
        acceleration in -6.0..6.0_f64,
        speed_rpm in 10.0..600.0_f64,
        mass in 0.1..50.0_f64,
        frictions in (0.0..0.5_f64, 0.0..0.5_f64),
    ) {
        let load = Load {
            speed_rpm,
            mass,
            groove_friction: frictions.0,
            rail_friction: frictions.1,
        };
        let motion = MotionJet { velocity, acceleration, ..MotionJet::default() };
        let lead = (velocity / RADIUS).atan();
        let force = load.force(motion, lead, RADIUS);
        // Along and round the shaft, the box going its own way: wall, its friction, rail, inertia, sleeve.
        let (sin, cos) = lead.abs().sin_cos();
        let side = if force.driving { 1.0 } else { -1.0 };
        let (n, f) = (force.normal, force.normal * frictions.0);
        let omega = speed_rpm * TAU / 60.0;
        let rail = mass * super::GRAVITY * frictions.1;
        let along = velocity.signum() * acceleration * 1e-3 * omega * omega;
        let axial = side * n * cos - f * sin - rail - mass * along;
        let round = force.transverse - side * n * sin - f * cos;
        let size = n + rail + mass * along.abs();
        prop_assert!(axial.abs() < 1e-10 * size, "{axial}");
        prop_assert!(round.abs() < 1e-10 * size, "{round}");
        prop_assert!(n >= 0.0);
        // Without friction in the groove the torque does the work along the shaft, nothing more.
        let smooth = Load { groove_friction: 0.0, ..load };
        let force = smooth.force(motion, lead, RADIUS);
        prop_assert!((force.torque - force.push * velocity.abs()).abs() < 1e-9 * size * RADIUS);
    }

    #[test]
    fn solved_amplitudes_and_eccentricities_move_what_was_asked(
        window in 0.2..2.8_f64,
        share in 0.05..0.95_f64,
        harmonic in 1..3_u32,
    ) {
        let plain = LEAD * window / TAU;
        let minimum = plain - LEAD / (PI * f64::from(harmonic))
            * (0.5 * f64::from(harmonic) * window).sin();
        let required = minimum + share * (plain - minimum);
        let request = AmplitudeFor { moved_distance: required, window, lead: LEAD, harmonic };
        let amplitude = request.solve().expect("between the bounds");
        let sine = SpeedLaw::Sine(Sine { amplitude, harmonic, phase: 0.7 });
        let moved = law(&sine).moved(0.7 - 0.5 * window, 0.7 + 0.5 * window);
        prop_assert!((moved - required).abs() < 1e-12 * LEAD);
        let required = share * plain;
        let drive = EllipticDrive::for_moved_distance(required, window, LEAD).expect("below plain");
        let turned = drive.at(0.5 * window).position - drive.at(-0.5 * window).position;
        prop_assert!((LEAD * turned / TAU - required).abs() < 1e-11);
    }
}

/// A sine that is slow at the picks, picked first at an angle of the shaft.
fn picked_at(pick: f64) -> SpiralShaft {
    let design = SpiralShaftDesign {
        moved_distance: Some(2.05),
        pick,
        holes: 5,
        law: SpeedLaw::Sine(Sine {
            phase: pick,
            ..Sine::default()
        }),
        ..SpiralShaftDesign::default()
    };
    SpiralShaft::resolve(&design).expect("resolves")
}

#[test]
fn wherever_a_shaft_is_first_picked_the_same_holes_are_met_out_and_back() {
    let usual = picked_at(0.0);
    for pick in [1.0, -0.4, 3.0, 40.0, -17.0] {
        let shaft = picked_at(pick);
        let schedule = shaft.schedule();
        assert_eq!(schedule.visits, [2; 5], "{pick}");
        for (here, there) in schedule.picks.iter().zip(usual.schedule().picks) {
            assert!(here.misplacement.abs() < 1e-9, "{pick}: {here:?}");
            assert!((here.swept - there.swept).abs() < 1e-9, "{pick}: {here:?}");
            assert_eq!((here.way, here.hole), (there.way, there.hole));
        }
        // The usual groove, turned on the shaft.
        let (a, b) = (shaft.groove(), usual.groove());
        for i in 0..200 {
            let theta = 0.37 * f64::from(i);
            let [here, there] = [(a, pick), (b, 0.0)].map(|(g, by)| g.traverse().at(theta + by));
            assert!(
                (here.position - there.position).abs() < 1e-9,
                "{pick} {theta}"
            );
            assert!((here.velocity - there.velocity).abs() < 1e-9);
        }
        let [here, there] = [a, b].map(|g| (g.steepest().value, g.tightest_of_stroke().value));
        assert!((here.0 - there.0).abs() < 1e-9 && (here.1 - there.1).abs() < 1e-9);
        let gaps = |g: &Groove| -> Vec<f64> {
            let all = g.crossings().into_iter();
            all.filter(|c| c.of_strokes).map(|c| c.gap).collect()
        };
        assert_eq!(gaps(a).len(), gaps(b).len());
        for (here, there) in gaps(a).iter().zip(gaps(b)) {
            assert!((here - there).abs() < 1e-6, "{pick}: {here} {there}");
        }
        let breaks = shaft.traverse().breaks();
        assert!(breaks.iter().all(|at| (0.0..shaft.cycle()).contains(at)));
        let load = shaft.load();
        let [here, there] = [a, b].map(|g| g.force_range(load));
        assert!((here.normal[1].value - there.normal[1].value).abs() < 1e-9);
        assert!((here.torque[0].value - there.torque[0].value).abs() < 1e-9);
    }
    let tolerance = centrode_geometry::Tolerance::new(0.05).expect("positive");
    let mesh = picked_at(1.0).mesh(tolerance).expect("a shaft");
    assert!(mesh.is_watertight());
    let volume = usual.mesh(tolerance).expect("a shaft").volume();
    assert!((mesh.volume() / volume - 1.0).abs() < 1e-3);
    assert!(picked_at(1.0).shell().expect("a shaft").is_closed());
}

#[test]
fn a_geared_box_is_picked_where_its_gears_are_slow() {
    let mut design = MovingBoxDesign {
        scheme: Scheme::EllipticGear,
        gears: Some(EllipticGears {
            speed_ratio: Some(3.0),
            ..EllipticGears::default()
        }),
        ..MovingBoxDesign::default()
    };
    design.shaft.pick = 1.0;
    let machine = MovingBox::resolve(&design).expect("resolves");
    let schedule = machine.schedule();
    assert!(schedule.visits.iter().all(|visits| *visits == 2));
    for pick in &schedule.picks {
        assert!(pick.misplacement.abs() < 1e-9, "{pick:?}");
        assert!(pick.swept < machine.moved_in_window() + 1e-9, "{pick:?}");
    }
}

#[test]
fn gears_before_a_shaft_have_the_bore_of_its_journal_and_a_keyway_for_its_key() {
    use centrode_kinematics::machine::Keyway;
    let text = include_str!("../design/moving_box.toml");
    let mut design = MovingBoxDesign::from_toml(text).expect("a design");
    design.shaft.pick = 0.4;
    let pair = |design: &MovingBoxDesign| {
        let machine = MovingBox::resolve(design).expect("resolves");
        let pair = design.gear_pair(machine.drive().expect("has gears"));
        centrode_gear::GearPair::resolve(&pair.expect("has gears")).expect("resolves")
    };
    let gears = pair(&design);
    for body in [gears.driver().body(), gears.driven().body()] {
        assert_eq!(body.bore, 16.0);
        // DIN 6885-1 for a key of 5 mm.
        let key = body.keyway.expect("a keyway");
        assert!(key.width == 5.0 && (key.depth - 2.3).abs() < 1e-12);
    }
    // Where the driven gear is slowest it has turned by half a turn, and the shaft by the pick: seen from the
    // shaft, whose key lies at its angle 0, the gear is turned by both.
    let turned = gears.driven_angle(PI) + design.shaft.pick;
    let key = gears.driven().body().keyway_angle + turned;
    assert!((key / TAU - (key / TAU).round()).abs() < 1e-12, "{key}");
    let bore = gears.driven().bore().expect("a bore").centroid();
    let shown = gears.driven().body().keyway_angle;
    assert!((bore.y.atan2(bore.x) - shown).abs() < 1e-9);
    let own = design.gears.as_mut().expect("gears");
    own.body.bore = 12.0;
    assert_eq!(pair(&design).driven().body().bore, 12.0);
    assert_eq!(pair(&design).driven().body().keyway, None);
    let hub = |width, depth| Keyway { width, depth }.of_hub().depth;
    // Rows of DIN 6885-1, and a square key that is none of its.
    assert!((hub(8.0, 4.0) - 3.3).abs() < 1e-12 && (hub(22.0, 9.0) - 5.4).abs() < 1e-12);
    assert!((hub(7.0, 4.0) - 3.42).abs() < 1e-12);
}

#[test]
fn the_elliptic_drive_is_the_integral_of_its_speed() {
    let drive = EllipticDrive {
        eccentricity: 0.6,
        phase: 1.0,
    };
    for i in -40..40 {
        let x = 0.3 * f64::from(i);
        let jet = drive.at(x);
        assert!((slope(|x| drive.at(x).position, x) - jet.velocity).abs() < 1e-9);
        assert!((slope(|x| drive.at(x).velocity, x) - jet.acceleration).abs() < 1e-8);
        assert!((slope(|x| drive.at(x).acceleration, x) - jet.jerk).abs() < 1e-6);
        assert!((drive.at(x + TAU).position - jet.position - TAU).abs() < 1e-13);
    }
    assert!((drive.at(1.0).velocity - 0.25).abs() < 1e-15);
}

#[test]
fn knots_hold_the_slow_speed_through_the_window() {
    let half = PI / 6.0;
    let law = law(&SpeedLaw::Knots(SpeedKnots {
        angle: vec![half, PI, TAU - half],
        speed: vec![0.6, 1.3, 0.6],
        law: LawSpec::ModifiedTrapezoid,
    }));
    for theta in [-0.5, -0.2, 0.0, 0.3, 0.5] {
        let motion = law.at(theta);
        assert!((motion.velocity - law.slowest().value).abs() < 1e-13);
        assert!(motion.acceleration.abs() < 1e-13);
    }
    assert!((law.fastest().value / law.slowest().value - 1.3 / 0.6).abs() < 1e-12);
}

#[test]
fn bad_shafts_are_refused_by_name() {
    let with = |change: &dyn Fn(&mut SpiralShaftDesign)| {
        let mut design = SpiralShaftDesign::default();
        change(&mut design);
        SpiralShaft::resolve(&design).expect_err("refused").key()
    };
    assert_eq!(with(&|d| d.lead = 0.0), "lead");
    assert_eq!(with(&|d| d.holes = 1), "holes");
    assert_eq!(with(&|d| d.groove.width = 19.9), "groove.width");
    assert_eq!(with(&|d| d.groove.depth = 15.0), "groove.depth");
    assert_eq!(with(&|d| d.reversal.angle = 1.0), "reversal.angle_deg");
    assert_eq!(
        with(&|d| d.reversal.law = LawSpec::ConstantVelocity),
        "reversal.law"
    );
    assert_eq!(with(&|d| d.moved_distance = Some(5.0)), "moved_distance");
    assert_eq!(with(&|d| d.slider.length = 3.0), "slider.length");
    assert_eq!(
        with(&|d| d.body.journal_diameter = 31.0),
        "body.journal_diameter"
    );
    assert_eq!(with(&|d| d.load.mass = -1.0), "load.mass");
    assert_eq!(with(&|d| d.pick = f64::NAN), "pick_deg");
    // So thin that half a turn is too tight to turn round in for a wide slider.
    let bend = with(&|d| {
        (d.radius, d.lead) = (1.4, 20.0);
        d.reversal.angle = PI;
        (d.groove.depth, d.groove.width, d.slider.reach) = (0.3, 3.0, 0.2);
        (d.slider.clearance, d.slider.pin_diameter) = (0.1, 1.0);
    });
    assert_eq!(bend, "reversal.angle_deg");
    let speed = SpeedLaw::Formula(SpeedFormula {
        expression: "cos(phi)".into(),
    });
    let refused = speed.resolve(LEAD, RADIUS).expect_err("stands still");
    assert!(matches!(refused, ShaftError::SpeedNotPositive { .. }));
}

#[test]
fn short_bursts_of_speed_between_even_places_count() {
    let law = law(&SpeedLaw::Formula(SpeedFormula {
        expression: "1 + 0.5*exp(-700*(1 - cos(5*phi)))".into(),
    }));
    for fifth in 1..5 {
        let way = law.at(TAU * f64::from(fifth) / 5.0).position;
        let expected = LEAD * f64::from(fifth) / 5.0;
        assert!((way - expected).abs() < 1e-13 * LEAD, "{fifth}: {way}");
    }
}

#[test]
fn both_schemes_together_are_their_chain() {
    let mut design = MovingBoxDesign {
        scheme: Scheme::Both,
        gears: Some(EllipticGears {
            speed_ratio: Some(1.5),
            ..EllipticGears::default()
        }),
        ..MovingBoxDesign::default()
    };
    design.shaft.law = SpeedLaw::Sine(Sine {
        amplitude: 0.6,
        ..Sine::default()
    });
    let both = MovingBox::resolve(&design).expect("resolves");
    let motion = both.motion().as_ref();
    for i in 0..200 {
        let input = 0.9 * f64::from(i);
        let jet = motion.at(input);
        assert!((slope(|x| motion.at(x).position, input) - jet.velocity).abs() < 1e-6);
    }
    let (first, second) = (both.shaft().moved_in_window(), both.moved_in_window());
    assert!(second < first && first < LEAD / 6.0);
    for at in motion.breaks() {
        let [s, v, a] = across(motion, at);
        assert!(s.abs() < 1e-7 && v.abs() < 1e-6 && a.abs() < 1e-4);
    }
    design.scheme = Scheme::EllipticGear;
    let refused = MovingBox::resolve(&design).expect_err("the shaft is not plain");
    assert_eq!(refused.key(), "shaft.law");
    let plain: Arc<dyn Transmission> = Arc::new(law(&SpeedLaw::default()));
    assert!(ShaftLaw::new(plain).is_ok());
}

#[test]
fn templates_are_sound_designs() {
    let text = include_str!("../design/spiral_shaft.toml");
    let design = SpiralShaftDesign::from_toml(text).expect("a design");
    let shaft = SpiralShaft::resolve(&design).expect("resolves");
    assert!((shaft.amplitude().expect("a sine") - 1.283_333).abs() < 1e-6);
    let written = design.to_toml().expect("written");
    let read = SpiralShaftDesign::from_toml(&written).expect("reads");
    assert_eq!(read, design);
    let text = include_str!("../design/moving_box.toml");
    let design = MovingBoxDesign::from_toml(text).expect("a design");
    let machine = MovingBox::resolve(&design).expect("resolves");
    assert!((machine.moved_in_window() - 1.954_217).abs() < 1e-6);
    let pair = design.gear_pair(machine.drive().expect("has gears"));
    let pair = centrode_gear::GearPair::resolve(&pair.expect("has gears")).expect("resolves");
    assert!((pair.center_distance() - 52.709_22).abs() < 1e-5);
    let written = design.to_toml().expect("written");
    let read = MovingBoxDesign::from_toml(&written).expect("reads");
    assert_eq!(read, design);
}
