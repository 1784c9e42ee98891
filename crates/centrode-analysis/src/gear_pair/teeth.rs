use centrode_gear::{Gear, GearPair, Limits, Member, Side, Tooth, ToothSide};

use super::remedy::remedy_of_teeth;
use crate::{Finding, FlankPlace, Report, Severity, Unit};

/// Flanks for which `found` holds, on teeth that are not cut off, each with the radius of its end at the root or at the tip.
fn flanks(
    pair: &GearPair,
    gear: &Gear,
    found: &dyn Fn(&ToothSide) -> bool,
    at_tip: bool,
) -> Vec<FlankPlace> {
    let mut places = Vec::new();
    for (number, tooth) in gear
        .teeth()
        .iter()
        .enumerate()
        .filter(|(_, t)| !t.cut_through)
    {
        for (side, word, made) in [
            (Side::Leading, "leading", tooth.leading),
            (Side::Trailing, "trailing", tooth.trailing),
        ] {
            if found(&made) {
                let radii = pair.flank_radii(gear.member(), number, side);
                places.push(FlankPlace {
                    tooth: number as u32,
                    side: word,
                    radius: radii.map(|radii| radii[usize::from(at_tip)]),
                });
            }
        }
    }
    places
}

/// Minimum share of a pair's module that a remedy names: below it more than twenty times as many teeth would be needed.
const USEFUL: f64 = 0.05;

/// Teeth with a fault, and the largest figure of it.
#[derive(Default)]
struct FaultyTeeth {
    numbers: Vec<u32>,
    worst: f64,
}

pub(super) fn teeth(pair: &GearPair, gear: &Gear, limits: &Limits, report: &mut Report) {
    let part = gear.member().name();
    let minimum = pair.teeth().minimum_tip_width;
    let small = 1e-9 * pair.module();
    let collect = |figure: &dyn Fn(&Tooth) -> Option<f64>| {
        let mut found = FaultyTeeth::default();
        for (number, tooth) in (0_u32..).zip(gear.teeth()) {
            if let Some(figure) = figure(tooth) {
                found.numbers.push(number);
                found.worst = found.worst.max(figure);
            }
        }
        found
    };
    let sides = |tooth: &Tooth| [tooth.leading, tooth.trailing];
    let module = limits.largest_module_of_full_teeth();
    let largest = if module < USEFUL * pair.module() {
        let sharpest = limits.convex_curvature.max(limits.concave_curvature);
        format!(
            "no practical module avoids it: the minimum radius of curvature is {:.4} mm",
            1.0 / sharpest
        )
    } else {
        format!("the largest module without it is {module:.4} mm")
    };
    let mut add = |rule,
                   severity,
                   FaultyTeeth { numbers, worst }: FaultyTeeth,
                   required,
                   unit,
                   say: &dyn Fn(&str, f64) -> String| {
        if numbers.is_empty() {
            return;
        }
        let who = format!(
            "{} of {} teeth of the {part}",
            numbers.len(),
            gear.tooth_count()
        );
        // For a thin tip the worst figure is the missing width.
        let measured = match rule {
            "thin-tip" => minimum - worst,
            _ => worst,
        };
        let flanks = match rule {
            "undercut" => flanks(pair, gear, &|side| side.undercut > 0.0, false),
            "short-tooth" => flanks(pair, gear, &|side| side.tip_shortening > small, true),
            _ => Vec::new(),
        };
        Finding::new(rule, severity, say(&who, worst))
            .measured(measured, required, unit)
            .remedy(remedy_of_teeth(rule, pair.teeth().addendum))
            .on(part)
            .teeth(numbers, flanks)
            .add_to(report);
    };
    let cut_through = collect(&|t| t.cut_through.then_some(1.0));
    add(
        "cut-through",
        Severity::Error,
        cut_through,
        None,
        Unit::Count,
        &|who, _| {
            format!(
                "{who} are cut off at the root by undercut from both sides; {}",
                largest
            )
        },
    );
    let undercut = collect(&|t| {
        let worst = sides(t).iter().map(|s| s.undercut).fold(0.0, f64::max);
        (worst > 0.0 && !t.cut_through).then_some(worst)
    });
    add(
        "undercut",
        Severity::of_deviation(undercut.worst),
        undercut,
        Some(0.0),
        Unit::Millimetre,
        &|who, worst| {
            format!(
                "{who} are undercut by up to {worst:.4} mm of roll; {}",
                largest
            )
        },
    );
    let short = collect(&|t| {
        let worst = sides(t)
            .iter()
            .map(|s| s.tip_shortening)
            .fold(0.0, f64::max);
        (worst > small && !t.cut_through).then_some(worst)
    });
    add(
        "short-tooth",
        Severity::of_deviation(short.worst),
        short,
        Some(0.0),
        Unit::Millimetre,
        &|who, worst| {
            format!(
                "{who} cannot be cut to full height, up to {worst:.4} mm is missing: the pitch curve is concave there, or the shaper cutter does not reach it"
            )
        },
    );
    let pointed = collect(&|t| (t.tip_width <= small && !t.cut_through).then_some(0.0));
    add(
        "pointed",
        Severity::Warning,
        pointed,
        Some(minimum),
        Unit::Millimetre,
        &|who, _| format!("{who} are pointed: their flanks meet below the tip"),
    );
    let thin = collect(&|t| {
        (t.tip_width > small && t.tip_width < minimum * (1.0 - 1e-9))
            .then_some(minimum - t.tip_width)
    });
    add(
        "thin-tip",
        Severity::Warning,
        thin,
        Some(minimum),
        Unit::Millimetre,
        &|who, worst| {
            format!("{who} are thinner at the tip than {minimum:.4} mm, by up to {worst:.4} mm")
        },
    );
    let dead = collect(&|t| {
        (!t.cut_through && sides(t).iter().any(|s| s.active.is_none())).then_some(1.0)
    });
    add(
        "no-flank",
        Severity::Warning,
        dead,
        None,
        Unit::Count,
        &|who, _| format!("{who} have no working flank on at least one side"),
    );
    let present = gear.teeth().iter().filter(|t| !t.cut_through);
    let width = present
        .clone()
        .map(|t| t.tip_width)
        .fold(f64::INFINITY, f64::min);
    let fillet = present
        .flat_map(|t| sides(t).map(|s| s.fillet_radius))
        .fold(f64::INFINITY, f64::min);
    let names = match gear.member() {
        Member::Driver => [
            "driver_tip_width_min",
            "driver_fillet_radius_min",
            "driver_root_radius_min",
            "driver_tip_radius_max",
        ],
        Member::Driven => [
            "driven_tip_width_min",
            "driven_fillet_radius_min",
            "driven_root_radius_min",
            "driven_tip_radius_max",
        ],
    };
    let radii = gear.radii();
    for (name, figure) in names.into_iter().zip([width, fillet, radii.0, radii.1]) {
        report.values.insert(name, figure);
    }
    if let Ok(found) = pair.base_tangent(gear.member()) {
        let names = match gear.member() {
            Member::Driver => ["driver_base_tangent_teeth", "driver_base_tangent"],
            Member::Driven => ["driven_base_tangent_teeth", "driven_base_tangent"],
        };
        let figures = [f64::from(found.teeth), found.length];
        report.values.extend(names.into_iter().zip(figures));
    }
}

#[cfg(test)]
mod tests {
    use centrode_gear::design::GearPairDesign;
    use centrode_gear::pitch::{Ellipse, PitchSpec, Polar};

    use super::*;

    #[test]
    fn a_module_of_no_use_is_not_told_as_a_remedy() {
        let stated = |pitch| {
            let pair = GearPair::resolve(&GearPairDesign::new(pitch)).expect("a pair");
            let mut report = Report::default();
            teeth(&pair, pair.driver(), &pair.limits(), &mut report);
            let messages: Vec<String> = report.findings.into_iter().map(|f| f.message).collect();
            (messages.join("\n"), pair.rolling().radii(Member::Driver).1)
        };
        let (mild, _) = stated(PitchSpec::Ellipse(Ellipse {
            eccentricity: 0.6,
            module: Some(2.0),
            tooth_count: Some(21),
            ..Ellipse::default()
        }));
        assert!(mild.contains("the largest module without it is"), "{mild}");
        let (sharp, maximum) = stated(PitchSpec::Polar(Polar {
            module: Some(2.0),
            tooth_count: Some(21),
            ..Polar::expression("1 + 0.01*exp(-1000*(1 - cos(phi)))")
        }));
        // On top of the bump the second derivative of the radius is -10.
        let radius = maximum / (1.0 + 10.0 / 1.01);
        let radius = format!("the minimum radius of curvature is {radius:.4} mm");
        assert!(sharp.contains(&radius), "{radius}: {sharp}");
        assert!(!sharp.contains("largest module"), "{sharp}");
    }
}
