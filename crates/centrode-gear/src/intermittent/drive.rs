use std::f64::consts::TAU;

use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};

/// Reason why there is no intermittent drive.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntermittentError {
    /// A count of zero.
    #[error("{name} is 0; it must be at least 1")]
    NoTeeth {
        /// Name of the count.
        name: &'static str,
    },
    /// The toothed arc leaves no room for a dwell.
    #[error(
        "{kept} teeth with entry and exit take {motion} rad of the driver's turn, which leaves no dwell: the driver needs more than {kept} pitches"
    )]
    NoDwell {
        /// Number of teeth.
        kept: u32,
        /// Driver angle of the motion, rad.
        motion: f64,
    },
    /// The driven gear does not come to rest where it can be locked again.
    #[error(
        "{kept} teeth move the driven gear by {kept}/{driven} of a turn: for stops at equal angles one of the two numbers must be a multiple of the other"
    )]
    Stops {
        /// Number of teeth.
        kept: u32,
        /// Pitches round the driven gear.
        driven: u32,
    },
    /// The entry angle is out of range.
    #[error("the entry angle is {angle} rad; it must be finite and at least 0")]
    Entry {
        /// Angle as given, rad.
        angle: f64,
    },
}

/// Motion of an intermittent gear pair with circular pitch curves. A toothed arc of the driver turns the driven gear at the arc's
/// own ratio; for the rest of its turn the driver locks the driven gear.
///
/// Both counts are pitches of the whole circle. N teeth turn the driven gear by N of its pitches while the driver turns by N of
/// its own. One driven turn per driver turn with a dwell therefore needs a driver with more pitches than the driven gear: equal
/// pitch circles, a full turn and a dwell contradict each other. Angles are those of the pitch circles; the law holds for teeth
/// that enter and leave without backlash.
///
/// Without an entry the driven gear's speed jumps at the first tooth. An entry of angle beta, by cam plates or a shaped first
/// tooth, accelerates it by w = ratio (10 u³ - 15 u⁴ + 6 u⁵), u from 0 to 1 over beta. The exit slows it likewise: no jump of
/// speed or acceleration. Each takes the driven gear through ratio beta / 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntermittentDrive {
    driver_pitches: u32,
    driven_pitches: u32,
    kept: u32,
    entry: f64,
}

impl IntermittentDrive {
    /// Makes the drive of a driver with `kept` teeth in a row on `driver_pitches` pitches, a driven gear of
    /// `driven_pitches`, and entry and exit of the driver angle `entry` each, rad.
    ///
    /// # Errors
    /// [`IntermittentError`].
    pub fn new(
        driver_pitches: u32,
        driven_pitches: u32,
        kept: u32,
        entry: f64,
    ) -> Result<Self, IntermittentError> {
        for (name, count) in [
            ("the driver's number of pitches", driver_pitches),
            ("the driven gear's number of pitches", driven_pitches),
            ("the driver's number of teeth", kept),
        ] {
            if count == 0 {
                return Err(IntermittentError::NoTeeth { name });
            }
        }
        if !(entry.is_finite() && entry >= 0.0) {
            return Err(IntermittentError::Entry { angle: entry });
        }
        if !kept.is_multiple_of(driven_pitches) && !driven_pitches.is_multiple_of(kept) {
            let driven = driven_pitches;
            return Err(IntermittentError::Stops { kept, driven });
        }
        let drive = Self {
            driver_pitches,
            driven_pitches,
            kept,
            entry,
        };
        let motion = drive.motion_angle();
        if kept >= driver_pitches || motion >= TAU {
            return Err(IntermittentError::NoDwell { kept, motion });
        }
        if 2.0 * entry > motion {
            return Err(IntermittentError::Entry { angle: entry });
        }
        Ok(drive)
    }

    /// Driven turn per driver turn at the toothed arc.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        f64::from(self.driver_pitches) / f64::from(self.driven_pitches)
    }

    /// Driver angle from start to stop of the driven gear, rad: the toothed arc and one entry angle more, because entry and exit
    /// each lose half an entry angle.
    #[must_use]
    pub fn motion_angle(&self) -> f64 {
        TAU * f64::from(self.kept) / f64::from(self.driver_pitches) + self.entry
    }

    /// Driver angle of the dwell, rad.
    #[must_use]
    pub fn dwell_angle(&self) -> f64 {
        TAU - self.motion_angle()
    }

    /// Angle through which the driven gear turns in one driver turn, rad.
    #[must_use]
    pub fn driven_angle(&self) -> f64 {
        TAU * f64::from(self.kept) / f64::from(self.driven_pitches)
    }

    /// Number of positions at which the driven gear stops, and of locking arcs on it.
    #[must_use]
    pub fn stops(&self) -> u32 {
        (self.driven_pitches / self.kept).max(1)
    }

    /// Jump of the driven gear's speed when the motion starts and stops, per driver speed.
    #[must_use]
    pub fn shock(&self) -> f64 {
        if self.entry > 0.0 { 0.0 } else { self.ratio() }
    }

    /// Maximum acceleration of the driven gear, per driver speed squared: 15/8 ratio / entry.
    #[must_use]
    pub fn maximum_acceleration(&self) -> f64 {
        1.875 * self.ratio() / self.entry
    }

    /// Time of the dwell, s, at a driver speed, rad/s.
    #[must_use]
    pub fn dwell_time(&self, speed: f64) -> f64 {
        self.dwell_angle() / speed.abs()
    }

    /// The driven angle as a function of the driver angle; the motion starts at zero.
    #[must_use]
    pub fn transmission(&self) -> impl Transmission + use<> {
        let drive = *self;
        let (motion, entry) = (self.motion_angle(), self.entry);
        let mut breaks = vec![0.0];
        if entry > 0.0 {
            breaks.extend([entry, motion - entry]);
        }
        breaks.push(motion);
        let advance = self.driven_angle();
        FromFn::new(TAU, advance, breaks, move |input: f64| {
            let turns = (input / TAU).floor();
            let mut jet = drive.within(input - turns * TAU);
            jet.position += turns * advance;
            jet
        })
    }

    fn within(&self, input: f64) -> MotionJet {
        let (motion, entry, ratio) = (self.motion_angle(), self.entry, self.ratio());
        if input >= motion {
            return MotionJet::at_rest(self.driven_angle());
        }
        if input < entry {
            return self.ramp(input);
        }
        if input < motion - entry {
            return MotionJet::uniform(ratio * (input - 0.5 * entry), ratio);
        }
        // The exit is the entry in reverse.
        let mirrored = self.ramp(motion - input);
        MotionJet {
            position: self.driven_angle() - mirrored.position,
            velocity: mirrored.velocity,
            acceleration: -mirrored.acceleration,
            jerk: mirrored.jerk,
        }
    }

    fn ramp(&self, input: f64) -> MotionJet {
        let (ratio, beta) = (self.ratio(), self.entry);
        let u = input / beta;
        MotionJet {
            position: ratio * beta * u.powi(4) * (2.5 - 3.0 * u + u * u),
            velocity: ratio * u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u),
            acceleration: ratio / beta * 30.0 * (u * (1.0 - u)).powi(2),
            jerk: ratio / beta.powi(2) * 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pitch_circles_a_full_turn_and_a_dwell_contradict_each_other() {
        let refused = IntermittentDrive::new(30, 30, 30, 0.0);
        assert!(matches!(
            refused,
            Err(IntermittentError::NoDwell { kept: 30, .. })
        ));
        assert!(IntermittentDrive::new(30, 30, 0, 0.0).is_err());
        assert!(IntermittentDrive::new(40, 30, 20, 0.0).is_err());
        assert!(IntermittentDrive::new(40, 30, 30, -0.1).is_err());
        assert!(IntermittentDrive::new(40, 30, 30, f64::NAN).is_err());
        // An entry that eats the dwell.
        assert!(matches!(
            IntermittentDrive::new(40, 30, 30, 1.6),
            Err(IntermittentError::NoDwell { .. })
        ));
        assert!(matches!(
            IntermittentDrive::new(400, 30, 30, 3.0),
            Err(IntermittentError::Entry { .. })
        ));
    }

    #[test]
    fn one_driven_turn_a_driver_turn_and_then_a_dwell() {
        for entry in [0.0, 0.3] {
            let drive = IntermittentDrive::new(40, 30, 30, entry).expect("a drive");
            assert!((drive.ratio() - 4.0 / 3.0).abs() < 1e-15);
            assert!((drive.dwell_angle() - (TAU / 4.0 - entry)).abs() < 1e-14);
            assert_eq!(drive.stops(), 1);
            let law = drive.transmission();
            assert!((law.at(TAU).position - TAU).abs() < 1e-14);
            assert!((law.at(-TAU + 1.0).position - law.at(1.0).position + TAU).abs() < 1e-13);
            assert_eq!(law.at(drive.motion_angle() + 0.1).velocity, 0.0);
            assert_eq!(law.at(2.0).velocity, drive.ratio());
        }
        // 11.11 r/min: a quarter turn of dwell is 1.35 s.
        let drive = IntermittentDrive::new(40, 30, 30, 0.0).expect("a drive");
        assert!((drive.dwell_time(30.0 / 2.7 * TAU / 60.0) - 1.35).abs() < 1e-12);
        assert!((drive.shock() - 4.0 / 3.0).abs() < 1e-15);
        let quarter = IntermittentDrive::new(24, 20, 5, 0.1).expect("a drive");
        assert_eq!(quarter.stops(), 4);
        assert!((quarter.driven_angle() - TAU / 4.0).abs() < 1e-15);
    }

    #[test]
    fn the_entry_takes_the_jump_out_of_speed_and_acceleration() {
        let drive = IntermittentDrive::new(40, 30, 30, 0.4).expect("a drive");
        let law = drive.transmission();
        assert_eq!(drive.shock(), 0.0);
        for at in law.breaks() {
            let (before, after) = (law.at(at - 1e-9), law.at(at));
            assert!((before.position - after.position).abs() < 1e-8);
            assert!((before.velocity - after.velocity).abs() < 1e-7);
            assert!((before.acceleration - after.acceleration).abs() < 1e-6);
        }
        let mut maximum = 0.0_f64;
        for i in 1..6000 {
            let (phi, h) = (f64::from(i) * 0.001 + 1e-5, 1e-6);
            let (a, b, c) = (law.at(phi - h), law.at(phi), law.at(phi + h));
            assert!(((c.position - a.position) / (2.0 * h) - b.velocity).abs() < 1e-7);
            assert!(((c.velocity - a.velocity) / (2.0 * h) - b.acceleration).abs() < 1e-6);
            assert!(((c.acceleration - a.acceleration) / (2.0 * h) - b.jerk).abs() < 1e-3);
            maximum = maximum.max(b.acceleration.abs());
        }
        assert!((maximum / drive.maximum_acceleration() - 1.0).abs() < 1e-4);
    }
}
