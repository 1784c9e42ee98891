use centrode_geometry::Tolerance;
use centrode_mechanism::composed::{ClearanceEnd, Composed, ComposedFigure};
use centrode_mechanism::machine::{JointKind, Machine, Surface};

use super::Made;
use super::goals::Found;
use crate::interference::{LinkClearanceError, LinkPair};
use crate::{Finding, Place, Report, Severity, Unit};

/// Accuracy to which plates are looked over for collisions, as a share of a plate's width.
const ACCURACY: f64 = 1e-3;

/// Clearance of two bodies, or of a body and an obstacle, of a composed machine, made ready; none where they lie apart along
/// the shafts.
///
/// A body counts with its plate and its gears.
///
/// # Errors
/// [`LinkClearanceError`] for a contour that makes no body.
pub fn composed_clearance(
    composed: &Composed,
    machine: &Machine,
    ends: [ClearanceEnd; 2],
    tolerance: Tolerance,
) -> Result<Option<LinkPair>, LinkClearanceError> {
    let obstacles: Vec<Surface> = composed.obstacles().iter().map(|o| o.surface()).collect();
    let links = ends.map(|end| composed.body_of_end(end));
    let surfaces = ends.map(|end| match end {
        ClearanceEnd::Obstacle(obstacle) => vec![&obstacles[obstacle]],
        ClearanceEnd::Body(body) => {
            let own = machine.links[body].surfaces.iter();
            own.map(|&index| &machine.surfaces[index]).collect()
        }
    });
    LinkPair::new(machine, links, surfaces, tolerance)
}

/// Plates that share a height and collide, among those that no joint holds together.
pub(super) fn plates(made: &Made<'_>, report: &mut Report) {
    let composed = made.composed;
    let tolerance = Tolerance::new(ACCURACY * composed.design().plates.width);
    let (Some(machine), Ok(tolerance)) = (made.machine(), tolerance) else {
        return;
    };
    let count = machine.links.len();
    let plate = |link: usize| -> Vec<&Surface> {
        let own = machine.links[link].surfaces.iter();
        let own = own.map(|&index| &machine.surfaces[index]);
        own.filter(|surface| surface.teeth.is_empty()).collect()
    };
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
    for links in pairs.filter(|links| !held(machine, *links)) {
        // Plates at other heights cost no more than a look at their ends.
        let Ok(Some(pair)) = LinkPair::new(machine, links, links.map(plate), tolerance) else {
            continue;
        };
        let Ok(found) = pair.over([0.0, composed.period()]) else {
            continue;
        };
        // What touches, as plates side by side on one line do, does not collide.
        if found.least >= -tolerance.mm() {
            continue;
        }
        let [one, other] = links.map(|link| machine.links[link].name.as_str());
        report.findings.push(Finding {
            rule: "plates-collide",
            severity: Severity::Error,
            message: format!(
                "the plates of {one} and {other} share a height and overlap by {} at an input of {}",
                Unit::Millimetre.tell(-found.least),
                Unit::Angle.tell(found.input)
            ),
            measured: Some(found.least),
            required: Some(0.0),
            unit: Unit::Millimetre,
            remedy: Some("another layer for one of them, or a narrower plate"),
            place: Place {
                part: Some(one.to_owned()),
                input: Some(found.input),
                ..Place::default()
            },
        });
    }
}

/// Whether two links are held together by a joint or pin, or do not move against each other.
fn held(machine: &Machine, links: [usize; 2]) -> bool {
    let [one, other] = links;
    let meet = |[a, b]: [usize; 2]| [a, b] == [one, other] || [b, a] == [one, other];
    let joints = machine.joints.iter();
    let joined = joints
        .clone()
        .any(|joint| meet([joint.parent, joint.child]));
    let pinned = machine.closures.iter().any(|pin| meet(pin.links));
    let still = |link: usize| {
        let mut root = link;
        for joint in machine.carriers(link) {
            if joint.kind != JointKind::Fixed {
                break;
            }
            root = joint.parent;
        }
        root
    };
    joined || pinned || still(one) == still(other)
}

/// A note for every goal of a clearance between what shares no height, which is infinite.
pub(super) fn apart(composed: &Composed, found: &[Found], report: &mut Report) {
    let figures = composed.figures().iter().zip(found);
    for (figure, found) in figures {
        let (ComposedFigure::Clearance(ends), Some(f64::INFINITY)) = (figure, found.goal.value)
        else {
            continue;
        };
        let [one, other] = ends.map(|end| composed.name_of_end(end));
        report.findings.push(Finding {
            rule: "no-common-height",
            severity: Severity::Note,
            message: format!(
                "goal {}, {}: {one} and {other} share no height along the shafts, so that their clearance is infinite",
                found.goal.number, found.goal.title
            ),
            measured: Some(f64::INFINITY),
            required: None,
            unit: Unit::Millimetre,
            remedy: Some("one layer for both, if they are to pass each other in one plane"),
            place: Place {
                part: Some(one.to_owned()),
                ..Place::default()
            },
        });
    }
}
