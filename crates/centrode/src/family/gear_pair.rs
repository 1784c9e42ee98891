use centrode_analysis::{Contact, Report, check, check_contact};
use centrode_export::page::{Curve, Picture};
use centrode_export::{Bundle, ExportError, Format, Options};
use centrode_export::{gear_pair, machine};
use centrode_geometry::Tolerance;
use centrode_mechanism::design::{Design, MechanismError};
use centrode_mechanism::gear::GearPair;
use centrode_mechanism::gear::design::GearPairDesign;
use centrode_mechanism::machine::Machine;

use super::contact::contact_curves;
use super::handles::handles;
use super::{Mechanism, PartName, Resolved};

/// Tolerance of the picture, as a share of the module: a tenth of a pixel when a tooth is as high as a hand.
const DRAWN: f64 = 2e-3;

impl Mechanism for GearPair {
    fn design(&self) -> &dyn Design {
        self.design()
    }

    fn definition(&self) -> String {
        let (driver, driven) = self.mean_ratio();
        format!("{}; mean ratio {driver}:{driven}", self.definition())
    }

    fn check(&self) -> Report {
        check(self)
    }

    fn check_with_curves(&self) -> (Report, Vec<Curve>) {
        let contact = Contact::of(self);
        (check_contact(self, &contact), contact_curves(&contact))
    }

    fn curves(&self) -> Vec<Curve> {
        gear_pair::curves(self)
    }

    fn picture(&self) -> Picture {
        let Ok(tolerance) = Tolerance::new(DRAWN * self.module()) else {
            return Picture::default();
        };
        let mut picture = machine::picture(&gear_pair::drawn(self), tolerance);
        let mut links = picture.links.iter();
        if let Some(link) = links.position(|link| link.name == picture.motion.input_name) {
            let length = self.driver().pitch_length();
            picture.handles = handles(&self.design().pitch, length, link);
        }
        picture
    }

    fn machine(&self) -> Result<Machine, ExportError> {
        gear_pair::machine(self)
    }

    fn accuracy(&self) -> f64 {
        self.accuracy()
    }

    fn files(&self, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
        gear_pair::files(self, formats, options)
    }
}

impl Resolved for GearPair {
    type Design = GearPairDesign;

    const NOUN: &'static str = "a gear pair";

    const PARTS: &'static [PartName] = &[
        PartName::new("driver", "The driver of a pair"),
        PartName::new("driven", "The driven gear of a pair"),
        PartName::ASSEMBLY,
    ];

    fn resolve(design: &GearPairDesign) -> Result<Self, MechanismError> {
        Ok(Self::resolve(design)?)
    }
}
