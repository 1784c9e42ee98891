use centrode_formats::mjcf::Closure;
use centrode_formats::model::{self, Convex, MAX_FACES, Mimic, Model, ModelJoint};
use centrode_geometry::{Mesh, SolidError, Tolerance};
use centrode_kinematics::machine::{Form, JointKind, Link, LinkedMachine, Shape};

use super::motion::Line;
use super::{bodies, motion};

/// A machine as simulators require it.
pub(crate) struct Simulated {
    pub(crate) model: Model,
    /// Loops that the tree of joints leaves open.
    pub(crate) closures: Vec<Closure>,
    /// The meshes that it shows, by file name.
    pub(crate) meshes: Vec<(String, Mesh)>,
}

/// A visible mesh, the name of its file, and its maximum distance from the body, mm.
struct Seen {
    file: String,
    mesh: Mesh,
    off: f64,
}

/// The tree of links; every joint is zero at the start of the cycle.
pub(crate) fn simulated(
    machine: &LinkedMachine,
    lines: &[Line],
    tolerance: Tolerance,
) -> Result<Simulated, SolidError> {
    let seen: Vec<Seen> = machine
        .shapes
        .iter()
        .map(|shape| show(shape, tolerance))
        .collect::<Result<_, _>>()?;
    let touching: Vec<bodies::ContactBodies> = machine
        .surfaces
        .iter()
        .map(|surface| bodies::all(surface, tolerance))
        .collect();
    let link = |link: &Link| model::ModelLink {
        name: link.name.clone(),
        mass: link.mass,
        meshes: meshes(link, &seen),
        collision: link
            .surfaces
            .iter()
            .flat_map(|&surface| touching[surface].bodies.iter().cloned())
            .collect::<Vec<Convex>>(),
    };
    let driving = motion::driving(machine, lines);
    let joints = (0..machine.joints.len()).map(|index| joint(machine, lines, index, driving));
    let model = Model {
        name: machine.name.clone(),
        note: note(machine, lines, &touching, &seen),
        links: machine.links.iter().map(link).collect(),
        joints: joints.collect(),
    };
    let closures = machine.closures.iter().map(|closure| {
        let [first, second] = closure.links.map(|link| machine.links[link].name.clone());
        Closure {
            name: format!("{first}_on_{second}"),
            first,
            second,
            at: closure.at,
        }
    });
    Ok(Simulated {
        closures: closures.collect(),
        meshes: seen
            .into_iter()
            .map(|seen| (seen.file, seen.mesh))
            .collect(),
        model,
    })
}

/// The visible meshes of a link.
fn meshes(link: &Link, seen: &[Seen]) -> Vec<model::Seen> {
    let file = |shape: usize| seen[shape].file.clone();
    let own = link.shape.map(|shape| model::Seen::upright(file(shape)));
    let mounted = link.mounted.iter().map(|body| model::Seen {
        file: file(body.shape),
        at: body.at,
        turn: body.turn,
    });
    own.into_iter().chain(mounted).collect()
}

/// The visible mesh of a shape, with the name of its file.
pub(super) fn shown(shape: &Shape, tolerance: Tolerance) -> Result<(String, Mesh), SolidError> {
    show(shape, tolerance).map(|seen| (seen.file, seen.mesh))
}

/// The visible mesh of a shape; under the name of its part if it is within the tolerance, like the part's own file.
fn show(shape: &Shape, tolerance: Tolerance) -> Result<Seen, SolidError> {
    let (mesh, off) = meshed(&shape.form, tolerance)?;
    let name = if off <= tolerance.mm() && !shape.part.is_empty() {
        &shape.part
    } else {
        &shape.name
    };
    Ok(Seen {
        file: format!("{name}.stl"),
        mesh,
        off,
    })
}

/// The mesh of a body at the tolerance, or at the finest coarser one that simulators accept, and its maximum distance from the
/// body, mm.
pub(super) fn meshed(form: &Form, tolerance: Tolerance) -> Result<(Mesh, f64), SolidError> {
    match form {
        Form::Mesh(mesh, off) => Ok((mesh.clone(), *off)),
        Form::Solids(solids) => {
            let faces = |t| solids.iter().map(|solid| solid.mesh_face_count(t)).sum();
            let coarse = shown_tolerance(tolerance, faces);
            let meshes = solids.iter().map(|solid| solid.mesh(coarse));
            let meshes: Vec<Mesh> = meshes.collect::<Result<_, _>>()?;
            Ok((Mesh::joined(&meshes), coarse.mm()))
        }
        Form::Turned(part) => {
            let body = part.solid()?;
            coarsened(tolerance, |tolerance| body.mesh(tolerance))
        }
        Form::Body(body) => coarsened(tolerance, |tolerance| body.mesh(tolerance)),
    }
}

/// The finest mesh from a function that simulators accept, and its tolerance, mm.
fn coarsened(
    tolerance: Tolerance,
    mesh: impl Fn(Tolerance) -> Result<Mesh, SolidError>,
) -> Result<(Mesh, f64), SolidError> {
    let mut made = None;
    let coarse = shown_tolerance(tolerance, |t| match mesh(t) {
        Ok(mesh) => made.insert(mesh).faces.len(),
        Err(_) => 0,
    });
    let mesh = made.take().map_or_else(|| mesh(coarse), Ok)?;
    Ok((mesh, coarse.mm()))
}

fn joint(
    machine: &LinkedMachine,
    lines: &[Line],
    index: usize,
    driving: Option<usize>,
) -> ModelJoint {
    let about = &machine.joints[index];
    let start = about.law.at(0.0).position;
    let name = |link: usize| machine.links[link].name.clone();
    // A joint can mimic the driving joint if both laws are straight lines.
    let mimic = driving.filter(|&driver| driver != index && about.kind == JointKind::Turning);
    let mimic = mimic.and_then(|driver| {
        let [line, input] = [&lines[index], &lines[driver]];
        (line.is_law() && input.is_law()).then(|| Mimic {
            joint: machine.joint_name(driver),
            multiplier: line.slope / input.slope,
            offset: 0.0,
        })
    });
    let joint = ModelJoint {
        name: machine.joint_name(index),
        kind: match about.kind {
            JointKind::Fixed => model::JointKind::Fixed,
            JointKind::Turning => model::JointKind::Continuous,
            JointKind::Sliding(range) => model::JointKind::Sliding(range),
        },
        parent: name(about.parent),
        child: name(about.child),
        origin: about.origin,
        turn: about.turn,
        axis: about.axis,
        mimic,
    };
    joint.starting_at(start)
}

/// Comment at the head of a model.
fn note(
    machine: &LinkedMachine,
    lines: &[Line],
    touching: &[bodies::ContactBodies],
    seen: &[Seen],
) -> String {
    let table = motion::TABLE;
    let mut note = format!(
        "The laws of motion are in {table}, as motion.json describes. Every joint is zero where the cycle begins. "
    );
    note += if lines.iter().all(Line::is_law) {
        "They are linear and written as mimic joints."
    } else {
        "Those that are not linear are in no mimic joint, which is affine."
    };
    if !machine.closures.is_empty() {
        note += " The loops of the linkage are closed by equality constraints in MJCF. URDF has no loops: there they are open, \
                 and close where all joints are set from the table.";
    }
    let of = |gears: bool| {
        let which = machine.surfaces.iter().zip(touching);
        which
            .filter(|(surface, _)| surface.teeth.is_empty() != gears)
            .map(|(_, bodies)| bodies.excess)
            .reduce(f64::max)
    };
    if let Some(excess) = of(true) {
        note += &format!(
            " Teeth touch as convex bodies, of flanks and tip without fillets, over a hub without bore. These project from the \
             gears by at most {excess:.1e} mm."
        );
    }
    if let Some(excess) = of(false) {
        note += &format!(
            " Other bodies that touch are convex and exceed the parts by at most {excess:.1e} mm."
        );
    }
    if let Some(off) = seen.iter().map(|seen| seen.off).reduce(f64::max) {
        note += &format!(
            " Meshes for display deviate by at most {off:.1e} mm. If possible, each has at most {MAX_FACES} triangles."
        );
    }
    if !machine.note.is_empty() {
        note += " ";
        note += &machine.note;
    }
    note
}

/// The tolerance of a mesh that a model shows: the given one, doubled until the mesh has at most [`MAX_FACES`] triangles. `faces`
/// counts the triangles of the mesh at a tolerance.
fn shown_tolerance(tolerance: Tolerance, mut faces: impl FnMut(Tolerance) -> usize) -> Tolerance {
    // If coarser tolerances do not reduce a mesh enough, it keeps the given tolerance.
    const DOUBLINGS: i32 = 30;
    let coarser = |times: i32| tolerance.scaled(2.0_f64.powi(times));
    (0..DOUBLINGS)
        .map(coarser)
        .find(|&coarse| faces(coarse) <= MAX_FACES)
        .unwrap_or(tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_is_shown_at_its_own_tolerance_or_as_finely_as_the_budget_allows() {
        let tolerance = Tolerance::new(1e-3).expect("positive");
        let shown = |faces: f64| {
            shown_tolerance(tolerance, |t| (faces * tolerance.mm() / t.mm()) as usize).mm()
        };
        assert_eq!(shown(100_000.0), 1e-3);
        assert_eq!(shown(150_000.0), 2e-3);
        assert_eq!(shown(900_000.0), 16e-3);
    }
}
