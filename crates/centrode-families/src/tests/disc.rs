//! Family of machine in a list of its own: the whole cost of a new one.

use super::{Depth, Families, Family, Mechanism, PartName, Resolved};
use centrode_analysis::Report;
use centrode_export::picture::{Curve, Picture};
use centrode_export::{ExportError, Options, Package};
use centrode_formats::csv::Column;
use centrode_formats::{Bundle, Format};
use centrode_geometry::{Outline, Point, Solid, Tolerance};
use centrode_kinematics::machine::{Input, Joint, Linear, Link, LinkedMachine, Quantity};
use centrode_spec::{Design, DesignSpec, MechanismError, SpecError};
use centrode_synthesis::optimise::NotSearched;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A disc on a shaft.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
struct DiscDesign {
    name: String,
    /// Radius, mm.
    radius: f64,
}

impl DesignSpec for DiscDesign {
    const FAMILY: &'static str = "disc";
    const ABOUT: &'static str = "A disc on a shaft.";
    const TEMPLATE: &'static str = "family = \"disc\"\nname = \"wheel\"\nradius = 20.0\n";
    const TABLES: &'static [&'static str] = &[];

    fn words(&self) -> [&str; 2] {
        [&self.name, ""]
    }

    fn rules(&self) -> Result<(), SpecError> {
        Ok(())
    }
}

#[derive(Debug)]
struct Disc(DiscDesign);

#[derive(Debug, thiserror::Error)]
#[error("there is no disc of {0} mm")]
struct NoDisc(f64);

impl Disc {
    fn outline(&self) -> Outline {
        Outline::circle(Point::origin(), self.0.radius)
    }
}

impl Mechanism for Disc {
    fn design(&self) -> &dyn Design {
        &self.0
    }

    fn definition(&self) -> String {
        format!("radius {} mm", self.0.radius)
    }

    fn check(&self) -> Report {
        let mut report = Report::default();
        report.values.insert("radius", self.0.radius);
        report
    }

    fn curves(&self) -> Vec<Curve> {
        Vec::new()
    }

    fn picture(&self) -> Picture {
        Picture::default()
    }

    fn machine(&self) -> Result<LinkedMachine, ExportError> {
        let mut machine = LinkedMachine {
            input: Input {
                name: "disc".into(),
                period: TAU,
                speed: 1.0,
            },
            ..LinkedMachine::default()
        };
        let [base, disc] = ["base", "disc"].map(|name| {
            let name = name.into();
            machine.link(Link {
                name,
                mass: Some(
                    Solid::new(self.outline(), Vec::new(), 0.0, 5.0)
                        .expect("a disc")
                        .mass_properties(7850.0),
                ),
                ..Link::default()
            })
        });
        let law = Linear::new(0.0, 1.0);
        let joint = machine.joint(Joint::turning(base, disc, Arc::new(law)));
        let turned = Quantity::joint(joint);
        machine.column("disc_rad", "rad", "turn of the disc", turned);
        Ok(machine)
    }

    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
        let mut package = Package::new("a disc", &self.0.name, "", formats, options);
        let radius = || vec![Column::numbers("radius_mm", [self.0.radius])];
        package.table("disc", "disc", radius)?;
        package.machine(|| self.machine())?;
        package.finish()
    }
}

impl Resolved for Disc {
    type Design = DiscDesign;

    const NOUN: &'static str = "a disc";

    fn resolve(design: &DiscDesign) -> Result<Self, MechanismError> {
        if design.radius <= 0.0 {
            return Err(MechanismError::new("radius".into(), NoDisc(design.radius)));
        }
        Ok(Self(design.clone()))
    }
}

/// List of the one family.
static DISCS: Families = Families(&[Family::new::<Disc>()]);

#[test]
fn a_family_of_ones_own_is_read_checked_and_exported_as_any_other() {
    let file = DISCS.read(DiscDesign::TEMPLATE.as_bytes()).expect("good");
    assert_eq!(
        file.design().to_toml().expect("writable"),
        DiscDesign::TEMPLATE
    );
    let disc = file.mechanism().expect("a disc");
    assert_eq!((disc.design().name(), disc.design().title()), ("wheel", ""));
    assert_eq!(disc.definition(), "radius 20 mm");
    assert!(disc.check().ok() && !disc.is_coarse() && disc.detailed().is_none());
    assert_eq!(disc.check_with_curves().0, disc.report(Depth::Motion));
    let options = Options::new(Tolerance::new(1e-3).expect("positive"));
    let bundle = disc.files(&Format::ALL, &options).expect("files");
    let names: Vec<&str> = bundle.files().map(|(name, _)| name).collect();
    let machine = [
        "motion.csv",
        "motion.json",
        "machine.urdf",
        "play_pybullet.py",
    ];
    let machine = [&machine[..], &["machine.xml", "play_mujoco.py"]].concat();
    assert_eq!(names, [&["disc.csv"], &machine[..]].concat());
    assert!(disc.downcast::<Disc>().is_some());
}

#[test]
fn errors_of_a_family_of_ones_own_are_told_at_their_line() {
    let stated = |text: &str| {
        let found = DISCS.read(text.as_bytes()).and_then(|f| f.mechanism());
        found.expect_err(text).to_string()
    };
    let flat = DiscDesign::TEMPLATE.replace("20.0", "-1.0");
    assert_eq!(
        stated(&flat),
        "line 3, column 1: radius: there is no disc of -1 mm"
    );
    let strange = DiscDesign::TEMPLATE.replace("radius", "radios");
    assert!(stated(&strange).contains("did you mean \"radius\"?"));
    assert!(stated("").contains("write family = \"disc\""));
}

#[test]
fn what_a_family_leaves_out_has_an_answer_all_the_same() {
    let file = DISCS.read(DiscDesign::TEMPLATE.as_bytes()).expect("good");
    let (family, design) = (file.family(), file.design());
    assert_eq!(family.parts, &[] as &[PartName]);
    assert!(matches!(
        family.problem(design).err(),
        Some(NotSearched::Family)
    ));
    let widened = family.widen(design).expect_err("no bounds").to_string();
    assert_eq!(widened, "the bounds of a disc cannot be widened");
    let response = family.sweep(design, &["radius"], &[vec![1.0], vec![-1.0]], Depth::Whole);
    let answers = response.expect("a number").answers();
    assert_eq!(answers[0].figures, [Some(1.0), None]);
    let schema = DISCS.json_schema();
    assert_eq!(schema["oneOf"][0]["properties"]["family"]["const"], "disc");
}
