use super::{Limit, Mechanism, Resolved};
use centrode_analysis::{
    Report, Table, Unit, check_machine, check_machine_goals, check_machine_motion, machine_figures,
    machine_goals, machine_layers,
};
use centrode_export::picture::{Curve, Handle, HandlePlane, Picture};
use centrode_export::{ExportError, Options, linked, machine};
use centrode_formats::{Bundle, Format};
use centrode_gear::{GearPair, GearPairError};
use centrode_geometry::Tolerance;
use centrode_kinematics::machine::LinkedMachine;
use centrode_machines::machine::{DyadKind, Machine, MachineDesign, MachineError, Over};
use centrode_spec::{Design, MechanismError};
use centrode_synthesis::optimise::{DesignProblem, NO_MACHINE, NotSearched, VaryProblem};
use centrode_synthesis::reverse::{GearDrive, GearDriveError, GearDriveSpec};
use std::sync::Arc;

/// Tolerance of the picture, as a share of a plate's width.
const DRAWN: f64 = 2e-3;

impl Mechanism for Machine {
    fn design(&self) -> &dyn Design {
        self.design()
    }

    fn definition(&self) -> String {
        let count = |count: usize, one: &str, many: &str| match count {
            1 => format!("1 {one}"),
            _ => format!("{count} {many}"),
        };
        format!(
            "{}, {}; input at {}",
            count(self.bodies().len() - 1, "body", "bodies"),
            count(self.dyads().len(), "dyad", "dyads"),
            Unit::TurnsPerMinute.with_unit(self.design().input.speed_rpm)
        )
    }

    fn check(&self) -> Report {
        check_machine(self)
    }

    fn check_motion(&self) -> Report {
        check_machine_motion(self)
    }

    fn check_goals(&self) -> Report {
        check_machine_goals(self)
    }

    fn goals_come_first(&self) -> bool {
        !self.design().goals.is_empty()
    }

    fn pairs(&self) -> Result<Vec<(String, Arc<GearPair>)>, GearPairError> {
        let pairs = Self::pairs(self).into_iter();
        Ok(pairs
            .map(|pair| (pair.name().to_owned(), Arc::clone(pair)))
            .collect())
    }

    fn gear_drive(&self, spec: &GearDriveSpec) -> Option<Result<GearDrive, GearDriveError>> {
        Some(GearDrive::new(self.design(), spec))
    }

    fn remedies(&self) -> Vec<(String, Box<dyn Design>)> {
        let found = machine_layers(self).into_iter();
        found
            .map(|(words, design)| -> (String, Box<dyn Design>) { (words, Box::new(design)) })
            .collect()
    }

    fn figures(&self) -> Vec<Table> {
        machine_figures(self)
    }

    /// Goals of the minimum transmission angle of one dyad are drawn in the chart of the minimum of all dyads.
    fn limits(&self, report: &Report) -> Vec<Limit> {
        let goals = self.design().goals.iter();
        let of_dyads = goals.filter(|(_, goal)| {
            goal.figure.starts_with("transmission(") && goal.over == Some(Over::Minimum)
        });
        of_dyads
            .flat_map(|(name, _)| Limit::of_goal(report, name, "Minimum transmission angle"))
            .collect()
    }

    fn input_speed(&self) -> Option<f64> {
        Some(self.speed())
    }

    fn curves(&self) -> Vec<Curve> {
        machine::curves(self)
    }

    fn picture(&self) -> Picture {
        let tolerance = Tolerance::new(DRAWN * self.plates().width);
        let (Ok(tolerance), Ok(made)) = (tolerance, machine::outlined(self)) else {
            return Picture::default();
        };
        let mut picture = linked::picture(&made, tolerance);
        picture.handles = handles(self);
        picture
    }

    fn machine(&self) -> Result<LinkedMachine, ExportError> {
        machine::machine(self)
    }

    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
        machine::files(self, formats, options)
    }
}

impl Resolved for Machine {
    type Design = MachineDesign;

    const NOUN: &'static str = "a composed machine";

    fn resolve(design: &MachineDesign) -> Result<Self, MechanismError> {
        design.check_vary()?;
        Ok(Self::resolve(design)?)
    }

    fn problem(design: &MachineDesign) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
        let goals_of =
            |design: &dyn Design| match Self::resolve(design.downcast_ref().ok_or(f64::MAX)?) {
                Ok(machine) => Ok(machine_goals(&machine)),
                Err(MachineError::DoesNotClose { dyads }) => {
                    // Only the first dyad counts: the others may close as soon as it does.
                    let missing = dyads.first();
                    let missing = missing.map_or(f64::INFINITY, |(_, found)| found.missing);
                    Err((NO_MACHINE + missing).min(f64::MAX))
                }
                Err(_) => Err(f64::MAX),
            };
        let (start, count) = (Arc::new(design.clone()), design.goals.len());
        let problem = VaryProblem::new(start, count, &design.vary, Box::new(goals_of))?;
        Ok(Box::new(problem))
    }
}

/// Handles on the points of the bodies and on the bars of the dyads; links are drawn in the order of the bodies.
fn handles(composed: &Machine) -> Vec<Handle> {
    let design = composed.design();
    let frame = ("frame", "frame".to_owned(), &design.frame.points);
    let bodies = design.bodies.iter();
    let bodies = bodies.map(|(name, body)| (name.as_str(), format!("bodies.{name}"), &body.points));
    let mut found = Vec::new();
    for (name, key, points) in std::iter::once(frame).chain(bodies) {
        let Some(link) = composed.body_named(name) else {
            continue;
        };
        found.extend(points.iter().map(|(point, at)| Handle {
            name: format!("{name}.{point}"),
            link,
            plane: HandlePlane::Cartesian,
            keys: [0, 1].map(|i| format!("{key}.points.{point}[{i}]")),
            values: *at,
            scale: 1.0,
            origin: [0.0; 2],
            chained: false,
        }));
    }
    let bars = composed.dyads().iter().flat_map(|dyad| {
        let lengths = design.dyads.get(&dyad.name).map(|spec| &spec.lengths[..]);
        let lengths = lengths.unwrap_or_default().iter().enumerate();
        // Both bars end in one joint: each has its handle in its middle.
        let scale = if dyad.kind == DyadKind::TwoBars {
            0.5
        } else {
            1.0
        };
        lengths.map(move |(i, &length)| Handle {
            name: format!("bar {} of {}", i + 1, dyad.name),
            link: dyad.bodies[i],
            plane: HandlePlane::Polar,
            keys: [format!("dyads.{}.lengths[{i}]", dyad.name), String::new()],
            values: [length, 0.0],
            scale,
            origin: [0.0; 2],
            chained: false,
        })
    });
    found.extend(bars);
    found
}
