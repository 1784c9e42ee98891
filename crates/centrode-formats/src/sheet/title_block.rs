use super::{Draft, Pen, lettering, projection};
use crate::drawing::Anchor;
use centrode_geometry::{Bounds, Point};
use centrode_spec::{DrawingSpec, Projection};

/// Width of a title block, mm, ISO 7200.
pub(super) const WIDTH: f64 = 180.0;
/// Height of this title block, mm.
pub(super) const HEIGHT: f64 = 45.0;

/// Field of the texture of the surfaces: left, right, low, high.
const SURFACE: [f64; 4] = [145.0, 180.0, 36.0, 45.0];

/// Height of the names of the fields, mm.
const CAPTION: f64 = 1.8;
/// Width of the field of the titles, and the minimum height of letters there, mm.
const TITLES: f64 = 71.0;
const SMALL: f64 = 2.5;

/// Entries of the title block of a sheet, ISO 7200; unknown ones stay empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TitleBlock {
    /// Legal owner.
    pub owner: String,
    /// Title.
    pub title: String,
    /// Supplementary title.
    pub supplement: String,
    /// Drawing number.
    pub number: String,
    /// Revision.
    pub revision: String,
    /// Date of issue.
    pub date: String,
    /// Person who drew it.
    pub drawn_by: String,
    /// Person who approved it.
    pub approved_by: String,
    /// Kind of document: "Part drawing".
    pub document: String,
    /// Scale of the main view.
    pub scale: String,
    /// Material.
    pub material: String,
    /// Mass, with its unit.
    pub mass: String,
    /// General tolerances.
    pub general_tolerance: String,
    /// State of the edges.
    pub edges: String,
    /// Texture of the surfaces.
    pub surface: String,
    /// Texture of surfaces with a tolerance class up to grade [`TitleBlock::FINE`], and of flanks and profiles; if empty, that of
    /// the other surfaces.
    pub fitted_surface: String,
    /// Arrangement of the views.
    pub projection: Projection,
}

impl TitleBlock {
    /// Fields from a design file for a part, whose name ends the drawing number. `projection` replaces that of the file.
    #[must_use]
    pub fn new(spec: &DrawingSpec, part: &str, projection: Option<Projection>) -> Self {
        let number = match spec.number.as_str() {
            "" => String::new(),
            number => format!("{number}-{part}"),
        };
        Self {
            owner: spec.owner.clone(),
            number,
            revision: spec.revision.clone(),
            date: spec.date.clone(),
            drawn_by: spec.drawn_by.clone(),
            approved_by: spec.approved_by.clone(),
            general_tolerance: spec.general_tolerance.clone(),
            edges: spec.edges.clone(),
            surface: spec.surface.clone(),
            fitted_surface: spec.fitted_surface.clone(),
            projection: projection.unwrap_or(spec.projection),
            ..Self::default()
        }
    }

    /// Fields of a part drawing: name and title of the part, and the machine's title as supplement.
    pub fn of_part(
        spec: &DrawingSpec,
        name: &str,
        title: &str,
        supplement: &str,
        projection: Option<Projection>,
    ) -> Self {
        Self {
            title: title.to_owned(),
            supplement: supplement.to_owned(),
            document: "Part drawing".into(),
            ..Self::new(spec, name, projection)
        }
    }

    /// Coarsest grade of ISO 286 whose surfaces have a texture of their own.
    pub const FINE: u32 = 8;

    /// Adds the texture of fitted surfaces after that of the others, if one of these tolerance classes is fine or `contour` names
    /// flanks or a profile. Returns the note that states where it holds.
    pub fn fitted<'a>(
        &mut self,
        classes: impl IntoIterator<Item = &'a str>,
        contour: &str,
    ) -> Option<String> {
        let grade = |class: &str| {
            let letters = class.trim_end_matches(|c: char| c.is_ascii_digit());
            class[letters.len()..].parse::<u32>().ok()
        };
        // Threads have a class, too: 6H.
        let mut grades = classes.into_iter().filter_map(grade);
        let is_fine = grades.any(|grade| grade <= Self::FINE);
        let fine = self.fitted_surface.clone();
        if fine.trim().is_empty() || fine == self.surface || (!is_fine && contour.is_empty()) {
            return None;
        }
        let classes = format!("surfaces with a class up to grade {}", Self::FINE);
        let places = match (is_fine, contour) {
            (true, "") => classes,
            (false, contour) => contour.into(),
            (true, contour) => format!("{classes}, {contour}"),
        };
        self.surface = format!("{} ({fine})", self.surface);
        Some(format!("{fine}: {places}."))
    }

    /// Draft of the block, its lower left corner in the origin, on the sheet `page` of `pages`.
    pub(super) fn draft(&self, size: &str, page: usize, pages: usize) -> Draft {
        let mut draft = Draft::default();
        let sheet = format!("{page}/{pages}");
        let cells: [(&str, &str, [f64; 4]); 17] = [
            ("Material", &self.material, [0.0, 55.0, 36.0, 45.0]),
            (
                "General tolerances",
                &self.general_tolerance,
                [55.0, 95.0, 36.0, 45.0],
            ),
            ("Edges", &self.edges, [95.0, 145.0, 36.0, 45.0]),
            ("Surface texture", "", SURFACE),
            ("", "", [0.0, 35.0, 18.0, 36.0]),
            ("Created by", &self.drawn_by, [35.0, 85.0, 27.0, 36.0]),
            ("Approved by", &self.approved_by, [85.0, 135.0, 27.0, 36.0]),
            ("Document type", &self.document, [135.0, 180.0, 27.0, 36.0]),
            ("Scale", &self.scale, [35.0, 60.0, 18.0, 27.0]),
            ("Mass", &self.mass, [60.0, 85.0, 18.0, 27.0]),
            ("Date of issue", &self.date, [85.0, 113.0, 18.0, 27.0]),
            ("Language", "en", [113.0, 135.0, 18.0, 27.0]),
            ("Format", size, [135.0, 157.5, 18.0, 27.0]),
            ("Sheet", &sheet, [157.5, 180.0, 18.0, 27.0]),
            ("Legal owner", &self.owner, [0.0, 60.0, 0.0, 18.0]),
            ("Drawing number", &self.number, [135.0, 180.0, 9.0, 18.0]),
            ("Revision", &self.revision, [135.0, 180.0, 0.0, 9.0]),
        ];
        for (caption, value, [left, right, low, high]) in cells {
            draft.rectangle(Pen::Rule, cell(left, right, low, high));
            let at = Point::new(left + 1.2, high - CAPTION - 1.0);
            draft.text(at, CAPTION, caption, Anchor::Left);
            let at = Point::new(left + 2.0, low + 0.5 * (high - low - CAPTION) - 1.6);
            let room = right - left - 4.0;
            draft.text_within(at, &[3.5, 2.5], value, Anchor::Left, room);
        }
        self.surface(&mut draft);
        self.titles(&mut draft);
        let center = Point::new(17.5, 27.0);
        projection::symbol(&mut draft, center, 9.0, self.projection);
        draft.rectangle(Pen::Outline, cell(0.0, WIDTH, 0.0, HEIGHT));
        draft
    }

    /// Draws the symbol of a surface from which material is removed, ISO 21920-1, and its requirements.
    fn surface(&self, draft: &mut Draft) {
        if self.surface.is_empty() {
            return;
        }
        let [left, right, low, _] = SURFACE;
        let slope = 60.0_f64.to_radians().tan();
        let foot = Point::new(left + 4.0, low + 0.6);
        let at = |x: f64, y: f64| Point::new(foot.x + x, foot.y + y);
        let (short, long) = (2.3, 4.6);
        draft.line(Pen::Thin, foot, at(-short / slope, short));
        draft.line(Pen::Thin, foot, at(long / slope, long));
        draft.line(
            Pen::Thin,
            at(-short / slope, short),
            at(short / slope, short),
        );
        let from = at(long / slope + 0.8, 0.8);
        let room = right - from.x - 1.0;
        draft.text_within(from, &[3.5, 2.5], &self.surface, Anchor::Left, room);
    }

    fn titles(&self, draft: &mut Draft) {
        draft.rectangle(Pen::Rule, cell(60.0, 135.0, 0.0, 18.0));
        let at = Point::new(61.2, 18.0 - CAPTION - 1.0);
        draft.text(at, CAPTION, "Title, supplementary title", Anchor::Left);
        let line = |y: f64| Point::new(62.0, y);
        // A long supplementary title takes two lines, the second after a comma if there is one.
        let fits = |words: &str| lettering::width(words, SMALL) <= TITLES;
        let breaks = self.supplement.match_indices(' ').map(|(at, _)| at);
        let breaks = breaks.rev().filter(|&at| fits(&self.supplement[..at]));
        let is_good = |at: &usize| {
            let (first, second) = self.supplement.split_at(*at);
            first.ends_with(',') && fits(second)
        };
        let found = breaks.clone().find(is_good).or(breaks.clone().next());
        match found.filter(|_| !fits(&self.supplement)) {
            Some(at) => {
                draft.text_within(line(9.2), &[3.5], &self.title, Anchor::Left, TITLES);
                let (first, second) = self.supplement.split_at(at);
                draft.text_within(line(4.9), &[SMALL], first, Anchor::Left, TITLES);
                draft.text_within(line(1.2), &[SMALL], second.trim(), Anchor::Left, TITLES);
            }
            None => {
                let (title, words) = (&self.title, &self.supplement);
                draft.text_within(line(8.3), &[5.0, 3.5], title, Anchor::Left, TITLES);
                draft.text_within(line(2.6), &[3.5, SMALL], words, Anchor::Left, TITLES);
            }
        }
    }
}

fn cell(left: f64, right: f64, low: f64, high: f64) -> Bounds {
    Bounds {
        min: Point::new(left, low),
        max: Point::new(right, high),
    }
}
