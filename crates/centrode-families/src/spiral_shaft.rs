use std::f64::consts::TAU;

use centrode_analysis::{Report, SHAFT_FIGURES, check_shaft};
use centrode_export::linked::picture;
use centrode_export::picture::{Curve, Handle, HandlePlane, Picture};
use centrode_export::{ExportError, Options, shaft};
use centrode_formats::{Bundle, Format};
use centrode_geometry::Tolerance;
use centrode_groove::{ShaftSolid, SpiralShaft, SpiralShaftDesign};
use centrode_kinematics::machine::LinkedMachine;
use centrode_kinematics::transmission::MotionJet;
use centrode_spec::goals::check_varied;
use centrode_spec::{Design, MechanismError};
use centrode_synthesis::optimise::{DesignProblem, NotSearched};

use super::figure_goals;
use super::handles::degrees;
use super::{Mechanism, Resolved};

/// Tolerance of the picture, as a share of the groove's width.
const DRAWN: f64 = 5e-3;

impl Mechanism for SpiralShaft {
    fn design(&self) -> &dyn Design {
        self.design()
    }

    fn definition(&self) -> String {
        in_words(self)
    }

    fn check(&self) -> Report {
        check_shaft(self).with_goals(&self.design().goals, true)
    }

    fn curves(&self) -> Vec<Curve> {
        shaft::shaft_curves(self)
    }

    /// The developed groove with its slider.
    fn picture(&self) -> Picture {
        let mut picture = drawn(self, shaft::drawn(self));
        let even = |input: f64| MotionJet::uniform(input, 1.0);
        picture.handles = window(self, "", even);
        picture
    }

    fn machine(&self) -> Result<LinkedMachine, ExportError> {
        shaft::machine(self)
    }

    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
        shaft::files(self, formats, options)
    }
}

impl Resolved for SpiralShaft {
    type Design = SpiralShaftDesign;

    const NOUN: &'static str = "a spiral shaft";

    fn resolve(design: &SpiralShaftDesign) -> Result<Self, MechanismError> {
        figure_goals::check_names("goals", &design.goals, &[SHAFT_FIGURES])?;
        check_varied(design, &design.vary, &[])?;
        Ok(Self::resolve(design)?)
    }

    fn problem(design: &SpiralShaftDesign) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
        figure_goals::problem::<Self>(design, design.goals.len(), &design.vary)
    }
}

/// The picture of a machine with a spiral shaft; an empty one if the machine cannot be made.
pub(super) fn drawn(shaft: &SpiralShaft, machine: Result<LinkedMachine, ExportError>) -> Picture {
    let tolerance = Tolerance::new(DRAWN * shaft.groove().width());
    match (machine, tolerance) {
        (Ok(machine), Ok(tolerance)) => picture(&machine, tolerance),
        _ => Picture::default(),
    }
}

/// Description of a shaft in one line.
pub(super) fn in_words(shaft: &SpiralShaft) -> String {
    let design = shaft.design();
    format!(
        "{} holes, lead {} mm, {} turns out and back, on a shaft of radius {} mm",
        design.holes,
        design.lead,
        shaft.traverse().turns(),
        design.radius
    )
}

/// Handles at the middle and the end of the window in which a seedling is picked. They are at the near and the far end of the
/// development, because next to each other they would overlap.
pub(super) fn window(
    part: &SpiralShaft,
    table: &str,
    turn: impl Fn(f64) -> MotionJet,
) -> Vec<Handle> {
    let Ok(solid) = ShaftSolid::new(part.groove(), part.body()) else {
        return Vec::new();
    };
    let (design, radius) = (part.design(), part.groove().radius());
    let handle = |name: &str, key: &str, value: f64, input: f64, [x, share]: [f64; 2]| {
        let at = turn(input);
        // `scale` is the distance, mm, by which one degree of the number moves the point; the turned surface runs downwards.
        let scale = -radius * at.velocity * share * 1.0_f64.to_radians();
        let place = -radius * at.position.rem_euclid(TAU);
        Handle {
            name: name.into(),
            link: 0,
            plane: HandlePlane::Cartesian,
            keys: [String::new(), format!("{table}{key}")],
            values: [0.0, value],
            scale,
            origin: [x, place - scale * value],
            chained: false,
        }
    };
    let [near, far] = solid.ends();
    let (middle, end) = (design.pick, design.pick + 0.5 * design.window);
    let (pick, width) = (degrees(middle), degrees(design.window));
    vec![
        handle(
            "middle of the picking",
            "pick_deg",
            pick,
            middle,
            [near, 1.0],
        ),
        handle("end of the picking", "window_deg", width, end, [far, 0.5]),
    ]
}
