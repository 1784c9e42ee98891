//! Drawing sheets: one layout on paper (ISO 5457) for DXF, SVG and PDF.

mod dimension;
mod draft;
mod frame;
pub mod geometrical;
mod hatch;
mod layout;
pub mod lettering;
mod number;
mod overlap;
mod pen;
mod piece;
mod projection;
mod scale;
mod table;
mod title_block;

use crate::drawing::Drawing;
use centrode_geometry::{Bounds, Vector};
use centrode_spec::SheetSize;
pub use dimension::dimension_words;
pub use draft::Draft;
pub use layout::Corner;
use layout::Page;
pub use number::{number, steady};
pub use overlap::{Overlap, overlaps};
pub use pen::Pen;
pub use piece::{SheetBlock, view_letters};
pub use scale::Scale;
pub use table::{Table, broken};
use thiserror::Error;
pub use title_block::TitleBlock;

/// Distance of everything from the frame, mm: room for the centring marks.
const INSET: f64 = 7.0;

/// Minimum fraction of a sheet's room that the pieces must take at full scale or larger; an emptier sheet is replaced by a
/// smaller one with a reduced view.
const FILLED: f64 = 0.5;
/// Minimum length on paper of the longest side of a view that is reduced for a smaller sheet, mm.
const READABLE: f64 = 100.0;

/// One page of a drawing, in millimetres on paper from its lower left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Size of the trimmed sheet.
    pub size: SheetSize,
    /// Everything on it, on the layers of the [`Pen`]s.
    pub drawing: Drawing,
}

/// Reason why there is no sheet.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SheetError {
    /// The views do not fit, not even at the smallest scale.
    #[error("the views with their dimensions do not fit on {}: at scale {scale} they still need {:.0} x {:.0} mm, and {:.0} x {:.0} mm is available", size.name(), needed[0], needed[1], room[0], room[1])]
    Views {
        /// The requested sheet.
        size: SheetSize,
        /// The smallest scale.
        scale: Scale,
        /// Width and height taken at that scale, mm.
        needed: [f64; 2],
        /// Width and height of the drawing space, mm.
        room: [f64; 2],
    },
    /// A table is wider than the sheet.
    #[error("the table {title:?} is {width:.0} mm wide; {} has room for {room:.0} mm", size.name())]
    Table {
        /// The requested sheet.
        size: SheetSize,
        /// Title of the table.
        title: String,
        /// Width of the table, mm.
        width: f64,
        /// Width of the drawing space, mm.
        room: f64,
    },
}

/// Composes the sheets of a drawing: the pieces on the first, at the largest recommended scale that fits; the
/// tables where there is room left, and on further sheets.
///
/// `extent` is the longest side of a view at full scale, mm: no scale is tried at which it alone is too long. Without a requested
/// size the sheet is the smallest one on which all pieces fit at full scale or larger, or A0. If the pieces take less than half
/// of its room, it is a smaller one on which they fit reduced, with the longest side at least 100 mm on paper.
///
/// # Errors
/// [`SheetError`] if views or a table do not fit on the requested sheet.
pub fn compose(
    required: Option<SheetSize>,
    block: &TitleBlock,
    extent: f64,
    pieces: &dyn Fn(Scale, SheetSize) -> Vec<SheetBlock>,
    tables: &[Table],
) -> Result<Vec<Sheet>, SheetError> {
    let possible = |size: SheetSize, scale: &&Scale| {
        let room = room(size).max - room(size).min;
        scale.factor() * extent <= room.amax()
    };
    let [full, reduced] = Scale::RECOMMENDED
        .split_at_checked(7)
        .map_or([&Scale::RECOMMENDED[..], &[]], |(full, reduced)| {
            [full, reduced]
        });
    let complete = |size: SheetSize, scales: &[Scale]| {
        scales
            .iter()
            .filter(|s| possible(size, s))
            .find_map(|&scale| {
                let (page, rest) = place(size, pieces(scale, size))?;
                rest.iter()
                    .all(|piece| piece.waits)
                    .then_some((size, scale, page, rest))
            })
    };
    let sizes = required.map_or(SheetSize::ALL.to_vec(), |size| vec![size]);
    let whole = sizes.iter().find_map(|&size| complete(size, full));
    let is_empty = |page: &Page, size| page.filled() < FILLED * area(room(size));
    let smaller = match &whole {
        Some((size, _, page, _)) if is_empty(page, *size) => {
            let readable = |s: &&Scale| s.factor() * extent >= READABLE;
            let reduced: Vec<Scale> = reduced.iter().filter(readable).copied().collect();
            // A4 is excluded: it has smaller letters.
            let larger = |own: &&SheetSize| **own > SheetSize::A4 && *own < size;
            let mut sizes = sizes.iter().filter(larger);
            sizes.find_map(|&size| complete(size, &reduced))
        }
        _ => None,
    };
    if let Some((size, scale, page, rest)) = smaller.or(whole) {
        return pages(size, scale, block, page, rest, tables);
    }
    let size = required.unwrap_or(SheetSize::A0);
    for &scale in full.iter().chain(reduced).filter(|s| possible(size, s)) {
        if let Some((page, rest)) = place(size, pieces(scale, size)) {
            return pages(size, scale, block, page, rest, tables);
        }
    }
    let scale = Scale::RECOMMENDED[Scale::RECOMMENDED.len() - 1];
    let room = room(size).max - room(size).min;
    // At the smallest scale little is left of a view but its dimensions.
    let leading = pieces(scale, size).into_iter().filter(|p| p.leads);
    let needed = leading
        .map(|piece| piece.draft.bounds())
        .map(|bounds| bounds.max - bounds.min)
        .fold(Vector::zeros(), |a: Vector, b| a.sup(&b));
    Err(SheetError::Views {
        size,
        scale,
        needed: needed.into(),
        room: room.into(),
    })
}

fn room(size: SheetSize) -> Bounds {
    let Bounds { min, max } = frame::space(size);
    let inset = Vector::repeat(INSET);
    Bounds {
        min: min + inset,
        max: max - inset,
    }
}

fn area(Bounds { min, max }: Bounds) -> f64 {
    (max - min).product()
}

fn block_place(size: SheetSize) -> Bounds {
    let Bounds { min, max } = frame::space(size);
    let corner = centrode_geometry::Point::new(max.x - title_block::WIDTH, min.y);
    Bounds {
        min: corner,
        max: corner + Vector::new(title_block::WIDTH, title_block::HEIGHT),
    }
}

fn blank(size: SheetSize) -> Page {
    Page::new(room(size), block_place(size))
}

/// A page with all leading views, and the pieces without room, with the waiting ones last; `None` if a leading view has no room.
fn place(size: SheetSize, pieces: Vec<SheetBlock>) -> Option<(Page, Vec<SheetBlock>)> {
    let (waiting, pieces): (Vec<SheetBlock>, Vec<SheetBlock>) =
        pieces.into_iter().partition(|p| p.waits);
    let (mut page, mut rest) = placed(size, pieces)?;
    for piece in waiting {
        if !rest.is_empty() || !page.place(piece.draft.clone(), piece.corner, piece.floats) {
            rest.push(piece);
        }
    }
    Some((page, rest))
}

fn placed(size: SheetSize, pieces: Vec<SheetBlock>) -> Option<(Page, Vec<SheetBlock>)> {
    let mut page = blank(size);
    let mut rest = Vec::new();
    let (views, others): (Vec<SheetBlock>, Vec<SheetBlock>) =
        pieces.into_iter().partition(|p| p.floats);
    // Tables and notes first, if all pieces fit; otherwise the views first.
    let mut whole = page.clone();
    let all = others
        .iter()
        .chain(&views)
        .all(|piece| whole.place(piece.draft.clone(), piece.corner, piece.floats));
    if all {
        return Some((whole, rest));
    }
    let (first, later): (Vec<SheetBlock>, Vec<SheetBlock>) =
        views.into_iter().partition(|p| p.leads);
    for piece in first.into_iter().chain(later).chain(others) {
        if page.place(piece.draft.clone(), piece.corner, piece.floats) {
            continue;
        }
        if piece.leads {
            return None;
        }
        rest.push(piece);
    }
    Some((page, rest))
}

fn pages(
    size: SheetSize,
    scale: Scale,
    block: &TitleBlock,
    first: Page,
    rest: Vec<SheetBlock>,
    tables: &[Table],
) -> Result<Vec<Sheet>, SheetError> {
    let block = TitleBlock {
        scale: scale.to_string(),
        ..block.clone()
    };
    let mut done = Vec::new();
    let mut page = first;
    let width = room(size).max.x - room(size).min.x;
    for piece in rest {
        if page.place(piece.draft.clone(), piece.corner, piece.floats) {
            continue;
        }
        done.push(std::mem::replace(&mut page, blank(size)));
        let bounds = piece.draft.bounds();
        if !page.place(piece.draft, piece.corner, piece.floats) {
            return Err(SheetError::Table {
                size,
                title: piece.name.to_owned(),
                width: bounds.max.x - bounds.min.x,
                room: width,
            });
        }
    }
    for table in tables {
        let mut first = 0;
        let mut fresh = false;
        while first < table.rows.len() {
            if let Some(rows) = page.place_rows(table, first) {
                first += rows;
                fresh = false;
                continue;
            }
            if fresh {
                return Err(SheetError::Table {
                    size,
                    title: table.title.clone(),
                    width: table.width(),
                    room: width,
                });
            }
            done.push(std::mem::replace(&mut page, blank(size)));
            fresh = true;
        }
    }
    done.push(page);
    let count = done.len();
    let sheet = |(index, page): (usize, Page)| {
        let mut whole = frame::draw(size);
        whole.add(&page.finish(), Vector::zeros());
        let name = block.draft(size.name(), index + 1, count);
        whole.add(&name, block_place(size).min.coords);
        let mut drawing = Pen::drawing();
        drawing.entities = whole.into_entities();
        Sheet { size, drawing }
    };
    Ok(done.into_iter().enumerate().map(sheet).collect())
}

#[cfg(test)]
mod tests;
