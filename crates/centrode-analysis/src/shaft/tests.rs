use super::*;
use crate::Table;
use centrode_gear::cam::law::LawSpec;
use centrode_groove::{
    EllipticGears, MovingBox, MovingBoxDesign, RotatedSine, Scheme, SpeedFormula, SpeedKnots,
    SpeedLaw, SpiralShaftDesign,
};
use centrode_kinematics::transmission::Transmission as _;
use std::f64::consts::PI;

fn published() -> SpiralShaftDesign {
    SpiralShaftDesign {
        moved_distance: Some(2.05),
        ..SpiralShaftDesign::default()
    }
}

fn rules(report: &Report) -> Vec<&'static str> {
    report.findings.iter().map(|f| f.rule).collect()
}

fn table<'a>(report: &'a Report, name: &str) -> &'a Table {
    let found = report.tables.iter().find(|t| t.name == name);
    found.expect("a table of that name")
}

fn report(design: &SpiralShaftDesign) -> Report {
    check_shaft(&SpiralShaft::resolve(design).expect("resolves"))
}

#[test]
fn the_published_shaft_works_but_picks_on_its_crossings() {
    let report = report(&published());
    assert!(report.ok());
    assert_eq!(
        rules(&report),
        ["slider-tilts", "crossing-while-picking", "flat-slider"]
    );
    // Twice the 40.1 mm that the slow crossings leave without walls.
    assert!((report.findings[0].required.expect("a length") - 80.224).abs() < 1e-3);
    let offered = &report.findings[1].message;
    assert!(offered.contains("return_offset = "), "{offered}");
    assert!((report.values["moved_distance"] - 2.05).abs() < 1e-12);
    assert!((report.values["contact_limit_rpm"] - 323.36).abs() < 0.01);
    // The table of docs/moving-box.md, at 90 deg.
    let printed = [
        ("accelerations", &[0.5629, 0.0263][..], 5e-5),
        ("normal-forces", &[21.248, 9.489, 15.094][..], 5e-4),
        ("transverse-forces", &[6.489, 1.042, 1.657][..], 5e-4),
    ];
    for (name, figures, half) in printed {
        let row = &table(&report, name).rows[2];
        assert_eq!(row.0, "at 90 deg");
        assert_eq!(row.1.len(), figures.len());
        for (value, printed) in row.1.iter().zip(figures) {
            assert!((value - printed).abs() < 1.02 * half, "{value} {printed}");
        }
    }
    // A flat slider has left a groove on a shaft of 15 mm after 9.63 mm each way.
    assert!((report.values["slider_guided_length"] - 19.261).abs() < 1e-3);
}

#[test]
fn the_paper_s_equations_for_a_sine_stand_beside_sines_alone() {
    let turned = SpiralShaftDesign {
        law: SpeedLaw::RotatedSine(RotatedSine {
            amplitude: 1.0,
            ..RotatedSine::default()
        }),
        ..SpiralShaftDesign::default()
    };
    // kappa w = 1 mm * 200 r/min, a quarter turn after the slow point.
    let turned = report(&turned);
    let row = &table(&turned, "accelerations").rows[2].1;
    assert!((row[1] - 1e-3 * 200.0 * TAU / 60.0).abs() < 1e-12);
    let formula = SpiralShaftDesign {
        law: SpeedLaw::Formula(SpeedFormula {
            expression: "exp(-0.3*cos(phi))".into(),
        }),
        ..SpiralShaftDesign::default()
    };
    let report = report(&formula);
    assert!(report.tables.iter().all(|t| t.name != "accelerations"));
    assert_eq!(table(&report, "normal-forces").columns.len(), 2);
    assert_eq!(table(&report, "normal-forces").rows[0].1.len(), 2);
}

#[test]
fn each_fault_is_found() {
    let plain = report(&SpiralShaftDesign::default());
    assert!(!plain.ok() && rules(&plain).contains(&"moved-distance"));
    let mut design = published();
    design.reversal.angle = PI;
    let half = report(&design);
    assert!(rules(&half).contains(&"misplaced-hole"));
    assert!(rules(&half).contains(&"hole-not-picked-twice"));
    let mut design = published();
    design.slider.length = 30.0;
    assert!(rules(&report(&design)).contains(&"slider-length"));
    let mut design = published();
    design.slider.length = 81.0;
    let long = report(&design);
    assert!(!rules(&long).contains(&"slider-tilts"));
    let mut design = published();
    design.slider.clearance = 0.1;
    assert!(rules(&report(&design)).contains(&"slider-clearance"));
    let mut design = published();
    design.load.speed_rpm = 330.0;
    assert!(rules(&report(&design)).contains(&"contact-lost"));
    let mut design = published();
    (design.radius, design.groove.width, design.groove.depth) = (5.0, 4.0, 1.0);
    (design.slider.reach, design.body.journal_diameter) = (0.8, 4.0);
    design.slider.pin_diameter = 2.0;
    (design.body.keyway, design.body.chamfer) = (None, 0.3);
    assert!(rules(&report(&design)).contains(&"pressure-angle"));
}

#[test]
fn picks_beside_the_slow_places_are_found_and_those_on_them_meet_every_hole() {
    // Slow at 0 and picked at 120 deg: it moves more than the pot allows.
    let mut design = published();
    design.pick = 2.0 * PI / 3.0;
    let beside = report(&design);
    let found = beside.findings.iter().find(|f| f.rule == "moved-distance");
    let found = found.expect("a finding");
    assert!(found.measured > found.required && !beside.ok());
    assert!(beside.values["misplacement_max"] < 1e-9);
    design.law = SpeedLaw::Sine(centrode_groove::Sine {
        phase: design.pick,
        ..Default::default()
    });
    let on = report(&design);
    assert!(on.ok(), "{:?}", on.findings);
    assert!(on.values["misplacement_max"] < 1e-9);
    assert!(on.values["moved_distance_of_cycle_max"] < 2.05 + 1e-9);
}

#[test]
fn gears_with_a_bore_of_their_own_must_fit_the_journal() {
    let mut design = MovingBoxDesign {
        scheme: Scheme::EllipticGear,
        gears: Some(EllipticGears {
            speed_ratio: Some(3.0),
            ..EllipticGears::default()
        }),
        ..MovingBoxDesign::default()
    };
    let found = |design: &MovingBoxDesign| {
        let machine = MovingBox::resolve(design).expect("resolves");
        rules(&check_moving_box(&machine)).contains(&"gear-seat")
    };
    assert!(!found(&design));
    for (bore, fits) in [(16.0, true), (12.0, false)] {
        design.gears.as_mut().expect("gears").body.bore = bore;
        assert_eq!(found(&design), !fits, "{bore}");
    }
}

#[test]
fn gears_of_a_box_that_cannot_be_cut_are_found_and_those_of_bad_teeth_told() {
    let report = |count: u32, module: f64| {
        let mut design = MovingBoxDesign {
            scheme: Scheme::EllipticGear,
            gears: Some(EllipticGears {
                speed_ratio: Some(3.0),
                ..EllipticGears::default()
            }),
            ..MovingBoxDesign::default()
        };
        let gears = design.gears.as_mut().expect("gears");
        (gears.tooth_count, gears.module) = (count, module);
        let machine = MovingBox::resolve(&design).expect("resolves");
        check_moving_box(&machine)
    };
    let none = report(12, 2.25);
    assert!(!none.ok() && rules(&none).contains(&"no-gears"));
    let undercut = report(10, 5.0);
    assert!(undercut.ok() && rules(&undercut).contains(&"undercut"));
}

#[test]
fn the_elliptic_scheme_has_its_published_figures() {
    let design = MovingBoxDesign {
        scheme: Scheme::EllipticGear,
        gears: Some(EllipticGears {
            speed_ratio: Some(3.0),
            ..EllipticGears::default()
        }),
        ..MovingBoxDesign::default()
    };
    let machine = MovingBox::resolve(&design).expect("resolves");
    let report = check_moving_box(&machine);
    assert!(report.ok(), "{:?}", report.findings);
    assert!((report.values["moved_distance"] - 1.954_217).abs() < 1e-6);
    assert!((report.values["box_contact_limit_rpm"] - 239.66).abs() < 0.01);
    assert!((report.values["moved_distance_plain"] - 10.0 / 3.0).abs() < 1e-12);
    let moved: Vec<f64> = report.tables[0].rows.iter().map(|row| row.1[0]).collect();
    assert!((moved[0] - 10.0 / 3.0).abs() < 1e-12 && (moved[1] - moved[0]).abs() < 1e-12);
    assert!((moved[2] - moved[3]).abs() < 1e-12);
    let speeds = &table(&report, "scheme-speeds").rows[2].1;
    assert!((speeds[0] - 0.577_350).abs() < 1e-6 && (speeds[1] - 1.732_051).abs() < 1e-6);
    let forces = &table(&report, "scheme-forces").rows;
    assert!((forces[0].1[0] - 15.369).abs() < 1e-3 && (forces[2].1[1] - 26.072).abs() < 1e-3);
}

/// Extremes of a figure over one turn of the input, at so many even inputs.
fn seen(of: impl Fn(f64) -> f64) -> [f64; 2] {
    const COUNT: u32 = 60_000;
    (0..COUNT)
        .map(|i| of(TAU * f64::from(i) / f64::from(COUNT)))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
}

#[test]
fn no_speed_acceleration_or_force_of_the_box_is_beyond_the_extremes_stated() {
    let machine = MovingBox::resolve(&MovingBoxDesign {
        scheme: Scheme::Both,
        gears: Some(EllipticGears {
            eccentricity: Some(0.3),
            ..EllipticGears::default()
        }),
        shaft: SpiralShaftDesign {
            law: SpeedLaw::Knots(SpeedKnots {
                angle: [0.0, 1.0, 2.9, 4.6].to_vec(),
                speed: [1.0, 1.0, 1.7, 1.4].to_vec(),
                law: LawSpec::Parabolic,
            }),
            ..SpiralShaftDesign::default()
        },
        ..MovingBoxDesign::default()
    })
    .expect("resolves");
    let report = check_moving_box(&machine);
    let (shaft, load) = (machine.shaft(), machine.shaft().load());
    let mean = shaft.law().mean_speed();
    let force = |input: f64| {
        let turn = machine.shaft_turn(input).position;
        let lead = (shaft.law().at(turn).velocity / shaft.groove().radius()).atan();
        let motion = machine.stroke_at(input);
        load.force(motion, lead, shaft.groove().radius()).normal
    };
    let acceleration = |input: f64| machine.stroke_at(input).acceleration;
    let [braking, speeding] = seen(acceleration);
    let [slow, fast] = seen(|input| machine.stroke_at(input).velocity / mean);
    let [minimum, maximum] = seen(force);
    let metres = 1e-3 * load.speed() * load.speed();
    let stated = |table: &str| table_row(&report, table);
    let accelerations = stated("scheme-accelerations");
    let forces = stated("scheme-forces");
    for (name, stated, seen, sign) in [
        ("speed", report.values["box_speed_ratio_max"], fast, 1.0),
        (
            "minimum speed",
            report.values["box_speed_ratio_min"],
            slow,
            -1.0,
        ),
        (
            "acceleration",
            report.values["box_acceleration_max"],
            speeding.max(-braking),
            1.0,
        ),
        ("force", report.values["box_normal_force_max"], maximum, 1.0),
        (
            "minimum force",
            report.values["box_normal_force_min"],
            minimum,
            -1.0,
        ),
        (
            "minimum of the table",
            accelerations[0],
            metres * braking,
            -1.0,
        ),
        (
            "maximum of the table",
            accelerations[1],
            metres * speeding,
            1.0,
        ),
        ("minimum force of the table", forces[0], minimum, -1.0),
        ("maximum force of the table", forces[1], maximum, 1.0),
    ] {
        let beyond = sign * (stated - seen) / seen.abs().max(1.0);
        // At a jump of the acceleration even samples miss the limit by their distance from it.
        assert!((0.0..1e-3).contains(&beyond), "{name}: {stated} {seen}");
    }
}

/// Figures of the scheme as designed.
fn table_row(report: &Report, name: &str) -> Vec<f64> {
    let rows = &table(report, name).rows;
    let row = rows.iter().find(|(of, _)| of == "as designed");
    row.expect("a row").1.clone()
}

/// On a journal of 16 mm a key of 5 x 5 mm, 18 mm long with round ends, bears over 13 mm and 2 mm of the hub's keyway.
#[test]
fn keys_of_shaft_and_gears_are_pressed_by_the_torques_they_carry() {
    let mut design = published();
    let light = report(&design);
    let torque = light.values["torque_max"].max(-light.values["torque_min"]);
    let pressure = torque / 8.0 / (2.0 * 13.0);
    assert!((light.values["key_pressure_max"] / pressure - 1.0).abs() < 1e-12);
    assert!(!rules(&light).contains(&"key-pressure"));
    // In 9 mm, half round at one end, a key of 6 mm with square ends.
    let long = std::mem::replace(&mut design.body.keyway_length, 9.0);
    let short = report(&design).values["key_pressure_max"];
    assert!((short / pressure - 13.0 / 6.0).abs() < 1e-12);
    design.body.keyway_length = long;
    design.load.mass *= 1000.0;
    let heavy = report(&design);
    let finding = heavy.findings.iter().find(|f| f.rule == "key-pressure");
    let finding = finding.expect("a finding");
    assert!((finding.measured.expect("a pressure") / (1000.0 * pressure) - 1.0).abs() < 1e-9);
    assert_eq!(finding.required, Some(0.9 * 235.0));
    let mut design = MovingBoxDesign {
        scheme: Scheme::EllipticGear,
        gears: Some(EllipticGears {
            speed_ratio: Some(3.0),
            ..EllipticGears::default()
        }),
        ..MovingBoxDesign::default()
    };
    let machine = MovingBox::resolve(&design).expect("resolves");
    let report = check_moving_box(&machine);
    let (shaft, load) = (machine.shaft(), machine.shaft().load());
    let torque = |input: f64| {
        let turn = machine.shaft_turn(input).position;
        let lead = (shaft.law().at(turn).velocity / shaft.groove().radius()).atan();
        load.force(machine.stroke_at(input), lead, shaft.groove().radius())
            .torque
    };
    // What goes in is what comes out.
    let driving = |input: f64| {
        let step = 1e-6;
        let [before, after] = [-step, step].map(|h| machine.shaft_turn(input + h).position);
        torque(input) * (after - before) / (2.0 * step)
    };
    let maximum = |of: &dyn Fn(f64) -> f64| {
        let [low, high] = seen(of);
        high.max(-low)
    };
    let gears = design.gears.as_ref().expect("gears");
    let width = gears.body.width;
    let long = [10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0, 25.0, 28.0];
    let long = long
        .into_iter()
        .rev()
        .find(|long| *long <= width)
        .expect("a key");
    for (figure, torque) in [
        ("driven_key_pressure_max", maximum(&torque)),
        ("driver_key_pressure_max", maximum(&driving)),
    ] {
        // Square ends where round ones would leave half the length or less.
        let bearing = if 2.0 * (long - 5.0) > long {
            long - 5.0
        } else {
            long
        };
        let pressure = torque / 8.0 / (2.0 * bearing);
        let found = report.values[figure];
        assert!(
            (found / pressure - 1.0).abs() < 1e-6,
            "{figure}: {found} {pressure}"
        );
    }
    assert!(!report.values.contains_key("key_pressure_max"));
    design.shaft.load.mass *= 1000.0;
    let heavy = check_moving_box(&MovingBox::resolve(&design).expect("resolves"));
    let pressed = heavy.findings.iter().filter(|f| f.rule == "key-pressure");
    let mut parts: Vec<_> = pressed.filter_map(|f| f.place.part.as_deref()).collect();
    parts.sort_unstable();
    assert_eq!(parts, ["driven", "driver"]);
}

/// A plain shaft moves the box by `lead window / 2 pi`; a sixth of the pot is allowed.
#[test]
fn figures_equal_to_their_limits_but_for_rounding_keep_them() {
    // Lead, holes, radius, window in sixths of a turn.
    let neighbours = [
        (18.0, 16, 20.0, 1.0),
        (20.0, 14, 15.0, 1.0),
        (7.0, 5, 15.0, 1.0),
        (11.0, 9, 17.3, 1.0),
        (13.7, 12, 25.0, 1.0),
        (17.1, 3, 12.9, 1.0),
        (19.0, 8, 20.0, 1.5),
        (23.0, 10, 31.0, 0.7),
        (29.9, 6, 18.1, 1.3),
        (33.3, 4, 22.0, 0.9),
        (14.1, 20, 16.0, 1.1),
        (12.3, 11, 19.0, 0.3),
    ];
    let mut rounded_up = 0;
    for (lead, holes, radius, sixths) in neighbours {
        let mut design = SpiralShaftDesign {
            lead,
            holes,
            radius,
            window: f64::to_radians(60.0 * sixths),
            pot_width: lead * sixths,
            ..SpiralShaftDesign::default()
        };
        design.groove.width = 4.0;
        design.slider.pin_diameter = 2.5;
        let even = report(&design);
        let [moved, limit] =
            ["moved_distance_of_cycle_max", "moved_distance_limit"].map(|key| even.values[key]);
        rounded_up += u32::from(moved > limit);
        assert!((moved / (lead * sixths / 6.0) - 1.0).abs() < 1e-12);
        assert!(
            !rules(&even).contains(&"moved-distance"),
            "{lead} {moved} {limit}"
        );
        design.pot_width *= 1.0 - 1e-7;
        assert!(
            rules(&report(&design)).contains(&"moved-distance"),
            "{lead}"
        );
    }
    assert!(rounded_up > 1, "no neighbour is rounded up: {rounded_up}");
}

/// The verdict at a limit, and a hair to either side of it; the limits are the figures that the report gives.
#[test]
fn a_hair_of_rounding_changes_no_verdict() {
    let figure = |key: &str| report(&published()).values[key];
    let [length, speed, clearance] = [
        "crossing_gap_max",
        "contact_limit_rpm",
        "slider_clearance_min",
    ]
    .map(figure);
    type Set = fn(&mut SpiralShaftDesign, f64);
    let rows: [(&str, Set, f64, bool); 4] = [
        ("slider-length", |d, x| d.slider.length = x, length, true),
        (
            "slider-tilts",
            |d, x| d.slider.length = x,
            2.0 * length,
            false,
        ),
        ("contact-lost", |d, x| d.load.speed_rpm = x, speed, false),
        (
            "slider-clearance",
            |d, x| d.slider.clearance = x,
            clearance,
            false,
        ),
    ];
    for (rule, set, limit, at_limit) in rows {
        for hair in [-3e-15, -4e-16, 0.0, 4e-16, 3e-15] {
            let mut design = published();
            set(&mut design, limit * (1.0 + hair));
            assert_eq!(
                rules(&report(&design)).contains(&rule),
                at_limit,
                "{rule} {hair}"
            );
        }
        let verdicts = [-1e-6, 1e-6].map(|step| {
            let mut design = published();
            set(&mut design, limit * (1.0 + step));
            rules(&report(&design)).contains(&rule)
        });
        assert_ne!(verdicts[0], verdicts[1], "{rule}");
    }
}

/// The sine law decelerates by its amplitude at most, the gears of eccentricity k not at all for k = 0.
#[test]
fn the_limit_of_the_speed_is_a_value_with_friction_and_without() {
    let sine = |amplitude: f64| {
        SpeedLaw::Sine(centrode_groove::Sine {
            amplitude,
            ..Default::default()
        })
    };
    // Amplitude of the groove, eccentricity of the gears, friction of the rails.
    let neighbours = [
        (0.0, Some(0.268), 0.0),
        (0.0, None, 0.0),
        (1.0, None, 0.0),
        (0.5, Some(0.1), 0.0),
        (0.0, Some(0.0), 0.0),
        (1e-18, None, 0.0),
        (0.0, None, 0.15),
        (0.0, Some(0.0), 1e-12),
        (1.0, None, 0.15),
        (2.0, None, 1e-9),
        (0.3, Some(0.2), 0.4),
        (1e-15, None, 1e-30),
        (0.7, Some(0.0), 0.05),
    ];
    for (amplitude, eccentricity, friction) in neighbours {
        let mut shaft = SpiralShaftDesign {
            law: sine(amplitude),
            ..SpiralShaftDesign::default()
        };
        shaft.load.rail_friction = friction;
        let machine = MovingBox::resolve(&MovingBoxDesign {
            scheme: match (eccentricity, amplitude) {
                (None, _) => Scheme::Shaft,
                (_, 0.0) => Scheme::EllipticGear,
                _ => Scheme::Both,
            },
            gears: eccentricity.map(|eccentricity| EllipticGears {
                eccentricity: Some(eccentricity),
                ..EllipticGears::default()
            }),
            shaft,
            ..MovingBoxDesign::default()
        })
        .expect("resolves");
        let report = check_moving_box(&machine);
        let case = format!("{amplitude} {eccentricity:?} {friction}");
        for (key, value) in &report.values {
            assert!(!value.is_nan(), "{key} of {case}");
        }
        let figures = report
            .tables
            .iter()
            .flat_map(|t| t.rows.iter().flat_map(|row| &row.1));
        assert!(figures.copied().all(|x| !x.is_nan()), "{case}");
        let is_even = amplitude < 1e-12;
        let limit = report.values["contact_limit_rpm"];
        if is_even {
            assert_eq!(limit, f64::INFINITY, "{case}");
        } else {
            let closed = (9.81 * friction * 1e3 / amplitude).sqrt() * 60.0 / TAU;
            assert!(
                (limit - closed).abs() <= 1e-9 * closed,
                "{case}: {limit} {closed}"
            );
        }
        if let Some(k) = eccentricity {
            let limit = report.values["box_contact_limit_rpm"];
            assert_eq!(limit == f64::INFINITY, is_even && k == 0.0, "{case}");
            assert_eq!(
                limit == 0.0,
                friction == 0.0 && !(is_even && k == 0.0),
                "{case}"
            );
        }
        let at_any_speed = report.findings.iter().find(|f| f.rule == "contact-lost");
        let at_any_speed = at_any_speed.is_some_and(|f| f.message.contains("at any speed"));
        let is_even = is_even && eccentricity.unwrap_or_default() == 0.0;
        assert_eq!(at_any_speed, friction == 0.0 && !is_even, "{case}");
    }
}
