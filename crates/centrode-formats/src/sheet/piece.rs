use super::{Corner, Draft, Table};
use crate::drawing::Anchor;
use centrode_geometry::Point;
use centrode_spec::SheetSize;

/// A piece of the first page.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetBlock {
    /// Name of the piece, for errors.
    pub name: &'static str,
    /// Drawing of the piece.
    pub draft: Draft,
    /// The corner of the sheet near which it is placed.
    pub corner: Corner,
    /// Whether it is put in the middle of its room, as views are.
    pub floats: bool,
    /// Whether it must be on the first page; others move to the next page if there is no room.
    pub leads: bool,
    /// Whether it moves to a further page instead of making the first larger.
    pub waits: bool,
}

impl SheetBlock {
    /// Main view, at the upper left of the first page.
    pub fn view(name: &'static str, draft: Draft) -> Self {
        Self {
            leads: true,
            ..Self::detail(name, draft, Corner::UpperLeft)
        }
    }

    /// Section or detail.
    pub fn detail(name: &'static str, draft: Draft, corner: Corner) -> Self {
        Self {
            name,
            draft,
            corner,
            floats: true,
            leads: false,
            waits: false,
        }
    }

    /// Section that may be on a further page.
    pub fn further(name: &'static str, draft: Draft) -> Self {
        Self {
            floats: false,
            waits: true,
            ..Self::detail(name, draft, Corner::UpperLeft)
        }
    }

    /// Table of one block, at the upper right.
    pub fn table(name: &'static str, table: &Table) -> Self {
        Self {
            floats: false,
            ..Self::detail(name, table.whole(), Corner::UpperRight)
        }
    }

    /// Lines of words, at the upper right.
    pub fn notes(lines: &[String]) -> Self {
        let mut draft = Draft::default();
        for (row, line) in lines.iter().enumerate() {
            let at = Point::new(0.0, -4.6 * row as f64);
            draft.text(at, 2.5, line, Anchor::Left);
        }
        Self {
            floats: false,
            ..Self::detail("notes", draft, Corner::UpperRight)
        }
    }
}

/// Height of the letters of views, mm: smaller on the smallest sheet.
pub fn view_letters(size: SheetSize) -> f64 {
    match size {
        SheetSize::A4 => 2.5,
        _ => 3.5,
    }
}
