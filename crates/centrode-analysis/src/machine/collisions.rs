//! Plates and gears that collide.

use centrode_geometry::{Bounds, Point, Tolerance, Vector, maxima};
use centrode_kinematics::machine::{JointKind, LinkedMachine, Surface};
use centrode_machines::machine::{BodyPoint, Machine, MachineDesign};

use super::clearance::surfaces;
use super::{Made, ends as ends_of, through};
use crate::interference::LinkPair;
use crate::{Finding, Report, Severity, Unit};

/// Accuracy to which collisions of parts are searched, as a share of a plate's width. Ten times more misses small
/// overlaps, ten times less takes longer.
const ACCURACY: f64 = 1e-3;

/// Accuracy of the minimum distance between the circles around two parts, as a share of that distance. A larger share
/// checks more pairs exactly, a smaller one takes longer to find the distance.
const SLACK: f64 = 0.05;

/// Maximum number of colliding pairs of parts of a kind that are reported. Further pairs are counted, but not checked:
/// this limits the time and the length of the report.
const MOST: usize = 30;

/// Surfaces of a link that belong to one part, and a circle around them.
pub(super) struct PartSurfaces<'a> {
    pub(super) name: &'a str,
    pub(super) link: usize,
    pub(super) surfaces: Vec<&'a Surface>,
    center: Point,
    radius: f64,
}

impl<'a> PartSurfaces<'a> {
    /// The part; `None` if it has no surface.
    pub(super) fn new(
        name: &'a str,
        link: usize,
        surfaces: Vec<&'a Surface>,
        tolerance: Tolerance,
    ) -> Option<Self> {
        let corners = |surface: &&Surface| surface.outline.flatten(tolerance);
        let corners: Vec<Point> = surfaces.iter().flat_map(corners).collect();
        if corners.is_empty() {
            return None;
        }
        let center = corners.iter().copied().collect::<Bounds>().center();
        let far = corners.iter().map(|at| (at - center).norm());
        Some(Self {
            name,
            link,
            surfaces,
            center,
            radius: far.fold(0.0, f64::max) + tolerance.mm(),
        })
    }
}

/// Findings of colliding plates, gears, pins and cams of a machine with copied chains, the deepest first: `plates-collide`,
/// `gears-collide`, `pins-collide` and `parts-collide`. The list is empty for a design without copies or with errors.
#[must_use]
pub fn machine_collisions(design: &MachineDesign) -> Vec<Finding> {
    let composed = (!design.copies.is_empty()).then(|| Machine::resolve(design));
    let Some(Ok(composed)) = composed else {
        return Vec::new();
    };
    let mut report = Report::default();
    collisions(&Made::new(&composed), &ends_of(&composed), &mut report);
    let deep = |finding: &Finding| finding.measured.unwrap_or(0.0);
    report.findings.sort_by(|a, b| deep(a).total_cmp(&deep(b)));
    report.findings
}

/// Reports plates, and gears that do not mesh, that share a height and collide.
pub(super) fn collisions(made: &Made<'_>, ends: &[f64], report: &mut Report) {
    let composed = made.composed;
    let tolerance = Tolerance::new(ACCURACY * composed.plates().width);
    let (Some(machine), Ok(tolerance)) = (made.machine(), tolerance) else {
        return;
    };
    let plate = |link: usize| {
        let is_plate = |surface: &&Surface| surface.name == machine.links[link].name;
        let own = surfaces(machine, link).filter(is_plate);
        PartSurfaces::new(&machine.links[link].name, link, own.collect(), tolerance)
    };
    let plates: Vec<PartSurfaces<'_>> = (0..machine.links.len()).filter_map(plate).collect();
    let may_collide = |pair: [usize; 2]| !held(machine, pair.map(|plate| plates[plate].link));
    let found = overlaps(composed, machine, &plates, may_collide, ends, tolerance);
    let remedy = "another layer for one of them, or a narrower plate";
    let found = findings("plates-collide", "the plates of", remedy, &found);
    report.findings.extend(found);
    let gears = composed.gears().iter().filter_map(|gear| {
        let (link, name) = (composed.body_named(gear.body_name())?, gear.surface_name());
        let own = surfaces(machine, link).filter(|surface| surface.name == name);
        PartSurfaces::new(&gear.name, link, own.collect(), tolerance)
    });
    let gears: Vec<PartSurfaces<'_>> = gears.collect();
    let may_collide =
        |pair: [usize; 2]| !is_meshed(composed, machine, pair.map(|gear| &gears[gear]));
    let found = overlaps(composed, machine, &gears, may_collide, ends, tolerance);
    let remedy =
        "fewer copies, smaller gears, or gears of another pair, which lies at another height";
    let found = findings("gears-collide", "gears", remedy, &found);
    report.findings.extend(found);
    through::collisions(composed, machine, ends, tolerance, report);
}

/// Parts of a kind that overlap, and the number of pairs that are not examined because enough overlap.
pub(super) struct Overlaps<'a> {
    found: Vec<Overlap<'a>>,
    left: usize,
}

/// Two parts that overlap, with their minimum clearance (mm, below zero) and the input there.
type Overlap<'a> = ([&'a PartSurfaces<'a>; 2], [f64; 2]);

/// Pairs of parts that overlap within the cycle, among those that may collide. The search ends at the maximum number of
/// reported pairs.
///
/// Parts that only touch, such as plates side by side on one line, do not overlap. Parts whose circles stay apart, and parts
/// at different heights, are dismissed quickly.
pub(super) fn overlaps<'a>(
    composed: &Machine,
    machine: &LinkedMachine,
    pieces: &'a [PartSurfaces<'a>],
    may_collide: impl Fn([usize; 2]) -> bool,
    ends: &[f64],
    tolerance: Tolerance,
) -> Overlaps<'a> {
    let center = |part: &PartSurfaces<'_>| BodyPoint {
        body: part.link,
        at: part.center,
    };
    let centers: Vec<BodyPoint> = pieces.iter().map(center).collect();
    let pairs = meeting(&swept(composed, pieces, &centers, ends));
    let pairs: Vec<[usize; 2]> = pairs
        .into_iter()
        .filter(|pair| may_collide(*pair))
        .collect();
    let together = |input: f64, values: &mut Vec<f64>| {
        let places = composed.moving(&centers, input);
        let near = |&[i, k]: &[usize; 2]| -(places[i].0 - places[k].0).norm();
        values.extend(pairs.iter().map(near));
    };
    let alone = |pair: usize, input: f64| {
        let places = composed.moving(&pairs[pair].map(|number| centers[number]), input);
        -(places[0].0 - places[1].0).norm()
    };
    let slack = |distance: f64| SLACK * distance.abs();
    let nearest = maxima(pairs.len(), together, alone, |_, v| slack(v), ends);
    let near = pairs.iter().zip(nearest).filter_map(|(pair, nearest)| {
        let pair = pair.map(|number| &pieces[number]);
        let reach = pair[0].radius + pair[1].radius;
        (-nearest.value - slack(nearest.value) <= reach).then_some(pair)
    });
    let overlap = |pair: [&'a PartSurfaces<'a>; 2]| -> Option<Overlap<'a>> {
        let surfaces = pair.map(|piece| piece.surfaces.clone());
        let links = pair.map(|piece| piece.link);
        let ready = LinkPair::of_any(machine, links, surfaces, tolerance).ok()??;
        let found = ready.over([0.0, machine.input.period]).ok()?;
        (found.minimum < -tolerance.mm()).then_some((pair, [found.minimum, found.input]))
    };
    let near: Vec<_> = near.collect();
    let mut rest = near.iter();
    let found = rest.by_ref().filter_map(|pair| overlap(*pair));
    Overlaps {
        found: found.take(MOST).collect(),
        left: rest.len(),
    }
}

/// Number of samples of the path of a part's circle between two ends of the parts of a cycle. With fewer samples the
/// boxes are larger and more pairs are examined; more samples take longer.
const SAMPLES: u32 = 24;

/// Box that contains each part over the cycle: around the samples of its circle, enlarged by the longest step between two
/// samples.
fn swept(
    composed: &Machine,
    pieces: &[PartSurfaces<'_>],
    centers: &[BodyPoint],
    ends: &[f64],
) -> Vec<Bounds> {
    let inputs = ends.windows(2).flat_map(|ends| {
        let step = (ends[1] - ends[0]) / f64::from(SAMPLES);
        (0..=SAMPLES).map(move |k| ends[0] + step * f64::from(k))
    });
    let places = composed.places_each(centers, &inputs.collect::<Vec<_>>());
    let own = pieces.iter().enumerate().map(|(number, piece)| {
        let path = places.iter().skip(number).step_by(centers.len());
        let path = path.map(|at| Point::from(*at));
        let steps = path.clone().zip(path.clone().skip(1));
        let longest = steps.map(|(a, b)| (b - a).norm()).fold(0.0, f64::max);
        let (around, margin) = (path.collect::<Bounds>(), piece.radius + longest);
        Bounds {
            min: around.min - Vector::repeat(margin),
            max: around.max + Vector::repeat(margin),
        }
    });
    own.collect()
}

/// Pairs of boxes that meet, in the order of their indices.
fn meeting(boxes: &[Bounds]) -> Vec<[usize; 2]> {
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&a, &b| boxes[a].min.x.total_cmp(&boxes[b].min.x));
    let mut found = Vec::new();
    for (rank, &one) in order.iter().enumerate() {
        let later = order[rank + 1..].iter();
        let later = later.take_while(|&&other| boxes[other].min.x <= boxes[one].max.x);
        let met = later.filter(|&&other| boxes[one].meets(&boxes[other]));
        found.extend(met.map(|&other| [one.min(other), one.max(other)]));
    }
    found.sort_unstable();
    found
}

/// Findings for parts of a kind that overlap, with the given rule, words for the kind, and remedy.
pub(super) fn findings<'a>(
    rule: &'static str,
    kind: &'static str,
    remedy: &'static str,
    overlaps: &'a Overlaps<'a>,
) -> impl Iterator<Item = Finding> + 'a {
    let pairs = overlaps.found.iter();
    let worst = pairs
        .map(|(_, [minimum, _])| Severity::of_overlap(-minimum))
        .max();
    let left = worst.filter(|_| overlaps.left > 0).map(|severity| {
        let message = format!(
            "{} more such pairs come near each other; they are not checked, because {MOST} already collide",
            overlaps.left
        );
        Finding::new(rule, severity, message).remedy(remedy)
    });
    overlaps
        .found
        .iter()
        .map(move |overlap| collision(rule, kind, remedy, overlap))
        .chain(left)
}

/// Finding for two parts of a kind that overlap.
fn collision(
    rule: &'static str,
    kind: &str,
    remedy: &'static str,
    &(pair, [minimum, input]): &Overlap<'_>,
) -> Finding {
    let [one, other] = pair;
    Finding::new(
        rule,
        Severity::of_overlap(-minimum),
        format!(
            "{kind} {} and {} share a height and overlap by {} at an input of {}",
            one.name,
            other.name,
            Unit::Millimetre.with_unit(-minimum),
            Unit::Angle.with_unit(input)
        ),
    )
    .measured(minimum, 0.0, Unit::Millimetre)
    .remedy(remedy)
    .on(one.name)
    .at(input)
}

/// Whether two gears are designed to mesh, or do not move relative to each other.
fn is_meshed(
    composed: &Machine,
    machine: &LinkedMachine,
    [one, other]: [&PartSurfaces<'_>; 2],
) -> bool {
    let both = [one.link, other.link];
    let mut meshes = machine.meshes.iter();
    let mut loops = composed.whole().meshes.values();
    let is_of = |gears: &[String; 2]| {
        [one, other]
            .iter()
            .all(|gear| gears.iter().any(|name| name == gear.name))
    };
    meshes.any(|mesh| meet(mesh.links, both))
        || loops.any(|mesh| is_of(&mesh.gears))
        || stands_on(machine, both)
}

/// Whether two pairs of links are the same, in either order.
fn meet([a, b]: [usize; 2], links: [usize; 2]) -> bool {
    [a, b] == links || [b, a] == links
}

/// Whether a joint or pin connects two links, or the links do not move relative to each other.
fn held(machine: &LinkedMachine, links: [usize; 2]) -> bool {
    let mut joints = machine.joints.iter();
    let joined = joints.any(|joint| meet([joint.parent, joint.child], links));
    let pinned = machine.closures.iter().any(|pin| meet(pin.links, links));
    joined || pinned || stands_on(machine, links)
}

/// Whether two links do not move relative to each other.
fn stands_on(machine: &LinkedMachine, links: [usize; 2]) -> bool {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_boxes_that_meet_are_those_of_all_pairs() {
        // Boxes of several sizes at positions that no grid repeats, some on one line.
        let boxes = |count: u32, size: f64| {
            let at = |i: u32, k: f64| 100.0 * (k * f64::from(i)).fract();
            let own = move |i: u32| {
                let low = Point::new(
                    at(i, 0.618),
                    if i.is_multiple_of(5) {
                        7.0
                    } else {
                        at(i, 0.414)
                    },
                );
                let span = Vector::new(at(i, 0.732), at(i, 0.236)) * size;
                let (min, max) = (low, low + span);
                Bounds { min, max }
            };
            (0..count).map(own).collect::<Vec<Bounds>>()
        };
        for (count, size) in [
            (0, 1.0),
            (1, 1.0),
            (2, 1.0),
            (40, 0.01),
            (40, 0.1),
            (60, 0.0),
        ] {
            let boxes = boxes(count, size);
            let numbers = 0..boxes.len();
            let pairs = numbers.flat_map(|i| (i + 1..boxes.len()).map(move |k| [i, k]));
            let pairs: Vec<_> = pairs.filter(|[i, k]| boxes[*i].meets(&boxes[*k])).collect();
            assert_eq!(meeting(&boxes), pairs, "{count} {size}");
        }
    }
}
