use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{MassProperties, Solid, SolidError, Vector};
use nalgebra::Isometry2;

use super::{Feeder, FeederPart, Plate};
use centrode_kinematics::machine::{
    Closure, Input, Joint, Link, LinkPoint, LinkedMachine, Load, STANDARD_GRAVITY,
};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};

impl FeederPart {
    /// The part on which the part is mounted; `None` for the frame.
    #[must_use]
    pub fn carrier(self) -> Option<Self> {
        match self {
            Self::Frame => None,
            Self::Crank | Self::Rocker | Self::Effector => Some(Self::Frame),
            Self::Coupler => Some(Self::Crank),
            Self::Slider => Some(Self::Effector),
        }
    }

    /// Index of the part's link in the machine of a feeder.
    #[must_use]
    pub fn link(self) -> usize {
        self as usize
    }

    /// Index of the joint that carries the part in the machine of a feeder; for the frame, that of the crank.
    #[must_use]
    pub fn joint(self) -> usize {
        self.link().saturating_sub(1)
    }
}

impl Feeder {
    /// The six-bar as links, joints and closures, with a mass (kg) carried at its tip; without bodies, picture and table.
    ///
    /// The links are those of [`FeederPart::ALL`] in their order, each with its joint. At the rest position of the effector every
    /// frame is parallel to the world's and every joint is zero. The y axis points up. The coupler closes the loop first, the
    /// slider second, both on the rocker at C. The first point is the tip.
    #[must_use]
    pub fn links(&self, carried: f64) -> LinkedMachine {
        let design = self.design();
        let mut machine = LinkedMachine {
            name: design.name.clone(),
            title: design.title.clone(),
            input: Input {
                name: "intermittent gear".into(),
                period: TAU,
                speed: self.speed(),
            },
            gravity: [0.0, -STANDARD_GRAVITY, 0.0],
            ..LinkedMachine::default()
        };
        let rest = |part: FeederPart| self.place(part, self.start()).translation.vector;
        for part in FeederPart::ALL {
            let link = machine.link(Link::new(part.name()));
            let Some(carrier) = part.carrier() else {
                continue;
            };
            let law = self.joint_law(part);
            let joint = if part == FeederPart::Slider {
                let (axis, range) = self.slide();
                Joint::sliding(carrier.link(), link, axis, range, law)
            } else {
                Joint::turning(carrier.link(), link, law)
            };
            let at = rest(part) - rest(carrier);
            machine.joint(joint.at([at.x, at.y, 0.0]));
        }
        for (part, moved) in [
            (
                FeederPart::Coupler,
                [FeederPart::Coupler, FeederPart::Rocker],
            ),
            (
                FeederPart::Slider,
                [FeederPart::Effector, FeederPart::Slider],
            ),
        ] {
            let at = rest(FeederPart::Slider) - rest(part);
            machine.closures.push(Closure {
                links: [part, FeederPart::Rocker].map(FeederPart::link),
                at: [at.x, at.y, 0.0],
                joints: moved.map(FeederPart::joint),
            });
        }
        let link = FeederPart::Effector.link();
        let turned = self.place(FeederPart::Effector, self.start()).rotation;
        let at = turned * Vector::new(self.six_bar().effector_length(), 0.0);
        let at = [at.x, at.y, 0.0];
        machine.points.push(LinkPoint {
            name: "tip".into(),
            link,
            at,
        });
        if carried != 0.0 {
            machine.loads.push(Load::Mass {
                link,
                at,
                mass: carried,
            });
        }
        machine
    }

    /// Plates of a part in the frame of its link, and their total mass. The second plate of the frame is above all other plates.
    ///
    /// # Errors
    /// [`SolidError`] if the plate encloses no volume.
    pub fn bodies(&self, plate: &Plate) -> Result<(Vec<Solid>, MassProperties), SolidError> {
        let place = self.place(plate.part, self.start());
        let turned = Isometry2::new(Vector::zeros(), place.rotation.angle());
        let spec = &self.design().plates;
        let above = 5.0 * (spec.thickness + spec.gap);
        let heights = (0..plate.part.quantity()).map(|k| plate.bottom + f64::from(k) * above);
        let solids = heights.map(|bottom| plate.solid_at(&turned, bottom));
        let solids = solids.collect::<Result<Vec<Solid>, _>>()?;
        let masses: Vec<MassProperties> = solids
            .iter()
            .map(|solid| solid.mass_properties(spec.density))
            .collect();
        let together = MassProperties::combined(&masses).unwrap_or(masses[0]);
        Ok((solids, together))
    }

    /// Direction of the effector's slot at the rest position, and the limits of the slider's motion in it, mm.
    fn slide(&self) -> ([f64; 3], [f64; 2]) {
        let along = self.place(FeederPart::Effector, self.start()).rotation * Vector::x();
        let bar = self.six_bar();
        let now = bar.slider_distance(self.start()).position;
        // The ends of the slot limit the motion.
        let clearance = self.design().plates.slot_clearance;
        let range = [
            bar.minimum_slider_distance() - now - clearance,
            bar.maximum_slider_distance() - now + clearance,
        ];
        ([along.x, along.y, 0.0], range)
    }

    /// Change of a joint's coordinate since the effector left its rest position.
    fn joint_law(&self, part: FeederPart) -> Arc<dyn Transmission> {
        let bar = *self.six_bar();
        let at = move |crank: f64| -> MotionJet {
            let by_crank = MotionJet {
                position: crank,
                velocity: 1.0,
                ..MotionJet::default()
            };
            let four = bar.four_bar();
            match part {
                FeederPart::Frame => MotionJet::default(),
                FeederPart::Crank => by_crank,
                FeederPart::Coupler => four
                    .coupler_angle(crank)
                    .unwrap_or_default()
                    .plus(-1.0, &by_crank),
                FeederPart::Rocker => four.rocker_angle(crank).unwrap_or_default(),
                FeederPart::Effector => bar.effector_angle(crank),
                FeederPart::Slider => bar.slider_distance(crank),
            }
        };
        let (own, start) = (self.clone(), self.start());
        let rest = at(start).position;
        let advance = match part {
            FeederPart::Crank => TAU,
            FeederPart::Coupler => at(start + TAU).position - rest,
            _ => 0.0,
        };
        Arc::new(FromFn::new(TAU, advance, self.breaks(), move |input| {
            let crank = own.crank(input);
            let mut jet = at(crank.position).after(&crank);
            jet.position -= rest;
            jet
        }))
    }
}
