//! Drawing sheets: one layout on paper, ISO 5457, for DXF, SVG and PDF alike.

mod dimension;
mod draft;
pub(crate) mod fit;
mod frame;
mod hatch;
mod layout;
pub(crate) mod lettering;
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
use centrode_mechanism::design::SheetSize;
pub use draft::Draft;
pub use layout::Corner;
use layout::Page;
pub(crate) use number::{mass, number};
pub use overlap::{Overlap, overlaps};
pub use pen::Pen;
pub use piece::Piece;
pub(crate) use piece::view_letters;
pub use scale::Scale;
pub use table::Table;
use thiserror::Error;
pub use title_block::TitleBlock;

/// Distance of everything from the frame, mm: room for the centring marks.
const INSET: f64 = 7.0;

/// One page of a drawing, in millimetres on paper from its lower left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Size of the trimmed sheet.
    pub size: SheetSize,
    /// Everything on it, on the layers of the [`Pen`]s.
    pub drawing: Drawing,
}

/// Why there is no sheet.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SheetError {
    /// The views do not fit, not even at the smallest scale.
    #[error("the views with their dimensions do not fit on {}: at scale {scale} they still take {:.0} x {:.0} mm of {:.0} x {:.0} mm", size.name(), needed[0], needed[1], room[0], room[1])]
    Views {
        /// The sheet asked for.
        size: SheetSize,
        /// The smallest scale.
        scale: Scale,
        /// Width and height taken at that scale, mm.
        needed: [f64; 2],
        /// Width and height of the drawing space, mm.
        room: [f64; 2],
    },
    /// A table is wider than the sheet.
    #[error("the table {title:?} is {width:.0} mm wide: {} leaves it {room:.0} mm", size.name())]
    Table {
        /// The sheet asked for.
        size: SheetSize,
        /// Title of the table.
        title: String,
        /// Width of the table, mm.
        width: f64,
        /// Width of the drawing space, mm.
        room: f64,
    },
}

/// The sheets of a drawing: the pieces on the first, at the largest recommended scale that fits; the
/// tables where there is room left, and on further sheets.
///
/// `extent` is the longest side of a view at full scale, mm: no scale is tried at which it alone is too
/// long. Without a size asked for it is the smallest sheet that takes all pieces at full scale or larger, or A0.
///
/// # Errors
/// [`SheetError`] if views or a table do not fit on the sheet asked for.
pub fn compose(
    wanted: Option<SheetSize>,
    block: &TitleBlock,
    extent: f64,
    pieces: &dyn Fn(Scale, SheetSize) -> Vec<Piece>,
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
    let complete = |size: SheetSize| {
        full.iter()
            .filter(|s| possible(size, s))
            .find_map(|&scale| {
                let (page, rest) = place(size, pieces(scale, size))?;
                rest.is_empty().then_some((scale, page))
            })
    };
    let sizes = wanted.map_or(SheetSize::ALL.to_vec(), |size| vec![size]);
    for size in sizes {
        if let Some((scale, page)) = complete(size) {
            return pages(size, scale, block, page, Vec::new(), tables);
        }
    }
    let size = wanted.unwrap_or(SheetSize::A0);
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

/// A page with all views on it, and the pieces that found no room; `None` if a view did not.
fn place(size: SheetSize, pieces: Vec<Piece>) -> Option<(Page, Vec<Piece>)> {
    let mut page = blank(size);
    let mut rest = Vec::new();
    let (views, others): (Vec<Piece>, Vec<Piece>) = pieces.into_iter().partition(|p| p.floats);
    // With all the pieces, if that works; the views alone otherwise.
    let mut whole = page.clone();
    let all = others
        .iter()
        .chain(&views)
        .all(|piece| whole.place(piece.draft.clone(), piece.corner, piece.floats));
    if all {
        return Some((whole, rest));
    }
    let (first, later): (Vec<Piece>, Vec<Piece>) = views.into_iter().partition(|p| p.leads);
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
    rest: Vec<Piece>,
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
mod tests {
    use super::*;
    use crate::drawing::{Anchor, Shape};
    use crate::{dxf, pdf, svg};
    use centrode_geometry::{Outline, Point, Tolerance};

    /// A plate of this width with a hole, dimensioned.
    fn plate(width: f64) -> impl Fn(Scale, SheetSize) -> Vec<Piece> {
        move |scale, _| {
            let k = scale.factor();
            let mut draft = Draft::default();
            let corner = Point::new(k * width, 0.5 * k * width);
            let bounds = Bounds {
                min: Point::origin(),
                max: corner,
            };
            let hole = Outline::circle(
                Point::new(0.3 * k * width, 0.2 * k * width),
                0.1 * k * width,
            );
            draft.hatch(
                &[
                    hole.clone(),
                    Outline::polygon(&[
                        Point::origin(),
                        Point::new(corner.x, 0.0),
                        corner,
                        Point::new(0.0, corner.y),
                    ]),
                ],
                Tolerance::new(0.01).expect("positive"),
            );
            draft.rectangle(Pen::Outline, bounds);
            draft.draw(Pen::Outline, Shape::Contour(hole));
            let below = Point::new(0.0, -10.0);
            let across = [Point::origin(), Point::new(corner.x, 0.0)];
            draft.dimension(across, Vector::x(), below, &format!("{width}"));
            let upwards = [Point::new(corner.x, 0.0), corner];
            let beside = Point::new(corner.x + 10.0, 0.0);
            draft.dimension(upwards, Vector::y(), beside, &format!("{}", 0.5 * width));
            let note = vec!["Ø hole".to_owned(), "through".to_owned()];
            draft.callouts(
                bounds,
                [0.0; 2],
                &[(Point::new(0.4 * k * width, 0.2 * k * width), note)],
            );
            vec![Piece {
                name: "plate",
                draft,
                corner: Corner::UpperLeft,
                floats: true,
                leads: true,
            }]
        }
    }

    fn long_table(rows: usize) -> Table {
        Table {
            title: "Points".into(),
            headings: ["no.", "x", "y"].map(String::from).to_vec(),
            columns: vec![Anchor::Right; 3],
            rows: (0..rows)
                .map(|i| {
                    vec![
                        i.to_string(),
                        format!("{:.4}", 0.1 * i as f64),
                        "-12.3456".into(),
                    ]
                })
                .collect(),
            notes: vec!["x and y in mm".into()],
        }
    }

    fn block() -> TitleBlock {
        TitleBlock {
            title: "A plate with a rather long title that does not fit its cell".into(),
            owner: "Owner".into(),
            general_tolerance: "ISO 2768-mK".into(),
            edges: "ISO 13715, -0.2 / +0.1".into(),
            ..TitleBlock::default()
        }
    }

    #[test]
    fn the_smallest_sheet_that_takes_a_part_is_chosen_and_nothing_overlaps() {
        let sizes = [20.0, 230.0, 400.0, 800.0, 30_000.0];
        let found = sizes.map(|width| {
            let sheets = compose(None, &block(), width, &plate(width), &[]).expect("fits");
            assert_eq!(overlaps(&sheets[0]), [], "{width}");
            sheets[0].size
        });
        use SheetSize::{A0, A1, A2, A3, A4};
        assert_eq!(found, [A4, A3, A2, A0, A0]);
        let _ = A1;
    }

    #[test]
    fn long_tables_flow_on_to_further_sheets_row_by_row() {
        for size in SheetSize::ALL {
            let table = long_table(1000);
            let sheets = compose(Some(size), &block(), 60.0, &plate(60.0), &[table]).expect("fits");
            let words: Vec<&str> = sheets
                .iter()
                .flat_map(|sheet| &sheet.drawing.entities)
                .filter_map(|e| match &e.shape {
                    Shape::Text(text) => Some(text.words.as_str()),
                    _ => None,
                })
                .collect();
            for row in ["0", "567", "999"] {
                assert!(words.contains(&row), "{size:?} lacks row {row}");
            }
            let last = format!("{0}/{0}", sheets.len());
            assert!(words.contains(&last.as_str()));
            for sheet in &sheets {
                assert_eq!(overlaps(sheet), [], "{size:?}");
            }
        }
    }

    #[test]
    fn what_cannot_fit_is_refused_with_its_size() {
        let error =
            compose(Some(SheetSize::A4), &block(), 1e7, &plate(1e7), &[]).expect_err("too big");
        assert!(
            error
                .to_string()
                .contains("do not fit on A4: at scale 1:10000 they still take"),
            "{error}"
        );
        let mut wide = long_table(5);
        wide.rows[0][1] = "7".repeat(200);
        let error =
            compose(Some(SheetSize::A4), &block(), 50.0, &plate(50.0), &[wide]).expect_err("wide");
        assert!(error.to_string().contains("leaves it"), "{error}");
    }

    #[test]
    fn overlapping_words_are_found() {
        let mut sheets = compose(None, &block(), 60.0, &plate(60.0), &[]).expect("fits");
        let mut draft = Draft::default();
        draft.text(Point::new(100.0, 250.0), 3.5, "one", Anchor::Left);
        draft.turned_text(Point::new(103.0, 249.0), 3.5, "two", Anchor::Left, 0.7);
        draft.line(Pen::Thin, Point::new(99.0, 251.0), Point::new(101.0, 251.2));
        sheets[0].drawing.entities.extend(draft.into_entities());
        let found = overlaps(&sheets[0]);
        let named: Vec<[&str; 2]> = found.iter().map(|o| [&*o.words, &*o.other]).collect();
        assert_eq!(named, [["one", "two"], ["one", "THIN"]]);
    }

    #[test]
    fn all_writers_give_the_same_bytes_twice() {
        let tolerance = Tolerance::new(0.01).expect("positive");
        let write = || {
            let sheets =
                compose(None, &block(), 60.0, &plate(60.0), &[long_table(300)]).expect("fits");
            let drawing = &sheets[0].drawing;
            [
                pdf::write(&sheets, "plate", tolerance).expect("written"),
                svg::sheet(&sheets[0], tolerance).into_bytes(),
                dxf::write(drawing, dxf::Version::R12, dxf::Curves::Arcs, tolerance).expect("r12"),
                dxf::write(drawing, dxf::Version::R2010, dxf::Curves::Arcs, tolerance)
                    .expect("r2010"),
            ]
        };
        assert!(write() == write());
    }
}
