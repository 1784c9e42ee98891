use std::f64::consts::TAU;
use std::sync::{Arc, Mutex, PoisonError};

use centrode_gear::{GearPair, Member};
use centrode_geometry::{MassProperties, Solid};
use centrode_kinematics::machine::{
    self, Column, Form, GearMesh, Input, Joint, JointKind, Linear, Link, LinkPoint, Quantity,
    STANDARD_GRAVITY, Shape,
};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};
use centrode_machines::three_arm::{LinkMotion, Pusher, ThreeArm, ThreeArmLink};
use nalgebra::Isometry2;

use super::limbs::Limbs;
use super::machine::{Parts, no_gearbox};
use super::{ThreeArmPart, arrangement, figures, surroundings};
use crate::plate::Plate;
use crate::{ExportError, gear_pair};

/// Pose of a cam in the carrier's frame.
pub(super) fn cam_on_carrier(machine: &Parts<'_>, chain: u32) -> Isometry2<f64> {
    let mechanism = machine.mechanism;
    let share = TAU * f64::from(chain) / f64::from(mechanism.arms());
    let later = -mechanism.train().direction().sign() * share;
    let at = mechanism.on_carrier(ThreeArmLink::Planet(chain));
    Isometry2::new(at.coords, machine.pusher.cam_angle() + later)
}

/// Sun and tray fixed to the base, ground sliding on it, the carrier on the base, gears and cams on the carrier, arms on planets,
/// forks and rods on arms. Without parts only moving links: no cams, forks or rods. The gears are drawn with teeth if a pair is
/// given, otherwise by their pitch and tip curves.
pub(super) fn machine(
    mechanism: &ThreeArm,
    parts: Option<&Parts<'_>>,
    teeth: Option<&GearPair>,
) -> Result<machine::LinkedMachine, ExportError> {
    let design = mechanism.design();
    let mut builder = Builder {
        mechanism,
        parts,
        laws: Arc::new(Laws {
            mechanism: mechanism.clone(),
            pusher: parts.map(|parts| parts.pusher.clone()),
            last: (0..mechanism.arms()).map(|_| Mutex::default()).collect(),
        }),
        machine: machine::LinkedMachine {
            name: design.name.clone(),
            title: design.title.clone(),
            input: Input {
                name: "carrier".into(),
                period: TAU,
                speed: mechanism.carrier_speed(),
            },
            note: "Cams, forks and rods, ground, tray and seedlings are there to be seen.".into(),
            gravity: [0.0, -STANDARD_GRAVITY, 0.0],
            ..machine::LinkedMachine::default()
        },
    };
    builder.machine.column(
        "carrier_turn_rad",
        "rad",
        "turn of the carrier from its start, positive in the direction in which it turns",
        Quantity::Input(1.0),
    );
    let base = builder.machine.link(Link::new("base"));
    builder.surroundings(base);
    let carrier = builder.carrier(base)?;
    let sun = builder.sun(base)?;
    let limbs = parts.map(|parts| Limbs::new(parts, &mut builder));
    let limbs = limbs.transpose()?;
    for chain in 0..mechanism.arms() {
        builder.chain(chain, carrier, sun, limbs.as_ref())?;
    }
    builder.ground_column();
    builder.tips();
    figures::draw(mechanism, parts, teeth, &mut builder.machine);
    if let Some(parts) = parts {
        arrangement::annotate(parts, &mut builder.machine);
    }
    Ok(builder.machine)
}

/// Input, and the motions of a chain's links at this input.
type Solved = (f64, [LinkMotion; 3]);

/// The laws of the joints.
#[derive(Debug)]
pub(super) struct Laws {
    pub(super) mechanism: ThreeArm,
    pub(super) pusher: Option<Pusher>,
    /// Last result for each chain.
    last: Vec<Mutex<Option<Solved>>>,
}

impl Laws {
    /// Intermediate gear, planet and arm of a chain: the train is solved once for all its joints.
    fn links(&self, chain: u32, input: f64) -> [LinkMotion; 3] {
        let last = &self.last[chain as usize];
        let known = *last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, links)) = known.filter(|(at, _)| at.to_bits() == input.to_bits()) {
            return links;
        }
        // Computed without the lock: the computation may be cancelled.
        let links = self.mechanism.chain(chain, input).links();
        *last.lock().unwrap_or_else(PoisonError::into_inner) = Some((input, links));
        links
    }
}

/// Index of a shape, and the mass properties of its link.
pub(super) type Seen = (usize, Option<MassProperties>);

pub(super) struct Builder<'a> {
    pub(super) mechanism: &'a ThreeArm,
    parts: Option<&'a Parts<'a>>,
    laws: Arc<Laws>,
    pub(super) machine: machine::LinkedMachine,
}

impl Builder<'_> {
    fn link(&mut self, name: &str, mass: Option<MassProperties>, shape: Option<usize>) -> usize {
        self.machine.link(machine::Link {
            name: name.into(),
            mass,
            shape,
            ..machine::Link::default()
        })
    }

    /// Adds a link with at most a shape and a mass.
    pub(super) fn bodied(&mut self, name: &str, seen: Option<Seen>) -> usize {
        let (shape, mass) = seen.map_or((None, None), |(shape, mass)| (Some(shape), mass));
        self.link(name, mass, shape)
    }

    /// The law of a joint by the carrier's turn.
    pub(super) fn law(
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
            let pushed = laws.pusher.iter().flat_map(Pusher::breaks);
            let own = own.into_iter().chain(pushed);
            breaks.extend(own.map(|b| (b + later).rem_euclid(TAU)));
        }
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        Arc::new(FromFn::new(TAU, advance, breaks, move |input| {
            f(&laws, input)
        }))
    }

    /// Adds the column that holds a joint's coordinate.
    pub(super) fn column(&mut self, joint: usize, name: &str, unit: &str, meaning: &str) {
        let name = format!("{name}_{unit}");
        self.machine
            .column(&name, unit, meaning, Quantity::joint(joint));
    }

    /// Several plates as one body with their total mass.
    pub(super) fn body(
        &mut self,
        name: &str,
        plates: &[(Plate, [f64; 2])],
    ) -> Result<Seen, ExportError> {
        let (mut solids, mut masses): (Vec<Solid>, Vec<_>) = (Vec::new(), Vec::new());
        for (plate, span) in plates {
            let solid = plate.placed(*span);
            let solid = solid.map_err(ExportError::no_solid(&plate.name))?;
            masses.push(solid.mass_properties(plate.density));
            solids.push(solid);
        }
        let shape = self.machine.solids(name, "", solids);
        Ok((shape, MassProperties::combined(&masses)))
    }

    fn surroundings(&mut self, base: usize) {
        let mechanism = self.mechanism;
        let (mut shapes, mut heavy) = ([None; 2], None);
        if let Some(parts) = self.parts {
            let mut seen = |name: &str, mesh| {
                Some(
                    self.machine
                        .shape(Shape::new(name, "", Form::Mesh(mesh, 0.0))),
                )
            };
            shapes = [
                seen("tray", surroundings::tray_body(mechanism)),
                seen("ground", surroundings::ground_body(mechanism)),
            ];
            // A sliding link needs a mass: the mass of a carrier plate is used.
            let outline = parts.gearbox.outline.clone();
            let solid = Solid::new(outline, Vec::new(), 0.0, 10.0);
            heavy = solid.map(|solid| solid.mass_properties(2000.0)).ok();
        }
        let [tray, ground] = shapes;
        let tray = self.link("tray", None, tray);
        self.machine.joint(Joint::fixed(base, tray));
        let ground = self.link("ground", heavy, ground);
        let law = Linear::new(
            0.0,
            mechanism.train().direction().sign() * mechanism.advance(),
        );
        let travel = TAU * mechanism.advance();
        let (axis, range) = ([1.0, 0.0, 0.0], [-travel, travel]);
        let slide = Joint::sliding(base, ground, axis, range, Arc::new(law));
        self.machine.joint(slide);
    }

    fn carrier(&mut self, base: usize) -> Result<usize, ExportError> {
        let carrier = self.bodied("carrier", None);
        if let Some(parts) = self.parts {
            let plate = parts.plate_of(ThreeArmPart::Carrier);
            let plate = plate.ok_or_else(no_gearbox)?;
            let levels = parts.gearbox.spans.map(|[bottom, _]| [0.0, 0.0, bottom]);
            let plates = self.pieces(&plate, &levels)?;
            self.mount(carrier, &plates);
            let spacer = parts.plate_of(ThreeArmPart::Spacer);
            if let (Some(spacer), Some(screws)) = (spacer, &parts.screws[0]) {
                let [[_, bottom], _] = parts.gearbox.spans;
                let at = screws.at.iter().map(|at| [at.x, at.y, bottom]);
                let spacers = self.pieces(&spacer, &at.collect::<Vec<_>>())?;
                self.mount(carrier, &spacers);
            }
        }
        let train = self.mechanism.train();
        let law = Linear::new(train.carrier_start(), train.direction().sign());
        let joint = Joint::turning(base, carrier, Arc::new(law));
        let joint = self.machine.joint(joint);
        let meaning = "direction of the first intermediate gear's axis from the x axis";
        self.column(joint, "carrier", "rad", meaning);
        Ok(carrier)
    }

    fn sun(&mut self, base: usize) -> Result<usize, ExportError> {
        let sun = self.gear(ThreeArmPart::Sun, "sun")?;
        let start = self.mechanism.link(ThreeArmLink::Sun, 0.0).angle.position;
        let joint = Joint::fixed(base, sun).turned([0.0, 0.0, start]);
        self.machine.joint(joint);
        Ok(sun)
    }

    /// A gear's link.
    fn gear(&mut self, part: ThreeArmPart, name: &str) -> Result<usize, ExportError> {
        let Some(parts) = self.parts else {
            return Ok(self.bodied(name, None));
        };
        let (pair, member) = parts.gear(part).ok_or_else(no_gearbox)?;
        // A planet as wide as the sun has the same teeth.
        let teeth = match member {
            Member::Driver if same_width(parts) => ThreeArmPart::Sun.name(),
            _ => part.name(),
        };
        let link = self.bodied(name, None);
        gear_pair::embody(&mut self.machine, link, pair, member, [part.name(), teeth])?;
        Ok(link)
    }

    /// Intermediate gear, planet, cam, arm, fork and rod of a chain.
    fn chain(
        &mut self,
        k: u32,
        carrier: usize,
        sun: usize,
        limbs: Option<&Limbs>,
    ) -> Result<(), ExportError> {
        let mechanism = self.mechanism;
        let name = format!("intermediate_{k}");
        let intermediate = self.gear(ThreeArmPart::Intermediate, &name)?;
        let first = self.on_carrier(carrier, intermediate, k, 0);
        self.column(first, &name, "rad", "intermediate gear against the carrier");
        let name = format!("planet_{k}");
        let planet = self.gear(ThreeArmPart::Planet, &name)?;
        let second = self.on_carrier(carrier, planet, k, 1);
        let meaning = "planet, and the arm with it, against the carrier";
        self.column(second, &name, "rad", meaning);
        for (links, joint) in [
            ([sun, intermediate], first),
            ([intermediate, planet], second),
        ] {
            let copy = k as usize;
            let pressure_angle = mechanism.design().tool.pressure_angle();
            self.machine.meshes.push(GearMesh {
                copy,
                ..GearMesh::new(links, joint, pressure_angle)
            });
        }
        let level = mechanism.arm_level();
        let mut cam = None;
        if let (Some(parts), Some(limbs)) = (self.parts, limbs) {
            let cam = *cam.insert(self.bodied(&format!("cam_{k}"), Some(limbs.cam)));
            let place = cam_on_carrier(parts, k);
            let at = place.translation.vector;
            let fixed = Joint::fixed(carrier, cam).at([at.x, at.y, level]);
            let turned = fixed.turned([0.0, 0.0, place.rotation.angle()]);
            self.machine.joint(turned);
        }
        let touching = limbs.map_or(Vec::new(), |limbs| limbs.touching.clone());
        let arm = self.bodied(&format!("arm_{k}"), None);
        if let Some(limbs) = limbs {
            self.mount(arm, &limbs.arm);
        }
        self.machine.links[arm].surfaces = touching;
        let on_planet = mechanism.train().arm_on_planet() + mechanism.clamp_mounting();
        let fixed = Joint::fixed(planet, arm).at([0.0, 0.0, level]);
        self.machine.joint(fixed.turned([0.0, 0.0, on_planet]));
        if let (Some(parts), Some(limbs), Some(cam)) = (self.parts, limbs, cam) {
            self.pushed(&parts.pusher, k, [cam, arm], limbs);
        }
        Ok(())
    }

    /// The joint of a gear on the carrier: the intermediate gear of a chain (`number` 0), or its planet (1).
    fn on_carrier(&mut self, carrier: usize, gear: usize, chain: u32, number: usize) -> usize {
        let mechanism = self.mechanism;
        let turn = move |laws: &Laws, input: f64| {
            let train = laws.mechanism.train();
            let carrier = MotionJet::uniform(
                train.carrier_start() + train.direction().sign() * input,
                train.direction().sign(),
            );
            let motion = laws.links(chain, input)[number];
            motion.angle.plus(-1.0, &carrier)
        };
        let got = turn(&self.laws, TAU).position - turn(&self.laws, 0.0).position;
        let law = self.law(TAU * (got / TAU).round(), turn);
        let link = [ThreeArmLink::Intermediate, ThreeArmLink::Planet][number](chain);
        let at = mechanism.on_carrier(link);
        let joint = Joint::turning(carrier, gear, law).at([at.x, at.y, 0.0]);
        self.machine.joint(joint)
    }

    fn ground_column(&mut self) {
        let slides =
            |joint: &Joint| joint.parent == 0 && matches!(joint.kind, JointKind::Sliding(_));
        if let Some(joint) = self.machine.joints.iter().position(slides) {
            let meaning = "ground along the x axis, as the machine travels over it";
            self.column(joint, "ground", "mm", meaning);
        }
    }

    /// Adds the tips of the arms and their columns.
    fn tips(&mut self) {
        let [.., tip] = figures::joints(self.mechanism);
        for k in 0..self.mechanism.arms() {
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

/// Whether sun and planets have the same width: then their teeth are the same bodies.
fn same_width(machine: &Parts<'_>) -> bool {
    let [sun, planet] = machine
        .pairs
        .each_ref()
        .map(|pair| pair.driver().body().width);
    sun == planet
}
