use centrode_geometry::{Tolerance, least};
use centrode_mechanism::composed::{ClearanceEnd, Composed, ComposedFigure, ComposedGear};
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
        ClearanceEnd::Body(body) => surfaces(machine, body).collect(),
    });
    LinkPair::new(machine, links, surfaces, tolerance)
}

/// Surfaces of a link.
fn surfaces(machine: &Machine, link: usize) -> impl Iterator<Item = &Surface> {
    let own = machine.links[link].surfaces.iter();
    own.map(|&index| &machine.surfaces[index])
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
        let own = surfaces(machine, link);
        own.filter(|surface| surface.teeth.is_empty()).collect()
    };
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
    for links in pairs.filter(|links| !held(machine, *links)) {
        let Some(found) = overlap(machine, links, links.map(plate), tolerance) else {
            continue;
        };
        let [one, other] = links.map(|link| machine.links[link].name.as_str());
        report.findings.push(Finding {
            remedy: Some("another layer for one of them, or a narrower plate"),
            ..collision(
                "plates-collide",
                &format!("the plates of {one} and {other}"),
                one,
                found,
            )
        });
    }
}

/// Least clearance (mm) of some surfaces of two links over the cycle, and the input there, where they overlap.
///
/// What touches, as plates side by side on one line do, does not; surfaces at other heights cost no more than a look at their
/// ends.
fn overlap(
    machine: &Machine,
    links: [usize; 2],
    surfaces: [Vec<&Surface>; 2],
    tolerance: Tolerance,
) -> Option<[f64; 2]> {
    let pair = LinkPair::new(machine, links, surfaces, tolerance).ok()??;
    let found = pair.over([0.0, machine.input.period]).ok()?;
    (found.least < -tolerance.mm()).then_some([found.least, found.input])
}

/// Two parts that overlap at an input, by how much (mm, below zero).
fn collision(rule: &'static str, what: &str, part: &str, [least, input]: [f64; 2]) -> Finding {
    Finding {
        rule,
        severity: Severity::Error,
        message: format!(
            "{what} share a height and overlap by {} at an input of {}",
            Unit::Millimetre.tell(-least),
            Unit::Angle.tell(input)
        ),
        measured: Some(least),
        required: Some(0.0),
        unit: Unit::Millimetre,
        remedy: None,
        place: Place {
            part: Some(part.to_owned()),
            input: Some(input),
            ..Place::default()
        },
    }
}

/// Gears that share a height and collide, among those that are not to mesh.
pub(super) fn gears(made: &Made<'_>, ends: &[f64], report: &mut Report) {
    let composed = made.composed;
    let tolerance = Tolerance::new(ACCURACY * composed.design().plates.width);
    let (Some(machine), Ok(tolerance)) = (made.machine(), tolerance) else {
        return;
    };
    let all: Vec<(&ComposedGear, usize, f64)> = composed
        .gears()
        .iter()
        .filter_map(|gear| {
            let corners = gear.gear().outline().flatten(tolerance);
            let far = corners.iter().map(|at| at.coords.norm());
            let far = far.fold(0.0, f64::max) + tolerance.mm();
            Some((gear, composed.body_named(gear.body_name())?, far))
        })
        .collect();
    let loops = &composed.whole().meshes;
    for (i, (one, first, reach)) in all.iter().enumerate() {
        for (other, second, far) in &all[i + 1..] {
            let both = [*first, *second];
            let mut meshes = machine.meshes.iter();
            let mut loops = loops.values().map(|mesh| &mesh.gears);
            let meshed = meshes.any(|mesh| meet(mesh.links, both))
                || loops.any(|gears| gears.contains(&one.name) && gears.contains(&other.name));
            if meshed || stands_on(machine, both) {
                continue;
            }
            // Gears whose axes keep farther apart than their teeth reach cost no more than this.
            let apart = |input: f64| {
                let [a, b] = [(one, *first), (other, *second)]
                    .map(|(gear, body)| composed.place(body, gear.at, input));
                (a - b).norm()
            };
            if least(apart, ends).value > reach + far {
                continue;
            }
            let teeth = |gear: &ComposedGear, body: usize| -> Vec<&Surface> {
                let name = gear.surface_name();
                let own = surfaces(machine, body);
                own.filter(|surface| surface.name == name).collect()
            };
            let teeth = [teeth(one, *first), teeth(other, *second)];
            if let Some(found) = overlap(machine, both, teeth, tolerance) {
                report.findings.push(Finding {
                    remedy: Some("fewer copies, smaller gears, or gears of another pair, which lies at another height"),
                    ..collision(
                        "gears-collide",
                        &format!("gears {} and {}", one.name, other.name),
                        &one.name,
                        found,
                    )
                });
            }
        }
    }
}

/// Whether two pairs of links are the same, in either order.
fn meet([a, b]: [usize; 2], links: [usize; 2]) -> bool {
    [a, b] == links || [b, a] == links
}

/// Whether two links are held together by a joint or pin, or stand on each other.
fn held(machine: &Machine, links: [usize; 2]) -> bool {
    let mut joints = machine.joints.iter();
    let joined = joints.any(|joint| meet([joint.parent, joint.child], links));
    let pinned = machine.closures.iter().any(|pin| meet(pin.links, links));
    joined || pinned || stands_on(machine, links)
}

/// Whether two links do not move against each other.
fn stands_on(machine: &Machine, links: [usize; 2]) -> bool {
    let [one, other] = links.map(|link| {
        let mut root = link;
        for joint in machine.carriers(link) {
            if joint.kind != JointKind::Fixed {
                break;
            }
            root = joint.parent;
        }
        root
    });
    one == other
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
