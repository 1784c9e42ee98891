use std::f64::consts::{PI, TAU};

use centrode_kinematics::linkage::SixBar;
use centrode_machines::feeder::{Feeder, FeederGoals};

use super::Attainable;
use crate::report::Missed;
use crate::{Goal, Report, Unit};

/// The goals that a six-bar alone can meet: swing, minimum transmission angle and quick return.
#[must_use]
pub fn six_bar_goals(six_bar: &SixBar, goals: &FeederGoals) -> [Goal; 3] {
    let FeederGoals {
        swing,
        swing_tolerance,
        transmission_angle,
        quick_return,
        ..
    } = *goals;
    [
        Goal::new(1, "swing", "swing of the effector", Unit::Angle)
            .range(
                [swing - swing_tolerance, swing + swing_tolerance].map(Some),
                swing_tolerance,
            )
            .with(six_bar.swing()),
        Goal::new(
            3,
            "transmission-angle",
            "minimum transmission angle",
            Unit::Angle,
        )
        .minimum(transmission_angle, size(transmission_angle))
        .with(six_bar.four_bar().minimum_transmission_angle()),
        Goal::new(
            5,
            "quick-return",
            "crank angle of the feed stroke",
            Unit::Angle,
        )
        .minimum(TAU * quick_return / (1.0 + quick_return), PI)
        .with(six_bar.extremes().longer_stroke()),
    ]
}

/// Scale of a goal with a minimum: its size.
fn size(required: f64) -> f64 {
    if required > 0.0 { required } else { 1.0 }
}

/// Every goal with its figure, in the order of their numbers.
#[must_use]
pub fn feeder_goals(feeder: &Feeder) -> Vec<Goal> {
    let required = &feeder.design().goals;
    let bar = feeder.six_bar().four_bar();
    let [swing, transmission_angle, quick_return] = six_bar_goals(feeder.six_bar(), required);
    let [crank, ..] = bar.lengths();
    let turns = Goal::new(
        2,
        "crank-rocker",
        "Grashof's margin (crank turns)",
        Unit::Millimetre,
    );
    let mut goals = vec![
        swing,
        turns.minimum(0.0, crank).with(bar.grashof_margin()),
        transmission_angle,
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
        let goal = Goal::new(4, name, title, Unit::Millimetre);
        let goal = goal.range([Some(low), Some(high)], high - low);
        goals.push(goal.with(length));
    }
    let rate = Goal::new(6, "feed-rate", "cuttings per minute", Unit::PerMinute);
    let dwell = Goal::new(7, "dwell", "rest of the effector for filling", Unit::Second);
    let FeederGoals {
        feed_rate,
        pushing_time,
        ..
    } = *required;
    goals.extend([
        quick_return,
        rate.minimum(feed_rate, size(feed_rate))
            .with(feeder.feed_rate()),
        dwell
            .minimum(pushing_time, size(pushing_time))
            .with(feeder.dwell_time()),
    ]);
    Goal::listed(goals)
}

/// A finding for each goal that is missed.
pub(super) fn unmet(feeder: &Feeder, report: &mut Report) {
    let attainable = match report.goals.iter().find(|g| g.name == "transmission-angle") {
        Some(goal) if goal.met() == Some(false) => attainable(feeder, report),
        _ => String::new(),
    };
    report.blame_goals(|goal| Missed {
        remedy: remedy(&goal.name),
        words: match &*goal.name {
            "transmission-angle" => attainable.clone(),
            _ => String::new(),
        },
        ..Missed::default()
    });
}

/// Text on the limit that the bounds set to the transmission angle.
fn attainable(feeder: &Feeder, report: &mut Report) -> String {
    let Some(found) = Attainable::search(feeder.design()) else {
        return "; no suitable crank-rocker was found within the bounds".into();
    };
    let values = &mut report.values;
    values.insert("attainable_transmission_angle", found.transmission_angle);
    if let Some(widening) = found.widening {
        values.insert("minimum_widening", widening);
    }
    format!("; {found}")
}

fn remedy(goal: &str) -> Option<&'static str> {
    Some(match goal {
        "swing" => "other lengths, or the pivot on the chord between the slider's dead centres",
        "transmission-angle" => "a crank that is shorter relative to the other links",
        "feed-rate" => "a faster motor, or more slots",
        "dwell" => "more pitches round the driver, or a smaller entry angle",
        _ => return None,
    })
}
