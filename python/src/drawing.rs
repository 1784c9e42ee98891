use centrode_spec as spec;

use crate::table::table;

table! {
    /// Words of the title block of drawing sheets, and their layout.
    ///
    /// Keywords omitted stay empty on the sheet.
    ///
    /// Args:
    ///     number: Drawing number; the part's name is added to it.
    ///     revision: Revision.
    ///     date: Date of issue, as it is to be printed.
    ///     owner: Legal owner.
    ///     drawn_by: Who has drawn it.
    ///     approved_by: Who has approved it.
    ///     sheet: "A4" to "A0"; the smallest that takes the part by default.
    ///     projection: "first-angle" or "third-angle".
    ///     general_tolerance: General tolerances.
    ///     edges: State of the edges.
    ///     surface: Texture of the surfaces without a texture of their own, ISO 21920.
    ///     fitted_surface: Texture of the surfaces with a tolerance class up to grade 8, and of flanks and profiles.
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
        /// Who has drawn it.
        drawn_by: String,
        /// Who has approved it.
        approved_by: String,
        /// Size of the sheets; None for the smallest that takes the part.
        sheet: Option<spec::SheetSize>,
        /// "first-angle" or "third-angle".
        projection: spec::Projection,
        /// General tolerances.
        general_tolerance: String,
        /// State of the edges.
        edges: String,
        /// Texture of the surfaces without a texture of their own.
        surface: String,
        /// Texture of the surfaces with a tolerance class up to grade 8, and of flanks and profiles.
        fitted_surface: String,
    }
}
