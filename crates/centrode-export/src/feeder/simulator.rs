use crate::ExportError;
use crate::mjcf::Closure;
use crate::model::{Joint, JointKind, Link, Model, shown_tolerance};
use centrode_geometry::{Mesh, Solid, Tolerance, Vector};
use centrode_mechanism::feeder::{Feeder, Part, Plate};
use nalgebra::Isometry2;

/// What the model of a format without loops says.
pub(super) const OPEN: &str = "URDF has no loops: the joints of coupler and rocker, and of slider and rocker, at C are left open \
     here. Set all five joints from motion.csv, as motion.json describes, and they close; the MJCF file closes them itself. \
     Every joint is zero where the effector rests.";

/// What the model of a format with loops says.
pub(super) const CLOSED: &str = "The loops are closed by equality constraints at C, between coupler and rocker and between slider and \
     rocker: turn crank_joint and the others follow. Every joint is zero where the effector rests; motion.csv holds them all.";

pub(super) fn mesh_file(part: &str) -> String {
    format!("links/{part}.stl")
}

/// A plate in the axes of the model's link: parallel to the world's where the effector rests.
fn solid(feeder: &Feeder, plate: &Plate) -> Result<Solid, ExportError> {
    let place = feeder.place(plate.part, feeder.start());
    let turned = Isometry2::new(Vector::zeros(), place.rotation.angle());
    plate
        .solid_at(&turned, plate.bottom)
        .map_err(ExportError::no_solid(plate.part.name()))
}

/// The solids the models show.
pub(super) fn meshes(
    feeder: &Feeder,
    plates: &[Plate],
    tolerance: Tolerance,
) -> Result<Vec<(&'static str, Mesh)>, ExportError> {
    let mesh = |plate: &Plate| {
        let part = plate.part.name();
        let no_solid = ExportError::no_solid(part);
        let solid = solid(feeder, plate)?;
        let shown = shown_tolerance(tolerance, |t| solid.mesh_faces(t));
        Ok((part, solid.mesh(shown).map_err(no_solid)?))
    };
    plates.iter().map(mesh).collect()
}

/// The part another one is mounted on.
fn carrier(part: Part) -> Option<Part> {
    match part {
        Part::Frame => None,
        Part::Crank | Part::Rocker | Part::Effector => Some(Part::Frame),
        Part::Coupler => Some(Part::Crank),
        Part::Slider => Some(Part::Effector),
    }
}

/// The links as a tree, every joint zero where the effector rests.
pub(super) fn model(feeder: &Feeder, plates: &[Plate], note: &str) -> Result<Model, ExportError> {
    let density = feeder.design().plates.density;
    let rest = |part: Part| feeder.place(part, feeder.start()).translation.vector;
    let (mut links, mut joints) = (Vec::new(), Vec::new());
    for plate in plates {
        let part = plate.part;
        links.push(Link {
            name: part.name().into(),
            mass: Some(solid(feeder, plate)?.mass_properties(density)),
            mesh: Some(mesh_file(part.name())),
            collision: Vec::new(),
        });
        let Some(carrier) = carrier(part) else {
            continue;
        };
        let origin = rest(part) - rest(carrier);
        let (kind, axis) = if part == Part::Slider {
            let along = feeder.place(Part::Effector, feeder.start()).rotation;
            let along = along * Vector::x();
            let bar = feeder.six_bar();
            let now = bar.slider_distance(feeder.start()).position;
            // As far as the slot lets it.
            let play = feeder.design().plates.slot_play;
            let kind = JointKind::Sliding([
                bar.least_slider_distance() - now - play,
                bar.greatest_slider_distance() - now + play,
            ]);
            (kind, [along.x, along.y, 0.0])
        } else {
            (JointKind::Continuous, [0.0, 0.0, 1.0])
        };
        joints.push(Joint {
            name: format!("{}_joint", part.name()),
            kind,
            parent: carrier.name().into(),
            child: part.name().into(),
            origin: [origin.x, origin.y, 0.0],
            turn: [0.0; 3],
            axis,
            mimic: None,
        });
    }
    Ok(Model {
        name: feeder.design().name.clone(),
        note: note.into(),
        links,
        joints,
    })
}

/// Where the tree closes: coupler and slider on the rocker at C.
pub(super) fn closures(feeder: &Feeder) -> Vec<Closure> {
    let rest = |part: Part| feeder.place(part, feeder.start()).translation.vector;
    let c = rest(Part::Slider);
    [Part::Coupler, Part::Slider]
        .map(|part| {
            let at = c - rest(part);
            Closure {
                name: format!("{}_on_rocker", part.name()),
                first: part.name().into(),
                second: Part::Rocker.name().into(),
                at: [at.x, at.y, 0.0],
            }
        })
        .into()
}
