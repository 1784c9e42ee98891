use centrode_geometry::Tolerance;
use centrode_kinematics::machine::{LinkedMachine, Surface};
use centrode_machines::machine::{ClearanceEnd, Machine, MachineFigure};

use super::goals::Found;
use crate::interference::{LinkClearanceError, LinkPair};
use crate::{Finding, Report, Severity, Unit};

/// Prepares the clearance of two bodies, or of a body and an obstacle, of a machine; `None` if they do not overlap along the
/// shafts.
///
/// The surfaces of a body are those of its plate and its gears.
///
/// # Errors
/// [`LinkClearanceError`] for a contour that makes no body.
pub fn machine_clearance(
    composed: &Machine,
    machine: &LinkedMachine,
    ends: [ClearanceEnd; 2],
    tolerance: Tolerance,
) -> Result<Option<LinkPair>, LinkClearanceError> {
    let obstacles: Vec<Surface> = composed.obstacles().iter().map(|o| o.surface()).collect();
    let links = ends.map(|end| composed.body_of_end(end));
    let surfaces = ends.map(|end| match end {
        ClearanceEnd::Obstacle(obstacle) => vec![&obstacles[obstacle]],
        ClearanceEnd::Body(body) => surfaces(machine, body).collect(),
    });
    LinkPair::new(machine, links, surfaces, tolerance)
}

/// Surfaces of a link.
pub(super) fn surfaces(machine: &LinkedMachine, link: usize) -> impl Iterator<Item = &Surface> {
    let own = machine.links[link].surfaces.iter();
    own.map(|&index| &machine.surfaces[index])
}

/// Adds a note for every clearance goal whose two ends share no height: the clearance is infinite.
pub(super) fn apart(composed: &Machine, found: &[Found], report: &mut Report) {
    let figures = composed.figures().iter().zip(found);
    for (figure, found) in figures {
        let (MachineFigure::Clearance(ends), Some(f64::INFINITY)) = (figure, found.goal.value)
        else {
            continue;
        };
        let [one, other] = ends.map(|end| composed.name_of_end(end));
        let message = format!(
            "goal {}, {}: {one} and {other} are at different heights along the shafts, so their clearance is infinite",
            found.goal.number, found.goal.title
        );
        Finding::new("no-common-height", Severity::Note, message)
            .measured(f64::INFINITY, None, Unit::Millimetre)
            .remedy("one layer for both, if they must pass each other in one plane")
            .on(one)
            .add_to(report);
    }
}
