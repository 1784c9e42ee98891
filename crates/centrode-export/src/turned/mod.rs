//! Drawings of shafts and pins: parts turned from round bar.

mod across;
mod centre;
mod sheet;

use crate::cutting::{self, CENTER, PROFILE};
use crate::plate::{Exactness, Plate};
use crate::{ExportError, Package, fit};
pub(crate) use across::{across, cutting_plane};
pub(crate) use centre::{centre, centre_mark};
use centrode_formats::drawing::{Drawing, EntityShape};
use centrode_gear::design::BodySpec;
use centrode_geometry::{Outline, Point};
use centrode_kinematics::machine::{LinkedMachine, Spacer, SpacerKind, TurnedPart, TurnedPieces};
use centrode_spec::DrawingSpec;
use std::ops::Deref;

/// Lists turned parts in a machine, their size with its limits as the remark.
pub(crate) fn list(all: &[TurnedPieces], machine: &mut LinkedMachine) {
    for pieces in all {
        machine.add_turned(pieces, remark(pieces));
    }
}

/// Writes the sizes of turned parts into the remarks of the parts that a machine lists.
pub(crate) fn size(all: &[TurnedPieces], machine: &mut LinkedMachine) {
    for pieces in all {
        let listed = machine.parts.iter_mut();
        for part in listed.filter(|part| part.file == pieces.part.name) {
            part.remark = remark(pieces);
        }
    }
}

/// Size of a turned part with its limits, and its role.
fn remark(pieces: &TurnedPieces) -> String {
    let size = fit::shaft(&pieces.fit);
    match &*pieces.role {
        "" => size,
        // Screws have the size in their name.
        role if pieces.fit.size == 0.0 => role.into(),
        role => format!("{size}, {role}"),
    }
}

/// Offers turned parts that are made: for each the contour for the lathe, the sheets, the exact body and its mesh.
pub(crate) fn add(
    all: &[TurnedPieces],
    package: &mut Package<'_>,
    spec: &DrawingSpec,
) -> Result<(), ExportError> {
    for pieces in all.iter().filter(|pieces| pieces.standard.is_none()) {
        let (part, name) = (Drawn(&pieces.part), &*pieces.part.name);
        package.turning(name, |_| Ok(part.drawing()))?;
        let (options, tolerance) = (package.options(), package.tolerance());
        let (supplement, count) = (package.design(), pieces.pieces.len());
        package.sheets(name, || {
            part.sheets(spec, supplement, count, &options.sheet, tolerance)
                .map_err(ExportError::no_sheet(name))
        })?;
        let body = || part.solid().map_err(ExportError::no_solid(name));
        package.shell(name, || Ok(body()?.shell()))?;
        let title = package.titled(name);
        package.mesh(name, &title, |tolerance| {
            body()?.mesh(tolerance).map_err(ExportError::no_solid(name))
        })?;
    }
    for ring in made_rings(all) {
        ring.add(package, spec)?;
    }
    Ok(())
}

/// The sleeves and rollers on turned parts, each once.
fn made_rings(all: &[TurnedPieces]) -> Vec<Plate> {
    let mut found: Vec<Plate> = Vec::new();
    for pieces in all {
        for (spacer, _) in &pieces.spacers {
            let Some(file) = spacer.file() else { continue };
            let quantity = pieces.pieces.len();
            if let Some(known) = found.iter_mut().find(|known| known.name == file) {
                known.quantity += quantity;
                continue;
            }
            let circle = |diameter: f64| Outline::circle(Point::origin(), 0.5 * diameter);
            // A roller turns on its pin and has the same heat treatment.
            let (bore, rim, treatment) = match spacer.kind {
                SpacerKind::Roller => {
                    (&*pieces.fit.hole, Spacer::RIM, &*pieces.part.heat_treatment)
                }
                SpacerKind::Shim | SpacerKind::Sleeve => (Spacer::BORE, "", ""),
            };
            let body = BodySpec {
                width: spacer.length,
                bore: spacer.inner,
                bore_fit: bore.into(),
                heat_treatment: treatment.into(),
                material: pieces.part.material.clone(),
                density: pieces.part.density,
                ..BodySpec::default()
            };
            let bore = Some(circle(spacer.inner));
            let (outer, title) = (circle(spacer.outer), spacer.name());
            let ring = Plate::of_body(&file, &title, outer, bore, &body);
            found.push(Plate {
                quantity,
                classes: [rim.into(), String::new()],
                exactness: (!rim.is_empty()).then_some(Exactness::Rim),
                ..ring
            });
        }
    }
    found
}

/// A turned part for drawings, its axis along x.
struct Drawn<'a>(&'a TurnedPart);

impl Deref for Drawn<'_> {
    type Target = TurnedPart;

    fn deref(&self) -> &TurnedPart {
        self.0
    }
}

impl Drawn<'_> {
    /// Corners of the upper half of its contour, from end to end along x, without the centres of the end faces.
    fn half(&self) -> Vec<Point> {
        let (mut at, c) = (0.0, self.chamfer);
        let mut corners = Vec::new();
        let last = self.steps.len() - 1;
        for (index, step) in self.steps.iter().enumerate() {
            let radius = 0.5 * step.diameter;
            let end = at + step.length;
            let [from, to] =
                [(index == 0, at, 1.0), (index == last, end, -1.0)].map(|(is_end, x, inwards)| {
                    match is_end && c > 0.0 {
                        true => vec![
                            Point::new(x, radius - c),
                            Point::new(x + inwards * c, radius),
                        ],
                        false => vec![Point::new(x, radius)],
                    }
                });
            corners.extend(from.into_iter().chain(to.into_iter().rev()));
            at = end;
        }
        corners.dedup();
        corners
    }

    /// Contour as seen from the side, along x.
    fn silhouette(&self) -> Outline {
        let upper = self.half();
        let lower = upper.iter().map(|p| Point::new(p.x, -p.y));
        let around: Vec<Point> = lower.chain(upper.iter().rev().copied()).collect();
        Outline::polygon(&around)
    }

    fn drawing(&self) -> Drawing {
        let mut drawing = cutting::drawing();
        drawing.draw(PROFILE, EntityShape::Contour(self.silhouette()));
        let [from, to] = [-3.0, self.length() + 3.0].map(|x| Point::new(x, 0.0));
        drawing.draw(CENTER, EntityShape::Line(from, to));
        drawing
    }
}

#[cfg(test)]
mod tests;
