//! Collisions of pins and shafts with parts that have no hole for them, and of cams and gears with parts at their height.

use std::cell::OnceCell;

use centrode_geometry::{Outline, Point, Tolerance};
use centrode_kinematics::machine::{
    Form, LinkedMachine, SpacerKind, Surface, TurnedPiece, TurnedPieces,
};
use centrode_machines::machine::{BodyPoint, Frames, Machine};

use super::collisions::{PartSurfaces, findings, overlaps};
use crate::Report;

/// Height by which parts that touch may overlap, mm: rounding.
const LEVEL: f64 = 1e-6;

/// Number of steps of the cycle at which a pin is tested to be within a slot. Fewer can miss a pin that leaves it, more
/// take longer.
const SLOT_STEPS: u32 = 360;

/// Kind of the part that surfaces belong to.
#[derive(Clone, Copy)]
enum Kind<'a> {
    /// A pin or shaft with the sleeves on it, or a roller, with its axis in the frame of its link.
    Turned { axis: Point, is_roller: bool },
    /// A plate, with the holes for its pins.
    Plate(&'a [Outline]),
    /// A gear, with its bore.
    Gear(&'a [Outline]),
    /// A cam, with its bore.
    Cam(&'a [Outline]),
}

/// A pin or shaft with the sleeves on it, or a roller.
struct Round {
    name: String,
    link: usize,
    axis: Point,
    surfaces: Vec<Surface>,
    is_roller: bool,
}

/// Reports collisions of pins, shafts and the parts on them, of cams, and of gears with plates.
pub(super) fn collisions(
    composed: &Machine,
    machine: &LinkedMachine,
    ends: &[f64],
    tolerance: Tolerance,
    report: &mut Report,
) {
    let turned = on_axes(composed, machine);
    let mut kinds = Vec::new();
    let mut pieces = Vec::new();
    for round in &turned {
        let all = round.surfaces.iter().collect();
        if let Some(piece) = PartSurfaces::new(&round.name, round.link, all, tolerance) {
            let (axis, is_roller) = (round.axis, round.is_roller);
            kinds.push(Kind::Turned { axis, is_roller });
            pieces.push(piece);
        }
    }
    let parts = parts(composed, machine);
    for (name, link, surface, kind) in &parts {
        if let Some(piece) = PartSurfaces::new(name, *link, vec![surface], tolerance) {
            kinds.push(*kind);
            pieces.push(piece);
        }
    }
    let is_level = |[one, other]: [usize; 2]| {
        let mut own = pieces[one].surfaces.iter();
        own.any(|a| {
            let mut others = pieces[other].surfaces.iter();
            others.any(|b| a.span[0] < b.span[1] && b.span[0] < a.span[1])
        })
    };
    let frames = composed.frames(&Machine::SHARES.map(|share| share * composed.period()));
    let steps = (0..=SLOT_STEPS).map(|k| f64::from(k) / f64::from(SLOT_STEPS) * composed.period());
    let paths = OnceCell::new();
    let paths = || paths.get_or_init(|| composed.frames(&steps.clone().collect::<Vec<_>>()));
    // Turned parts come first in the list.
    let pins_may = |[one, other]: [usize; 2]| {
        let Kind::Turned { axis, is_roller } = kinds[one] else {
            return false;
        };
        let (body, link) = (pieces[one].link, pieces[other].link);
        let own = BodyPoint { body, at: axis };
        let is_free = || match kinds[other] {
            Kind::Turned { axis, .. } => !is_one(&frames, own, link, axis),
            // A roller touches its cam, and passes through no hole.
            Kind::Cam(bores) => !is_roller && !is_in_hole(&frames, own, link, bores),
            Kind::Gear(bores) => is_roller || !is_in_hole(&frames, own, link, bores),
            Kind::Plate(holes) => {
                is_roller
                    || !(is_in_hole(&frames, own, link, holes)
                        || is_in_slot(composed, paths, own, &pieces[one], &pieces[other]))
            }
        };
        is_level([one, other]) && is_free()
    };
    let found = overlaps(composed, machine, &pieces, pins_may, ends, tolerance);
    let remedy = "another layer for a plate or cam on this axis, or for the part that it hits";
    let found = findings("pins-collide", "parts", remedy, &found);
    report.findings.extend(found);
    // Plates among each other, and gears among each other, are checked elsewhere.
    let parts_may = |pair: [usize; 2]| {
        let is_ours = matches!(
            pair.map(|part| kinds[part]),
            [Kind::Cam(_), Kind::Plate(_) | Kind::Gear(_) | Kind::Cam(_)]
                | [Kind::Plate(_) | Kind::Gear(_), Kind::Cam(_)]
                | [Kind::Plate(_), Kind::Gear(_)]
                | [Kind::Gear(_), Kind::Plate(_)]
        );
        is_ours && is_level(pair)
    };
    let found = overlaps(composed, machine, &pieces, parts_may, ends, tolerance);
    let remedy = "another layer for the cam or plate";
    let found = findings("parts-collide", "parts", remedy, &found);
    report.findings.extend(found);
}

/// Each pin and shaft with its sleeves, and the rollers on it.
fn on_axes(composed: &Machine, machine: &LinkedMachine) -> Vec<Round> {
    let mut found = Vec::new();
    for pieces in composed.turned() {
        for piece in &pieces.pieces {
            let Some(link) = machine.link_named(&piece.link) else {
                continue;
            };
            let axis = Point::new(piece.at[0], piece.at[1]);
            let on_it = |name: String, surfaces: Vec<Surface>, is_roller: bool| Round {
                name,
                link,
                axis,
                surfaces,
                is_roller,
            };
            let name = match pieces.pieces.len() {
                1 => pieces.part.name.clone(),
                _ => format!("{} of {}", pieces.part.name, piece.link),
            };
            found.push(on_it(name, bars(pieces, piece), false));
            let rings = pieces.spacers.iter();
            let rollers = rings.filter(|(ring, _)| ring.kind == SpacerKind::Roller);
            found.extend(rollers.map(|(ring, at)| {
                let roller = round(piece, ring.outer, [*at, at + ring.length]);
                on_it(format!("roller of {}", piece.link), vec![roller], true)
            }));
        }
    }
    found
}

/// The bar of a piece and the sleeves on it.
fn bars(pieces: &TurnedPieces, piece: &TurnedPiece) -> Vec<Surface> {
    let bar = round(piece, pieces.part.diameter(), [0.0, pieces.part.length()]);
    let rings = pieces.spacers.iter();
    let sleeves = rings.filter(|(ring, _)| ring.kind != SpacerKind::Roller);
    let sleeves = sleeves.map(|(ring, at)| round(piece, ring.outer, [*at, at + ring.length]));
    std::iter::once(bar).chain(sleeves).collect()
}

/// A cylinder about the axis of a piece, between heights above its lower end.
fn round(piece: &TurnedPiece, diameter: f64, span: [f64; 2]) -> Surface {
    let [x, y, low] = piece.at;
    Surface::new(
        piece.link.clone(),
        Outline::circle(Point::new(x, y), 0.5 * diameter),
        [low + span[0] + LEVEL, low + span[1] - LEVEL],
    )
}

/// Name, link, surface and kind of every plate, gear and cam.
fn parts<'a>(
    composed: &'a Machine,
    machine: &'a LinkedMachine,
) -> Vec<(&'a str, usize, Surface, Kind<'a>)> {
    let mut found = Vec::new();
    for (index, link) in machine.links.iter().enumerate() {
        let shape = link.shape.and_then(|shape| machine.shapes.get(shape));
        let Some(Form::Solids(solids)) = shape.map(|shape| &shape.form) else {
            continue;
        };
        // A link has a surface for each of its solids, in the same order.
        for (&surface, solid) in link.surfaces.iter().zip(solids) {
            let mut surface = machine.surfaces[surface].clone();
            surface.span = [surface.span[0] + LEVEL, surface.span[1] - LEVEL];
            let mut gears = composed.gears().iter();
            let gear = gears.find(|gear| gear.surface_name() == surface.name);
            let mut cams = composed.cams().iter();
            let cam = cams.find(|cam| cam.surface_name() == surface.name);
            let (name, kind) = match (gear, cam) {
                (Some(gear), _) => (&gear.name, Kind::Gear(solid.holes())),
                (None, Some(cam)) => (&cam.name, Kind::Cam(solid.holes())),
                (None, None) => {
                    let slots = composed.slots(index).len();
                    let (pins, _) = solid.holes().split_at(solid.holes().len() - slots);
                    (&link.name, Kind::Plate(pins))
                }
            };
            found.push((&**name, index, surface, kind));
        }
    }
    found
}

/// Whether two axes coincide over the whole cycle.
fn is_one(frames: &Frames, own: BodyPoint, body: usize, axis: Point) -> bool {
    frames.path(body, own).all(|at| (at - axis).norm() < LEVEL)
}

/// Whether the axis of a pin stays in one hole of a part over the whole cycle.
fn is_in_hole(frames: &Frames, own: BodyPoint, link: usize, holes: &[Outline]) -> bool {
    let mut holes = holes.iter();
    holes.any(|hole| frames.path(link, own).all(|at| hole.contains(at)))
}

/// Whether a pin, with the parts on it at the height of a plate, stays within one slot of the plate over the whole cycle.
fn is_in_slot<'a>(
    composed: &Machine,
    paths: impl Fn() -> &'a Frames,
    own: BodyPoint,
    pin: &PartSurfaces<'_>,
    plate: &PartSurfaces<'_>,
) -> bool {
    let is_level = |a: &Surface, b: &Surface| a.span[0] < b.span[1] && b.span[0] < a.span[1];
    let level = pin.surfaces.iter().filter(|a| {
        let mut others = plate.surfaces.iter();
        others.any(|b| is_level(a, b))
    });
    let radii = level.map(|surface| surface.outline.maximum_distance(own.at));
    let radius = radii.fold(0.0, f64::max);
    let slots = composed.slots(plate.link);
    slots.iter().any(|slot| {
        let mut path = paths().path(plate.link, own);
        path.all(|at| slot.depth(at) >= radius - LEVEL)
    })
}
