//! Shafts of a composed machine, each through the plates, gears and cams on one axis, turning with one of the bodies.

use std::f64::consts::TAU;

use centrode_geometry::{COMPUTED, Point};
use nalgebra::Isometry2;

use crate::PinHole;
use crate::machine::gears::gearing::Meshing;
use crate::machine::hardware::pins::Axis;
use crate::machine::{BodyPoint, Machine};
use centrode_gear::design::BodySpec;
use centrode_kinematics::machine::{JointKind, Key, Keyway};

/// Wall of a plate next to the hole of a shaft, as a share of the shaft's diameter.
const WALL: f64 = 0.14;
/// Step to which the diameter of a plate about a shaft is rounded, mm.
const STEP: f64 = 0.5;
/// Shaft through plates, gears and cams on one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineShaft {
    /// Name of its first gear or cam, or of its body if it carries neither.
    pub name: String,
    /// Index of the body that it belongs to.
    pub body: usize,
    /// Position of its axis in the body's axes, mm.
    pub at: Point,
    /// Bore, keyway with its direction in the body's axes, tolerance classes and materials of the parts that are fixed on it.
    pub hub: BodySpec,
    /// Whether it is driven from outside.
    pub is_driven: bool,
    /// Parts on the shaft.
    pub parts: Vec<ShaftPart>,
}

/// A plate, gear or cam on a shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftPart {
    /// Name.
    pub name: String,
    /// Index of its body.
    pub body: usize,
    /// Position of the hole or bore in the body's axes, mm.
    pub at: Point,
    /// Whether it is the plate of its body.
    pub is_plate: bool,
    /// Lower and upper face, mm.
    pub span: [f64; 2],
    /// How it is joined.
    pub hold: Hold,
}

/// Joint between a part and a shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold {
    /// By a parallel key, which sets its angle, too.
    Keyed(Key),
    /// Fixed on the shaft without a key; the customer chooses the means.
    Given,
    /// The part turns on the shaft.
    Turning,
    /// The shaft passes through its bore; a bracket holds it on its body.
    Bracket,
    /// The bore or keyway of the part differs from that of the shaft.
    Loose,
}

impl Hold {
    /// Whether the part turns with the shaft.
    #[must_use]
    pub fn is_fixed(self) -> bool {
        matches!(self, Self::Keyed(_) | Self::Given)
    }
}

/// A gear or cam on its axis.
struct Wheel {
    name: String,
    body: usize,
    at: Point,
    /// Dimensions of its body; the direction of the keyway is in the axes of the body that carries it.
    hub: BodySpec,
    span: [f64; 2],
}

impl Machine {
    /// Shafts of the machine's gears and cams, and those by which bodies are driven from outside.
    ///
    /// Each belongs to the body of the gear or cam with the narrowest bore, the highest one of several. Plates and wheels of
    /// this body, and of bodies fixed to it, are fixed on the shaft, with a key if the gear has a keyway. Plates of other bodies
    /// turn on it.
    #[must_use]
    pub fn shafts(&self) -> &[MachineShaft] {
        self.shafts.get_or_init(|| self.found_shafts())
    }

    fn found_shafts(&self) -> Vec<MachineShaft> {
        let wheels = self.wheels();
        let is_own = |body: usize| self.is_driven(body) || self.rigid(body).0 != body;
        if wheels.is_empty() && !(0..self.bodies.len()).any(is_own) {
            return Vec::new();
        }
        let axes = self.axes();
        axes.iter()
            .filter_map(|axis| self.shaft(axis, &wheels))
            .collect()
    }

    /// Gears and cams that have a bore.
    fn wheels(&self) -> Vec<Wheel> {
        let wheel = |name: &String, body: &str, (at, mount), hub: &BodySpec, bottom: f64| {
            let mut hub = hub.clone();
            hub.keyway_angle += mount;
            Some(Wheel {
                name: name.clone(),
                body: self.body_named(body)?,
                at,
                span: [bottom, bottom + hub.width],
                hub,
            })
        };
        let gears = self.gears.iter().filter_map(|gear| {
            let (place, bottom) = ((gear.at, gear.mount), self.gear_bottom(gear));
            wheel(
                &gear.name,
                &gear.body_name,
                place,
                gear.gear().body(),
                bottom,
            )
        });
        let cams = self.cams.iter().filter_map(|cam| {
            let (place, bottom) = ((cam.at, cam.mount), self.cam_bottom(cam));
            wheel(&cam.name, &cam.body_name, place, cam.part.body(), bottom)
        });
        let bored = gears.chain(cams).filter(|wheel| wheel.hub.bore > 0.0);
        bored.collect()
    }

    /// Whether a body turns on the frame by a law of its own, and nothing else in the machine moves it.
    pub(in crate::machine) fn is_driven(&self, body: usize) -> bool {
        let own = &self.bodies[body];
        let law = self
            .design
            .bodies
            .get(&own.name)
            .and_then(|body| body.law.as_ref());
        let is_outside = law.is_some_and(|law| law.follows.is_none() && law.by.is_none());
        let on_frame = own.mount.as_ref();
        is_outside && on_frame.is_some_and(|m| m.carrier == 0 && m.kind == JointKind::Turning)
    }

    /// The body to which a body is fixed, directly or through others, and the pose of the fixed body's axes in it.
    pub(in crate::machine) fn rigid(&self, mut body: usize) -> (usize, Isometry2<f64>) {
        let mut place = Isometry2::identity();
        while let Some(mount) = &self.bodies[body].mount
            && mount.kind == JointKind::Fixed
        {
            place = mount.seat() * place;
            body = mount.carrier;
        }
        (body, place)
    }

    fn shaft(&self, axis: &Axis, wheels: &[Wheel]) -> Option<MachineShaft> {
        let mut own: Vec<&Wheel> = wheels
            .iter()
            .filter(|wheel| axis.is_one(&self.places_of(wheel.body, wheel.at)))
            .collect();
        // The narrowest bore gives the shaft's diameter; brackets hold gears and cams with wider bores.
        own.sort_by(|a, b| {
            let narrower = a.hub.bore.total_cmp(&b.hub.bore);
            narrower.then(b.span[1].total_cmp(&a.span[1]))
        });
        // Bodies that need a shaft at their origin: those driven from outside, and those with another plate fixed to them on
        // this axis.
        let is_own = |&&BodyPoint { body, at }: &&BodyPoint| {
            let here = at.coords.norm() <= COMPUTED * self.design.plates.width;
            let root = self.rigid(body).0;
            let mates = axis
                .holes
                .iter()
                .filter(|other| self.rigid(other.body).0 == root);
            here && (self.is_driven(body) || (root != 0 && mates.count() > 1))
        };
        let driven = axis.holes.iter().find(is_own);
        let plates = &self.design.plates;
        let (name, body, at, hub) = match (own.first(), driven) {
            (Some(first), _) => (first.name.clone(), first.body, first.at, first.hub.clone()),
            (None, Some(&BodyPoint { body, at }))
                if axis.holes.len() > 1 && plates.pin_diameter > 0.0 =>
            {
                // With a keyway the tolerance classes are those of gears, otherwise those of pins.
                let keyway = Keyway::of_bore(plates.pin_diameter);
                let classes = match keyway {
                    Some(_) => BodySpec::default(),
                    None => BodySpec {
                        bore_fit: plates.hole_fit.clone(),
                        shaft_fit: plates.pin_fit.clone(),
                        ..BodySpec::default()
                    },
                };
                let hub = BodySpec {
                    bore: plates.pin_diameter,
                    keyway,
                    material: plates.material.clone(),
                    shaft_heat_treatment: plates.pin_heat_treatment.clone(),
                    density: plates.density,
                    ..classes
                };
                (self.bodies[body].name.clone(), body, at, hub)
            }
            _ => return None,
        };
        let (root, place) = self.rigid(body);
        let with_it = |other: usize| self.rigid(other).0 == root;
        let of_plates = axis.holes.iter().zip(&axis.plates);
        let of_plates = of_plates.map(|(&BodyPoint { body, at }, &span)| {
            let key = hub
                .keyway
                .and_then(|hub| Key::fitting(hub, span[1] - span[0]));
            let hold = match key {
                _ if !with_it(body) => Hold::Turning,
                Some(key) => Hold::Keyed(key),
                None => Hold::Given,
            };
            let (name, is_plate) = (self.bodies[body].name.clone(), true);
            ShaftPart {
                name,
                body,
                at,
                is_plate,
                span,
                hold,
            }
        });
        let of_wheels = own.iter().map(|wheel| {
            let turn = self.rigid(wheel.body).1.rotation.angle() + wheel.hub.keyway_angle
                - place.rotation.angle()
                - hub.keyway_angle;
            let off = (turn - TAU * (turn / TAU).round()).abs();
            let is_seat = (wheel.hub.bore - hub.bore).abs() < COMPUTED
                && wheel.hub.keyway == hub.keyway
                && (hub.keyway.is_none() || off < COMPUTED);
            let key = hub
                .keyway
                .and_then(|hub| Key::fitting(hub, wheel.hub.width));
            let hold = match (with_it(wheel.body), key) {
                (true, Some(key)) if is_seat => Hold::Keyed(key),
                (true, None) if is_seat => Hold::Given,
                (false, _) if wheel.hub.bore > hub.bore => Hold::Bracket,
                _ => Hold::Loose,
            };
            ShaftPart {
                name: wheel.name.clone(),
                body: wheel.body,
                at: wheel.at,
                is_plate: false,
                span: wheel.span,
                hold,
            }
        });
        Some(MachineShaft {
            parts: of_plates.chain(of_wheels).collect(),
            is_driven: self.is_driven(body),
            name,
            body,
            at,
            hub,
        })
    }

    /// Indices of the meshes of a gear in the machine, each with whether the gear is the driven one there.
    #[must_use]
    pub fn meshes_of(&self, gear: &str) -> Vec<(usize, bool)> {
        let is_it = |index: usize| self.gears[index].name == gear;
        let meshes = self.meshes.iter().enumerate();
        let role = |mesh: &Meshing| mesh.gears.into_iter().position(is_it);
        meshes
            .filter_map(|(index, mesh)| Some((index, role(mesh)? == 1)))
            .collect()
    }

    /// The shaft through a body's plate at a position, and the joint between plate and shaft.
    pub(super) fn shaft_at(&self, body: usize, at: Point) -> Option<(&MachineShaft, Hold)> {
        let near = COMPUTED * self.design.plates.width;
        let is_here =
            |part: &&ShaftPart| part.is_plate && part.body == body && (part.at - at).norm() <= near;
        self.shafts().iter().find_map(|shaft| {
            let part = shaft.parts.iter().find(is_here)?;
            Some((shaft, part.hold))
        })
    }

    /// A hole in a body's plate, sized for its shaft or pin.
    pub(in crate::machine) fn hole(&self, body: usize, name: String, at: Point) -> PinHole {
        let spec = &self.design.plates;
        let pin = BodySpec {
            bore: spec.pin_diameter,
            bore_fit: spec.hole_fit.clone(),
            shaft_fit: spec.pin_fit.clone(),
            ..BodySpec::default()
        };
        let hub = self
            .shaft_at(body, at)
            .map_or(pin.clone(), |(shaft, hold)| {
                let own = self.rigid(shaft.body).1.rotation.angle();
                let turn = own - self.rigid(body).1.rotation.angle();
                match hold {
                    Hold::Keyed(_) => BodySpec {
                        keyway_angle: shaft.hub.keyway_angle + turn,
                        ..shaft.hub.clone()
                    },
                    Hold::Given => BodySpec {
                        keyway: None,
                        ..shaft.hub.clone()
                    },
                    _ => BodySpec {
                        bore: shaft.hub.bore,
                        ..pin
                    },
                }
            });
        PinHole { name, at, hub }
    }

    /// Radius of a plate about the hole of a shaft, mm, that leaves a wall; zero if no shaft needs it.
    pub(super) fn boss(&self, body: usize, at: Point) -> f64 {
        let shaft = self.shaft_at(body, at).map(|(shaft, _)| shaft);
        // Round holes of the pins' diameter need none: the plates are wide enough for them.
        let pin = self.design.plates.pin_diameter;
        let shaft = shaft.filter(|shaft| shaft.hub.bore != pin || shaft.hub.keyway.is_some());
        let around = |shaft: &MachineShaft| shaft.hub.bore_reach() + WALL * shaft.hub.bore;
        // The diameter is a multiple of the step.
        shaft.map_or(0.0, |shaft| {
            0.5 * STEP * (2.0 * around(shaft) / STEP).ceil()
        })
    }
}
