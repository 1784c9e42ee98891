use crate::ExportError;
use centrode_gear::GearPair;
use centrode_groove::{EllipticDrive, MovingBox, Schedule, SpiralShaft};
use centrode_kinematics::machine::GuideForce;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use std::f64::consts::PI;
use std::sync::Arc;

/// A shaft and its drive.
pub(super) struct Parts<'a> {
    pub(super) name: &'a str,
    pub(super) title: &'a str,
    pub(super) shaft: &'a SpiralShaft,
    pub(super) gears: Option<Gears<'a>>,
    pub(super) schedule: Schedule,
    /// Path of the box by the input, mm.
    pub(super) stroke: Arc<dyn Transmission>,
}

/// The elliptic gears that drive a shaft.
pub(super) struct Gears<'a> {
    pub(super) drive: &'a EllipticDrive,
    pub(super) pair: GearPair,
}

impl<'a> Parts<'a> {
    /// A shaft that turns at constant speed.
    pub(super) fn of_shaft(shaft: &'a SpiralShaft) -> Self {
        Self {
            name: &shaft.design().name,
            title: &shaft.design().title,
            shaft,
            gears: None,
            schedule: shaft.schedule(),
            stroke: Arc::new(shaft.traverse().clone()),
        }
    }

    /// A shaft with the gears of its scheme.
    pub(super) fn of_box(machine: &'a MovingBox) -> Result<Self, ExportError> {
        let design = machine.design();
        let gears = match machine.drive() {
            None => None,
            Some(drive) => match design.gear_pair(drive) {
                None => None,
                Some(pair) => {
                    let pair = GearPair::resolve(&pair)?;
                    Some(Gears { drive, pair })
                }
            },
        };
        Ok(Self {
            name: &design.name,
            title: &design.title,
            shaft: machine.shaft(),
            gears,
            schedule: machine.schedule(),
            stroke: Arc::clone(machine.motion()),
        })
    }

    /// Turn of the shaft by the input, rad.
    pub(super) fn turn(&self, input: f64) -> MotionJet {
        match &self.gears {
            Some(gears) => gears.drive.at(input),
            None => MotionJet::uniform(input, 1.0),
        }
    }

    /// Input at which the shaft has turned by an angle, rad.
    pub(super) fn input_at_turn(&self, turn: f64) -> f64 {
        let gears = self.gears.as_ref();
        gears.map_or(turn, |gears| gears.drive.input_at(turn))
    }

    /// Motion of the box by the input, mm and rad.
    pub(super) fn motion(&self, input: f64) -> MotionJet {
        self.stroke.at(input)
    }

    /// Lead angle under the slider by the input, rad: the angle by which the slider has swivelled.
    pub(super) fn swivel(&self, input: f64) -> MotionJet {
        let turn = self.turn(input);
        let (radius, motion) = (
            self.shaft.groove().radius(),
            self.shaft.traverse().at(turn.position),
        );
        let slope = motion.velocity / radius;
        let by_turn = MotionJet::uniform(
            slope.atan(),
            motion.acceleration / radius / (1.0 + slope * slope),
        );
        by_turn.after(&turn)
    }

    /// Forces on the slider; the load's speed is the input's.
    pub(super) fn force(&self, input: f64) -> GuideForce {
        let groove = self.shaft.groove();
        let lead = groove.lead_angle(self.turn(input).position);
        let load = self.shaft.load();
        load.force(self.motion(input), lead, groove.radius())
    }
}

impl Gears<'_> {
    /// Driver angle of the pair at which it turns its mate slowest, rad: 0 or half a turn.
    pub(super) fn slowest(&self) -> f64 {
        if self.pair.ratio(0.0) < self.pair.ratio(PI) {
            0.0
        } else {
            PI
        }
    }

    /// Mounting angle of the driven gear on the shaft, rad: at the slow point the gear has turned by its own angle, the shaft by
    /// `-pick`.
    pub(super) fn rest(&self) -> f64 {
        self.pair.driven_angle(self.slowest()) + self.drive.phase
    }
}
