use super::*;
use crate::drawing::{Anchor, EntityShape};
use crate::{dxf, pdf, svg};
use centrode_geometry::{Outline, Point, Tolerance};

/// A plate of this width with a hole, dimensioned.
fn plate(width: f64) -> impl Fn(Scale, SheetSize) -> Vec<SheetBlock> {
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
        draft.draw(Pen::Outline, EntityShape::Contour(hole));
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
        vec![SheetBlock {
            name: "plate",
            draft,
            corner: Corner::UpperLeft,
            floats: true,
            leads: true,
            waits: false,
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
    // What would fill little of a large sheet is drawn smaller on a small one.
    use SheetSize::{A0, A3, A4};
    assert_eq!(found, [A4, A3, A3, A3, A0]);
}

#[test]
fn long_tables_flow_on_to_further_sheets_row_by_row() {
    for size in SheetSize::ALL {
        let table = long_table(1000);
        let sheets = compose(Some(size), &block(), 60.0, &plate(60.0), &[table]).expect("fits");
        let words: Vec<&str> = sheets
            .iter()
            .flat_map(|sheet| sheet.drawing.plain())
            .filter_map(|e| match &e.shape {
                EntityShape::Text(text) => Some(text.words.as_str()),
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
    let error = compose(Some(SheetSize::A4), &block(), 1e7, &plate(1e7), &[]).expect_err("too big");
    assert!(
        error
            .to_string()
            .contains("do not fit on A4: at scale 1:10000 they still need"),
        "{error}"
    );
    let mut wide = long_table(5);
    wide.rows[0][1] = "7".repeat(200);
    let error =
        compose(Some(SheetSize::A4), &block(), 50.0, &plate(50.0), &[wide]).expect_err("wide");
    assert!(error.to_string().contains("has room for"), "{error}");
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
        let sheets = compose(None, &block(), 60.0, &plate(60.0), &[long_table(300)]).expect("fits");
        let drawing = &sheets[0].drawing;
        [
            pdf::write(&sheets, "plate", tolerance).expect("written"),
            svg::sheet(&sheets[0], tolerance).into_bytes(),
            dxf::write(drawing, dxf::Version::R12, dxf::Curves::Arcs, tolerance).expect("r12"),
            dxf::write(drawing, dxf::Version::R2010, dxf::Curves::Arcs, tolerance).expect("r2010"),
        ]
    };
    assert!(write() == write());
}
