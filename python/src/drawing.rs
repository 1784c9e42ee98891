use centrode_spec as spec;

use crate::table::table;

table! {
    /// Entries of the title block of drawing sheets, and their layout.
    ///
    /// Entries without a value stay empty on the sheet.
    ///
    /// Args:
    ///     number: Drawing number; the name of the part is added to it.
    ///     revision: Revision.
    ///     date: Date of issue, printed as written.
    ///     owner: Legal owner.
    ///     drawn_by: Name of the person who made the drawing.
    ///     approved_by: Name of the person who approved the drawing.
    ///     sheet: "A4" to "A0"; default: the smallest on which the part fits.
    ///     projection: "first-angle" or "third-angle".
    ///     general_tolerance: General tolerances.
    ///     edges: State of the edges.
    ///     surface: Surface texture (ISO 21920) of all surfaces without their own symbol.
    ///     fitted_surface: Surface texture (ISO 21920) of surfaces with a tolerance class up to grade 8, and of flanks
    ///         and profiles.
    ///
    /// >>> import centrode as ct
    /// >>> ct.DrawingSpec(number="7-204", sheet="A3").projection
    /// 'first-angle'
    "centrode" DrawingSpec(spec::DrawingSpec) from spec::DrawingSpec::default(), keys "", rules spec::DrawingSpec::validate;
    needed {}
    usual {
        /// Drawing number.
        number: String,
        /// Revision.
        revision: String,
        /// Date of issue.
        date: String,
        /// Legal owner.
        owner: String,
        /// Name of the person who made the drawing.
        drawn_by: String,
        /// Name of the person who approved the drawing.
        approved_by: String,
        /// Size of the sheets; None for the smallest on which the part fits.
        sheet: Option<spec::SheetSize>,
        /// "first-angle" or "third-angle".
        projection: spec::Projection,
        /// General tolerances.
        general_tolerance: String,
        /// State of the edges.
        edges: String,
        /// Surface texture of all surfaces without their own symbol.
        surface: String,
        /// Texture of the surfaces with a tolerance class up to grade 8, and of flanks and profiles.
        fitted_surface: String,
    }
}
