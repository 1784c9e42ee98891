use super::machine::{Gears, Machine};
use super::{motion, slider_solid};
use crate::ExportError;
use crate::gear_pair::simulator as pair_model;
use crate::model::{Joint, JointKind, Link, MOST_FACES, Model, shown_tolerance};
use centrode_geometry::{MassProperties, Mesh, Tolerance};
use centrode_mechanism::gear::Member;
use centrode_mechanism::shaft::ShaftSolid;
use nalgebra::{Matrix3, Point3};
use std::f64::consts::{FRAC_PI_2, PI};

/// How far beyond the slider's way the box's joint lets it slide, mm.
const ROOM: f64 = 1.0;
/// Edge of the cube whose inertia the box has, mm.
const CUBE: f64 = 100.0;

/// Prefix of the gears' files in a moving box's bundle.
pub(super) const GEARS: &str = "gears-";

/// The model of the machine, and the meshes of shaft and slider that it shows by file name.
pub(super) struct Simulated {
    pub(super) model: Model,
    pub(super) meshes: Vec<(String, Mesh)>,
}

/// The shaft lying along x of the world, the slider on top of it; the box slides, the slider swivels on its
/// pin, and elliptic gears, if any, stand at the near end.
pub(super) fn simulated(
    machine: &Machine<'_>,
    tolerance: Tolerance,
) -> Result<Simulated, ExportError> {
    let shaft = machine.shaft;
    let (groove, slider) = (shaft.groove(), shaft.slider());
    let slider_solid = slider_solid(shaft)?;
    let block = slider_solid.mass_properties(slider.density);
    let fine = shaft.mesh(tolerance)?;
    let coarse = shown_tolerance(tolerance, |t| {
        // The finest mesh is at hand.
        let mesh = (t != tolerance).then(|| shaft.mesh(t));
        mesh.map_or(fine.faces.len(), |made| {
            made.map_or(0, |mesh| mesh.faces.len())
        })
    });
    let [end, _] = ShaftSolid::new(groove, shaft.body())?.whole();
    let solid = shaft.mass_properties()?;
    let (file, mesh) = if coarse == tolerance {
        ("shaft.stl", fine)
    } else {
        ("shaft-body.stl", shaft.mesh(coarse)?)
    };
    let (low, high) = shaft.traverse().reach();
    let body = |name: &str, mass: Option<MassProperties>, mesh: Option<&str>| Link {
        name: name.into(),
        mass,
        mesh: mesh.map(Into::into),
        collision: Vec::new(),
    };
    let mut links = vec![
        body("base", None, None),
        body("frame", None, None),
        body("shaft", Some(solid), Some(file)),
        body("box", Some(carried(shaft.load().mass - block.mass)), None),
        body("slider", Some(block), Some("slider.stl")),
    ];
    let joint = |child: &str, kind: JointKind, parent: &str| Joint {
        name: format!("{child}_joint"),
        kind,
        parent: parent.into(),
        child: child.into(),
        origin: [0.0; 3],
        turn: [0.0; 3],
        axis: [0.0, 0.0, 1.0],
        mimic: None,
    };
    let mut joints = vec![
        Joint {
            // The frame's z, along the shaft, on the world's x; its x, where the slider is, upwards.
            turn: [PI, -FRAC_PI_2, 0.0],
            ..joint("frame", JointKind::Fixed, "base")
        },
        joint("shaft", JointKind::Continuous, "frame"),
        joint(
            "box",
            JointKind::Sliding([low - ROOM, high + ROOM]),
            "frame",
        ),
        Joint {
            origin: [groove.radius() - slider.reach, 0.0, 0.0],
            // The slider's length on y, its width on z, its pin on x.
            turn: [FRAC_PI_2, 0.0, FRAC_PI_2],
            ..joint("slider", JointKind::Continuous, "box")
        },
    ];
    if let Some(gears) = &machine.gears {
        hang(gears, (end, tolerance), &mut links, &mut joints)?;
    }
    let joints = joints.into_iter().map(|joint| {
        let start = motion::start(machine, &joint.name);
        joint.starting_at(start)
    });
    let model = Model {
        name: machine.name.to_owned(),
        note: note(machine, coarse),
        links,
        joints: joints.collect(),
    };
    let block = slider_solid.mesh(tolerance);
    let block = block.map_err(ExportError::no_solid("slider"))?;
    Ok(Simulated {
        model,
        meshes: vec![(file.to_owned(), mesh), ("slider.stl".to_owned(), block)],
    })
}

/// The box, of which no more is known than what it weighs.
fn carried(mass: f64) -> MassProperties {
    // A slider heavier than all that is moved leaves something to slide all the same.
    let mass = mass.max(1e-3);
    MassProperties {
        mass,
        center: Point3::origin(),
        inertia: Matrix3::identity() * (mass * CUBE * CUBE / 6.0),
    }
}

/// Adds the driver on the frame and its mate on the shaft, whose near end is at the height `end`.
fn hang(
    gears: &Gears<'_>,
    (end, tolerance): (f64, Tolerance),
    links: &mut Vec<Link>,
    joints: &mut Vec<Joint>,
) -> Result<(), ExportError> {
    let of_pair = pair_model::model(&gears.pair, tolerance)?;
    let place =
        |member: Member| crate::gear_pair::solid(&gears.pair, member).map(|solid| solid.bottom());
    for link in of_pair.links.into_iter().skip(1) {
        links.push(Link {
            mesh: link.mesh.map(|file| format!("{GEARS}{file}")),
            ..link
        });
    }
    for joint in of_pair.joints {
        let (kind, parent, x, turn, member) = if joint.child == Member::Driver.name() {
            let a = gears.pair.center_distance();
            (JointKind::Continuous, "frame", -a, 0.0, Member::Driver)
        } else {
            (JointKind::Fixed, "shaft", 0.0, rest(gears), Member::Driven)
        };
        joints.push(Joint {
            kind,
            parent: parent.into(),
            origin: [x, 0.0, end - place(member)?],
            turn: [0.0, 0.0, turn],
            mimic: None,
            ..joint
        });
    }
    Ok(())
}

/// Turn of the driven gear on the shaft, rad: it has turned by its own angle at the slow place when the
/// shaft, by `-pick`, stands there.
fn rest(gears: &Gears<'_>) -> f64 {
    gears.pair.driven_angle(gears.slowest()) + gears.drive.phase
}

fn note(machine: &Machine<'_>, shown: Tolerance) -> String {
    let mut note = format!(
        "The law of motion is in {}, as motion.json describes it; no joint follows another by itself. Every joint is zero \
         where the law begins. The box has the mass moved and the inertia of a cube of {CUBE} mm, and no friction. The shaft is \
         shown within {:?} mm, as finely as {MOST_FACES} triangles allow.",
        motion::TABLE,
        shown.mm(),
    );
    if machine.gears.is_some() {
        note += " The teeth of the gears touch as convex bodies; slider and groove do not touch.";
    } else {
        note += " Slider and groove do not touch.";
    }
    note
}
