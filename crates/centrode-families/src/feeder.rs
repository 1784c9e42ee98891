use super::figure_goals;
use super::{Limit, Mechanism, Resolved, Widening, WideningError};
use centrode_analysis::{FEEDER_FIGURES, FeederForces, Report, check_feeder, check_strokes};
use centrode_export::linked::picture;
use centrode_export::picture::{Curve, Handle, HandlePlane, Picture};
use centrode_export::{ExportError, Options, feeder};
use centrode_formats::{Bundle, Format};
use centrode_gear::IntermittentPair;
use centrode_geometry::Tolerance;
use centrode_kinematics::machine::LinkedMachine;
use centrode_machines::feeder::{Dimension, Feeder, FeederDesign, FeederPart};
use centrode_spec::{Design, MechanismError};
use centrode_synthesis::optimise::feeder::{FeederProblem, Widened};
use centrode_synthesis::optimise::{DesignProblem, NotSearched};
use serde_json::json;
use std::f64::consts::TAU;

/// Intervals of a cycle, at whose ends the torque is computed.
const SAMPLES: u32 = 360;

/// Tolerance of the picture, as a share of the frame's length.
const DRAWN: f64 = 1e-4;
/// Factor on that tolerance as long as no teeth are cut: the picture is then fast enough to follow a handle that is dragged.
const COARSE: f64 = 10.0;

impl Mechanism for Feeder {
    fn design(&self) -> &dyn Design {
        self.design()
    }

    fn definition(&self) -> String {
        let [crank, coupler, rocker, frame] = self.six_bar().four_bar().lengths();
        format!(
            "crank {crank}, coupler {coupler}, rocker {rocker}, frame {frame} mm; {:.4} cycles per minute",
            self.cycles_per_minute()
        )
    }

    fn check(&self) -> Report {
        check_feeder(self).with_goals(&self.design().figure_goals, true)
    }

    fn check_motion(&self) -> Report {
        check_strokes(self).with_goals(&self.design().figure_goals, false)
    }

    fn goals_come_first(&self) -> bool {
        true
    }

    fn check_with_curves(&self) -> (Report, Vec<Curve>) {
        (Mechanism::check(self), torques(self))
    }

    /// The goal bounds the angle of coupler and rocker on both sides: above its minimum, below 180 degrees less that minimum.
    fn limits(&self, report: &Report) -> Vec<Limit> {
        let mut all = Limit::of_goal(report, "transmission-angle", "Angle of coupler and rocker");
        if let Some(minimum) = all.first() {
            let maximum = Limit {
                value: 180.0 - minimum.value,
                minimum: false,
                ..minimum.clone()
            };
            all.push(maximum);
        }
        all
    }

    fn input_speed(&self) -> Option<f64> {
        Some(self.speed())
    }

    fn curves(&self) -> Vec<Curve> {
        feeder::curves(self)
    }

    /// Picture of the moving six-bar, with the path of its tip. The gears are drawn without teeth, because cutting the teeth
    /// takes too long for a first picture.
    fn picture(&self) -> Picture {
        drawn(self, None)
    }

    fn is_coarse(&self) -> bool {
        true
    }

    fn detailed(&self) -> Option<Picture> {
        let pair = self.gears().ok()?;
        Some(drawn(self, Some(&pair)))
    }

    fn machine(&self) -> Result<LinkedMachine, ExportError> {
        feeder::machine(self)
    }

    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
        feeder::files(self, formats, options)
    }
}

impl Resolved for Feeder {
    type Design = FeederDesign;

    const NOUN: &'static str = "a feeder";

    fn resolve(design: &FeederDesign) -> Result<Self, MechanismError> {
        figure_goals::check_names("figure_goals", &design.figure_goals, &[FEEDER_FIGURES])?;
        Ok(Self::resolve(design)?)
    }

    fn problem(design: &FeederDesign) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
        Ok(Box::new(FeederProblem::new(design)))
    }

    fn widen(design: &FeederDesign) -> Result<Widening, WideningError> {
        let Widened { share, design } = Widened::search(design)?;
        let linkage = &design.linkage;
        let lengths = Dimension::ALL.into_iter().filter(|d| !d.is_of_pivot());
        let numbers = lengths.map(|d| (d.key().to_owned(), d.of(linkage)));
        let bounds = design.bounds.named();
        let pivot = ("linkage.pivot".to_owned(), linkage.pivot.to_vec());
        let lists = bounds.map(|(name, ends)| (format!("bounds.{name}"), ends.to_vec()));
        let bounded = Dimension::ALL.into_iter().zip(bounds);
        let mut lines: Vec<String> = bounded
            .map(|(dimension, (_, [low, high]))| {
                let (name, length) = (dimension.name(), dimension.of(linkage));
                format!("{name:<8} {length:>9.3} mm, within {low:.3} to {high:.3}")
            })
            .collect();
        let [x, y] = linkage.pivot;
        lines.push(format!("{:<8} ({x:.3}, {y:.3}) mm", "pivot"));
        Ok(Widening {
            share,
            tables: vec![
                ("linkage", json!(linkage)),
                ("bounds", json!(design.bounds)),
            ],
            numbers: numbers.collect(),
            lists: std::iter::once(pivot).chain(lists).collect(),
            lines,
        })
    }
}

/// Torque of the crank along the cycle; an empty list if a link has no plate.
fn torques(machine: &Feeder) -> Vec<Curve> {
    let Ok(system) = FeederForces::analyse(machine) else {
        return Vec::new();
    };
    let input: Vec<f64> = (0..=SAMPLES)
        .map(|i| TAU * f64::from(i) / f64::from(SAMPLES))
        .collect();
    let curve = |name, moving| {
        let torque = |&phi: &f64| {
            let forces = system.at(phi, moving);
            forces.map_or(f64::NAN, |forces| FeederForces::torque(&forces))
        };
        let words = ["Torque of the crank", name, "N·mm"];
        Curve::new(words, &input, input.iter().map(torque).collect())
    };
    vec![curve("moving", true), curve("at rest", false)]
}

fn drawn(machine: &Feeder, gears: Option<&IntermittentPair>) -> Picture {
    let frame = machine.six_bar().four_bar().lengths()[3];
    let coarseness = gears.map_or(COARSE, |_| 1.0);
    let Ok(tolerance) = Tolerance::new(coarseness * DRAWN * frame) else {
        return Picture::default();
    };
    let mut picture = picture(&feeder::drawn(machine, gears), tolerance);
    let link = |part: FeederPart| picture.links.iter().position(|l| l.name == part.name());
    let handles = joints(machine).into_iter().filter_map(|(part, handle)| {
        let link = link(part)?;
        Some(Handle { link, ..handle })
    });
    picture.handles = handles.collect();
    picture
}

/// Handles, one on each part: a point that sets a length of the linkage.
fn joints(machine: &Feeder) -> [(FeederPart, Handle); 6] {
    let spec = &machine.design().linkage;
    // A length is set along its own link, at any angle. Coupler and rocker end in one joint: each has its handle in its middle.
    // The pivot is on top, so that it can be reached even if a coupler passes over it.
    use FeederPart::{Coupler, Crank, Effector, Frame, Rocker};
    use HandlePlane::{Cartesian, Polar};
    #[rustfmt::skip]
    let rows = [
        (Frame, "axis of the rocker", Cartesian, ["frame", ""], [spec.frame, 0.0], 1.0),
        (Crank, "end of the crank", Polar, ["crank", ""], [spec.crank, 0.0], 1.0),
        (Coupler, "middle of the coupler", Polar, ["coupler", ""], [spec.coupler, 0.0], 0.5),
        (Rocker, "middle of the rocker", Polar, ["rocker", ""], [spec.rocker, 0.0], 0.5),
        (Effector, "tip of the effector", Polar, ["effector_length", ""], [spec.effector_length, 0.0], 1.0),
        (Frame, "pivot of the effector", Cartesian, ["pivot[0]", "pivot[1]"], spec.pivot, 1.0),
    ];
    rows.map(|(part, name, plane, keys, values, scale)| {
        let keys = keys.map(|key| match key {
            "" => String::new(),
            key => format!("linkage.{key}"),
        });
        let handle = Handle {
            name: name.into(),
            link: 0,
            plane,
            keys,
            values,
            scale,
            origin: [0.0; 2],
            chained: false,
        };
        (part, handle)
    })
}
