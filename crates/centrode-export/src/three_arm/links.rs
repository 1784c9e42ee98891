use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{MassProperties, Solid, Vector};
use centrode_mechanism::gear::Member;
use centrode_mechanism::machine::{
    self, Column, Form, GearMesh, Input, Joint, JointKind, Linear, LinkPoint, Quantity, Shape,
    Surface,
};
use centrode_mechanism::three_arm::{Link, Pusher, ThreeArm};
use centrode_mechanism::transmission::{FromFn, MotionJet, Transmission};
use nalgebra::Isometry2;

use super::machine::Machine;
use super::machine::{no_fork, no_gearbox};
use super::plate::Plate;
use super::{Part, surroundings};
use crate::{ExportError, gear_pair};

/// Times the tolerance by which the bodies of an arm may stand off it: arms touch nothing as closely as teeth do.
const COARSE: f64 = 20.0;

/// Where a cam is on the carrier: its frame in the carrier's.
pub(super) fn cam_on_carrier(machine: &Machine<'_>, chain: u32) -> Isometry2<f64> {
    let mechanism = machine.mechanism;
    let share = TAU * f64::from(chain) / f64::from(mechanism.arms());
    let later = -mechanism.train().direction().sign() * share;
    let at = mechanism.on_carrier(Link::Planet(chain));
    Isometry2::new(at.coords, machine.pusher.cam_angle() + later)
}

/// Sun and tray fixed to the base, ground sliding on it, the carrier on the base, gears and cams on the carrier, arms on
/// planets, forks and rods on arms.
pub(super) fn machine(parts: &Machine<'_>) -> Result<machine::Machine, ExportError> {
    let mechanism = parts.mechanism;
    let design = mechanism.design();
    let mut builder = Builder {
        parts,
        laws: Arc::new(Laws {
            mechanism: mechanism.clone(),
            pusher: parts.pusher.clone(),
        }),
        machine: machine::Machine {
            name: design.name.clone(),
            title: design.title.clone(),
            input: Input {
                name: "carrier".into(),
                period: TAU,
                speed: mechanism.carrier_speed(),
            },
            note: "Cams, forks and rods, ground, tray and seedlings are there to be seen.".into(),
            ..machine::Machine::default()
        },
    };
    builder.machine.column(
        "carrier_turn_rad",
        "rad",
        "turn of the carrier from its start, positive whichever way it turns",
        Quantity::Input(1.0),
    );
    let base = builder.link("base", None, None, Vec::new());
    builder.surroundings(base);
    let carrier = builder.carrier(base)?;
    let sun = builder.sun(base)?;
    let limbs = Limbs::of(&mut builder)?;
    for chain in 0..mechanism.arms() {
        builder.chain(chain, (carrier, sun), &limbs)?;
    }
    builder.ground_column();
    builder.tips();
    Ok(builder.machine)
}

/// The laws of the joints.
#[derive(Debug)]
struct Laws {
    mechanism: ThreeArm,
    pusher: Pusher,
}

/// Index of a shape, what the link weighs, and its surfaces.
type Seen = (usize, Option<MassProperties>);

/// The parts every chain has.
struct Limbs {
    arm: Seen,
    touching: Vec<usize>,
    cam: Seen,
    fork: Seen,
    rod: Seen,
}

struct Builder<'a> {
    parts: &'a Machine<'a>,
    laws: Arc<Laws>,
    machine: machine::Machine,
}

impl Builder<'_> {
    fn link(
        &mut self,
        name: &str,
        mass: Option<MassProperties>,
        shape: Option<usize>,
        surfaces: Vec<usize>,
    ) -> usize {
        self.machine.link(machine::Link {
            name: name.into(),
            mass,
            shape,
            surfaces,
        })
    }

    /// The law of a joint by the carrier's turn.
    fn law(
        &self,
        advance: f64,
        f: impl Fn(&Laws, f64) -> MotionJet + Send + Sync + 'static,
    ) -> Arc<dyn Transmission> {
        let laws = self.laws.clone();
        let mechanism = &laws.mechanism;
        let mut breaks = Vec::new();
        for arm in 0..mechanism.arms() {
            let later = TAU * f64::from(arm) / f64::from(mechanism.arms());
            let own = mechanism.train().breaks();
            let own = own.into_iter().chain(laws.pusher.breaks());
            breaks.extend(own.map(|b| (b + later).rem_euclid(TAU)));
        }
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        Arc::new(FromFn::new(TAU, advance, breaks, move |input| {
            f(&laws, input)
        }))
    }

    /// Adds the column that holds a joint's coordinate.
    fn column(&mut self, joint: usize, name: &str, unit: &str, meaning: &str) {
        let name = format!("{name}_{unit}");
        self.machine
            .column(&name, unit, meaning, Quantity::joint(joint));
    }

    /// Several solids as one body; their mass together.
    fn body(&mut self, name: &str, plates: &[(Plate, [f64; 2])]) -> Result<Seen, ExportError> {
        let (mut solids, mut masses): (Vec<Solid>, Vec<_>) = (Vec::new(), Vec::new());
        for (plate, span) in plates {
            let part = plate.part;
            let named = || ExportError::no_solid(part.name());
            solids.push(plate.placed(*span).map_err(named())?);
            masses.push(plate.mass(*span).map_err(named())?);
        }
        let shape = self.machine.shape(Shape {
            name: name.into(),
            part: String::new(),
            form: Form::Solids(solids),
        });
        Ok((shape, MassProperties::together(&masses)))
    }

    fn surroundings(&mut self, base: usize) {
        let mechanism = self.parts.mechanism;
        let mut seen = |name: &str, mesh| {
            self.machine.shape(Shape {
                name: name.into(),
                part: String::new(),
                form: Form::Mesh(mesh, 0.0),
            })
        };
        let tray = seen("tray", surroundings::tray_body(mechanism));
        let ground = seen("ground", surroundings::ground_body(mechanism));
        let tray = self.link("tray", None, Some(tray), Vec::new());
        self.machine.joint(Joint::fixed(base, tray));
        // What slides must weigh something; as much as the carrier will do.
        let body = &self.parts.gearbox;
        let heavy = Solid::new(body.outline.clone(), Vec::new(), 0.0, 10.0)
            .map(|solid| solid.mass_properties(2000.0))
            .ok();
        let ground = self.link("ground", heavy, Some(ground), Vec::new());
        let law = Linear {
            start: 0.0,
            slope: mechanism.train().direction().sign() * mechanism.advance(),
        };
        let travel = TAU * mechanism.advance();
        let slide = ([1.0, 0.0, 0.0], [-travel, travel]);
        let slide = Joint::sliding(base, ground, slide, Arc::new(law));
        self.machine.joint(slide);
    }

    fn carrier(&mut self, base: usize) -> Result<usize, ExportError> {
        let plate = self.parts.plate_of(Part::Carrier);
        let plate = plate.ok_or_else(no_gearbox)?;
        let [rear, front] = self.parts.gearbox.spans;
        let (shape, mass) = self.body("carrier-body", &[(plate.clone(), rear), (plate, front)])?;
        let carrier = self.link("carrier", mass, Some(shape), Vec::new());
        let train = self.parts.mechanism.train();
        let law = Linear {
            start: train.carrier_start(),
            slope: train.direction().sign(),
        };
        let joint = Joint::turning(base, carrier, Arc::new(law));
        let joint = self.machine.joint(joint);
        let meaning = "direction of the first intermediate gear's axis from the x axis";
        self.column(joint, "carrier", "rad", meaning);
        Ok(carrier)
    }

    fn sun(&mut self, base: usize) -> Result<usize, ExportError> {
        let sun = self.gear(Part::Sun, "sun")?;
        let start = self.parts.mechanism.link(Link::Sun, 0.0).angle.position;
        let joint = Joint::fixed(base, sun).turned([0.0, 0.0, start]);
        self.machine.joint(joint);
        Ok(sun)
    }

    /// A gear's link.
    fn gear(&mut self, part: Part, name: &str) -> Result<usize, ExportError> {
        let (pair, member) = self.parts.gear(part).ok_or_else(no_gearbox)?;
        let solid = gear_pair::solid(pair, member)?;
        let gear = pair.gear(member);
        // A planet has the teeth of the sun.
        let prefix = match member {
            Member::Driver if same_width(self.parts) => Part::Sun.name(),
            _ => part.name(),
        };
        let surface = self.machine.surface(gear_pair::teeth(gear, prefix));
        let mass = solid.mass_properties(gear.body().density);
        let shape = self.machine.shape(Shape {
            name: format!("{}-body", part.name()),
            part: part.name().into(),
            form: Form::Solids(vec![solid]),
        });
        Ok(self.link(name, Some(mass), Some(shape), vec![surface]))
    }

    /// Intermediate gear, planet, cam, arm, fork and rod of a chain.
    fn chain(
        &mut self,
        k: u32,
        (carrier, sun): (usize, usize),
        limbs: &Limbs,
    ) -> Result<(), ExportError> {
        let parts = self.parts;
        let mechanism = parts.mechanism;
        let on_carrier = |link: Link| {
            let at = mechanism.on_carrier(link);
            [at.x, at.y, 0.0]
        };
        let laws = self.laws.clone();
        let turn = |laws: &Laws, link: Link, input: f64| {
            let angle = |link| laws.mechanism.link(link, input).angle;
            angle(link).plus(-1.0, &angle(Link::Carrier))
        };
        let whole = |link: Link| {
            let got = turn(&laws, link, TAU).position - turn(&laws, link, 0.0).position;
            TAU * (got / TAU).round()
        };
        let name = format!("intermediate_{k}");
        let intermediate = self.gear(Part::Intermediate, &name)?;
        let own = Link::Intermediate(k);
        let law = self.law(whole(own), move |laws, input| turn(laws, own, input));
        let joint = Joint::turning(carrier, intermediate, law).at(on_carrier(own));
        let first = self.machine.joint(joint);
        self.column(first, &name, "rad", "intermediate gear against the carrier");
        let name = format!("planet_{k}");
        let planet = self.gear(Part::Planet, &name)?;
        let own = Link::Planet(k);
        let law = self.law(whole(own), move |laws, input| turn(laws, own, input));
        let joint = Joint::turning(carrier, planet, law).at(on_carrier(own));
        let second = self.machine.joint(joint);
        let meaning = "planet, and the arm with it, against the carrier";
        self.column(second, &name, "rad", meaning);
        for (links, joint) in [
            ([sun, intermediate], first),
            ([intermediate, planet], second),
        ] {
            let copy = k as usize;
            self.machine.meshes.push(GearMesh { links, joint, copy });
        }
        let (shape, mass) = limbs.cam;
        let cam = self.link(&format!("cam_{k}"), mass, Some(shape), Vec::new());
        let place = cam_on_carrier(parts, k);
        let at = place.translation.vector;
        let level = mechanism.arm_level();
        let fixed = Joint::fixed(carrier, cam).at([at.x, at.y, level]);
        self.machine
            .joint(fixed.turned([0.0, 0.0, place.rotation.angle()]));
        let (shape, mass) = limbs.arm;
        let arm = self.link(
            &format!("arm_{k}"),
            mass,
            Some(shape),
            limbs.touching.clone(),
        );
        let on_planet = mechanism.train().arm_on_planet() + mechanism.clamp_mounting();
        let fixed = Joint::fixed(planet, arm).at([0.0, 0.0, level]);
        self.machine.joint(fixed.turned([0.0, 0.0, on_planet]));
        let back = move |laws: &Laws, input: f64| {
            let own = laws.mechanism.own_input(input, k);
            laws.pusher.retraction(own)
        };
        let name = format!("fork_{k}");
        let (shape, mass) = limbs.fork;
        let fork = self.link(&name, mass, Some(shape), Vec::new());
        let law = self.law(0.0, move |laws, input| {
            laws.pusher.fork_angle(&back(laws, input))
        });
        let pivot = parts.pusher.pivot();
        let joint = Joint::turning(arm, fork, law).at([pivot.x, pivot.y, 0.0]);
        let joint = self.machine.joint(joint);
        self.column(joint, &name, "rad", "fork against its arm");
        let name = format!("push_rod_{k}");
        let (shape, mass) = limbs.rod;
        let rod = self.link(&name, mass, Some(shape), Vec::new());
        let law = self.law(0.0, move |laws, input| {
            MotionJet::default().plus(-1.0, &back(laws, input))
        });
        let slide = ([1.0, 0.0, 0.0], [-parts.pusher.stroke(), 0.0]);
        let joint = self.machine.joint(Joint::sliding(arm, rod, slide, law));
        let meaning = "push rod along its arm's x axis, zero thrown out";
        self.column(joint, &name, "mm", meaning);
        Ok(())
    }

    fn ground_column(&mut self) {
        let slides =
            |joint: &Joint| joint.parent == 0 && matches!(joint.kind, JointKind::Sliding(_));
        if let Some(joint) = self.machine.joints.iter().position(slides) {
            let meaning = "ground along the x axis, as the machine travels over it";
            self.column(joint, "ground", "mm", meaning);
        }
    }

    /// The tips of the arms and their columns.
    fn tips(&mut self) {
        let tip = self.parts.arm.tip();
        for k in 0..self.parts.mechanism.arms() {
            let Some(link) = self.machine.link_named(&format!("arm_{k}")) else {
                continue;
            };
            let name = format!("tip_{k}");
            let point = self.machine.points.len();
            let columns = ["x", "y"]
                .into_iter()
                .enumerate()
                .map(|(axis, letter)| Column {
                    name: format!("{name}_{letter}_mm"),
                    unit: "mm".into(),
                    meaning: format!("tip of arm {k} in the machine's frame"),
                    quantity: Quantity::Point { point, axis },
                });
            self.machine.columns.extend(columns);
            self.machine.points.push(LinkPoint {
                name,
                link,
                at: [tip.x, tip.y, 0.0],
            });
        }
    }
}

impl Limbs {
    fn of(builder: &mut Builder<'_>) -> Result<Self, ExportError> {
        let parts = builder.parts;
        let plate = |part: Part| parts.plate_of(part).ok_or_else(no_fork);
        let span = |name: &str| parts.of_arm(name).map_or([0.0, 1.0], |p| p.span);
        let arm = [
            (Part::Housing, "housing"),
            (Part::CoverRear, "cover-rear"),
            (Part::CoverFront, "cover-front"),
            (Part::Clamp, "flake-left"),
            (Part::Clamp, "flake-right"),
        ];
        let arm = arm.map(|(part, name)| Ok((plate(part)?, span(name))));
        let arm: Vec<_> = arm.into_iter().collect::<Result<_, ExportError>>()?;
        let pusher = &parts.pusher;
        let place = Vector::new(pusher.fork_spec().arm_length, 0.0);
        let place = Isometry2::new(place, 0.0);
        let mut roller = plate(Part::Roller)?;
        for outline in roller.holes.iter_mut().chain([&mut roller.outline]) {
            *outline = outline.transformed(&place);
        }
        let fork = [
            (plate(Part::Fork)?, pusher.fork_span()),
            (roller, pusher.cam_span()),
        ];
        Ok(Self {
            arm: builder.body("arm-body", &arm)?,
            touching: touching(builder),
            cam: builder.body("cam-body", &[(plate(Part::Cam)?, pusher.cam_span())])?,
            fork: builder.body("fork-body", &fork)?,
            rod: builder.body(
                "push-rod-body",
                &[(plate(Part::PushRod)?, span("push-rod"))],
            )?,
        })
    }
}

/// Surfaces of an arm: its housing with the covers, and both flakes.
fn touching(builder: &mut Builder<'_>) -> Vec<usize> {
    let parts = builder.parts;
    let covers = ["cover-rear", "cover-front"].map(|name| parts.of_arm(name));
    let surfaces = ["housing", "flake-left", "flake-right"].map(|name| {
        let part = parts.of_arm(name)?;
        let [mut bottom, mut top] = part.span;
        if name == "housing" {
            for [rear, front] in covers.iter().flatten().map(|cover| cover.span) {
                (bottom, top) = (bottom.min(rear), top.max(front));
            }
        }
        Some(Surface {
            name: format!("arm_{}", name.replace('-', "_")),
            outline: part.outline.clone(),
            span: [bottom, top],
            teeth: Vec::new(),
            coarseness: COARSE,
        })
    });
    let surfaces = surfaces.into_iter().flatten();
    surfaces
        .map(|surface| builder.machine.surface(surface))
        .collect()
}

/// Whether sun and planets are as wide: their teeth are then the same bodies.
fn same_width(machine: &Machine<'_>) -> bool {
    let [sun, planet] = machine
        .pairs
        .each_ref()
        .map(|pair| pair.driver().body().width);
    sun == planet
}
