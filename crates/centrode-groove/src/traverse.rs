use std::f64::consts::TAU;

use centrode_geometry::bracketed_root;

use super::reversal::{Ends, Turnaround};
use super::{Reversal, ShaftError, ShaftLaw};
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::rule::{count_in_range, finite};

/// Number of samples of a reversal in the search for the slider's turning point.
const SAMPLES: u32 = 512;

/// The slider's whole cycle out and back: forward stroke, reversal, return stroke, reversal.
///
/// The forward stroke runs from a start, by default the shaft angle 0, where the slider is at 0, through `holes - 1` turns; the
/// return stroke is its mirror image in time, shifted along the shaft by `-return_offset`.
/// Position, speed and acceleration are continuous; the motion repeats after [`period`](Transmission::period).
#[derive(Clone, Debug)]
pub struct Traverse {
    law: ShaftLaw,
    holes: u32,
    turnaround: Turnaround,
    return_offset: f64,
    /// Shaft angle at which the forward stroke starts, rad, and the law's motion there.
    start: f64,
    origin: MotionJet,
    /// Shaft angles at which the slider rests, at the far end and at the near one, rad.
    tips: [f64; 2],
}

impl Traverse {
    /// Makes the cycle over `holes` positions one lead apart, from the shaft angle 0.
    ///
    /// # Errors
    /// [`ShaftError`] naming the violated rule and its numbers.
    pub fn new(
        law: ShaftLaw,
        holes: u32,
        reversal: &Reversal,
        return_offset: f64,
    ) -> Result<Self, ShaftError> {
        Self::starting_at(0.0, law, holes, reversal, return_offset)
    }

    /// Makes the cycle over `holes` positions one lead apart, its forward stroke from the shaft angle `start` (rad).
    ///
    /// A shaft that picks at `start` and at every turn from there picks the first and the last hole where the
    /// strokes begin and end, and with a reversal of whole turns the same holes on the return stroke.
    ///
    /// # Errors
    /// [`ShaftError`] naming the violated rule and its numbers.
    pub fn starting_at(
        start: f64,
        law: ShaftLaw,
        holes: u32,
        reversal: &Reversal,
        return_offset: f64,
    ) -> Result<Self, ShaftError> {
        count_in_range("holes", holes, 2, 1000)?;
        finite("start", start)?;
        finite("return_offset", return_offset)?;
        let turnaround = reversal.resolve()?;
        let origin = law.at(start);
        let mut traverse = Self {
            law,
            holes,
            turnaround,
            return_offset,
            start,
            origin,
            tips: [0.0; 2],
        };
        traverse.tips = [
            traverse.tip(start + traverse.stroke())?,
            traverse.tip(start + 2.0 * traverse.stroke() + traverse.reversal())?,
        ];
        Ok(traverse)
    }

    /// Shaft angle in a reversal at which the slider rests.
    fn tip(&self, from: f64) -> Result<f64, ShaftError> {
        let speed = |theta: f64| self.at(theta).velocity;
        let at = |i: u32| from + self.reversal() * f64::from(i) / f64::from(SAMPLES);
        let speeds: Vec<f64> = (0..=SAMPLES).map(|i| speed(at(i))).collect();
        let mut found = (0..SAMPLES).filter(|&i| {
            let pair = [speeds[i as usize], speeds[i as usize + 1]];
            (pair[0] > 0.0) != (pair[1] > 0.0)
        });
        match (found.next(), found.count()) {
            (Some(i), 0) => {
                let pair = [speeds[i as usize], speeds[i as usize + 1]];
                Ok(bracketed_root(speed, at(i), at(i + 1), pair[0], pair[1]))
            }
            (first, more) => Err(ShaftError::TurnsRound(more + usize::from(first.is_some()))),
        }
    }

    /// The law of the strokes.
    #[must_use]
    pub fn law(&self) -> &ShaftLaw {
        &self.law
    }

    /// Number of positions to be picked, one lead apart.
    #[must_use]
    pub fn holes(&self) -> u32 {
        self.holes
    }

    /// Shaft angle at which the forward stroke starts, rad.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Shaft angle of one stroke, rad.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        f64::from(self.holes - 1) * TAU
    }

    /// Shaft angle of one reversal, rad.
    #[must_use]
    pub fn reversal(&self) -> f64 {
        self.turnaround.angle
    }

    /// Distance of the return stroke from the forward one, mm towards the near end.
    #[must_use]
    pub fn return_offset(&self) -> f64 {
        self.return_offset
    }

    /// Shaft turns of the whole cycle.
    #[must_use]
    pub fn turns(&self) -> u32 {
        (self.period() / TAU).round() as u32
    }

    /// Shaft angles at which the slider rests: at the far end, and at the near one.
    #[must_use]
    pub fn tips(&self) -> [f64; 2] {
        self.tips
    }

    /// Minimum and maximum position of the slider, mm.
    #[must_use]
    pub fn reach(&self) -> (f64, f64) {
        let [far, near] = self.tips.map(|theta| self.at(theta).position);
        (near, far)
    }

    /// Distance the slider runs beyond the ends of the strokes, mm: at the far end and at the near one.
    #[must_use]
    pub fn overshoot(&self) -> [f64; 2] {
        let (near, far) = self.reach();
        let length = self.law.moved(0.0, self.stroke());
        [far - length, (-self.return_offset).min(0.0) - near]
    }

    /// Distance the slider sweeps between two shaft angles, mm: the spread of its positions, even if it reverses between them.
    #[must_use]
    pub fn swept(&self, start: f64, stop: f64) -> f64 {
        let period = self.period();
        let inside = self.tips.iter().flat_map(|&tip| {
            let first = ((start - tip) / period).ceil();
            let next = tip + first * period;
            (next < stop).then_some(next)
        });
        let places: Vec<f64> = [start, stop]
            .into_iter()
            .chain(inside)
            .map(|theta| self.at(theta).position)
            .collect();
        let minimum = places.iter().copied().fold(f64::INFINITY, f64::min);
        let maximum = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        maximum - minimum
    }

    /// Shaft angle since the forward stroke last started, rad.
    pub(super) fn since_start(&self, theta: f64) -> f64 {
        (theta - self.start).rem_euclid(self.period())
    }

    /// Motion of the forward stroke, by the shaft angle since its start.
    fn forward(&self, gone: f64) -> MotionJet {
        let mut motion = self.law.at(self.start + gone);
        motion.position -= self.origin.position;
        motion
    }

    fn ends(&self, way: f64) -> Ends {
        Ends {
            speed: way * self.origin.velocity,
            acceleration: self.origin.acceleration,
            shift: -way * self.return_offset,
        }
    }
}

impl Transmission for Traverse {
    fn at(&self, theta: f64) -> MotionJet {
        let (stroke, turn) = (self.stroke(), self.reversal());
        let gone = self.since_start(theta);
        if gone < stroke {
            return self.forward(gone);
        }
        if gone < stroke + turn {
            let mut motion = self.turnaround.at((gone - stroke) / turn, self.ends(1.0));
            motion.position += self.law.lead() * f64::from(self.holes - 1);
            return motion;
        }
        if gone < 2.0 * stroke + turn {
            let out = self.forward(2.0 * stroke + turn - gone);
            return MotionJet {
                position: out.position - self.return_offset,
                velocity: -out.velocity,
                acceleration: out.acceleration,
                jerk: -out.jerk,
            };
        }
        let share = (gone - 2.0 * stroke - turn) / turn;
        let mut motion = self.turnaround.at(share, self.ends(-1.0));
        motion.position -= self.return_offset;
        motion
    }

    fn period(&self) -> f64 {
        2.0 * (self.stroke() + self.reversal())
    }

    fn breaks(&self) -> Vec<f64> {
        let (stroke, turn) = (self.stroke(), self.reversal());
        let of_law = self.law.breaks();
        let mut breaks = vec![0.0, stroke, stroke + turn, 2.0 * stroke + turn];
        for at in self.turnaround.breaks() {
            breaks.push(stroke + at * turn);
            breaks.push(2.0 * stroke + turn + at * turn);
        }
        for i in 0..self.holes - 1 {
            for at in &of_law {
                let out = f64::from(i) * TAU + (at - self.start).rem_euclid(TAU);
                breaks.push(out);
                breaks.push(2.0 * stroke + turn - out);
            }
        }
        for at in &mut breaks {
            *at = (self.start + *at).rem_euclid(self.period());
        }
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|b, a| *b - *a <= 1e-12 * self.period());
        breaks
    }
}
