//! Laws that ask much of teeth: other people's stress tests, and how many teeth they need.

use std::f64::consts::{PI, SQRT_2, TAU};

use centrode_analysis::{check, remedies};
use centrode_gear::design::{Addendum, Fit, GearPairDesign, Rack, ToolSpec};
use centrode_gear::pitch::{PitchSpec, Polar, Ratio, Transmission};
use centrode_gear::{GearPair, Member, ToothSide};
use serde::Deserialize;

use crate::data::{cases, file};

/// Transmission error up to which flanks transmit the motion, rad.
const CARRIED: f64 = 1e-9;

#[derive(Deserialize)]
struct Law {
    name: String,
    radius: String,
    teeth: u32,
    #[serde(default = "even")]
    mean_ratio: [u32; 2],
    passes: bool,
}

fn even() -> [u32; 2] {
    [1, 1]
}

/// The transmission error of a design's pair, rad, and whether its check finds no error.
fn error(design: &GearPairDesign) -> (f64, bool) {
    let report = check(&GearPair::resolve(design).expect("a pair"));
    (report.values["transmission_error_max"], report.ok())
}

fn in_words(design: &GearPairDesign) -> String {
    let report = check(&GearPair::resolve(design).expect("a pair"));
    let short = |value: f64| {
        let text = format!("{value:.1e}");
        let (digits, power) = text.split_once('e').expect("a power of ten");
        let power: i32 = power.parse().expect("a number");
        format!("{digits}e{power:+03}").replace("+-", "-")
    };
    let error = report.values["transmission_error_max"];
    if error > CARRIED {
        return format!("{} rad", short(error));
    }
    assert!(report.ok(), "{:?}", report.findings);
    "transmits".into()
}

/// Rows of the table in the docs, cell by cell.
fn rows() -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(file("../docs/strong-laws.md")).expect("the docs");
    let rows = text.lines().filter(|line| line.starts_with("| "));
    let cells = |line: &str| {
        let cells = line.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().to_owned()).collect()
    };
    rows.skip(1).map(cells).collect()
}

#[test]
fn the_table_of_strong_laws_in_the_docs_is_what_the_teeth_do() {
    let laws: Vec<Law> = cases("strong_laws");
    let rows = rows();
    assert_eq!(laws.len(), rows.len());
    std::thread::scope(|scope| {
        for (law, row) in laws.iter().zip(&rows) {
            scope.spawn(move || {
                let pitch = PitchSpec::Polar(Polar {
                    expression: Some(law.radius.clone()),
                    module: Some(1.0),
                    tooth_count: Some(law.teeth),
                    ..Polar::default()
                });
                let mut design = GearPairDesign::new(pitch);
                design.mean_ratio = law.mean_ratio;
                let full = in_words(&design);
                design.teeth.addendum = Addendum::Fitted;
                let fitted = in_words(&design);
                let expected = if law.passes { "passes" } else { "fails" };
                let found: [&str; 5] = [
                    &law.name.replace('_', " "),
                    &law.teeth.to_string(),
                    expected,
                    &full,
                    &fitted,
                ];
                assert_eq!(found.map(str::to_owned).as_slice(), row);
                assert!(!law.passes || fitted == "transmits", "{}", law.name);
                // Teeth are held against each other at twenty poses per pitch.
                let report = check(&GearPair::resolve(&design).expect("a pair"));
                let overlaps = ["interference", "tip-interference"];
                let depths = report
                    .findings
                    .iter()
                    .filter(|f| overlaps.contains(&f.rule));
                let depth = depths.filter_map(|f| f.measured).fold(0.0, f64::max);
                assert!(depth < 1e-3, "{}: {depth} mm", law.name);
            });
        }
    });
}

fn by_ratio(expression: &str, teeth: u32, addendum: Addendum) -> GearPairDesign {
    let mut design = GearPairDesign::new(PitchSpec::Ratio(Ratio {
        expression: Some(expression.into()),
        module: Some(2.0),
        tooth_count: Some(teeth),
        ..Ratio::default()
    }));
    design.teeth.addendum = addendum;
    design
}

#[test]
fn a_strong_law_is_carried_from_the_tooth_count_on_that_is_named_and_not_below() {
    let weak = by_ratio("1 + 0.45*cos(2*phi)", 24, Addendum::Fitted);
    assert!(error(&weak).0 > CARRIED);
    let found = remedies(&GearPair::resolve(&weak).expect("a pair"));
    let [remedy, chosen] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(
        (remedy.addendum, remedy.minimum_tooth_count),
        (Addendum::Fitted, 27)
    );
    let sound = error(&remedy.design);
    assert!(sound.0 <= CARRIED && sound.1, "{sound:?}");
    // On pitch curves of the same size.
    let size = |design: &GearPairDesign| {
        let pair = GearPair::resolve(design).expect("a pair");
        (pair.driver().tooth_count(), pair.center_distance())
    };
    let [(before, own), (after, made)] = [size(&weak), size(&remedy.design)];
    assert_eq!((before, after), (24, 27));
    assert!((own - made).abs() < 1e-12 * own);
    let one_below = weak.with_tooth_count(26);
    assert!(error(&one_below).0 > CARRIED);

    // With thickness, pressure angle and phase chosen as many teeth as written are enough, and one fewer is not.
    assert_eq!(chosen.minimum_tooth_count, 24);
    assert!(chosen.design.teeth.fit.is_empty());
    let sound = error(&chosen.design);
    assert!(sound.0 <= CARRIED && sound.1, "{sound:?}");
    let mut fewer = by_ratio("1 + 0.45*cos(2*phi)", 23, Addendum::Fitted);
    fewer.teeth.fit = chosen.fit.clone();
    assert!(error(&fewer).0 > CARRIED);
}

#[test]
fn chosen_numbers_are_sound_wherever_the_written_ones_are() {
    let ratios = [
        "1 + 0.3*cos(phi)",
        "1 + 0.4*cos(2*phi)",
        "1 + 0.2*cos(phi) + 0.15*sin(3*phi)",
    ];
    for (ratio, teeth) in ratios
        .iter()
        .flat_map(|r| [14, 19, 26].map(|teeth| (r, teeth)))
    {
        let written = by_ratio(ratio, teeth, Addendum::Fitted);
        for fit in [
            &[Fit::PressureAngle][..],
            &[Fit::ThicknessSplit, Fit::Phase],
        ] {
            let mut chosen = written.clone();
            chosen.teeth.fit = fit.to_vec();
            let [before, after] = [&written, &chosen].map(error);
            assert!(
                before.0 > CARRIED || after.1,
                "{ratio} {teeth} {fit:?}: {before:?} {after:?}"
            );
        }
    }
}

#[test]
fn the_strongest_law_is_transmitted_by_the_tooth_count_that_the_docs_name_and_not_by_one_fewer() {
    let transmits = |teeth: u32| {
        let law = by_ratio("1 + 0.5*cos(3*phi)", teeth, Addendum::Fitted);
        let (error, ok) = error(&law);
        ok && error <= CARRIED
    };
    let [named, fewer] = std::thread::scope(|scope| {
        let both = [414, 413].map(|teeth| scope.spawn(move || transmits(teeth)));
        both.map(|job| job.join().expect("checked"))
    });
    assert!(named && !fewer);
}

/// Figures of Baesel, arXiv:1905.02642: psi = phi - (2 - sqrt 2) sin phi, 14 teeth, module 2, 20 degrees, dedendum 1.2, tip radius
/// 0.3.
fn published() -> GearPair {
    let mut design = GearPairDesign::new(PitchSpec::Transmission(Transmission {
        expression: Some("phi - (2 - sqrt(2))*sin(phi)".into()),
        module: Some(2.0),
        tooth_count: Some(14),
        ..Transmission::default()
    }));
    design.tool = ToolSpec::Rack(Rack {
        dedendum_coefficient: 1.2,
        tip_radius_coefficient: 0.3,
        ..Rack::default()
    });
    GearPair::resolve(&design).expect("a pair")
}

#[test]
fn teeth_of_the_published_pair_stand_where_the_paper_has_them() {
    let pair = published();
    assert!((pair.center_distance() - 28.4385).abs() < 5e-5);
    let printed = [
        0.0, 0.674_065, 1.188_77, 1.630_10, 2.032_97, 2.413_17, 2.780_37, PI, 3.502_82,
    ];
    let rolling = pair.rolling();
    for (tooth, angle) in pair.driver().teeth().iter().zip(printed) {
        let middle = 0.5 * (tooth.leading.crossing + tooth.trailing.crossing);
        let found = rolling.angle(rolling.parameter(middle)).rem_euclid(TAU);
        assert!((found - angle).abs() < 6e-6, "{found} {angle}");
        // The law's own arc length: half the perimeter over pi a tooth.
        let length = rolling.pitch_length(Member::Driver) / 14.0;
        assert!((length - TAU).abs() < 1e-12);
    }
    let ratio = pair.driven_angle(1.0) - (1.0 - (2.0 - SQRT_2) * 1.0_f64.sin());
    assert!(ratio.abs() < 1e-12);
}

#[test]
fn of_the_published_driver_two_flanks_alone_are_free_of_undercut() {
    let pair = published();
    let free = |side: &ToothSide| side.undercut == 0.0;
    let mut found = Vec::new();
    for (number, tooth) in (1..).zip(pair.driver().teeth()) {
        found.extend(free(&tooth.leading).then_some((number, '-')));
        found.extend(free(&tooth.trailing).then_some((number, '+')));
    }
    assert_eq!(found, [(2, '-'), (14, '+')]);
}

#[test]
fn the_check_tells_of_each_undercut_flank_from_where_on_it_is_there() {
    let pair = published();
    let report = check(&pair);
    let of_driver = report.findings.iter().find(|finding| {
        finding.rule == "undercut" && finding.place.part.as_deref() == Some("driver")
    });
    let flanks = &of_driver.expect("undercut").place.flanks;
    assert_eq!(flanks.len(), 26);
    let stated = |tooth, side| flanks.iter().any(|f| (f.tooth, f.side) == (tooth, side));
    assert!(!stated(1, "leading") && !stated(13, "trailing"));
    // The root's corner of what is left of the flank stands on the contour, and nothing of the flank lies below it.
    for flank in flanks {
        let radius = flank.radius.expect("some flank is left");
        let roots = pair.driver().outline().segments().iter();
        let near = roots.map(|s| (s.start().coords.norm() - radius).abs());
        assert!(near.fold(f64::INFINITY, f64::min) < 1e-6, "{flank:?}");
    }
}
