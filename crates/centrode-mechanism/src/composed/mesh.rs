use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::bracketed_root;

use crate::gear::Rolling;
use crate::transmission::{MotionJet, Transmission, sorted};

/// Looks at a turn of the input in the search for where a pitch curve's bends jump.
const LOOKS: u32 = 720;

/// Sum of a constant and joint coordinates: the angle of a body, or of a gear on it, without jumps.
#[derive(Clone, Debug, Default)]
pub(super) struct Angle {
    /// The constant, rad.
    pub(super) start: f64,
    /// The coordinates.
    pub(super) terms: Vec<Arc<dyn Transmission>>,
}

impl Angle {
    /// The angle with a constant added.
    pub(super) fn plus(&self, more: f64) -> Self {
        Self {
            start: self.start + more,
            terms: self.terms.clone(),
        }
    }

    /// Angle by the input.
    pub(super) fn at(&self, input: f64) -> MotionJet {
        let start = MotionJet {
            position: self.start,
            ..MotionJet::default()
        };
        let sum = |sum: MotionJet, law: &Arc<dyn Transmission>| sum.plus(1.0, &law.at(input));
        self.terms.iter().fold(start, sum)
    }

    /// Inputs below `period` where a derivative may jump, ascending.
    pub(super) fn breaks(&self, period: f64) -> Vec<f64> {
        let of = |law: &Arc<dyn Transmission>| {
            let (own, jumps) = (law.period(), law.breaks());
            let repeats = (period / own).round().max(1.0) as u32;
            (0..repeats).flat_map(move |i| {
                let jumps = jumps.clone().into_iter();
                jumps.map(move |b| b + f64::from(i) * own)
            })
        };
        self.terms.iter().flat_map(of).collect()
    }
}

/// Two pitch curves that roll on each other wherever their axes are carried.
///
/// With lambda the direction from the driver's axis to the driven gear's, alpha and beta the angles of the two gears and f the
/// driven angle of the pair by the driver's polar angle: the driver's pitch point is at the polar angle lambda - alpha, so
/// beta = lambda + f(lambda - alpha), and alpha = lambda - f^-1(beta - lambda).
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub(super) rolling: Arc<Rolling>,
    /// Direction from the driver's axis to the driven gear's.
    pub(super) lambda: Angle,
}

impl Mesh {
    /// Angle of the driven gear by that of the driver.
    pub(super) fn driven(&self, driver: &MotionJet, input: f64) -> MotionJet {
        let lambda = self.lambda.at(input);
        let phi = lambda.plus(-1.0, driver);
        let turned = self.rolling.driven_jet(phi.position).after(&phi);
        lambda.plus(1.0, &turned)
    }

    /// Angle of the driver by that of the driven gear.
    pub(super) fn driver(&self, driven: &MotionJet, input: f64) -> MotionJet {
        let lambda = self.lambda.at(input);
        let turned = driven.plus(-1.0, &lambda);
        let phi = self.rolling.driver_jet(turned.position).after(&turned);
        lambda.plus(-1.0, &phi)
    }
}

/// Coordinate of a body that a mesh moves: its angle against the one that carries it.
#[derive(Clone, Debug)]
pub(super) struct MeshLaw {
    mesh: Mesh,
    /// Whether the body's gear is the driven one of its pair.
    is_driven: bool,
    /// Angle of the other gear.
    other: Angle,
    /// Angle of the carrier, and that at which the body's gear is mounted.
    carrier: Angle,
    mount: f64,
    period: f64,
    advance: f64,
    breaks: Vec<f64>,
}

impl MeshLaw {
    /// The law over a period, of a body whose gear is in a direction on its carrier from the other.
    pub(super) fn new(
        rolling: Arc<Rolling>,
        (is_driven, direction): (bool, f64),
        (carrier, other): (Angle, Angle),
        mount: f64,
        period: f64,
    ) -> Self {
        let turned = if is_driven { direction } else { direction + PI };
        let mesh = Mesh {
            rolling,
            lambda: carrier.plus(turned),
        };
        let mut law = Self {
            mesh,
            is_driven,
            other,
            carrier,
            mount,
            period,
            advance: 0.0,
            breaks: Vec::new(),
        };
        // The cycle begins within half a turn of zero.
        law.mount += TAU * (law.at(0.0).position / TAU).round();
        law.advance = law.at(period).position - law.at(0.0).position;
        law.breaks = law.jumps();
        law
    }

    /// Growth over the period less the nearest whole turns.
    pub(super) fn unsteady(&self) -> f64 {
        self.advance - TAU * (self.advance / TAU).round()
    }

    /// Sets the growth over the period to the nearest whole turns, from which it is off by rounding.
    pub(super) fn with_whole_turns(self) -> Self {
        let advance = TAU * (self.advance / TAU).round();
        Self { advance, ..self }
    }

    /// The driver's polar angle at an input.
    fn polar(&self, input: f64) -> f64 {
        let lambda = self.mesh.lambda.at(input).position;
        let other = self.other.at(input);
        let driver = match self.is_driven {
            true => other.position,
            false => self.mesh.driver(&other, input).position,
        };
        lambda - driver
    }

    /// Inputs at which a derivative may jump: of the angles it is made of, and where a bend of the pitch curve jumps.
    fn jumps(&self) -> Vec<f64> {
        let mut found = self.other.breaks(self.period);
        found.extend(self.carrier.breaks(self.period));
        let rolling = &self.mesh.rolling;
        let bends = (&rolling.breaks()[..], rolling.period());
        found.extend(crossings(|input| self.polar(input), bends, self.period));
        found.retain(|&b| b < self.period);
        sorted(found.into_iter(), self.period)
    }
}

/// Inputs of a period at which an angle meets one of some values, which repeat with a cycle of their own.
pub(super) fn crossings(
    angle: impl Fn(f64) -> f64,
    (values, cycle): (&[f64], f64),
    period: f64,
) -> Vec<f64> {
    let mut found = Vec::new();
    if values.is_empty() {
        return found;
    }
    let count = LOOKS * (period / TAU).round().max(1.0) as u32;
    let input = |i: u32| period * f64::from(i) / f64::from(count);
    let mut before = angle(0.0);
    for i in 1..=count {
        let after = angle(input(i));
        let (low, high) = (before.min(after), before.max(after));
        for value in values {
            // One cycle to either side more, lest rounding hide a value met just at a sample.
            let [first, last] = [low, high].map(|end| ((end - value) / cycle).round() as i64);
            let met = (first - 1..=last + 1).map(|n| value + cycle * n as f64);
            for at in met.filter(|at| (low..high).contains(at)) {
                let off = |x: f64| angle(x) - at;
                let (from, to) = (input(i - 1), input(i));
                found.push(bracketed_root(off, from, to, before - at, after - at));
            }
        }
        before = after;
    }
    found
}

impl Transmission for MeshLaw {
    fn at(&self, input: f64) -> MotionJet {
        let other = self.other.at(input);
        let mut own = match self.is_driven {
            true => self.mesh.driven(&other, input),
            false => self.mesh.driver(&other, input),
        };
        own.position -= self.mount;
        own.plus(-1.0, &self.carrier.at(input))
    }

    fn period(&self) -> f64 {
        self.period
    }

    fn advance(&self) -> f64 {
        self.advance
    }

    fn breaks(&self) -> Vec<f64> {
        self.breaks.clone()
    }
}
