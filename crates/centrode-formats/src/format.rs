use centrode_geometry::Tolerance;
use std::{fmt, str::FromStr};
use thiserror::Error;

/// A kind of file an export writes.
#[derive(Clone, Copy, Debug, Eq, Hash, Ord, PartialEq, PartialOrd)]
#[non_exhaustive]
pub enum Format {
    /// Cutting files: each part, and the assembly.
    Dxf,
    /// Pictures of the cutting files.
    Svg,
    /// Drawing sheets with views, dimensions and tables, as DXF and as pictures.
    Sheet,
    /// Drawing sheets as PDF.
    Pdf,
    /// Solids.
    Stl,
    /// Exact solids for CAD.
    Step,
    /// Solids as meshes with their unit, for 3D printing.
    ThreeMf,
    /// Tables: points of the outlines, motion, forces.
    Csv,
    /// Simulator model, with the solids it shows.
    Urdf,
    /// `MuJoCo` model, with the solids it shows.
    Mjcf,
}

centrode_spec::words!(Format {
    Dxf = "dxf",
    Svg = "svg",
    Sheet = "sheet",
    Pdf = "pdf",
    Step = "step",
    Stl = "stl",
    ThreeMf = "3mf",
    Csv = "csv",
    Urdf = "urdf",
    Mjcf = "mjcf",
});

/// Purpose of a design's files, which determines formats and tolerance.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[non_exhaustive]
pub enum Purpose {
    /// A machine that cuts flat parts.
    Laser,
    /// A printer.
    Print,
    /// A CAD program.
    Cad,
    /// A workshop that makes parts from drawings.
    Drawing,
    /// A simulator.
    Simulation,
}

centrode_spec::words!(Purpose {
    Laser = "laser",
    Print = "print",
    Cad = "cad",
    Drawing = "drawing",
    Simulation = "simulation",
});

impl Format {
    /// Default formats: for a cutter, CAD, a workshop and a printer.
    pub const USUAL: [Self; 5] = [Self::Dxf, Self::Svg, Self::Pdf, Self::Step, Self::ThreeMf];
}

impl Purpose {
    /// Formats for the purpose, in the order files are written.
    #[must_use]
    pub fn formats(self) -> &'static [Format] {
        match self {
            Self::Laser => &[Format::Dxf, Format::Svg],
            Self::Print => &[Format::Stl, Format::ThreeMf],
            Self::Cad => &[Format::Dxf, Format::Step],
            Self::Drawing => &[Format::Sheet, Format::Pdf],
            Self::Simulation => &[Format::Csv, Format::Urdf, Format::Mjcf],
        }
    }

    /// Tolerance for it: a tenth of a nozzle's steps for a printer, finer than any machine cuts for the others.
    #[must_use]
    pub fn tolerance(self) -> Tolerance {
        match self {
            Self::Print => Tolerance::MICROMETRE.scaled(10.0),
            _ => Tolerance::MICROMETRE,
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A word that names no format.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "no format is named {0:?}; there are dxf, svg, sheet, pdf, stl, step, 3mf, csv, urdf and mjcf"
)]
pub struct UnknownFormat(pub String);

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(word: &str) -> Result<Self, UnknownFormat> {
        Self::named(word).ok_or_else(|| UnknownFormat(word.to_owned()))
    }
}
