//! Parts of a file before its entities: units, line types, layers, lettering styles, blocks.

use super::entities::Writer;
use super::pairs::{Handle, Pairs};
use super::{STYLE, STYLE_FONT, objects};
use crate::drawing::{Color, Drawing, EntityShape, LineType};
use centrode_geometry::{Bounds, Point};

/// Writes the header with the first free handle.
pub(super) fn header(file: &mut Pairs, bounds: &Bounds, seed: Handle) {
    file.section("HEADER");
    let newer = file.is_newer();
    let version = if newer { "AC1024" } else { "AC1009" };
    file.word(9, "$ACADVER").word(1, version);
    if newer {
        file.word(9, "$DWGCODEPAGE").word(3, "ANSI_1252");
        file.word(9, "$HANDSEED").handle(5, seed);
    }
    // R12 itself lacks both variables, but most programs read them: metric line types and hatches, and millimetres.
    file.word(9, "$MEASUREMENT").whole(70, 1);
    file.word(9, "$INSUNITS").whole(70, 4);
    file.word(9, "$LTSCALE").number(40, 1.0);
    if bounds.diagonal().is_finite() {
        file.word(9, "$EXTMIN").point(10, &bounds.min);
        file.word(9, "$EXTMAX").point(10, &bounds.max);
        // Some programs take these for the paper.
        for (name, point) in [
            ("$LIMMIN", &bounds.min),
            ("$LIMMAX", &bounds.max),
            ("$PLIMMIN", &bounds.min),
            ("$PLIMMAX", &bounds.max),
        ] {
            file.word(9, name).flat(10, point);
        }
    }
    file.word(0, "ENDSEC");
}

/// Writes line types, layers and lettering styles, and all further tables that the newer version requires. Returns the handles of
/// the newer version's block records: the model space, which owns the entities, the paper space, and one for each dimension.
pub(super) fn tables(file: &mut Pairs, drawing: &Drawing, bounds: &Bounds) -> Option<Vec<Handle>> {
    file.section("TABLES");
    if file.is_newer() {
        view(file, bounds);
    }
    line_types(file, drawing);
    layers(file, drawing);
    let lettering = styles(file, drawing);
    let records = file
        .is_newer()
        .then(|| newer_tables(file, drawing, lettering));
    file.word(0, "ENDSEC");
    records
}

/// The blocks of the newer version: its two spaces, empty here, and the pictures of dimensions.
pub(super) fn blocks(writer: &mut Writer<'_>, drawing: &Drawing, records: &[Handle]) {
    writer.file.section("BLOCKS");
    let (spaces, pictures) = records.split_at(SPACES.len());
    for (name, space) in SPACES.into_iter().zip(spaces) {
        block(writer, name, *space, &|_| {});
    }
    objects::blocks(writer, drawing, pictures, block);
    writer.file.word(0, "ENDSEC");
}

fn block(writer: &mut Writer<'_>, name: &str, record: Handle, draw: &dyn Fn(&mut Writer<'_>)) {
    // Flag of a block with an automatic name.
    let own = u32::from(name.starts_with("*D"));
    writer.file.entry("BLOCK", record);
    writer.file.class("AcDbEntity").word(8, "0");
    let file = writer.file.class("AcDbBlockBegin");
    file.word(2, name).whole(70, own);
    file.point(10, &Point::origin()).word(3, name).word(1, "");
    writer.owner = record;
    draw(writer);
    writer.file.entry("ENDBLK", record);
    let file = writer.file.class("AcDbEntity").word(8, "0");
    file.class("AcDbBlockEnd");
}

/// The objects of the newer version: the root dictionary, and the required dictionary of groups.
pub(super) fn objects(file: &mut Pairs) {
    file.section("OBJECTS");
    let root = file.entry("DICTIONARY", Handle::NONE);
    file.class("AcDbDictionary").whole(281, 1);
    let groups = file.seed();
    file.word(3, "ACAD_GROUP").handle(350, groups);
    file.entry("DICTIONARY", root);
    file.class("AcDbDictionary").whole(281, 1);
    file.word(0, "ENDSEC");
}

/// Blocks every file of the newer version has: entities of the model, and of the paper.
const SPACES: [&str; 2] = ["*Model_Space", "*Paper_Space"];

/// Begins a table of `count` records.
pub(super) fn table(file: &mut Pairs, name: &str, count: usize) -> Handle {
    let handle = file
        .word(0, "TABLE")
        .word(2, name)
        .identity(5, Handle::NONE);
    file.class("AcDbSymbolTable").whole(70, count as u32);
    handle
}

/// Begins a record of a table.
pub(super) fn record(
    file: &mut Pairs,
    table: Handle,
    kind: &str,
    class: &str,
    name: &str,
) -> Handle {
    // In a dimension style code 5 is the name of a block.
    let code = if kind == "DIMSTYLE" { 105 } else { 5 };
    let handle = file.word(0, kind).identity(code, table);
    file.class("AcDbSymbolTableRecord").class(class);
    file.word(2, name).whole(70, 0);
    handle
}

/// The view a program opens with: all of the drawing.
fn view(file: &mut Pairs, bounds: &Bounds) {
    let owner = table(file, "VPORT", 1);
    record(file, owner, "VPORT", "AcDbViewportTableRecord", "*Active");
    file.flat(10, &Point::origin())
        .flat(11, &Point::new(1.0, 1.0));
    if bounds.diagonal().is_finite() {
        let [width, height] = [bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y];
        // A window is about four by three.
        let seen = 1.1 * height.max(0.75 * width);
        file.flat(12, &bounds.center());
        file.number(40, seen).number(41, 4.0 / 3.0);
    }
    file.word(0, "ENDTAB");
}

fn line_types(file: &mut Pairs, drawing: &Drawing) {
    const CLASS: &str = "AcDbLinetypeTableRecord";
    let used = |line_type| drawing.layers.iter().any(|l| l.line_type == line_type);
    let line_types: Vec<LineType> = LineType::ALL
        .into_iter()
        .filter(|&line_type| line_type != LineType::Phantom || used(line_type))
        .collect();
    let inherited: &[&str] = if file.is_newer() {
        &["BYBLOCK", "BYLAYER"]
    } else {
        &[]
    };
    let owner = table(file, "LTYPE", inherited.len() + line_types.len());
    for name in inherited {
        record(file, owner, "LTYPE", CLASS, name);
        file.word(3, "").whole(72, 65).whole(73, 0).number(40, 0.0);
    }
    for line_type in line_types {
        let pattern = line_type.pattern();
        record(file, owner, "LTYPE", CLASS, line_type_name(line_type));
        file.word(3, description(line_type)).whole(72, 65);
        file.whole(73, pattern.len() as u32);
        file.number(40, pattern.iter().map(|d| d.abs()).sum());
        for &dash in pattern {
            file.number(49, dash);
            if file.is_newer() {
                file.whole(74, 0);
            }
        }
    }
    file.word(0, "ENDTAB");
}

fn layers(file: &mut Pairs, drawing: &Drawing) {
    const CLASS: &str = "AcDbLayerTableRecord";
    let owner = table(file, "LAYER", drawing.layers.len() + 1);
    record(file, owner, "LAYER", CLASS, "0");
    file.whole(62, 7)
        .word(6, line_type_name(LineType::Continuous));
    for layer in &drawing.layers {
        record(file, owner, "LAYER", CLASS, &layer.name);
        file.whole(62, u32::from(color_index(layer.color)));
        file.word(6, line_type_name(layer.line_type));
        if file.is_newer() {
            if !layer.plots {
                file.whole(290, 0);
            }
            file.whole(370, weight(layer.line_width));
        }
    }
    file.word(0, "ENDTAB");
}

/// Writes the lettering styles; returns the handle of the style for fitted texts, if there are any.
fn styles(file: &mut Pairs, drawing: &Drawing) -> Option<Handle> {
    let mut shapes = drawing.plain().map(|entity| &entity.shape);
    let fitted =
        shapes.any(|shape| matches!(shape, EntityShape::Text(text) if text.width.is_some()));
    let styles = [("STANDARD", "txt"), (STYLE, STYLE_FONT)];
    let styles = if fitted { &styles[..] } else { &styles[..1] };
    let owner = table(file, "STYLE", styles.len());
    let mut last = None;
    for (name, font) in styles {
        let handle = record(file, owner, "STYLE", "AcDbTextStyleTableRecord", name);
        file.number(40, 0.0).number(41, 1.0).number(50, 0.0);
        file.whole(71, 0).number(42, 2.5).word(3, font).word(4, "");
        last = Some(handle).filter(|_| fitted);
    }
    file.word(0, "ENDTAB");
    last
}

/// Writes the tables that only the newer version requires; returns the handles of its block records.
fn newer_tables(file: &mut Pairs, drawing: &Drawing, lettering: Option<Handle>) -> Vec<Handle> {
    for name in ["VIEW", "UCS"] {
        table(file, name, 0);
        file.word(0, "ENDTAB");
    }
    let owner = table(file, "APPID", 1);
    record(file, owner, "APPID", "AcDbRegAppTableRecord", "ACAD");
    file.word(0, "ENDTAB");
    objects::dimension_styles(file, drawing, lettering);
    let pictures = objects::block_names(drawing);
    let names: Vec<&str> = SPACES
        .into_iter()
        .chain(pictures.iter().map(String::as_str))
        .collect();
    let owner = table(file, "BLOCK_RECORD", names.len());
    let class = "AcDbBlockTableRecord";
    let records = names
        .into_iter()
        .map(|name| record(file, owner, "BLOCK_RECORD", class, name))
        .collect();
    file.word(0, "ENDTAB");
    records
}

fn line_type_name(line_type: LineType) -> &'static str {
    match line_type {
        LineType::Continuous => "CONTINUOUS",
        LineType::Center => "CENTER",
        LineType::Hidden => "HIDDEN",
        LineType::Phantom => "PHANTOM",
    }
}

fn description(line_type: LineType) -> &'static str {
    match line_type {
        LineType::Continuous => "Solid line",
        LineType::Center => "Center ____ . ____ . ____",
        LineType::Hidden => "Hidden __ __ __ __ __",
        LineType::Phantom => "Phantom ____ . . ____ . . ____",
    }
}

/// Number of a color in the color index of all drawing programs.
fn color_index(color: Color) -> u8 {
    match color {
        Color::Red => 1,
        Color::Green => 3,
        Color::Cyan => 4,
        Color::Blue => 5,
        Color::Magenta => 6,
        Color::Foreground => 7,
        Color::Gray => 8,
    }
}

/// The line weight of the format nearest to a width (mm), in hundredths of a millimetre.
pub(super) fn weight(width: f64) -> u32 {
    const WEIGHTS: [u32; 24] = [
        0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120, 140, 158,
        200, 211,
    ];
    let required = 100.0 * width;
    let mut best = WEIGHTS[0];
    for candidate in WEIGHTS {
        if (f64::from(candidate) - required).abs() < (f64::from(best) - required).abs() {
            best = candidate;
        }
    }
    best
}
