//! The files of a composed machine: its bodies as plates, a simulator model, its motion.

mod curves;

use centrode_geometry::{Point, Solid};
use centrode_mechanism::composed::Composed;
use centrode_mechanism::machine::{Form, Machine};
use nalgebra::Isometry2;

use crate::drawing::{Color, Drawing, LineType, Shape};
use crate::{Bundle, ExportError, Format, Options, Package, cam, gear_pair};
pub use curves::curves;

const PROFILE: &str = "PROFILE";
const HOLE: &str = "HOLE";
const PATH: &str = "PATH";

/// Points of the way of a point.
const POINTS: u32 = 360;

/// A composed machine as links and joints, each body a plate.
///
/// # Errors
/// [`ExportError`] where a body is no solid.
pub fn machine(composed: &Composed) -> Result<Machine, ExportError> {
    let made = composed.machine();
    made.map_err(ExportError::no_solid(&composed.design().name))
}

/// The files of a composed machine in the formats asked for, not yet on disk.
///
/// Each body is a plate named after it; `assembly` is the machine where its cycle begins, with the ways of its points. MJCF
/// closes the loops by equality constraints; URDF, which has no loops, leaves them open and says so.
///
/// # Errors
/// [`ExportError`], for instance where the tolerance is too coarse.
pub fn files(
    composed: &Composed,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    let design = composed.design();
    let made = machine(composed)?;
    let named = [design.name.as_str(), design.title.as_str()];
    let mut package = Package::new("a composed machine", named, formats, options);
    package.finer_than(design.plates.pin_diameter, "pins' diameter")?;
    // Copies have the files of their originals.
    let is_copy = |name: &String| composed.original(name) != name;
    for (index, body) in composed.bodies().iter().enumerate() {
        let Some(solid) = plates(&made, index).first() else {
            continue;
        };
        let name = &body.name;
        if is_copy(name) {
            continue;
        }
        package.drawing(name, |_| {
            let mut drawing = layers();
            contours(&mut drawing, PROFILE, solid, &Isometry2::identity());
            Ok(drawing)
        })?;
        let title = package.titled(name);
        package.solid(name, &title, || Ok(solid.clone()))?;
    }
    for gear in composed.gears().iter().filter(|gear| !is_copy(&gear.name)) {
        let solid = || gear_pair::solid(&gear.pair, gear.member);
        package.drawing(&gear.name, |_| {
            let mut drawing = layers();
            contours(&mut drawing, PROFILE, &solid()?, &Isometry2::identity());
            Ok(drawing)
        })?;
        let title = package.titled(&gear.name);
        package.solid(&gear.name, &title, solid)?;
    }
    for cam in composed.cams().iter().filter(|cam| !is_copy(&cam.name)) {
        let title = package.titled(&cam.name);
        cam::add(&mut package, &cam.part, &title, options.tolerance)?;
    }
    package.drawing("assembly", |_| Ok(assembly(composed, &made)))?;
    package.machine(|| Ok(made.clone()))?;
    package.finish()
}

/// The plate of a link, and its gears.
fn plates(machine: &Machine, link: usize) -> &[Solid] {
    let shape = machine.links.get(link).and_then(|link| link.shape);
    match shape
        .and_then(|shape| machine.shapes.get(shape))
        .map(|shape| &shape.form)
    {
        Some(Form::Solids(solids)) => solids,
        _ => &[],
    }
}

/// The machine where its cycle begins, seen along the shafts, a layer a body, with the ways of its points.
fn assembly(composed: &Composed, machine: &Machine) -> Drawing {
    let mut drawing = layers().layer(PATH, Color::Blue, LineType::Continuous, 0.18);
    for (index, body) in composed.bodies().iter().enumerate() {
        let layer = body.name.to_uppercase();
        let line = match index {
            0 => LineType::Phantom,
            _ => LineType::Continuous,
        };
        drawing = drawing.layer(&layer, Color::Foreground, line, 0.35);
        let at = composed.place(index, Point::origin(), 0.0);
        let turned = composed.angle(index, 0.0).position;
        for solid in plates(machine, index) {
            contours(
                &mut drawing,
                &layer,
                solid,
                &Isometry2::new(at.coords, turned),
            );
        }
    }
    for (_, body, at) in composed.points().filter(|(_, body, _)| *body > 0) {
        let way = (0..=POINTS).map(|i| {
            let input = composed.period() * f64::from(i) / f64::from(POINTS);
            composed.place(body, at, input)
        });
        drawing.draw(PATH, Shape::Polyline(way.collect()));
    }
    drawing
}

fn contours(drawing: &mut Drawing, layer: &str, solid: &Solid, place: &Isometry2<f64>) {
    drawing.draw(layer, Shape::Contour(solid.outline().transformed(place)));
    let inner = if layer == PROFILE { HOLE } else { layer };
    for hole in solid.holes() {
        drawing.draw(inner, Shape::Contour(hole.transformed(place)));
    }
}

/// The profile last, over the lines of reference.
fn layers() -> Drawing {
    Drawing::default()
        .layer(HOLE, Color::Foreground, LineType::Continuous, 0.35)
        .layer(PROFILE, Color::Foreground, LineType::Continuous, 0.35)
}
