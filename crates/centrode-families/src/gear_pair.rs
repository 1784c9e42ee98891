use super::contact::contact_curves;
use super::figure_goals;
use super::handles::handles;
use super::{Depth, Limit, Mechanism, PartName, Resolved};
use centrode_analysis::{
    Contact, PAIR_FIGURES, PairRemedy, Report, check, check_contact, check_made, check_planned,
    pitch_overlap, remedies,
};
use centrode_export::picture::{Curve, Picture};
use centrode_export::{ExportError, Options, gear_pair, linked};
use centrode_formats::{Bundle, Format};
use centrode_gear::design::{Addendum, GearPairDesign};
use centrode_gear::{GearPair, GearPairError, PlannedPair};
use centrode_geometry::Tolerance;
use centrode_kinematics::machine::LinkedMachine;
use centrode_spec::goals::check_varied;
use centrode_spec::{Design, MechanismError};
use centrode_synthesis::optimise::{DesignProblem, NotSearched};
use std::sync::Arc;

/// Tolerance of the picture, as a share of the module: a tenth of a pixel if a tooth is drawn as high as a hand.
const DRAWN: f64 = 2e-3;

/// Description of a remedy.
fn words(pair: &GearPair, remedy: &PairRemedy) -> String {
    let mut teeth = match remedy.addendum {
        Addendum::Full => "full teeth".to_owned(),
        Addendum::Fitted => "fitted teeth".to_owned(),
    };
    if !remedy.fit.is_empty() {
        let GearPairDesign {
            teeth: spec, tool, ..
        } = &remedy.design;
        let angle = tool.pressure_angle().to_degrees();
        teeth += &format!(
            " of thickness split {} and pressure angle {angle:.2} deg, with their phase also chosen,",
            spec.thickness_split
        );
    }
    let (minimum, written) = (remedy.minimum_tooth_count, pair.driver().tooth_count());
    // The tooth counts of the driver go in such steps that the driven gear has a whole number of teeth.
    let fewer = minimum - pair.mean_ratio().1;
    let below = match fewer {
        0 => String::new(),
        _ => format!(
            " (not with {fewer}; a larger number may fail again: check the number you choose)"
        ),
    };
    let start = format!(
        "{teeth} transmit the motion by their flanks alone with {minimum} teeth of the driver{below}"
    );
    if minimum == written && !remedy.fit.is_empty() {
        return format!("{start}, the number in the design");
    }
    if minimum <= written {
        return format!("{start}, and with the {written} of the design");
    }
    let share = f64::from(minimum) / f64::from(written);
    format!(
        "{start}: module {:.4} mm on these pitch curves, or module {:.4} mm on curves {share:.4} times as large",
        pair.module() / share,
        pair.module()
    )
}

impl Mechanism for GearPair {
    fn design(&self) -> &dyn Design {
        PlannedPair::design(self)
    }

    fn definition(&self) -> String {
        let (driver, driven) = self.mean_ratio();
        let definition = PlannedPair::definition(self);
        format!("{definition}; mean ratio {driver}:{driven}")
    }

    fn check(&self) -> Report {
        check(self).with_goals(&PlannedPair::design(self).goals, true)
    }

    fn check_motion(&self) -> Report {
        check_planned(self).with_goals(&PlannedPair::design(self).goals, false)
    }

    fn check_made(&self) -> Report {
        check_made(self).with_goals(&PlannedPair::design(self).goals, false)
    }

    fn check_goals(&self) -> Report {
        figure_goals::check_goals(self)
    }

    fn check_with_curves(&self) -> (Report, Vec<Curve>) {
        let contact = Contact::analyse(self);
        (
            check_contact(self, &contact).with_goals(&PlannedPair::design(self).goals, true),
            contact_curves(&contact),
        )
    }

    fn remedies(&self) -> Vec<(String, Box<dyn Design>)> {
        let found = remedies(self).into_iter();
        found
            .map(|remedy| -> (String, Box<dyn Design>) {
                (words(self, &remedy), Box::new(remedy.design))
            })
            .collect()
    }

    fn no_remedy(&self) -> Option<String> {
        pitch_overlap(self).map(|finding| finding.message)
    }

    fn with_kerf(&self, kerf: f64) -> Option<Arc<dyn Mechanism>> {
        Some(Arc::new(self.with_kerf(kerf)))
    }

    fn pairs(&self) -> Result<Vec<(String, Arc<GearPair>)>, GearPairError> {
        Ok(vec![(self.name().to_owned(), Arc::new(self.clone()))])
    }

    fn limits(&self, report: &Report) -> Vec<Limit> {
        Limit::of_rule(report, "pressure-angle", "Pressure angle")
    }

    fn curves(&self) -> Vec<Curve> {
        gear_pair::curves(self)
    }

    fn picture(&self) -> Picture {
        let Ok(tolerance) = Tolerance::new(DRAWN * self.module()) else {
            return Picture::default();
        };
        let mut picture = linked::picture(&gear_pair::drawn(self), tolerance);
        let mut links = picture.links.iter();
        if let Some(link) = links.position(|link| link.name == picture.motion.input_name) {
            let length = self.driver().pitch_length();
            picture.handles = handles(&PlannedPair::design(self).pitch, length, link);
        }
        picture.contacts = vec![gear_pair::contacts(self)];
        picture
    }

    fn machine(&self) -> Result<LinkedMachine, ExportError> {
        gear_pair::machine(self)
    }

    fn accuracy(&self) -> f64 {
        PlannedPair::accuracy(self)
    }

    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
        gear_pair::files(self, formats, options)
    }
}

impl Resolved for GearPair {
    type Design = GearPairDesign;

    const NOUN: &'static str = "a gear pair";

    const PARTS: &'static [PartName] = &[
        PartName::new("driver", "Driver of a gear pair"),
        PartName::new("driven", "Driven gear of a gear pair"),
        PartName::new("housing", "Housing of a flow meter or pump"),
        PartName::ASSEMBLY,
    ];

    fn resolve(design: &GearPairDesign) -> Result<Self, MechanismError> {
        figure_goals::check_names("goals", &design.goals, &[PAIR_FIGURES])?;
        check_varied(design, &design.vary, &[])?;
        Self::resolve(design).map_err(|error| error.blamed(design))
    }

    fn report(design: &GearPairDesign, depth: Depth) -> Result<Report, MechanismError> {
        figure_goals::check_names("goals", &design.goals, &[PAIR_FIGURES])?;
        let planned = PlannedPair::new(design).map_err(|error| error.blamed(design))?;
        if depth == Depth::Motion {
            return Ok(check_planned(&planned).with_goals(&design.goals, false));
        }
        let pair = planned.cut().map_err(|error| error.blamed(design))?;
        let mechanism: &dyn Mechanism = &pair;
        Ok(mechanism.report(depth))
    }

    fn problem(design: &GearPairDesign) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
        figure_goals::problem::<Self>(design, design.goals.len(), &design.vary)
    }
}
