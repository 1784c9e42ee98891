//! Pins and shafts that run into parts through which they have no hole.

use centrode_geometry::{Outline, Point, Solid, Tolerance};
use centrode_mechanism::composed::Composed;
use centrode_mechanism::machine::{Form, Machine, SpacerKind, Surface, TurnedPiece, TurnedPieces};

use super::Made;
use super::collisions::{PartSurfaces, findings, overlaps};
use crate::Report;

/// Shares of the period at which what goes through a hole is in it.
const SHARES: [f64; 4] = [0.0, 0.137, 0.411, 0.732];

/// Owner of surfaces.
#[derive(Clone, Copy)]
enum Kind<'a> {
    /// A pin or shaft with the sleeves on it, or rollers, by its axis in its link.
    Turned { axis: Point, is_roller: bool },
    /// A plate, gear or cam with its holes.
    Part { solid: &'a Solid, is_cam: bool },
}

/// Pins, shafts and what is on them that run into plates, gears or cams.
pub(super) fn collisions(
    made: &Made<'_>,
    machine: &Machine,
    (ends, tolerance): (&[f64], Tolerance),
    report: &mut Report,
) {
    let composed = made.composed;
    let turned = on_axes(composed, machine);
    let mut kinds = Vec::new();
    let mut pieces = Vec::new();
    for (name, link, axis, surfaces, is_roller) in &turned {
        let all = surfaces.iter().collect();
        if let Some(piece) = PartSurfaces::new(name, *link, all, tolerance) {
            let axis = *axis;
            let is_roller = *is_roller;
            kinds.push(Kind::Turned { axis, is_roller });
            pieces.push(piece);
        }
    }
    for (name, link, surface, solid, is_cam) in parts(composed, machine) {
        if let Some(piece) = PartSurfaces::new(name, link, vec![surface], tolerance) {
            kinds.push(Kind::Part { solid, is_cam });
            pieces.push(piece);
        }
    }
    let number = |piece: &PartSurfaces<'_>| {
        pieces
            .iter()
            .position(|known| std::ptr::eq(known, piece))
            .map(|index| kinds[index])
    };
    let may_collide = |[one, other]: [&PartSurfaces<'_>; 2]| {
        let (Some(Kind::Turned { axis, is_roller }), Some(Kind::Part { solid, is_cam })) =
            (number(one), number(other))
        else {
            return false;
        };
        let own = one.surfaces.iter();
        let mut at_height = own.filter(|s| s.span[0] < solid.top() && s.span[1] > solid.bottom());
        // A roller touches its cam.
        !(is_roller && is_cam)
            && at_height.next().is_some()
            && !is_in_hole(composed, (one.link, axis), (other.link, solid))
    };
    let found = overlaps(composed, machine, (&pieces, may_collide), (ends, tolerance));
    let remedy = "another layer for a plate or cam that it joins, or for what it runs into";
    let told = ("pins-collide", "parts", remedy);
    report.findings.extend(findings(told, &found));
}

/// Name, link, axis and surfaces of each pin and shaft with its sleeves, and of the rollers on it.
fn on_axes(
    composed: &Composed,
    machine: &Machine,
) -> Vec<(String, usize, Point, Vec<Surface>, bool)> {
    let mut found = Vec::new();
    for pieces in composed.turned() {
        for piece in &pieces.pieces {
            let Some(link) = machine.link_named(&piece.link) else {
                continue;
            };
            let axis = Point::new(piece.at[0], piece.at[1]);
            let name = &pieces.part.name;
            found.push((name.clone(), link, axis, bars(pieces, piece), false));
            for (ring, at) in &pieces.spacers {
                if ring.kind == SpacerKind::Roller {
                    let roller = round(piece, ring.outer, [*at, at + ring.length]);
                    let name = format!("roller of {}", piece.link);
                    found.push((name, link, axis, vec![roller], true));
                }
            }
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
    Surface {
        name: piece.link.clone(),
        outline: Outline::circle(Point::new(x, y), 0.5 * diameter),
        span: span.map(|z| low + z),
        teeth: Vec::new(),
        coarseness: 1.0,
    }
}

/// Name, link, surface and solid of every plate, gear and cam, and whether it is a cam.
fn parts<'a>(
    composed: &'a Composed,
    machine: &'a Machine,
) -> Vec<(&'a str, usize, &'a Surface, &'a Solid, bool)> {
    let mut found = Vec::new();
    for (index, link) in machine.links.iter().enumerate() {
        let shape = link.shape.and_then(|shape| machine.shapes.get(shape));
        let Some(Form::Solids(solids)) = shape.map(|shape| &shape.form) else {
            continue;
        };
        // A link has a surface for each of its solids, in the same order.
        for (&surface, solid) in link.surfaces.iter().zip(solids) {
            let surface = &machine.surfaces[surface];
            let gears = composed.gears().iter();
            let gear = gears
                .filter(|gear| gear.surface_name() == surface.name)
                .map(|gear| &*gear.name);
            let cams = composed.cams().iter();
            let cam = cams
                .filter(|cam| cam.surface_name() == surface.name)
                .map(|cam| &*cam.name)
                .next();
            let name = gear.chain(cam).next().unwrap_or(&link.name);
            found.push((name, index, surface, solid, cam.is_some()));
        }
    }
    found
}

/// Whether the axis of a pin lies in one hole of a part all through the cycle.
fn is_in_hole(
    composed: &Composed,
    (own, axis): (usize, Point),
    (link, solid): (usize, &Solid),
) -> bool {
    let places = SHARES.map(|share| {
        let input = share * composed.period();
        let at = composed.place(own, axis, input);
        let origin = composed.place(link, Point::origin(), input);
        let turn = nalgebra::Rotation2::new(-composed.angle(link, input).position);
        Point::from(turn * (at - origin))
    });
    let mut holes = solid.holes().iter();
    holes.any(|hole| places.iter().all(|at| hole.contains(*at)))
}
