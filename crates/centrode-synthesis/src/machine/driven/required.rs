use std::f64::consts::TAU;
use std::sync::Arc;

use super::GearDriveError;
use crate::reverse::{Required, Section};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};
use centrode_machines::machine::{
    BodyPoint, Machine, MachineFigure, MachineGoalSpec, Over, PointPart,
};

/// An output over a turn of the crank, whether it is an angle, and the requirements on it.
type Output = (Arc<dyn Transmission>, bool, Vec<Section>);

/// The output that goals name, over a turn of the crank, and its requirements.
pub(super) fn required(composed: &Machine) -> Result<Output, GearDriveError> {
    let mut found: Option<(MachineFigure, &str)> = None;
    let mut sections = Vec::new();
    for ((name, goal), figure) in composed.design().goals.iter().zip(composed.figures()) {
        let Some((within, required)) = section(goal, figure) else {
            continue;
        };
        let refused = |why: String| GearDriveError::Figure {
            goal: name.clone(),
            figure: goal.figure.clone(),
            why,
        };
        if motion(composed, figure, 0.0).is_none() {
            let why = "the output must be a position or an angle: point.x, point.y, body.angle, body.swing or body.travel";
            return Err(refused(why.into()));
        }
        match found {
            Some((other, words)) if other != *figure => {
                return Err(refused(format!(
                    "another goal has figure {words}, but all goals of the output must have one figure"
                )));
            }
            _ => found = Some((*figure, &goal.figure)),
        }
        sections.push(Section {
            name: format!("goals.{name}"),
            within,
            required,
        });
    }
    let (figure, _) = found.ok_or(GearDriveError::Nothing)?;
    let start = motion(composed, &figure, 0.0).unwrap_or_default();
    let end = motion(composed, &figure, TAU).unwrap_or_default();
    // An angle advances by whole turns, a position by zero.
    let advance = TAU * ((end.position - start.position) / TAU).round();
    let machine = composed.clone();
    let output = move |angle: f64| motion(&machine, &figure, angle).unwrap_or_default();
    let output = FromFn::new(TAU, advance, composed.breaks(), output);
    Ok((Arc::new(output), is_angle(&figure), sections))
}

/// Names of the goals that do not define the motion of the output.
pub(super) fn left_alone(composed: &Machine) -> Vec<String> {
    let goals = composed.design().goals.iter().zip(composed.figures());
    let left = goals.filter(|((_, goal), figure)| section(goal, figure).is_none());
    left.map(|((name, _), _)| name.clone()).collect()
}

fn is_angle(figure: &MachineFigure) -> bool {
    matches!(figure, MachineFigure::Angle(_) | MachineFigure::Swing(_))
}

/// Whether the goals of the output are of an angle.
pub(super) fn is_of_angle(composed: &Machine) -> bool {
    let mut goals = composed.design().goals.values().zip(composed.figures());
    goals.any(|(goal, figure)| is_angle(figure) && section(goal, figure).is_some())
}

/// Section of the input over which a goal defines the output, and its requirement; `None` for other goals.
fn section(goal: &MachineGoalSpec, figure: &MachineFigure) -> Option<([f64; 2], Required)> {
    let [from, to] = goal.within[..] else {
        return None;
    };
    let kept = |shown: f64| match is_angle(figure) {
        true => shown.to_radians(),
        false => shown,
    };
    let required = match (goal.over, goal.uniform, goal.range().ends()) {
        (Some(Over::Deviation), Some(ends), _) => Required::Even(ends.map(kept)),
        (Some(Over::Span), _, [_, Some(band)]) => Required::Rest(kept(band)),
        _ => return None,
    };
    Some(([from, to], required))
}

/// Motion of a position or an angle by the input; `None` for another figure.
fn motion(composed: &Machine, figure: &MachineFigure, input: f64) -> Option<MotionJet> {
    Some(match *figure {
        MachineFigure::Point(BodyPoint { body, at }, part) => {
            let k = match part {
                PointPart::X => 0,
                PointPart::Y => 1,
                PointPart::Speed | PointPart::Acceleration => return None,
            };
            let jet = composed.point(body, at, input);
            MotionJet {
                position: jet.point[k],
                velocity: jet.first[k],
                acceleration: jet.second[k],
                jerk: jet.third[k],
            }
        }
        MachineFigure::Angle(body) => composed.angle(body, input),
        MachineFigure::Swing(body) | MachineFigure::Travel(body) => {
            composed.bodies().get(body)?.mount.as_ref()?.law.at(input)
        }
        _ => return None,
    })
}
