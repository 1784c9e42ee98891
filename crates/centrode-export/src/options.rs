use centrode_formats::dxf;
use centrode_geometry::Tolerance;
use centrode_kinematics::machine::Datum;
use centrode_spec::{Projection, SheetSize};

/// How files are written.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Maximum distance of every arc, point sequence and mesh from the exact curve.
    pub tolerance: Tolerance,
    /// Version of the DXF files.
    pub dxf_version: dxf::Version,
    /// Arcs or splines in the DXF.
    pub dxf_curves: dxf::Curves,
    /// Layers of the cutting files.
    pub layers: Layers,
    /// Width of the cut, mm, for which the contours of cutting files are moved; default: that of the design, otherwise 0.
    pub kerf: Option<f64>,
    /// How the drawing sheets are laid out.
    pub sheet: SheetOptions,
    /// Parts for which drawings, sheets, solids and tables are written, by the names of their files; default: all. Models and
    /// motion always contain the whole machine.
    pub parts: Option<Vec<String>>,
    /// Whether the bundle contains straight extrusions as solids instead of their files.
    pub keep_solids: bool,
}

impl Options {
    /// DXF R2010 with arcs, for all parts.
    #[must_use]
    pub fn new(tolerance: Tolerance) -> Self {
        Self {
            tolerance,
            dxf_version: dxf::Version::default(),
            dxf_curves: dxf::Curves::default(),
            layers: Layers::default(),
            kerf: None,
            sheet: SheetOptions::default(),
            parts: None,
            keep_solids: false,
        }
    }

    /// Whether a part is requested.
    pub(crate) fn wants(&self, part: &str) -> bool {
        let named = self.parts.as_ref();
        named.is_none_or(|parts| parts.iter().any(|name| name == part))
    }
}

/// Layers of the cutting files of parts, DXF and SVG.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Layers {
    /// Contour and holes: the lines to cut.
    #[default]
    Cut,
    /// Pitch curve, tip and root curves, and centre lines too, on layers that do not plot (R12 has no such layers).
    All,
}

centrode_spec::words!(Layers { Cut = "cut", All = "all" });

/// Layout of sheets where it differs from the design.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetOptions {
    /// Size; default: that of the design, otherwise the smallest size on which the part fits.
    pub size: Option<SheetSize>,
    /// How views lie to each other; default: as in the design.
    pub projection: Option<Projection>,
    /// Findings of checks, listed in tables next to the data of the design.
    pub found: Vec<Datum>,
}
