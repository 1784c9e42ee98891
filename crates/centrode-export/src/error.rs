use std::error::Error;

use centrode_formats::{
    BundleError, Format, csv::TableError, dxf::DxfError, mjcf::MjcfError, pdf::PdfError,
    sheet::SheetError, step::StepError, threemf::PackageError, urdf::UrdfError,
};
use centrode_geometry::{LoopError, SolidError};
use thiserror::Error as Explained;

/// Reason why the files of a machine could not be made.
#[derive(Debug, Explained)]
#[non_exhaustive]
pub enum ExportError {
    /// The tolerance is so coarse that little would be left of a part.
    #[error(
        "a tolerance of {tolerance} mm is too coarse: at most a tenth of the {of}, {largest:.4} mm"
    )]
    Tolerance {
        /// The tolerance, mm.
        tolerance: f64,
        /// The coarsest possible tolerance, mm.
        largest: f64,
        /// Name of the smallest size of the machine, which limits the tolerance.
        of: &'static str,
    },
    /// The tolerance is so fine that a part would take more pieces than anyone can use.
    #[error(
        "a tolerance of {tolerance} mm is too fine: at least a billionth of the {of}, {minimum:.3e} mm"
    )]
    FineTolerance {
        /// The tolerance, mm.
        tolerance: f64,
        /// The finest possible tolerance, mm.
        minimum: f64,
        /// Name of the size of the machine that limits the tolerance.
        of: &'static str,
    },
    /// A machine as designed lacks a part that its files need.
    #[error("{}{source}", key.as_ref().map(|key| format!("{key}: ")).unwrap_or_default())]
    Missing {
        /// Key of the design file at fault, where the reason does not name it.
        key: Option<String>,
        /// The error of the mechanism.
        source: Box<dyn Error + Send + Sync>,
    },
    /// No part of the machine has the requested name.
    #[error("{machine} has no part named {part}; there are {}", known.join(", "))]
    UnknownPart {
        /// Kind of machine, with its article.
        machine: &'static str,
        /// The requested name.
        part: String,
        /// Names of the parts that exist.
        known: Vec<String>,
    },
    /// A format for whole machines was requested for a cam alone.
    #[error("a cam alone is no machine: it cannot be written as {0}")]
    NoModel(Format),
    /// A part is no solid at this tolerance.
    #[error("the {part} is no solid: {source}")]
    Solid {
        /// Name of the part.
        part: String,
        /// Why.
        source: SolidError,
    },
    /// A cut is too wide for a part.
    #[error(
        "{contour} of the {part} cannot be cut with a kerf of {kerf} mm: {source}; give a narrower kerf"
    )]
    Kerf {
        /// Name of the part.
        part: String,
        /// The contour: an outline, or a hole with its size.
        contour: String,
        /// Width of the cut, mm.
        kerf: f64,
        /// Reason of the geometry.
        source: LoopError,
    },
    /// The drawing sheets of a part cannot be laid out.
    #[error("{part} drawing: {source}")]
    Sheet {
        /// Name of the part.
        part: String,
        /// Why.
        source: SheetError,
    },
    /// A part cannot be written as STEP.
    #[error("the {part} cannot be written as STEP: {source}")]
    Step {
        /// Name of the part.
        part: String,
        /// Why.
        source: StepError,
    },
    /// A drawing could not be written.
    #[error(transparent)]
    Dxf(#[from] DxfError),
    /// Drawing sheets could not be written as PDF.
    #[error(transparent)]
    Pdf(#[from] PdfError),
    /// A 3MF package could not be made.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The simulator model could not be written.
    #[error(transparent)]
    Urdf(#[from] UrdfError),
    /// The `MuJoCo` model could not be written.
    #[error(transparent)]
    Mjcf(#[from] MjcfError),
    /// A description could not be written as JSON.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// The files do not go together, or could not be written.
    #[error(transparent)]
    Bundle(#[from] BundleError),
}

impl ExportError {
    /// Error for a part that the machine lacks; its reason names the key of the design.
    pub(crate) fn missing(source: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        let source = source.into();
        Self::Missing { key: None, source }
    }

    /// Error for a part that the machine lacks, with the key of the design.
    pub(crate) fn missing_at(
        key: impl Into<String>,
        source: impl Into<Box<dyn Error + Send + Sync>>,
    ) -> Self {
        Self::Missing {
            key: Some(key.into()),
            source: source.into(),
        }
    }

    /// Adds the name of the part to the error of its solid.
    pub(crate) fn no_solid(part: &str) -> impl FnOnce(SolidError) -> Self {
        let part = part.to_owned();
        |source| Self::Solid { part, source }
    }

    /// Adds the name of the part to the error of its sheets.
    pub(crate) fn no_sheet(part: &str) -> impl FnOnce(SheetError) -> Self {
        let part = part.to_owned();
        |source| Self::Sheet { part, source }
    }
}
