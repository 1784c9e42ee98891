use std::f64::consts::{PI, TAU};

use centrode_geometry::{Extreme, maximum, piece_ends};

use super::{GearDriveError, GearDriveSpec, table_pair};
use crate::reverse::Timing;
use centrode_gear::Rolling;
use centrode_kinematics::transmission::Transmission as _;
use centrode_machines::machine::{
    GearRole, Machine, MachineBodySpec, MachineDesign, MachineGearSpec, MachineLawSpec,
    MachineMeshSpec,
};

/// Name of the pair, and of the point on the frame on which its driver turns.
pub(super) const DRIVE: &str = "drive";
/// Names of the shaft and of both gears.
const SHAFT: &str = "drive-shaft";
const PINION: &str = "drive-pinion";
const WHEEL: &str = "drive-wheel";
/// Number of parts of a turn, each with few extremes of the output's distance from its law.
const PARTS: u32 = 64;

/// The crank of a machine, and the position of its drive.
pub(super) struct Crank<'a> {
    design: &'a MachineDesign,
    spec: &'a GearDriveSpec,
    body: &'a MachineBodySpec,
    /// Point of the frame on which the crank turns.
    on: &'a str,
    start: f64,
    /// Sense of rotation of the crank: 1 counter-clockwise, -1 clockwise.
    sense: f64,
}

impl<'a> Crank<'a> {
    pub(super) fn new(
        design: &'a MachineDesign,
        spec: &'a GearDriveSpec,
    ) -> Result<Self, GearDriveError> {
        let no = |why: &str| GearDriveError::NoCrank {
            body: spec.body.clone(),
            why: why.into(),
        };
        let turns = design.input.turns;
        if turns != 1 {
            return Err(GearDriveError::Turns { turns });
        }
        let body = design.bodies.get(&spec.body);
        let body = body.ok_or_else(|| {
            let dyads = design.dyads.iter();
            let mut makers = dyads.filter(|(_, dyad)| dyad.bodies.contains(&spec.body));
            match makers.next() {
                Some((dyad, _)) => no(&format!("belongs to dyads.{dyad}")),
                None => no("is not in bodies"),
            }
        })?;
        let on = body.on.as_deref().filter(|on| on.starts_with("frame."));
        let on = on.ok_or_else(|| no("does not turn on a point of the frame"))?;
        if body.slides.is_some() {
            return Err(no("slides"));
        }
        let law = body.law.as_ref().ok_or_else(|| no("has no law"))?;
        let plain = MachineLawSpec {
            start_angle: law.start_angle,
            ratio: law.ratio,
            ..MachineLawSpec::default()
        };
        let sense = law
            .ratio
            .filter(|ratio| ratio.abs() == 1.0 && *law == plain);
        let sense = sense.ok_or_else(|| no("has another law"))?;
        for (name, other) in &design.bodies {
            let moves = |law: &MachineLawSpec| {
                let still = MachineLawSpec {
                    start_angle: law.start_angle,
                    start: law.start,
                    ..MachineLawSpec::default()
                };
                *law != still && law.by.is_none() && law.follows.is_none()
            };
            if *name != spec.body && other.law.as_ref().is_some_and(moves) {
                return Err(GearDriveError::Another { body: name.clone() });
            }
        }
        let taken = [
            (
                "frame.points",
                design.frame.points.contains_key(DRIVE),
                DRIVE,
            ),
            ("bodies", design.bodies.contains_key(SHAFT), SHAFT),
            ("pairs", design.pairs.contains_key(DRIVE), DRIVE),
            ("gears", design.gears.contains_key(PINION), PINION),
            ("gears", design.gears.contains_key(WHEEL), WHEEL),
        ];
        if let Some((table, _, name)) = taken.into_iter().find(|(_, is_taken, _)| *is_taken) {
            let key = format!("{table}.{name}");
            return Err(GearDriveError::Taken { key });
        }
        Ok(Self {
            design,
            spec,
            body,
            on,
            start: law.start_angle.unwrap_or(0.0),
            sense,
        })
    }

    /// Driven angles of the pair at equal steps of the driver's angle, the first zero; the gears turn in opposite directions.
    pub(super) fn table(&self, timing: &Timing, steps: u32) -> Vec<f64> {
        let start = timing.at(0.0).position;
        let at = |i: u32| {
            let polar = TAU * f64::from(i) / f64::from(steps);
            self.sense * (timing.at(self.sense * polar).position - start)
        };
        let mut table: Vec<f64> = (0..steps).map(at).collect();
        table[0] = 0.0;
        table.push(TAU);
        table
    }

    /// Maximum distance of the output driven by gears from its position by the law.
    pub(super) fn miss(&self, timing: &Timing, rolled: &Rolling) -> Extreme {
        let (output, start) = (timing.output(), timing.at(0.0).position);
        let first = rolled.driven_angle(0.0);
        let off = |input: f64| {
            let driven = rolled.driven_angle(self.sense * input) - first;
            let place = |angle: f64| output.at(angle).position;
            (place(start + self.sense * driven) - place(timing.at(input).position)).abs()
        };
        maximum(off, &piece_ends(0.0, TAU, PARTS, &timing.breaks()))
    }

    /// The design with the drive.
    ///
    /// With lambda the direction from the driving shaft to the crank's axis and f the driven angle of the pair, the driven gear is
    /// at `lambda + f(lambda - angle of the driver)`; the driver starts at lambda.
    pub(super) fn driven(
        &self,
        composed: &Machine,
        timing: &Timing,
        table: Vec<f64>,
    ) -> Result<MachineDesign, GearDriveError> {
        let mut design = self.design.clone();
        let axis = composed.point_named(self.on).unwrap_or_default().at;
        let (sin, cos) = self.spec.direction.sin_cos();
        let distance = self.spec.center_distance;
        let shaft = [axis.x + distance * cos, axis.y + distance * sin];
        let back = self.spec.direction + PI;
        design.frame.points.insert(DRIVE.into(), shaft);
        let shaft = MachineBodySpec {
            on: Some(format!("frame.{DRIVE}")),
            law: Some(MachineLawSpec {
                ratio: Some(-self.sense),
                start_angle: Some(back),
                ..MachineLawSpec::default()
            }),
            ..MachineBodySpec::default()
        };
        design.bodies.insert(SHAFT.into(), shaft);
        let crank = MachineBodySpec {
            on: Some("frame".into()),
            law: None,
            mesh: Some(MachineMeshSpec {
                gear: WHEEL.into(),
                with: PINION.into(),
                direction: back,
            }),
            ..self.body.clone()
        };
        design.bodies.insert(self.spec.body.clone(), crank);
        let gear = |role: GearRole, on: &str, mount: f64| MachineGearSpec {
            pair: DRIVE.into(),
            role,
            on: on.into(),
            mount,
        };
        let mount = back - (self.start + self.sense * timing.at(0.0).position);
        let gears = [
            (PINION, gear(GearRole::Driver, SHAFT, 0.0)),
            (WHEEL, gear(GearRole::Driven, &self.spec.body, mount)),
        ];
        design
            .gears
            .extend(gears.map(|(name, gear)| (name.into(), gear)));
        let mut pair = table_pair(table, distance);
        pair.driven.body = pair.driven.body.keyed(mount);
        design.pairs.insert(DRIVE.into(), pair);
        // The crank has no law any more.
        let law = format!("bodies.{}.law", self.spec.body);
        design.vary.retain(|key, _| !key.starts_with(&law));
        Ok(design)
    }
}
