use std::borrow::Cow;
use std::sync::Arc;

use centrode_analysis::{Report, Sweep};
use centrode_gear::pitch::SAMPLE_TABLES;
use centrode_spec::{
    self, Design, DesignError, DesignFamily, DesignFault, DesignFile, DesignSpec, MechanismError,
    OpenFile,
};
use centrode_synthesis::optimise::{DesignProblem, NotSearched};

use super::passing::PassingProblem;
use super::{Depth, Mechanism, OpenDesign, Widening, WideningError};

/// Mechanism of one family, with all that the registry needs in addition to the mechanism itself.
pub trait Resolved: Mechanism + Sized {
    /// Design of the family.
    type Design: DesignSpec;

    /// Noun for one machine of the family, for use in sentences: `a gear pair`.
    const NOUN: &'static str;

    /// Parts whose files can be requested by name.
    const PARTS: &'static [PartName] = &[];

    /// Resolves a design.
    ///
    /// # Errors
    /// [`MechanismError`] with the key at fault.
    fn resolve(design: &Self::Design) -> Result<Self, MechanismError>;

    /// Report of a design to a depth.
    ///
    /// # Errors
    /// [`MechanismError`] with the key at fault, if the design gives nothing to check to this depth.
    fn report(design: &Self::Design, depth: Depth) -> Result<Report, MechanismError> {
        let mechanism: &dyn Mechanism = &Self::resolve(design)?;
        Ok(mechanism.report(depth))
    }

    /// Search problem that starts from a design.
    ///
    /// # Errors
    /// [`NotSearched`] for a design that no search accepts.
    fn problem(_design: &Self::Design) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
        Err(NotSearched::Family)
    }

    /// Minimum widening of a design's bounds with which all its goals can be reached.
    ///
    /// # Errors
    /// A sentence with the reason why there is none.
    fn widen(_design: &Self::Design) -> Result<Widening, WideningError> {
        Err(format!("the bounds of {} cannot be widened", Self::NOUN).into())
    }
}

/// A part of a machine, or the assembly, by its name.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct PartName {
    /// Name of the part and of its files.
    pub name: &'static str,
    /// Description.
    pub about: &'static str,
}

impl PartName {
    /// The whole machine, as drawings show it.
    pub const ASSEMBLY: Self = Self::new("assembly", "The assembly");

    /// Makes a part from its name and its description.
    #[must_use]
    pub const fn new(name: &'static str, about: &'static str) -> Self {
        Self { name, about }
    }
}

pub(crate) type Resolve = fn(&dyn Design) -> Result<Arc<dyn Mechanism>, MechanismError>;
type SetProblem = fn(&dyn Design) -> Result<Box<dyn DesignProblem + Send>, NotSearched>;

/// One family of machine.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Name, template and reader of the family's design files.
    pub design: DesignFamily,
    /// Noun for one machine of the family, for use in sentences: `a gear pair`.
    pub noun: &'static str,
    /// Parts whose files can be requested by name; empty if the design names its parts.
    pub parts: &'static [PartName],
    resolve: Resolve,
    report: fn(&dyn Design, Depth) -> Result<Report, MechanismError>,
    problem: SetProblem,
    widen: fn(&dyn Design) -> Result<Widening, WideningError>,
}

impl Family {
    /// The family of a mechanism.
    #[must_use]
    pub const fn new<M: Resolved>() -> Self {
        Self {
            design: DesignFamily::new::<M::Design>(),
            noun: M::NOUN,
            parts: M::PARTS,
            resolve: |design| Ok(Arc::new(M::resolve(own(design)?)?)),
            report: |design, depth| M::report(own(design)?, depth),
            problem: |design| match own(design) {
                Ok(design) => M::problem(design),
                Err(_) => Err(NotSearched::Family),
            },
            widen: |design| M::widen(own(design)?),
        }
    }

    /// Resolves a design.
    ///
    /// # Errors
    /// [`MechanismError`] with the key at fault: `family` if the design is of another family.
    pub fn resolve(&self, design: &dyn Design) -> Result<Arc<dyn Mechanism>, MechanismError> {
        (self.resolve)(design)
    }

    /// Report of a design to a depth. Parts that this depth does not check need not exist: a pair whose teeth cannot be cut has a
    /// report of its motion.
    ///
    /// # Errors
    /// [`MechanismError`] with the key at fault.
    pub fn report(&self, design: &dyn Design, depth: Depth) -> Result<Report, MechanismError> {
        (self.report)(design, depth)
    }

    /// Search problem that starts from a design. Its goals are reached by designs that pass the check.
    ///
    /// # Errors
    /// [`NotSearched`] for a design that no search accepts.
    pub fn problem(
        &self,
        design: &dyn Design,
    ) -> Result<Box<dyn DesignProblem + Send>, NotSearched> {
        let inner = (self.problem)(design)?;
        let resolve = self.resolve;
        Ok(Box::new(PassingProblem { inner, resolve }))
    }

    /// Minimum widening of a design's bounds with which all its goals can be reached.
    ///
    /// # Errors
    /// A sentence with the reason why there is none.
    pub fn widen(&self, design: &dyn Design) -> Result<Widening, WideningError> {
        (self.widen)(design)
    }

    /// Checks variants of a design to a depth, on all cores: each has its own values at the keys, in the file's units.
    ///
    /// # Errors
    /// [`DesignError`] if a key is not that of a number of the design, or is given twice.
    pub fn sweep(
        &self,
        design: &dyn Design,
        keys: &[&str],
        variants: &[Vec<f64>],
        depth: Depth,
    ) -> Result<Sweep, DesignError> {
        Sweep::evaluate(design, keys, variants, |design| self.report(design, depth))
    }

    /// Checks variants of a design to the first depth that is enough; to the whole depth if none is.
    ///
    /// # Errors
    /// [`DesignError`], as of [`Self::sweep`].
    pub fn sweep_until(
        &self,
        design: &dyn Design,
        keys: &[&str],
        variants: &[Vec<f64>],
        is_enough: impl Fn(&Sweep) -> bool,
    ) -> Result<Sweep, DesignError> {
        for depth in [Depth::Motion, Depth::Made] {
            let sweep = self.sweep(design, keys, variants, depth)?;
            if is_enough(&sweep) {
                return Ok(sweep);
            }
        }
        self.sweep(design, keys, variants, Depth::Whole)
    }
}

impl AsRef<DesignFamily> for Family {
    fn as_ref(&self) -> &DesignFamily {
        &self.design
    }
}

/// Casts to the design type of a family.
fn own<D: DesignSpec>(design: &dyn Design) -> Result<&D, MechanismError> {
    design.downcast_ref().ok_or_else(|| MechanismError {
        key: "family".into(),
        fault: DesignFault::UnknownWord {
            word: design.family().word.into(),
            near: None,
            known: vec![D::FAMILY.into()],
        },
    })
}

/// Families that the key `family` of a design file can name.
#[derive(Clone, Copy, Debug)]
pub struct Families(pub &'static [Family]);

impl Families {
    /// Words that name the families.
    #[must_use]
    pub fn words(&self) -> Vec<&'static str> {
        self.0.iter().map(|family| family.design.word).collect()
    }

    /// The family with a name.
    #[must_use]
    pub fn named(&self, word: &str) -> Option<&'static Family> {
        self.0.iter().find(|family| family.design.word == word)
    }

    /// A commented design file of a family to start from, which is a valid design.
    #[must_use]
    pub fn template(&self, word: &str) -> Option<&'static str> {
        self.named(word).map(|family| family.design.template)
    }

    /// The JSON schema of the design files of all families.
    #[must_use]
    pub fn json_schema(&self) -> serde_json::Value {
        centrode_spec::json_schema(self.0)
    }

    /// Text of a design file with the samples of the files that it names, as [`DesignFile::with_files`] makes it.
    ///
    /// # Errors
    /// [`DesignError`] at the key `file` or `column`, with the line of the file.
    pub fn with_files<'t>(
        &self,
        text: &'t str,
        open: OpenFile<'_>,
    ) -> Result<Cow<'t, str>, DesignError> {
        DesignFile::with_files(text, &SAMPLE_TABLES, open)
    }

    /// Every mistake of a design file, as [`DesignFile::mistakes`] finds them.
    #[must_use]
    pub fn mistakes(&self, bytes: &[u8]) -> Vec<DesignError> {
        DesignFile::mistakes(bytes, self.0)
    }

    /// Reads a design file of one of the families and checks every rule that needs no geometry.
    ///
    /// # Errors
    /// [`DesignError`] with key, line and column.
    pub fn read(&self, bytes: &[u8]) -> Result<OpenDesign, DesignError> {
        let (file, family) = DesignFile::read(bytes, self.0)?;
        Ok(OpenDesign::new(*family, file))
    }
}
