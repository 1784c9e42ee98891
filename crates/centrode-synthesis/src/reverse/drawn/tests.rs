use std::f64::consts::TAU;

use super::{DrawingError, DrawnPath};
use crate::reverse::{PathError, RequiredPath};

const ELLIPSE: &str = "M 160 70 A 60 40 0 1 1 40 70 A 60 40 0 1 1 160 70 Z";

fn page(body: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"100mm\" viewBox=\"0 0 200 100\">{body}</svg>"
    )
}

fn drawn(data: &str) -> DrawnPath {
    let text = page(&format!("<path d=\"{data}\"/>"));
    DrawnPath::from_svg(text.as_bytes(), 1e-3).expect("a path")
}

fn fault(text: &str) -> DrawingError {
    match DrawnPath::from_svg(text.as_bytes(), 1e-3) {
        Err(PathError::Drawing(fault)) => fault,
        other => panic!("{text}: {other:?}"),
    }
}

/// Maximum distance of the spline through points from the ellipse ((x - 100)/60)^2 + ((y - 30)/40)^2 = 1, to first order.
fn off_the_ellipse(found: &DrawnPath) -> f64 {
    let path = RequiredPath::through(&found.points).expect("a path");
    let off = |i: u32| {
        let p = path.at(path.period() * f64::from(i) / 5000.0).point;
        let (x, y) = ((p.x - 100.0) / 60.0, (p.y - 30.0) / 40.0);
        let slope = 2.0 * (x / 60.0).hypot(y / 40.0);
        ((x * x + y * y - 1.0) / slope).abs()
    };
    (0..5000).map(off).fold(0.0, f64::max)
}

#[test]
fn the_spline_stays_as_near_an_ellipse_as_is_told() {
    let found = drawn(ELLIPSE);
    let off = off_the_ellipse(&found);
    assert!(found.deviation.value <= 1e-3);
    assert!(
        off <= found.deviation.value * 1.001 && off >= 0.98 * found.deviation.value,
        "{off}, told {}",
        found.deviation.value
    );
    // Twice as many points come nearer by the fourth power; half of them would not do.
    let text = page(&format!("<path d=\"{ELLIPSE}\"/>"));
    let finer = DrawnPath::from_svg(text.as_bytes(), 1e-6).expect("a path");
    assert!(finer.deviation.value <= 1e-6 && finer.points.len() > 2 * found.points.len());
    assert!(off_the_ellipse(&finer) < 1.01e-6);
    let first = found.points[0];
    assert!((first.x - 160.0).abs() < 1e-9 && (first.y - 30.0).abs() < 1e-9);
}

#[test]
fn points_are_evenly_spread_over_the_length() {
    // A circle of radius 40, whose length is 80 pi.
    let found = drawn("M 140 50 A 40 40 0 0 1 60 50 A 40 40 0 0 1 140 50");
    let count = found.points.len();
    for (i, p) in found.points.iter().enumerate() {
        // Clockwise on the page, y down, is clockwise with y up.
        let angle = -TAU * i as f64 / count as f64;
        let off = (p.x - 100.0 - 40.0 * angle.cos()).hypot(p.y - 50.0 - 40.0 * angle.sin());
        assert!(off < 1e-8, "{i}: {off:e}");
    }
}

#[test]
fn every_command_draws_one_and_the_same_line() {
    let smooth = drawn("M 40 50 C 40 20 100 20 100 50 S 160 80 160 50 S 40 130 40 50 Z");
    let whole =
        drawn("M 40 50 C 40 20 100 20 100 50 C 100 80 160 80 160 50 C 160 20 40 130 40 50 Z");
    let relative = drawn("m 40 50 c 0 -30 60 -30 60 0 s 60 30 60 0 s -120 80 -120 0 z");
    assert_eq!(smooth.points, whole.points);
    assert_eq!(smooth.points, relative.points);
    let quadratic = "M 40 50 Q 40 20 70 20 T 100 50 T 70 80 T 40 50";
    let (one, other) = (
        page(&format!("<path d=\"{quadratic}\"/>")),
        page("<path d=\"m 40 50 q 0 -30 30 -30 q 30 0 30 30 q 0 30 -30 30 q -30 0 -30 -30\"/>"),
    );
    let read = |text: &str| DrawnPath::from_svg(text.as_bytes(), 0.02);
    assert_eq!(read(&one), read(&other));
    let lines = "M 20 20 H 120 V 80 H 20 V 20";
    let same = "m 20 20 h 100 v 60 h -100 z";
    let corner = |data: &str| fault(&page(&format!("<path d=\"{data}\"/>")));
    assert_eq!(corner(lines), corner(same));
}

#[test]
fn groups_transforms_and_units_are_followed() {
    let plain = drawn(ELLIPSE);
    let moved = page(
        "<defs><path d=\"M 0 0 L 1 1\"/></defs><g transform=\"translate(100,70)\"><g transform=\"scale(2) rotate(90)\">\
         <path d=\"M 0 -30 A 20 30 0 1 1 0 30 A 20 30 0 1 1 0 -30 Z\"/></g></g><text>two</text>",
    );
    let moved = DrawnPath::from_svg(moved.as_bytes(), 1e-3).expect("a path");
    for (p, q) in plain.points.iter().zip(&moved.points) {
        assert!((p - q).norm() < 1e-8, "{p} {q}");
    }
    let inches = page(&format!("<path d=\"{ELLIPSE}\"/>"))
        .replace("200mm", "2in")
        .replace("100mm", "1in");
    let inches = DrawnPath::from_svg(inches.as_bytes(), 1e-3 * 0.254).expect("a path");
    for (p, q) in plain.points.iter().zip(&inches.points) {
        assert!((p.coords * 0.254 - q.coords).norm() < 1e-9, "{p} {q}");
    }
}

#[test]
fn what_is_hidden_is_left_aside_and_what_is_not_followed_is_refused() {
    let path = format!("<path d=\"{ELLIPSE}\"/>");
    let plain = drawn(ELLIPSE);
    for hidden in [
        "<g style=\"fill:none; display : none\"><path d=\"M 0 0 L 1 1\"/></g>",
        "<path display=\"none\" d=\"M 0 0 L 1 1\"/>",
        "<g style=\"display:none\"><use href=\"#other\"/></g>",
    ] {
        let text = page(&format!("{hidden}{path}"));
        let found = DrawnPath::from_svg(text.as_bytes(), 1e-3).expect("a path");
        assert_eq!(found, plain, "{hidden}");
    }
    for placed in [
        format!("{path}<use href=\"#other\"/>"),
        format!("<svg x=\"10\" viewBox=\"0 0 400 200\">{path}</svg>"),
        path.replace(
            "<path",
            "<path style=\"stroke:red;transform:rotate(20deg)\"",
        ),
    ] {
        let found = fault(&page(&placed));
        assert!(matches!(found, DrawingError::NotFollowed { .. }), "{found}");
    }
}

#[test]
fn a_drawing_of_any_size_gives_the_path_to_its_scale() {
    let plain = drawn(ELLIPSE);
    let scaled = |scale: f64| format!("<path transform=\"scale({scale:e})\" d=\"{ELLIPSE}\"/>");
    let lost = DrawnPath::from_svg(page(&scaled(1e-9)).as_bytes(), 1e-3);
    assert!(matches!(lost, Err(PathError::TooSmall { .. })), "{lost:?}");
    for scale in [1e-5, 1e6] {
        let body = scaled(scale);
        let found = DrawnPath::from_svg(page(&body).as_bytes(), 1e-3 * scale).expect("a path");
        assert_eq!(found.points.len(), plain.points.len());
        let [from, whole] = [&found, &plain].map(|drawn| drawn.points[0]);
        for (p, q) in found.points.iter().zip(&plain.points) {
            let off = (p - from) / scale - (q - whole);
            // Of micrometres, a decimetre from the origin, digits are lost.
            assert!(off.norm() < 1e-4, "{scale}: {p} {q}");
        }
    }
}

#[test]
fn a_drawing_that_gives_no_path_is_refused_with_the_reason() {
    let path = format!("<path d=\"{ELLIPSE}\"/>");
    let good = page(&path);
    assert!(matches!(fault("<svg"), DrawingError::Xml { .. }));
    assert!(matches!(fault("<html/>"), DrawingError::NotSvg { root } if root == "html"));
    for wrong in ["200px\"", "200\"", "20%\"", "0mm\"", "NaNmm\"", "150mm\""] {
        let text = good.replace("200mm\"", wrong);
        assert!(matches!(fault(&text), DrawingError::Size { .. }), "{wrong}");
    }
    let no_box = good.replace("viewBox", "data-box");
    assert!(matches!(fault(&no_box), DrawingError::Size { .. }));
    assert!(matches!(fault(&page("")), DrawingError::Paths { count: 0 }));
    let two = page(&format!("{path}{path}"));
    assert!(matches!(fault(&two), DrawingError::Paths { count: 2 }));
    let of = |data: &str| fault(&page(&format!("<path d=\"{data}\"/>")));
    assert!(matches!(
        of("M 0 0 L 1 x"),
        DrawingError::Data { key: "d", .. }
    ));
    assert!(matches!(of("M 0 0 L 9 0 L 9 9"), DrawingError::Open { to, .. } if to == [9.0, 91.0]));
    assert_eq!(of("M 5 5 Z"), DrawingError::Empty);
    let rings = "M 0 0 L 9 0 L 9 9 Z M 20 0 L 29 0 L 29 9 Z";
    assert!(matches!(of(rings), DrawingError::Several { count: 2 }));
    assert!(matches!(
        of("M 0 0 L 1e12 0 L 0 9 Z"),
        DrawingError::TooFar { .. }
    ));
    assert!(matches!(
        of("M 0 0 L 1e999 0 L 0 9 Z"),
        DrawingError::TooFar { .. } | DrawingError::Data { .. }
    ));
    let long = format!("M 0 0 {}Z", "L 1 1 L 2 1 ".repeat(6000));
    assert!(matches!(of(&long), DrawingError::TooMany { .. }));
    let turned = page(&path.replace("<path", "<path transform=\"turn(3)\""));
    assert!(matches!(
        fault(&turned),
        DrawingError::Data {
            key: "transform",
            ..
        }
    ));
    // A square: the corner is named.
    match of("M 20 20 H 120 V 80 H 20 Z") {
        DrawingError::Corner { angle, reached, .. } => {
            assert!((angle - 90.0).abs() < 1e-9 && reached > 1e-3);
        }
        other => panic!("{other}"),
    }
    let bad = DrawnPath::from_svg(good.as_bytes(), f64::NAN);
    assert!(matches!(
        bad,
        Err(PathError::Drawing(DrawingError::Within { .. }))
    ));
}

#[test]
fn an_element_of_very_many_attributes_is_refused_at_once() {
    let many = |count: usize, sign: &str| -> String {
        (0..count).map(|i| format!(" a{i}{sign}")).collect()
    };
    let path = |words: &str| page(&format!("<path d=\"{ELLIPSE}\"{words}/>"));
    for text in [
        path(&many(1000, "=\"\"")),
        path(&many(1001, "=\"\"")),
        path(&many(100_000, "=\"\"")),
        path(&many(100_000, "='1'")),
        path(&many(5000, " = \"x\"")),
        path(&many(5000, "=\n\t'x'")),
        page(&format!(
            "<g{}><path d=\"{ELLIPSE}\"/></g>",
            many(3000, "=\"\"")
        )),
        page(&format!(
            "<path d=\"{ELLIPSE}\"/><desc{}/>",
            many(2000, "=\"\"")
        )),
        format!(
            "<svg{} xmlns=\"http://www.w3.org/2000/svg\"/>",
            many(50_000, "=\"\"")
        ),
        path(&many(200_000, "=\">\"")),
    ] {
        let why = fault(&text).to_string();
        assert!(why.contains("attributes; at most 1000 are read"), "{why}");
    }
    // Few on each of many elements, and equals signs that are no attribute's.
    for text in [
        path(&many(990, "=\"\"")),
        path(""),
        page(&format!(
            "<path d=\"{ELLIPSE}\"/>{}",
            "<g a=\"1\" b='2'/>".repeat(2000)
        )),
        page(&format!(
            "<!-- {} --><path d=\"{ELLIPSE}\"/>",
            "= ".repeat(5000)
        )),
        page(&format!(
            "<desc>{}</desc><path d=\"{ELLIPSE}\"/>",
            "a=b ".repeat(5000)
        )),
    ] {
        assert!(DrawnPath::from_svg(text.as_bytes(), 1e-3).is_ok());
    }
}
