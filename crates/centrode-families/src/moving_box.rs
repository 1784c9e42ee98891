use super::figure_goals;
use super::spiral_shaft::{drawn, in_words, window};
use super::{Mechanism, Resolved};
use centrode_analysis::{Report, SHAFT_FIGURES, check_moving_box};
use centrode_export::picture::{Curve, Picture};
use centrode_export::{ExportError, Options, shaft};
use centrode_formats::{Bundle, Format};
use centrode_gear::{GearPair, GearPairError};
use centrode_groove::{MovingBox, MovingBoxDesign, Scheme};
use centrode_kinematics::machine::LinkedMachine;
use centrode_spec::goals::check_varied;
use centrode_spec::{Design, MechanismError};
use centrode_synthesis::optimise::{DesignProblem, NotSearched};
use std::sync::Arc;

impl Mechanism for MovingBox {
    fn design(&self) -> &dyn Design {
        self.design()
    }

    fn definition(&self) -> String {
        let scheme = match self.design().scheme {
            Scheme::Shaft => "driven at constant speed",
            Scheme::EllipticGear | Scheme::Both => "driven by elliptic gears",
        };
        format!("{}, {scheme}", in_words(self.shaft()))
    }

    fn check(&self) -> Report {
        check_moving_box(self).with_goals(&self.design().goals, true)
    }

    fn pairs(&self) -> Result<Vec<(String, Arc<GearPair>)>, GearPairError> {
        let design = self
            .drive()
            .and_then(|drive| self.design().gear_pair(drive));
        let pair = |design| Ok(("gears".to_owned(), Arc::new(GearPair::resolve(&design)?)));
        design.into_iter().map(pair).collect()
    }

    fn curves(&self) -> Vec<Curve> {
        shaft::box_curves(self).unwrap_or_default()
    }

    /// The developed groove with its slider, as a function of the input of the machine.
    fn picture(&self) -> Picture {
        let mut picture = drawn(self.shaft(), shaft::moving_box_drawn(self));
        picture.handles = window(self.shaft(), "shaft.", |input| self.shaft_turn(input));
        picture
    }

    fn machine(&self) -> Result<LinkedMachine, ExportError> {
        shaft::moving_box_machine(self)
    }

    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
        shaft::moving_box_files(self, formats, options)
    }
}

impl Resolved for MovingBox {
    type Design = MovingBoxDesign;

    const NOUN: &'static str = "a moving box";

    fn resolve(design: &MovingBoxDesign) -> Result<Self, MechanismError> {
        figure_goals::check_names("goals", &design.goals, &[SHAFT_FIGURES])?;
        check_varied(design, &design.vary, &[])?;
        Ok(Self::resolve(design)?)
    }

    fn problem(design: &MovingBoxDesign) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
        figure_goals::problem::<Self>(design, design.goals.len(), &design.vary)
    }
}
