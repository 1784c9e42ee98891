use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use centrode_geometry::{Tolerance, bracketed_minimum};
use centrode_mechanism::feeder::{Feeder, FeederGoals, Part};
use centrode_mechanism::transmission::Transmission;

use crate::optimise::six_bar::{BestTransmissionAngle, LeastWidening, Lengths};
use crate::optimise::{Candidate, Method, Problem, Settings, minimise};
use crate::{
    Finding, Goal, IncompleteContact, Place, Report, Severity, SixBarTolerances, SwingSpread, Table,
};

/// Evaluations of the search for the best attainable transmission angle.
const ATTAINABLE: u64 = 20_000;
/// Evaluations of the search for the least widening of the bounds.
const WIDENING: u64 = 40_000;
/// Looks over the motion for where the effector comes near the rocker's shaft.
const LOOKS: u32 = 1440;
/// Inputs at which the incomplete gears are held against each other.
const GEAR_LOOKS: u32 = 240;
/// Distance of their contours from the polygons looked at, in modules.
const CONTOUR: f64 = 1e-4;
/// Overlap above which they do not run, in modules.
const OVERLAP: f64 = 1e-3;
/// Play above which they are loose, as a multiple of the play asked for.
const LOOSE: f64 = 2.0;
/// Six-bars made by chance.
const MADE: u32 = 2000;
/// Distance of the effector's pivot from the chord, as a share of the frame, within which the swing says nothing of
/// the lengths.
const ON_CHORD: f64 = 1e-3;

/// What the bounds of a feeder's lengths allow of its least transmission angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attainable {
    /// Greatest least transmission angle of any crank-rocker within the bounds, rad.
    pub transmission_angle: f64,
    /// Its crank, coupler, rocker and frame, mm.
    pub lengths: [f64; 4],
    /// Share by which all bounds must be widened for the angle wanted; none where they need not.
    pub widening: Option<f64>,
    /// Crank, coupler, rocker and frame then, mm.
    pub widened_lengths: [f64; 4],
}

impl Attainable {
    /// Searches the bounds of a feeder's lengths, the same ones always found alike.
    ///
    /// None where the bounds hold no crank-rocker, or none is found that would do.
    #[must_use]
    pub fn of(feeder: &Feeder) -> Option<Self> {
        let bounds: Lengths = feeder.design().bounds.named().map(|(_, [a, b])| (a, b));
        let wanted = feeder.design().goals.transmission_angle;
        let best = search(&BestTransmissionAngle { bounds }, ATTAINABLE)?;
        let lengths = best.point.clone().try_into().ok()?;
        let transmission_angle = 0.5 * PI - best.evaluation.objective;
        if transmission_angle >= wanted {
            return Some(Self {
                transmission_angle,
                lengths,
                widening: None,
                widened_lengths: lengths,
            });
        }
        let problem = LeastWidening {
            bounds,
            least_transmission_angle: wanted,
        };
        let least = search(&problem, WIDENING)?;
        Some(Self {
            transmission_angle,
            lengths,
            widening: Some(least.evaluation.objective),
            widened_lengths: problem.lengths(&least.point).try_into().ok()?,
        })
    }
}

fn search(problem: &dyn Problem, evaluations: u64) -> Option<Candidate> {
    let settings = Settings {
        method: Method::DifferentialEvolution,
        evaluations,
        ..Settings::default()
    };
    let found = minimise(problem, settings, &mut |_| ControlFlow::Continue(())).ok()?;
    let best = found.0.best();
    best.evaluation.feasible().then_some(best)
}

/// Checks a feeder: swing, transmission angle, strokes and speeds, dwell and feed rate, each goal met or by how
/// much not.
///
/// Lengths are mm, angles rad, times s; speeds of the tip are mm/s, angular accelerations rad/s².
#[must_use]
pub fn check_feeder(feeder: &Feeder) -> Report {
    let mut report = Report {
        goals: goals(feeder),
        ..Report::default()
    };
    linkage(feeder, &mut report);
    motion(feeder, &mut report);
    spread(feeder, &mut report);
    unmet(feeder, &mut report);
    vacuous(feeder, &mut report);
    plates(feeder, &mut report);
    gears(feeder, &mut report);
    report
        .findings
        .sort_by_key(|f| std::cmp::Reverse(f.severity));
    report
}

/// Crank angle of the feed stroke, rad.
fn feed_stroke(feeder: &Feeder) -> f64 {
    let extremes = feeder.six_bar().extremes();
    let one = (extremes.high.0 - extremes.low.0).rem_euclid(TAU);
    one.max(TAU - one)
}

fn goals(feeder: &Feeder) -> Vec<Goal> {
    let FeederGoals {
        swing,
        swing_tolerance,
        transmission_angle,
        quick_return,
        feed_rate,
        pushing_time,
    } = feeder.design().goals;
    let (six_bar, bar) = (feeder.six_bar(), feeder.six_bar().four_bar());
    let least = |about, value, wanted, unit, scale| {
        Goal::new(about, Some(value), [Some(wanted), None], unit, scale)
    };
    let size = |wanted: f64| if wanted > 0.0 { wanted } else { 1.0 };
    let mut goals = vec![
        Goal::new(
            (1, "swing", "swing of the effector"),
            Some(six_bar.swing()),
            [Some(swing - swing_tolerance), Some(swing + swing_tolerance)],
            "rad",
            swing_tolerance,
        ),
        least(
            (2, "crank-rocker", "crank turns: Grashof's margin"),
            bar.grashof_margin(),
            0.0,
            "mm",
            bar.lengths()[0],
        ),
        least(
            (3, "transmission-angle", "least transmission angle"),
            bar.least_transmission_angle(),
            transmission_angle,
            "rad",
            size(transmission_angle),
        ),
    ];
    let names = [
        ("crank-bounds", "crank within its bounds"),
        ("coupler-bounds", "coupler within its bounds"),
        ("rocker-bounds", "rocker within its bounds"),
        ("frame-bounds", "frame within its bounds"),
    ];
    let bounds = feeder.design().bounds.named();
    for ((length, (_, [low, high])), (name, title)) in
        bar.lengths().into_iter().zip(bounds).zip(names)
    {
        let wanted = [Some(low), Some(high)];
        let goal = Goal::new((4, name, title), Some(length), wanted, "mm", high - low);
        goals.push(goal);
    }
    goals.extend([
        least(
            (5, "quick-return", "crank turns for the feed stroke"),
            feed_stroke(feeder),
            TAU * quick_return / (1.0 + quick_return),
            "rad",
            PI,
        ),
        least(
            (6, "feed-rate", "cuttings a minute"),
            feeder.feed_rate(),
            feed_rate,
            "1/min",
            size(feed_rate),
        ),
        least(
            (7, "dwell", "effector rests while it is filled"),
            feeder.dwell_time(),
            pushing_time,
            "s",
            size(pushing_time),
        ),
    ]);
    goals
}

/// What the lengths alone settle.
fn linkage(feeder: &Feeder, report: &mut Report) {
    let (six_bar, bar) = (feeder.six_bar(), feeder.six_bar().four_bar());
    let extremes = six_bar.extremes();
    let values = &mut report.values;
    values.insert("swing", six_bar.swing());
    values.insert("effector_angle_min", extremes.low.1);
    values.insert("effector_angle_max", extremes.high.1);
    values.insert("transmission_angle_min", bar.least_transmission_angle());
    let near = bar.transmission_angle(0.0);
    let far = bar.transmission_angle(PI);
    values.insert("coupler_rocker_angle_min", near.min(far));
    values.insert("coupler_rocker_angle_max", near.max(far));
    if let (Some(dead), Some(swing)) = (bar.dead_centers(), bar.rocker_swing()) {
        values.insert("dead_center_stretched", dead.stretched);
        values.insert("dead_center_folded", dead.folded);
        values.insert("slider_stretched_x", dead.stretched_at.x);
        values.insert("slider_stretched_y", dead.stretched_at.y);
        values.insert("slider_folded_x", dead.folded_at.x);
        values.insert("slider_folded_y", dead.folded_at.y);
        values.insert("rocker_swing", swing);
    }
    values.insert("slider_distance_min", six_bar.least_slider_distance());
    let slow = feed_stroke(feeder);
    values.insert("feed_crank_angle", slow);
    values.insert("crank_quick_return", slow / (TAU - slow));
    if let Some(distance) = feeder.distance_from_chord() {
        values.insert("pivot_from_chord", distance);
    }
    let sensitivity = six_bar.swing_sensitivity();
    let [crank, coupler, rocker, frame] = sensitivity.lengths;
    let rows = [
        ("crank", crank),
        ("coupler", coupler),
        ("rocker", rocker),
        ("frame", frame),
        ("pivot, x", sensitivity.pivot.x),
        ("pivot, y", sensitivity.pivot.y),
    ];
    report.tables.push(Table {
        name: "sensitivities",
        title: "Change of the swing by a millimetre of",
        unit: "rad",
        columns: vec!["swing".into()],
        rows: rows.map(|(name, by)| (name.into(), vec![by])).into(),
    });
}

/// Strokes, times and speeds at the design's speed.
fn motion(feeder: &Feeder, report: &mut Report) {
    let (drive, speed) = (feeder.drive(), feeder.speed());
    let [feed, back] = feeder.strokes();
    let reach = feeder.six_bar().effector_length();
    let values = &mut report.values;
    values.insert("driver_rpm", feeder.cycles_per_minute());
    values.insert("feed_rate", feeder.feed_rate());
    values.insert("arc_ratio", drive.ratio());
    values.insert("motion_angle", drive.motion_angle());
    values.insert("dwell_angle", drive.dwell_angle());
    values.insert("feed_time", (feed.to - feed.from) / speed);
    values.insert("return_time", (back.to - back.from) / speed);
    values.insert("dwell_time", feeder.dwell_time());
    let quick = (feed.to - feed.from) / (back.to - back.from);
    values.insert("quick_return", quick);
    values.insert("tip_speed_feed_max", feed.speed * speed * reach);
    values.insert("tip_speed_return_max", back.speed * speed * reach);
    // What is left of the speed at the ends is rounding: the tip is at rest there.
    let rest =
        [feed.from, feed.to].map(|input| (feeder.effector(input).velocity * speed * reach).abs());
    values.insert("tip_speed_ends_max", rest[0].max(rest[1]));
    values.insert("crank_speed_jump", drive.shock() * speed);
    let greatest = drive.greatest_acceleration();
    if greatest.is_finite() {
        values.insert("crank_acceleration_max", greatest * speed * speed);
    }
    values.insert(
        "crank_rpm_driven",
        drive.ratio() * feeder.cycles_per_minute(),
    );
    let turned = drive.transmission().advance();
    values.insert("crank_turns_a_cycle", turned / TAU);
}

/// What tolerances of making do to the swing.
fn spread(feeder: &Feeder, report: &mut Report) {
    let making = &feeder.design().making;
    let tolerances = SixBarTolerances {
        lengths: making.length_tolerance,
        pivot: making.pivot_tolerance,
    };
    let spread = SwingSpread::of(feeder.six_bar(), tolerances, MADE, 1);
    let values = &mut report.values;
    values.insert("swing_made_deviation", spread.deviation);
    values.insert("swing_made_min", spread.least);
    values.insert("swing_made_max", spread.greatest);
    values.insert("swing_first_order_max", spread.first_order_greatest);
    let goals = &feeder.design().goals;
    let miss = (spread.greatest - goals.swing).max(goals.swing - spread.least);
    if miss > goals.swing_tolerance {
        report.findings.push(Finding {
            rule: "swing-spread",
            severity: Severity::Warning,
            message: format!(
                "lengths made to +-{} mm and a pivot set to +-{} mm let the swing miss by up to {:.3} deg",
                making.length_tolerance,
                making.pivot_tolerance,
                miss.to_degrees()
            ),
            measured: Some(miss),
            required: Some(goals.swing_tolerance),
            unit: "rad",
            remedy: Some("closer tolerances, or a pivot nearer the middle of the chord"),
            place: Place::default(),
        });
    }
}

/// A finding for each goal that is missed.
fn unmet(feeder: &Feeder, report: &mut Report) {
    let missed: Vec<Goal> = report
        .goals
        .iter()
        .filter(|goal| goal.met() == Some(false))
        .cloned()
        .collect();
    for goal in missed {
        let (Some(value), Some(margin)) = (goal.value, goal.margin) else {
            continue;
        };
        let shown = |x: f64| match goal.unit {
            "rad" => format!("{:.4} deg", x.to_degrees()),
            unit => format!("{x:.4} {unit}"),
        };
        let mut message = format!(
            "{}: {}, missed by {}",
            goal.title,
            shown(value),
            shown(-margin)
        );
        if goal.name == "transmission-angle" {
            message += &attainable(feeder, report);
        }
        let required = match goal.wanted {
            [Some(least), _] if value < least => Some(least),
            [_, greatest] => greatest,
        };
        report.findings.push(Finding {
            rule: goal.name,
            severity: Severity::Error,
            message,
            measured: Some(value),
            required,
            unit: if matches!(goal.unit, "rad" | "mm") {
                goal.unit
            } else {
                ""
            },
            remedy: remedy(goal.name),
            place: Place::default(),
        });
    }
}

/// How far the bounds let the transmission angle come, in words.
fn attainable(feeder: &Feeder, report: &mut Report) -> String {
    let Some(found) = Attainable::of(feeder) else {
        return "; no crank-rocker that would do was found".into();
    };
    let values = &mut report.values;
    values.insert("attainable_transmission_angle", found.transmission_angle);
    let best = found.transmission_angle.to_degrees();
    let words = |lengths: [f64; 4]| lengths.map(|l| format!("{l:.3}")).join(", ");
    let at = words(found.lengths);
    let Some(widening) = found.widening else {
        return format!("; within the bounds up to {best:.4} deg can be had, at {at} mm");
    };
    values.insert("least_widening", widening);
    format!(
        "; no lengths within the bounds reach more than {best:.3} deg (at {at} mm): the bounds contradict the goal, and must be widened by {:.3} % to hold both (then {} mm)",
        100.0 * widening,
        words(found.widened_lengths)
    )
}

fn remedy(goal: &str) -> Option<&'static str> {
    Some(match goal {
        "swing" => "other lengths, or the pivot on the chord between the slider's dead centres",
        "transmission-angle" => "a shorter crank against the other lengths",
        "feed-rate" => "a faster motor, or more slots",
        "dwell" => "more pitches round the driver, or a smaller entry angle",
        _ => return None,
    })
}

/// Whether the incomplete gears can be cut, and hold the crank all the way: none of it overlaps, and the crank is
/// free by no more than the play asked for.
fn gears(feeder: &Feeder, report: &mut Report) {
    let about_gears =
        |rule, severity, message, [measured, required]: [Option<f64>; 2], unit| Finding {
            rule,
            severity,
            message,
            measured,
            required,
            unit,
            remedy: None,
            place: Place {
                part: Some("gears".into()),
                ..Place::default()
            },
        };
    let spec = &feeder.design().gears;
    let cut = feeder.gears();
    let pair = match cut {
        Ok(pair) => pair,
        Err(error) => {
            let message = error.to_string();
            let none = [None, None];
            let finding = about_gears("no-gears", Severity::Error, message, none, "");
            report.findings.push(finding);
            return;
        }
    };
    let Ok(tolerance) = Tolerance::new(CONTOUR * spec.module) else {
        return;
    };
    let contact = IncompleteContact::of(&pair, GEAR_LOOKS, tolerance);
    let most = |moving| {
        let [ahead, back] = [&contact.ahead, &contact.back];
        contact
            .greatest(ahead, moving)
            .max(contact.greatest(back, moving))
    };
    let (moving, resting, overlap) = (most(true), most(false), contact.deepest());
    let values = &mut report.values;
    values.insert("gear_center_distance", pair.center_distance());
    values.insert("gear_teeth", f64::from(pair.teeth()));
    values.insert("gear_lock_radius", pair.lock_radius());
    values.insert("gear_play_moving_max", moving);
    values.insert("gear_play_resting_max", resting);
    values.insert("gear_overlap_max", overlap);
    let limit = OVERLAP * spec.module;
    if overlap > limit {
        let message = format!("the incomplete gears overlap by {overlap:.4} mm");
        let figures = [Some(overlap), Some(limit)];
        report.findings.push(about_gears(
            "gears-overlap",
            Severity::Error,
            message,
            figures,
            "mm",
        ));
    }
    let loose = moving.max(resting);
    let pitch = 0.5 * spec.module * f64::from(spec.driven_pitches);
    let allowed = LOOSE * (0.5 * spec.backlash / pitch).max(pair.locked_play()) + 1e-4;
    if loose > allowed {
        let message = format!(
            "the incomplete gears leave the crank free by {:.3} deg",
            loose.to_degrees()
        );
        let figures = [Some(loose), Some(allowed)];
        let mut finding = about_gears("gears-loose", Severity::Warning, message, figures, "rad");
        finding.remedy =
            Some("an entry angle, for which cams are made, or pins nearer the line of centres");
        report.findings.push(finding);
    }
}

/// Whether the links can be cut from plate, and run clear of the shaft that passes them.
fn plates(feeder: &Feeder, report: &mut Report) {
    let cut = Part::ALL.map(|part| (part, feeder.plate(part)));
    for (part, plate) in cut {
        let Err(error) = plate else { continue };
        report.findings.push(Finding {
            rule: "no-plate",
            severity: Severity::Error,
            message: error.to_string(),
            measured: None,
            required: None,
            unit: "mm",
            remedy: None,
            place: Place {
                part: Some(part.name().into()),
                ..Place::default()
            },
        });
    }
    let motion = feeder.drive().motion_angle();
    let at = |i: u32| motion * f64::from(i) / f64::from(LOOKS);
    let room = |input: f64| feeder.shaft_clearance(input);
    let nearest = (1..LOOKS)
        .min_by(|&a, &b| room(at(a)).total_cmp(&room(at(b))))
        .unwrap_or(1);
    let (input, least) = bracketed_minimum(room, at(nearest - 1), at(nearest + 1));
    report.values.insert("shaft_clearance_min", least);
    if least < 0.0 {
        report.findings.push(Finding {
            rule: "effector-meets-shaft",
            severity: Severity::Error,
            message: format!(
                "the effector runs into the rocker's shaft, which passes it: {:.4} mm too near",
                -least
            ),
            measured: Some(least),
            required: Some(0.0),
            unit: "mm",
            remedy: Some(
                "narrower plates, a thinner pin, or the pivot farther from the rocker's shaft",
            ),
            place: Place {
                part: Some("effector".into()),
                input: Some(input),
                ..Place::default()
            },
        });
    }
}

/// Says where the swing is half a turn whatever the lengths are.
fn vacuous(feeder: &Feeder, report: &mut Report) {
    let frame = feeder.six_bar().four_bar().lengths()[3];
    let Some(distance) = feeder.distance_from_chord() else {
        return;
    };
    if distance > ON_CHORD * frame {
        return;
    }
    report.findings.push(Finding {
        rule: "pivot-on-chord",
        severity: Severity::Note,
        message: format!(
            "the effector's pivot lies {distance:.4} mm from the chord between the slider's dead centres: there lengths of any size swing it by half a turn, so a search must not move the pivot with them"
        ),
        measured: Some(distance),
        required: None,
        unit: "mm",
        remedy: None,
        place: Place::default(),
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_mechanism::feeder::{FeederDesign, LinkageSpec};
    use centrode_mechanism::linkage::Branch;

    fn feeder([crank, coupler, rocker, frame]: [f64; 4], pivot: [f64; 2]) -> Feeder {
        let design = FeederDesign::new(LinkageSpec {
            crank,
            coupler,
            rocker,
            frame,
            branch: Branch::Upper,
            pivot,
            effector_length: 200.0,
        });
        Feeder::resolve(&design).expect("resolves")
    }

    fn rules(report: &Report) -> Vec<&'static str> {
        report.findings.iter().map(|f| f.rule).collect()
    }

    #[test]
    fn the_published_bounds_contradict_the_published_transmission_angle() {
        let feeder = feeder([77.0, 147.0, 127.0, 105.0], [106.83, 67.05]);
        let report = check_feeder(&feeder);
        assert_eq!(rules(&report), ["transmission-angle", "pivot-on-chord"]);
        let message = &report.findings[0].message;
        for part in ["8.2243 deg", "missed by 31.7757 deg", "12.312", "22.443 %"] {
            assert!(message.contains(part), "{part}: {message}");
        }
        let value = |name: &str| report.values[name];
        assert!((value("rocker_swing").to_degrees() - 116.235_306).abs() < 5e-7);
        assert!((value("coupler_rocker_angle_max").to_degrees() - 82.9016).abs() < 5e-5);
        assert!((value("crank_quick_return") - 2.4015).abs() < 5e-5);
        assert!(value("tip_speed_ends_max") < 1e-9);
        assert!(value("quick_return") > 1.0);
        assert!((value("feed_rate") - 55.5556).abs() < 5e-5);
        // The times are those of the whole cycle.
        let cycle = value("feed_time") + value("return_time") + value("dwell_time");
        assert!((cycle - 60.0 / feeder.cycles_per_minute()).abs() < 1e-12);
    }

    #[test]
    fn each_goal_that_is_missed_is_found() {
        let lengths = [77.0, 147.0, 127.0, 105.0];
        let mut design = feeder(lengths, [106.83, 67.05]).design().clone();
        design.goals.transmission_angle = 5_f64.to_radians();
        let found = |change: &dyn Fn(&mut FeederDesign)| {
            let mut design = design.clone();
            change(&mut design);
            rules(&check_feeder(&Feeder::resolve(&design).expect("resolves")))
        };
        assert_eq!(found(&|_| ()), ["pivot-on-chord"]);
        let beside = found(&|d| d.linkage.pivot[1] = 50.0);
        assert_eq!(beside, ["swing", "swing-spread"]);
        assert!(found(&|d| d.bounds.crank = [78.0, 81.0]).contains(&"crank-bounds"));
        assert!(found(&|d| d.drive.slots = 4).contains(&"feed-rate"));
        assert!(found(&|d| d.goals.pushing_time = 1.06).contains(&"dwell"));
        assert!(found(&|d| d.goals.quick_return = 2.5).contains(&"quick-return"));
        assert!(found(&|d| d.making.length_tolerance = 0.5).contains(&"swing-spread"));
        let within = found(&|d| d.goals.transmission_angle = 9_f64.to_radians());
        assert!(within.contains(&"transmission-angle"));
    }

    #[test]
    fn bounds_that_allow_the_angle_need_no_widening() {
        let mut design = feeder([77.0, 147.0, 127.0, 105.0], [106.83, 67.05])
            .design()
            .clone();
        design.goals.transmission_angle = 12_f64.to_radians();
        let found = Attainable::of(&Feeder::resolve(&design).expect("resolves")).expect("found");
        assert_eq!(found.widening, None);
        assert!((found.transmission_angle.to_degrees() - 12.312).abs() < 5e-4);
        let report = check_feeder(&Feeder::resolve(&design).expect("resolves"));
        assert!(
            report.findings[0]
                .message
                .contains("within the bounds up to 12.31")
        );
    }
}
