use centrode_formats::sheet::{Draft, Pen};
use centrode_geometry::{Point, Vector};

/// Centre hole of a turned part, of form A: the widest that takes no more than a third of the end's diameter.
pub(crate) fn centre(diameter: f64) -> Option<String> {
    // Diameters of the pilot hole and of the countersink, mm; ISO 866.
    const SIZES: [(f64, f64); 11] = [
        (1.0, 2.12),
        (1.25, 2.65),
        (1.6, 3.35),
        (2.0, 4.25),
        (2.5, 5.3),
        (3.15, 6.7),
        (4.0, 8.5),
        (5.0, 10.6),
        (6.3, 13.2),
        (8.0, 17.0),
        (10.0, 21.2),
    ];
    let mut fitting = SIZES.iter().rev();
    let (pilot, wide) = fitting.find(|(_, wide)| 3.0 * wide <= diameter)?;
    Some(format!("ISO 6411-A{pilot}/{wide}"))
}

/// Symbol of a centre hole that stays on the part, ISO 6411.
pub(crate) fn centre_mark(draft: &mut Draft, end: Point, way: f64) {
    for side in [-1.0, 1.0] {
        let leg = Vector::new(way * 3.5, side * 2.0);
        draft.line(Pen::Outline, end, end + leg);
    }
}
