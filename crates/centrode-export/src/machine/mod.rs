//! The files of a composed machine: its bodies as plates, its gears and cams, a simulator model, and its motion.

mod curves;
mod parts;

use centrode_formats::drawing::{Color, Drawing, EntityShape, LineType};
use centrode_formats::{Bundle, Format};
use centrode_geometry::{MassProperties, Point, Solid};
use centrode_kinematics::machine::{Form, LinePath, LinkedMachine};
use centrode_machines::machine::{BodyPoint, Hardware, Machine};
use nalgebra::{Isometry2, Matrix3, Point3};

use crate::{ExportError, Options, Package, turned};
pub use curves::curves;

const PATH: &str = "PATH";
const SCENERY: &str = "SCENERY";

/// Mass and inertia of a body without any in a simulator model, kg and kg mm².
const TINY: f64 = 1e-6;
/// Number of segments of the path of a point.
const POINTS: u32 = 360;

/// A composed machine as links and joints, each body a plate.
///
/// # Errors
/// [`ExportError`] where a body is no solid.
pub fn machine(composed: &Machine) -> Result<LinkedMachine, ExportError> {
    let made = composed.machine();
    let mut made = made.map_err(ExportError::no_solid(&composed.design().name))?;
    turned::size(composed.turned(), &mut made);
    Ok(made)
}

/// A composed machine for a picture: [`machine`] without masses, pins and a list of parts.
///
/// # Errors
/// [`ExportError`] where a body is no solid.
pub fn outlined(composed: &Machine) -> Result<LinkedMachine, ExportError> {
    let made = composed.outlined();
    made.map_err(ExportError::no_solid(&composed.design().name))
}

/// The files of a machine in the requested formats, not yet on disk.
///
/// Each body is a plate named after it, each gear and cam a part with its own name; `assembly` is the machine at the start of its
/// cycle, with the paths of its points. MJCF closes the loops by equality constraints; URDF, which has no loops, leaves them open
/// and states this.
///
/// # Errors
/// [`ExportError`], for instance where the tolerance is too coarse.
pub fn files(
    composed: &Machine,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    let design = composed.design();
    if let Some(overlap) = composed.overlapping_holes() {
        return Err(ExportError::missing_at("plates.pin_diameter", overlap));
    }
    let made = machine(composed)?;
    let (name, title) = (&design.name, &design.title);
    let mut package = Package::new("a composed machine", name, title, formats, options);
    if design.hardware() != Hardware::None {
        package.finer_than(composed.plates().pin_diameter, "pins' diameter")?;
    }
    parts::add(&mut package, composed, &made)?;
    package.drawing("assembly", |_| Ok(assembly(composed, &made)))?;
    package.machine(|| Ok(with_masses(&made)))?;
    package.finish()
}

/// The machine with a mass for every moving body, as a simulator needs it: a body without mass gets [`TINY`].
fn with_masses(machine: &LinkedMachine) -> LinkedMachine {
    let mut made = machine.clone();
    for link in made.links.iter_mut().skip(1) {
        link.mass.get_or_insert(MassProperties {
            mass: TINY,
            center: Point3::origin(),
            inertia: Matrix3::identity() * TINY,
        });
    }
    made
}

/// The solids of a link: its plate and its gears.
fn plates(machine: &LinkedMachine, link: usize) -> &[Solid] {
    let shape = machine.links.get(link).and_then(|link| link.shape);
    match shape
        .and_then(|shape| machine.shapes.get(shape))
        .map(|shape| &shape.form)
    {
        Some(Form::Solids(solids)) => solids,
        _ => &[],
    }
}

/// The machine at the start of its cycle, seen along the shafts, one layer per body, with the paths of its points.
fn assembly(composed: &Machine, machine: &LinkedMachine) -> Drawing {
    let mut drawing = Drawing::default().layer(PATH, Color::Blue, LineType::Continuous, 0.18);
    for (index, body) in composed.bodies().iter().enumerate() {
        let layer = body.name.to_uppercase();
        // The frame, and bars that represent bodies without plates, are no parts.
        let line = match index == 0 || composed.bar(index).is_some() {
            true => LineType::Phantom,
            false => LineType::Continuous,
        };
        drawing = drawing.layer(&layer, Color::Foreground, line, 0.35);
        for solid in plates(machine, index) {
            contours(&mut drawing, &layer, solid, &start(composed, index));
        }
        if let Some(bar) = composed.bar(index) {
            let bar = bar.transformed(&start(composed, index));
            drawing.draw(&layer, EntityShape::Contour(bar));
        }
    }
    drawing = scenery(drawing, composed, machine);
    for (_, BodyPoint { body, at }) in composed.points().filter(|(_, point)| point.body > 0) {
        let way = (0..=POINTS).map(|i| {
            let input = composed.period() * f64::from(i) / f64::from(POINTS);
            composed.place(body, at, input)
        });
        drawing.draw(PATH, EntityShape::Polyline(way.collect()));
    }
    drawing
}

/// Pose of a body at the start of the cycle.
fn start(composed: &Machine, body: usize) -> Isometry2<f64> {
    let at = composed.place(body, Point::origin(), 0.0);
    Isometry2::new(at.coords, composed.angle(body, 0.0).position)
}

/// The drawing with the obstacles, as phantoms, where there are any.
fn scenery(mut drawing: Drawing, composed: &Machine, machine: &LinkedMachine) -> Drawing {
    if composed.obstacles().is_empty() {
        return drawing;
    }
    drawing = drawing.layer(SCENERY, Color::Gray, LineType::Phantom, 0.25);
    for obstacle in composed.obstacles() {
        let place = start(composed, obstacle.body);
        let sketch = machine.sketches.iter().find(|s| s.name == obstacle.name);
        for line in sketch.iter().flat_map(|sketch| &sketch.lines) {
            let shape = match &line.path {
                LinePath::Contour(outline) => EntityShape::Contour(outline.transformed(&place)),
                LinePath::Chain(ends) => {
                    let ends = ends.iter().map(|at| place * Point::from(*at));
                    EntityShape::Polyline(ends.collect())
                }
                LinePath::Trace(_) => continue,
            };
            drawing.draw(SCENERY, shape);
        }
    }
    drawing
}

fn contours(drawing: &mut Drawing, layer: &str, solid: &Solid, place: &Isometry2<f64>) {
    drawing.draw(
        layer,
        EntityShape::Contour(solid.outline().transformed(place)),
    );
    for hole in solid.holes() {
        drawing.draw(layer, EntityShape::Contour(hole.transformed(place)));
    }
}
