use super::contact::contact_curves;
use super::figure_goals;
use super::handles::handles;
use super::{Limit, Mechanism, PartName, Resolved};
use centrode_analysis::{
    PAIR_FIGURES, Report, THREE_ARM_FIGURES, TrainTeeth, arm_clearance_course, carrier_turn,
    check_arms, check_three_arm, check_three_arm_teeth,
};
use centrode_export::picture::{Curve, Picture};
use centrode_export::{ExportError, Options, linked, three_arm};
use centrode_formats::{Bundle, Format};
use centrode_gear::{GearPair, GearPairError, Member};
use centrode_geometry::{Tolerance, run_both};
use centrode_kinematics::machine::LinkedMachine;
use centrode_machines::three_arm::ThreeArm;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::{Design, MechanismError};
use centrode_synthesis::optimise::three_arm::ThreeArmProblem;
use centrode_synthesis::optimise::{DesignProblem, NotSearched};
use std::sync::Arc;

/// Chart of the clearances: between the arms, and between the arms and the tray.
const ARM_CLEARANCE: &str = "Clearance of the arms";

/// Number of intervals of a carrier turn, at whose ends the clearance is shown.
const PARTS: u32 = 120;

/// Tolerance of the picture, as a share of the distance between two axes.
const DRAWN: f64 = 1e-4;
/// Factor on that tolerance as long as no teeth are cut: the picture is then fast enough to follow a handle that is dragged.
const COARSE: f64 = 10.0;

impl Mechanism for ThreeArm {
    fn design(&self) -> &dyn Design {
        self.design()
    }

    fn definition(&self) -> String {
        format!(
            "{} arms; sun: {}; centre distance {:.6} mm",
            self.arms(),
            self.definition(),
            self.center_distance()
        )
    }

    fn check(&self) -> Report {
        check_three_arm(self).with_goals(&self.design().figure_goals, true)
    }

    fn check_motion(&self) -> Report {
        check_arms(self).with_goals(&self.design().figure_goals, false)
    }

    fn goals_come_first(&self) -> bool {
        true
    }

    fn check_with_curves(&self) -> (Report, Vec<Curve>) {
        let teeth = TrainTeeth::analyse(self);
        let found = check_three_arm_teeth(self, &teeth);
        let found = found.with_goals(&self.design().figure_goals, true);
        (found, checked_curves(self, teeth.ok().flatten().as_ref()))
    }

    /// Sun and intermediate gear represent every mesh, because a planet is the same part as the sun.
    fn pairs(&self) -> Result<Vec<(String, Arc<GearPair>)>, GearPairError> {
        if self.design().gear_tooth_count().is_none() {
            return Ok(Vec::new());
        }
        Ok(vec![("gears".to_owned(), Arc::new(self.pair()?))])
    }

    fn limits(&self, report: &Report) -> Vec<Limit> {
        Limit::of_goal(report, "arm-clearance", ARM_CLEARANCE)
    }

    fn curves(&self) -> Vec<Curve> {
        three_arm::curves(self)
    }

    /// Picture of the mechanism. Its gears have no teeth, because cutting the teeth takes too long for a first picture.
    fn picture(&self) -> Picture {
        drawn(self, None)
    }

    fn is_coarse(&self) -> bool {
        true
    }

    fn detailed(&self) -> Option<Picture> {
        let pair = self.pair().ok()?;
        Some(drawn(self, Some(&pair)))
    }

    fn machine(&self) -> Result<LinkedMachine, ExportError> {
        three_arm::machine(self)
    }

    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
        three_arm::files(self, formats, options)
    }
}

impl Resolved for ThreeArm {
    type Design = ThreeArmDesign;

    const NOUN: &'static str = "a three-arm mechanism";

    const PARTS: &'static [PartName] = &[
        PartName::new("sun", "Three-arm: the fixed gear"),
        PartName::new("intermediate", "Three-arm: the gear between sun and planet"),
        PartName::new("planet", "Three-arm: the gear that carries an arm"),
        PartName::new("cam", "Three-arm: the cam that moves the push rod"),
        PartName::new("fork", "Three-arm: the fork between cam and push rod"),
        PartName::new("roller", "Three-arm: the cam roller on the fork"),
        PartName::new(
            "carrier",
            "Three-arm: the carrier plates on both sides of the gears",
        ),
        PartName::new(
            "spacer",
            "Three-arm: the spacers between the carrier plates",
        ),
        PartName::new("housing", "Three-arm: the wall of an arm's housing"),
        PartName::new(
            "cover-rear",
            "Three-arm: the cover of the housing towards the gearbox",
        ),
        PartName::new(
            "cover-front",
            "Three-arm: the cover of the housing away from the gearbox",
        ),
        PartName::new("clamp", "Three-arm: a flake of the clamp"),
        PartName::new("push-rod", "Three-arm: the push rod with its pusher"),
        PartName::ASSEMBLY,
    ];

    fn resolve(design: &ThreeArmDesign) -> Result<Self, MechanismError> {
        let figures = [PAIR_FIGURES, THREE_ARM_FIGURES];
        figure_goals::check_names("figure_goals", &design.figure_goals, &figures)?;
        Ok(Self::resolve(design)?)
    }

    fn problem(design: &ThreeArmDesign) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
        match ThreeArmProblem::new(design) {
            Ok(problem) => Ok(Box::new(problem)),
            Err(error) => Err(NotSearched::Design(error.to_string())),
        }
    }
}

/// Curves over the carrier's turn: motion of all arms, their clearances, and contact of the flanks of sun and first
/// intermediate gear.
fn checked_curves(mechanism: &ThreeArm, teeth: Option<&TrainTeeth>) -> Vec<Curve> {
    let mut curves = three_arm::arm_curves(mechanism);
    if let Some(course) = arm_clearance_course(mechanism, PARTS) {
        let all = [
            ("between the arms", course.arms),
            ("from arm to tray", course.tray),
        ];
        let found = all.into_iter().filter(|(_, value)| !value.is_empty());
        curves
            .extend(found.map(|(name, value)| {
                Curve::new([ARM_CLEARANCE, name, "mm"], &course.input, value)
            }));
    }
    if let Some(teeth) = teeth {
        curves.extend(contact_curves(&teeth.contact).into_iter().map(|curve| {
            let mut points: Vec<(f64, f64)> = curve
                .input
                .iter()
                .map(|&sun| carrier_turn(mechanism, sun))
                .zip(curve.value)
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (input, value) = points.into_iter().unzip();
            Curve {
                input,
                value,
                ..curve
            }
        }));
    }
    curves
}

fn drawn(mechanism: &ThreeArm, teeth: Option<&GearPair>) -> Picture {
    let coarseness = teeth.map_or(COARSE, |_| 1.0);
    let Ok(tolerance) = Tolerance::new(coarseness * DRAWN * mechanism.center_distance()) else {
        return Picture::default();
    };
    let Ok(machine) = three_arm::drawn(mechanism, teeth) else {
        return Picture::default();
    };
    let (mut picture, contacts) = run_both(
        || linked::picture(&machine, tolerance),
        || three_arm::contacts(mechanism, teeth),
    );
    picture.contacts = contacts;
    if let Some(sun) = picture.links.iter().position(|link| link.name == "sun") {
        let length = mechanism.rolling().pitch_length(Member::Driver);
        picture.handles = handles(&mechanism.design().pitch, length, sun);
    }
    picture
}
