use std::f64::consts::TAU;

use centrode_geometry::{MassProperties, Mesh, Point, Solid, Tolerance, Vector, convex_pieces};
use centrode_mechanism::gear::Member;
use centrode_mechanism::three_arm::Link as Part;
use nalgebra::Isometry2;

use super::machine::{Machine, no_fork, no_gearbox};
use super::motion;
use super::plate::Plate;
use super::surroundings;
use crate::ExportError;
use crate::gear_pair::contact_bodies;
use crate::model::{Convex, Joint, JointKind, Link, Model, shown_tolerance};

/// Length by which a rod and the ground may slide, as shares of a stroke and of a cycle's travel.
const SLIDE: f64 = 1.0;

/// The model of the machine, and the meshes that it shows by file name.
pub(super) struct Simulated {
    pub(super) model: Model,
    pub(super) meshes: Vec<(String, Mesh)>,
}

/// Where a cam is on the carrier: its frame in the carrier's.
pub(super) fn cam_on_carrier(machine: &Machine<'_>, chain: u32) -> Isometry2<f64> {
    let mechanism = machine.mechanism;
    let share = TAU * f64::from(chain) / f64::from(mechanism.arms());
    let later = -mechanism.train().direction().sign() * share;
    let at = mechanism.on_carrier(Part::Planet(chain));
    Isometry2::new(at.coords, machine.pusher.cam_angle() + later)
}

/// The machine as links and joints.
pub(super) struct Builder<'a> {
    machine: &'a Machine<'a>,
    tolerance: Tolerance,
    links: Vec<Link>,
    joints: Vec<Joint>,
    meshes: Vec<(String, Mesh)>,
    excess: f64,
    /// Tolerance of the coarsest mesh to be seen.
    seen: Tolerance,
}

/// The model of a machine: sun, ground and tray fixed to the base or sliding on it, the carrier on the
/// base, gears and cams on the carrier, arms on planets, forks and rods on arms.
///
/// Gears and arms touch as convex bodies, a tooth one or several; nothing else touches.
pub(super) fn simulated(
    machine: &Machine<'_>,
    tolerance: Tolerance,
) -> Result<Simulated, ExportError> {
    let mut builder = Builder {
        machine,
        tolerance,
        links: Vec::new(),
        joints: Vec::new(),
        meshes: Vec::new(),
        excess: 0.0,
        seen: tolerance,
    };
    builder.link("base", None, None, Vec::new());
    builder.surroundings();
    builder.gears()?;
    builder.arms()?;
    let laws = motion::laws(machine);
    let start = |joint: &Joint| {
        let law = laws.iter().find(|law| law.joint == joint.name);
        law.map_or(0.0, |law| law.at(machine, 0.0))
    };
    let joints = std::mem::take(&mut builder.joints)
        .into_iter()
        .map(|joint| {
            let value = start(&joint);
            joint.starting_at(value)
        });
    let mechanism = machine.mechanism;
    let note = format!(
        "The laws of motion are not linear: mimic joints are affine and cannot hold them, so none is written. They are in motion.csv, \
         as motion.json describes: every joint over one turn of the carrier, repeated beyond it. Every joint is zero where that turn \
         begins: there the gears mesh as they should. Gears touch as convex bodies, of \
         flanks and tip without fillets, over a hub without bore; these stand out of the gears by at most {:.1e} mm. \
         Arms touch as convex bodies of housing and clamp, within {:.1e} mm. \
         Cams, forks and rods, ground, tray and seedlings are there to be seen. Meshes to be seen are within {:.1e} mm. {} arms.",
        builder.excess,
        builder.coarse().mm(),
        builder.seen.mm(),
        mechanism.arms(),
    );
    Ok(Simulated {
        model: Model {
            name: mechanism.design().name.clone(),
            note,
            links: builder.links,
            joints: joints.collect(),
        },
        meshes: builder.meshes,
    })
}

impl Builder<'_> {
    fn link(
        &mut self,
        name: &str,
        mass: Option<MassProperties>,
        mesh: Option<&str>,
        collision: Vec<Convex>,
    ) {
        self.links.push(Link {
            name: name.into(),
            mass,
            mesh: mesh.map(|file| format!("{file}.stl")),
            collision,
        });
    }

    fn joint(
        &mut self,
        (parent, child): (&str, &str),
        kind: JointKind,
        (at, z): (Point, f64),
        turn: f64,
    ) {
        let slides = matches!(kind, JointKind::Sliding(_));
        self.joints.push(Joint {
            name: format!("{child}_joint"),
            kind,
            parent: parent.into(),
            child: child.into(),
            origin: [at.x, at.y, z],
            turn: [0.0, 0.0, turn],
            axis: if slides {
                [1.0, 0.0, 0.0]
            } else {
                [0.0, 0.0, 1.0]
            },
            mimic: None,
        });
    }

    fn shown(&mut self, file: &str, mesh: Mesh) {
        self.meshes.push((format!("{file}.stl"), mesh));
    }

    /// Shows several solids as one mesh of a name; their mass together.
    fn body(
        &mut self,
        file: &str,
        plates: &[(Plate, [f64; 2])],
    ) -> Result<Option<MassProperties>, ExportError> {
        let mut solids: Vec<(super::Part, Solid)> = Vec::new();
        let mut masses = Vec::new();
        for (plate, span) in plates {
            let part = plate.part;
            let named = || ExportError::no_solid(part.name());
            solids.push((part, plate.placed(*span).map_err(named())?));
            masses.push(plate.mass(*span).map_err(named())?);
        }
        let tolerance = shown_tolerance(self.tolerance, |t| {
            solids.iter().map(|(_, solid)| solid.mesh_faces(t)).sum()
        });
        let meshes = solids.iter().map(|(part, solid)| {
            let mesh = solid.mesh(tolerance);
            mesh.map_err(ExportError::no_solid(part.name()))
        });
        let meshes: Vec<Mesh> = meshes.collect::<Result<_, _>>()?;
        self.shown(file, Mesh::joined(&meshes));
        self.seen = self.seen.max(tolerance);
        Ok(MassProperties::together(&masses))
    }

    fn surroundings(&mut self) {
        let mechanism = self.machine.mechanism;
        let origin = (Point::origin(), 0.0);
        self.shown("tray", surroundings::tray_body(mechanism));
        self.link("tray", None, Some("tray"), Vec::new());
        self.joint(("base", "tray"), JointKind::Fixed, origin, 0.0);
        let travel = SLIDE * TAU * mechanism.advance();
        self.shown("ground", surroundings::ground_body(mechanism));
        // What slides must weigh something; as much as the carrier will do.
        let body = &self.machine.gearbox;
        let heavy = Solid::new(body.outline.clone(), Vec::new(), 0.0, 10.0)
            .map(|solid| solid.mass_properties(2000.0))
            .ok();
        self.link("ground", heavy, Some("ground"), Vec::new());
        let slide = JointKind::Sliding([-travel, travel]);
        self.joint(("base", "ground"), slide, origin, 0.0);
    }

    fn gears(&mut self) -> Result<(), ExportError> {
        let machine = self.machine;
        let mechanism = machine.mechanism;
        let plate = machine
            .plate_of(super::Part::Carrier)
            .ok_or_else(no_gearbox)?;
        let [rear, front] = machine.gearbox.spans;
        let carrier = self.body("carrier-body", &[(plate.clone(), rear), (plate, front)])?;
        self.link("carrier", carrier, Some("carrier-body"), Vec::new());
        let origin = (Point::origin(), 0.0);
        self.joint(("base", "carrier"), JointKind::Continuous, origin, 0.0);
        self.gear(super::Part::Sun, "sun")?;
        let start = mechanism.link(Part::Sun, 0.0).angle.position;
        self.joint(("base", "sun"), JointKind::Fixed, origin, start);
        for k in 0..mechanism.arms() {
            let name = format!("intermediate_{k}");
            self.gear(super::Part::Intermediate, &name)?;
            let at = (mechanism.on_carrier(Part::Intermediate(k)), 0.0);
            self.joint(("carrier", &name), JointKind::Continuous, at, 0.0);
            let name = format!("planet_{k}");
            self.gear(super::Part::Planet, &name)?;
            let at = (mechanism.on_carrier(Part::Planet(k)), 0.0);
            self.joint(("carrier", &name), JointKind::Continuous, at, 0.0);
        }
        Ok(())
    }

    /// A gear's link; its mesh is written once.
    fn gear(&mut self, part: super::Part, name: &str) -> Result<(), ExportError> {
        let Some((pair, member)) = self.machine.gear(part) else {
            return Ok(());
        };
        let solid = crate::gear_pair::solid(pair, member)?;
        let tolerance = shown_tolerance(self.tolerance, |t| solid.mesh_faces(t));
        let file = if tolerance == self.tolerance {
            part.name().to_owned()
        } else {
            format!("{}-body", part.name())
        };
        if !self
            .meshes
            .iter()
            .any(|(known, _)| *known == format!("{file}.stl"))
        {
            let named = ExportError::no_solid(part.name());
            let mesh = solid.mesh(tolerance).map_err(named)?;
            self.shown(&file, mesh);
            self.seen = self.seen.max(tolerance);
        }
        // A planet has the teeth of the sun.
        let prefix = match member {
            Member::Driver if same_width(self.machine) => "sun",
            _ => part.name(),
        };
        let (bodies, excess) = contact_bodies(pair.gear(member), prefix, self.tolerance);
        self.excess = self.excess.max(excess);
        let density = pair.gear(member).body().density;
        let mass = solid.mass_properties(density);
        self.link(name, Some(mass), Some(&file), bodies);
        Ok(())
    }

    /// Arms touch nothing as closely as teeth do.
    fn coarse(&self) -> Tolerance {
        self.tolerance.scaled(20.0)
    }

    /// Housing with its covers, and both flakes, as convex bodies in the arm's frame.
    fn arm_bodies(&self) -> Vec<Convex> {
        let covers = ["cover-rear", "cover-front"].map(|name| self.machine.of_arm(name));
        let half = self.coarse().scaled(0.5);
        let mut bodies = Vec::new();
        for name in ["housing", "flake-left", "flake-right"] {
            let Some(part) = self.machine.of_arm(name) else {
                continue;
            };
            let [mut bottom, mut top] = part.span;
            if name == "housing" {
                for [rear, front] in covers.iter().flatten().map(|cover| cover.span) {
                    (bottom, top) = (bottom.min(rear), top.max(front));
                }
            }
            let cut = convex_pieces(&part.outline.flatten(half), half);
            for (i, piece) in cut.pieces.iter().enumerate() {
                bodies.push(Convex {
                    name: format!("arm_{}_{i}", name.replace('-', "_")),
                    mesh: Mesh::prism(piece, bottom, top),
                });
            }
        }
        bodies
    }

    fn arms(&mut self) -> Result<(), ExportError> {
        let machine = self.machine;
        let mechanism = machine.mechanism;
        let level = mechanism.arm_level();
        let plate = |part: super::Part| machine.plate_of(part).ok_or_else(no_fork);
        let mut arm = Vec::new();
        for (part, name) in [
            (super::Part::Housing, "housing"),
            (super::Part::CoverRear, "cover-rear"),
            (super::Part::CoverFront, "cover-front"),
            (super::Part::Clamp, "flake-left"),
            (super::Part::Clamp, "flake-right"),
        ] {
            let span = machine.of_arm(name).map_or([0.0, 1.0], |p| p.span);
            arm.push((plate(part)?, span));
        }
        let arm = self.body("arm-body", &arm)?;
        let cam = [(plate(super::Part::Cam)?, machine.pusher.cam_span())];
        let cam = self.body("cam-body", &cam)?;
        let roller_at = Vector::new(machine.pusher.fork_spec().arm_length, 0.0);
        let mut roller = plate(super::Part::Roller)?;
        let place = Isometry2::new(roller_at, 0.0);
        for outline in roller.holes.iter_mut().chain([&mut roller.outline]) {
            *outline = outline.transformed(&place);
        }
        let fork = [
            (plate(super::Part::Fork)?, machine.pusher.fork_span()),
            (roller, machine.pusher.cam_span()),
        ];
        let fork = self.body("fork-body", &fork)?;
        let rod_span = machine.of_arm("push-rod").map_or([0.0, 1.0], |p| p.span);
        let rod = self.body("push-rod-body", &[(plate(super::Part::PushRod)?, rod_span)])?;
        let touching = self.arm_bodies();
        let on_planet = mechanism.train().arm_on_planet() + mechanism.clamp_mounting();
        for k in 0..mechanism.arms() {
            let name = format!("cam_{k}");
            self.link(&name, cam, Some("cam-body"), Vec::new());
            let place = cam_on_carrier(machine, k);
            let at = Point::from(place.translation.vector);
            let turn = place.rotation.angle();
            self.joint(("carrier", &name), JointKind::Fixed, (at, level), turn);
            let own = format!("arm_{k}");
            self.link(&own, arm, Some("arm-body"), touching.clone());
            let planet = format!("planet_{k}");
            let origin = (Point::origin(), level);
            self.joint((&planet, &own), JointKind::Fixed, origin, on_planet);
            let name = format!("fork_{k}");
            self.link(&name, fork, Some("fork-body"), Vec::new());
            let pivot = (machine.pusher.pivot(), 0.0);
            self.joint((&own, &name), JointKind::Continuous, pivot, 0.0);
            let name = format!("push_rod_{k}");
            self.link(&name, rod, Some("push-rod-body"), Vec::new());
            let slide = JointKind::Sliding([-SLIDE * machine.pusher.stroke(), 0.0]);
            self.joint((&own, &name), slide, (Point::origin(), 0.0), 0.0);
        }
        Ok(())
    }
}

/// Whether sun and planets are as wide: their teeth are then the same bodies.
fn same_width(machine: &Machine<'_>) -> bool {
    let [sun, planet] = machine
        .pairs
        .each_ref()
        .map(|pair| pair.driver().body().width);
    sun == planet
}
