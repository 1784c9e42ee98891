use centrode_geometry::Point;
use centrode_kinematics::machine::{JointKind, LinkedMachine, Place, Seat};
use nalgebra::{Point3, Vector3};

use super::scene::Scene;

/// Distance below which two axes count as one, mm.
const ONE: f64 = 1e-6;
/// Maximum sine of the angle between an axis and the normal of the sheet at which the axis counts as normal to the sheet.
const UPRIGHT: f64 = 1e-9;

/// An axis about which links turn, normal to the sheet.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    pub(super) at: Point,
    /// The links that it joins: the carrying link, then the carried one. Links fixed to each other are represented by the first
    /// of them.
    pub(super) links: [usize; 2],
    /// The joint of the tree; `None` for a pin that closes a loop.
    pub(super) joint: Option<usize>,
    /// Name of the mark at its position, or of the carried link.
    pub(super) name: String,
    /// Whether a mark names it.
    pub(super) marked: bool,
}

impl Axis {
    /// Whether the axis is fixed to the frame.
    pub(super) fn stands(&self) -> bool {
        self.links[0] == 0
    }
}

/// A constant distance on one link.
pub(super) struct Length {
    pub(super) link: String,
    pub(super) between: String,
    pub(super) length: f64,
}

/// The first of the links that a link is fixed to.
fn fixed_to(machine: &LinkedMachine, link: usize) -> usize {
    let carriers = machine.carriers(link);
    let fixed = carriers.take_while(|joint| joint.kind == JointKind::Fixed);
    fixed.last().map_or(link, |joint| joint.parent)
}

/// A name with spaces instead of underscores and hyphens.
pub(super) fn words(name: &str) -> String {
    name.replace(['_', '-'], " ")
}

/// Name of a position, and whether a mark names it: the name of the mark there (on link `on`, or on any), otherwise `other` in
/// words.
fn named(scene: &Scene<'_>, at: Point, on: Option<usize>, other: &str) -> (String, bool) {
    let machine = scene.machine;
    let mark = machine.marks.iter().find(|mark| {
        let place = Place {
            figure: mark.figure,
            at: mark.at,
        };
        let own = match machine.figures[mark.figure].seat {
            Seat::Link(link) => on.is_none_or(|on| fixed_to(machine, link) == on),
            Seat::Free(_) => on.is_none(),
        };
        own && (scene.at(&place) - at).norm() < ONE
    });
    let name = mark.map_or_else(|| words(other), |mark| mark.name.clone());
    (name, mark.is_some())
}

/// All axes of links that are drawn at their positions.
pub(super) fn axes(scene: &Scene<'_>) -> Vec<Axis> {
    let machine = scene.machine;
    let turning = machine
        .joints
        .iter()
        .enumerate()
        .filter_map(|(index, joint)| {
            let place = &scene.places[joint.child];
            let axis = place.rotation * Vector3::from(joint.axis);
            let upright = axis.xy().norm() < UPRIGHT * axis.norm();
            let drawn = joint.kind == JointKind::Turning && scene.shows(joint.child) && upright;
            drawn.then(|| {
                let at = Point::from(place.translation.vector.xy());
                let (name, marked) = named(scene, at, None, &machine.links[joint.child].name);
                Axis {
                    at,
                    links: [joint.parent, joint.child].map(|link| fixed_to(machine, link)),
                    joint: Some(index),
                    name,
                    marked,
                }
            })
        });
    let pins = machine.closures.iter().filter_map(|closure| {
        let place = &scene.places[closure.links[0]];
        closure
            .links
            .iter()
            .all(|link| scene.shows(*link))
            .then(|| {
                let at = (place * Point3::from(closure.at)).xy();
                let (name, marked) = named(scene, at, None, &machine.links[closure.links[1]].name);
                Axis {
                    at,
                    links: closure.links.map(|link| fixed_to(machine, link)),
                    joint: None,
                    name,
                    marked,
                }
            })
    });
    turning.chain(pins).collect()
}

/// Distances from the axis on which each link turns to its other axes and to its points whose paths are drawn; equal links are
/// listed once.
pub(super) fn lengths(scene: &Scene<'_>, axes: &[Axis]) -> Vec<Length> {
    let machine = scene.machine;
    let mut all: Vec<Length> = Vec::new();
    for link in 0..machine.links.len() {
        let carrying = |axis: &&Axis| axis.joint.is_some() && axis.links[1] == link;
        let standing = |axis: &&Axis| link == 0 && axis.stands();
        let mut candidates = axes.iter().filter(|axis| carrying(axis) || standing(axis));
        let Some(own) = candidates.next() else {
            continue;
        };
        let touching = axes.iter().filter(|axis| axis.links.contains(&link));
        let mut ends: Vec<(Point, String)> =
            touching.map(|axis| (axis.at, axis.name.clone())).collect();
        ends.extend(scene.followed().into_iter().filter_map(|point| {
            let point = &machine.points[point];
            let place = &scene.places[point.link];
            let at = (place * Point3::from(point.at)).xy();
            let (name, _) = named(scene, at, Some(link), &point.name);
            (fixed_to(machine, point.link) == link).then_some((at, name))
        }));
        let mut found: Vec<Length> = Vec::new();
        for (at, name) in ends {
            let length = (at - own.at).norm();
            let again = found
                .iter()
                .any(|known| (known.length - length).abs() < ONE);
            if length > ONE && !again {
                found.push(Length {
                    link: words(&machine.links[link].name),
                    between: format!("{} to {name}", own.name),
                    length,
                });
            }
        }
        let kind = |name: &str| {
            name.trim_end_matches(|c: char| c.is_ascii_digit())
                .to_owned()
        };
        let same = |a: &Length, b: &Length| (a.length - b.length).abs() < ONE;
        let alike = |new: &Length| {
            all.iter()
                .any(|old| same(old, new) && kind(&old.link) == kind(&new.link))
        };
        found.retain(|new| !alike(new));
        all.append(&mut found);
    }
    all
}
