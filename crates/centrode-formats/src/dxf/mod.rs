//! DXF files for cutting machines and drawing programs.

mod entities;
mod objects;
mod pairs;
mod tables;

use crate::drawing::Drawing;
use centrode_geometry::Tolerance;
use pairs::{Handle, Pairs};
use thiserror::Error;

/// Version of DXF.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Version {
    /// Release 2010: lightweight polylines.
    #[default]
    R2010,
    /// Release 12: heavy polylines, for old controllers. It has no splines.
    R12,
}

/// Form of a curved contour.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Curves {
    /// One closed polyline of lines and arcs, joined without a kink where the contour is smooth.
    #[default]
    Arcs,
    /// One closed cubic spline.
    Splines,
    /// One closed polyline of straight lines, for programs that do not read arcs within polylines.
    Chords,
}

centrode_spec::words!(Curves {
    Arcs = "arcs",
    Splines = "splines",
    Chords = "chords",
});

/// Reason why a drawing could not be written as DXF.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DxfError {
    /// R12 has no spline entity.
    #[error("DXF R12 has no splines: choose arcs, or version R2010")]
    SplinesInR12,
    /// An entity lies on a layer the drawing does not list.
    #[error("no layer is named {name:?}")]
    Layer {
        /// The missing name.
        name: String,
    },
}

/// Writes a drawing as DXF text in millimetres (`$INSUNITS` 4), each contour as one closed entity within the tolerance; a circle
/// is written as a circle. Equal drawings give equal bytes: dates and identifiers are fixed.
///
/// # Errors
/// [`DxfError`] for splines in R12 or an entity without a layer.
pub fn write(
    drawing: &Drawing,
    version: Version,
    curves: Curves,
    tolerance: Tolerance,
) -> Result<Vec<u8>, DxfError> {
    if let Some(entity) = drawing.plain().find(|e| drawing.layer_of(e).is_none()) {
        return Err(DxfError::Layer {
            name: entity.layer.clone(),
        });
    }
    if (version, curves) == (Version::R12, Curves::Splines) {
        return Err(DxfError::SplinesInR12);
    }
    let bounds = drawing.bounds();
    let mut body = Pairs::new(version);
    let spaces = tables::tables(&mut body, drawing, &bounds);
    let mut writer = entities::Writer::new(&mut body, curves, tolerance);
    if let Some(spaces) = &spaces {
        tables::blocks(&mut writer, drawing, spaces);
    }
    let model = spaces.map_or(Handle::NONE, |spaces| spaces[0]);
    entities::entities(&mut writer, drawing, model);
    if version == Version::R2010 {
        tables::objects(&mut body);
    }
    body.word(0, "EOF");
    let mut file = Pairs::new(version);
    tables::header(&mut file, &bounds, body.seed());
    if version == Version::R2010 {
        file.section("CLASSES").word(0, "ENDSEC");
    }
    Ok(file.followed_by(&body))
}

/// Text style of fitted texts: the ISO 3098 shapes that drawing programs include.
const STYLE: &str = "ISO3098";
const STYLE_FONT: &str = "isocp.shx";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Anchor, Color, EntityShape, LineType, Text};
    use centrode_geometry::{Arc, Outline, Point, Segment};
    use std::collections::HashSet;

    /// Two half circles and two lines.
    fn slot() -> Outline {
        let p = Point::new;
        let half = |start, end| {
            Segment::Arc(Arc {
                start,
                end,
                bulge: 1.0,
            })
        };
        Outline::new(vec![
            Segment::Line(p(0.0, -10.0), p(5.0, -10.0)),
            half(p(5.0, -10.0), p(5.0, 10.0)),
            Segment::Line(p(5.0, 10.0), p(0.0, 10.0)),
            half(p(0.0, 10.0), p(0.0, -10.0)),
        ])
        .expect("closed")
    }

    fn sample() -> Drawing {
        let p = Point::new;
        let mut drawing = Drawing::default()
            .layer("PROFILE", Color::Foreground, LineType::Continuous, 0.35)
            .layer("AXES", Color::Red, LineType::Center, 0.18);
        drawing.draw("PROFILE", EntityShape::Contour(slot()));
        drawing.draw(
            "PROFILE",
            EntityShape::Polyline(vec![p(0.0, 0.0), p(1.0, 5.0), p(4.0, 4.0)]),
        );
        drawing.draw("AXES", EntityShape::Line(p(-12.0, 0.0), p(12.0, 0.0)));
        drawing.draw(
            "AXES",
            EntityShape::Circle {
                center: p(0.0, 0.0),
                radius: 3.0,
            },
        );
        let arc = Arc {
            start: p(5.0, 0.0),
            end: p(0.0, 5.0),
            bulge: -0.4,
        };
        drawing.draw("AXES", EntityShape::Arc(arc));
        drawing.draw("AXES", EntityShape::Mark(p(0.0, 0.0)));
        drawing.draw(
            "AXES",
            EntityShape::Text(Text::new(p(0.0, -15.0), 3.5, "z = 23", Anchor::Middle)),
        );
        drawing
    }

    fn tolerance() -> Tolerance {
        Tolerance::new(1e-3).expect("positive")
    }

    /// Pairs of code and value of the sample in release 2010.
    fn pairs(curves: Curves) -> Vec<(u16, String)> {
        pairs_of(&sample(), curves)
    }

    fn pairs_of(drawing: &Drawing, curves: Curves) -> Vec<(u16, String)> {
        let bytes = write(drawing, Version::R2010, curves, tolerance()).expect("written");
        let text = String::from_utf8(bytes).expect("text");
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        lines
            .chunks(2)
            .map(|pair| (pair[0].parse().expect("a code"), pair[1].to_owned()))
            .collect()
    }

    /// The pairs between the header of a section and its end.
    fn section(name: &str, pairs: &[(u16, String)]) -> Vec<(u16, String)> {
        pairs
            .iter()
            .skip_while(|(code, value)| (*code, value.as_str()) != (2, name))
            .take_while(|(code, value)| (*code, value.as_str()) != (0, "ENDSEC"))
            .cloned()
            .collect()
    }

    /// Each entity as its pairs.
    fn entities(pairs: &[(u16, String)]) -> Vec<Vec<(u16, String)>> {
        let pairs = section("ENTITIES", pairs);
        let entities = pairs[1..].chunk_by(|_, next| next.0 != 0);
        entities.map(<[_]>::to_vec).collect()
    }

    /// The values of a code.
    fn values(code: u16, pairs: &[(u16, String)]) -> Vec<&str> {
        let of_code = pairs.iter().filter(|pair| pair.0 == code);
        of_code.map(|(_, value)| value.as_str()).collect()
    }

    #[test]
    fn a_contour_reads_back_as_one_closed_polyline() {
        let pairs = pairs(Curves::Arcs);
        let header = section("HEADER", &pairs);
        for (name, value) in [("$INSUNITS", "4"), ("$MEASUREMENT", "1")] {
            let at = header.iter().position(|pair| pair.1 == name);
            assert_eq!(header[at.expect("stated") + 1].1, value, "{name}");
        }
        let entities = entities(&pairs);
        let closed: Vec<_> = entities
            .iter()
            .filter(|e| e[0].1 == "LWPOLYLINE" && values(70, e) == ["1"])
            .collect();
        assert_eq!((closed.len(), entities.len()), (1, 7));
        assert_eq!(values(8, closed[0]), ["PROFILE"]);
        assert_eq!(values(90, closed[0]), ["4"]);
        let bulges = values(42, closed[0]);
        assert_eq!(bulges.len(), 2);
        for bulge in bulges {
            let bulge: f64 = bulge.parse().expect("a number");
            assert!((bulge - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_contour_reads_back_as_chords_and_a_circle_as_such_in_every_form() {
        let mut drawing = sample();
        drawing.draw(
            "PROFILE",
            EntityShape::Contour(Outline::circle(Point::new(2.0, 1.0), 5.0)),
        );
        for curves in Curves::ALL {
            let entities = entities(&pairs_of(&drawing, curves));
            let of = |kind: &str| entities.iter().filter(|e| e[0].1 == kind).count();
            assert_eq!(of("CIRCLE"), 2, "{curves:?}");
            let bent = entities.iter().any(|e| !values(42, e).is_empty());
            assert_eq!(bent, curves == Curves::Arcs, "{curves:?}");
        }
    }

    #[test]
    fn a_spline_has_as_many_knots_as_its_points_and_degree_ask_for() {
        let entities = entities(&pairs(Curves::Splines));
        let spline = entities.iter().find(|e| e[0].1 == "SPLINE");
        let spline = spline.expect("the contour");
        let points = values(10, spline);
        let knots = values(40, spline);
        assert_eq!(knots.len(), points.len() + 4);
        assert_eq!(values(72, spline), [knots.len().to_string()]);
        assert_eq!(values(73, spline), [points.len().to_string()]);
        assert_eq!(points.first(), points.last());
    }

    #[test]
    fn every_entry_has_a_handle_of_its_own_and_an_owner_in_the_file() {
        let pairs = pairs(Curves::Arcs);
        let body = pairs.iter().skip_while(|pair| pair.1 != "TABLES");
        let body: Vec<_> = body.cloned().collect();
        let given: Vec<&str> = [values(5, &body), values(105, &body)].concat();
        let distinct: HashSet<&str> = given.iter().copied().collect();
        assert_eq!(given.len(), distinct.len());
        for owner in values(330, &body) {
            assert!(owner == "0" || distinct.contains(owner), "{owner}");
        }
        let number = |text: &str| u32::from_str_radix(text, 16).expect("a handle");
        let maximum = given.iter().map(|handle| number(handle)).max();
        let at = pairs.iter().position(|pair| pair.1 == "$HANDSEED");
        let seed = number(&pairs[at.expect("stated") + 1].1);
        assert!(maximum < Some(seed));
    }

    #[test]
    fn the_same_drawing_gives_the_same_bytes() {
        let every = || {
            [
                (Version::R2010, Curves::Arcs),
                (Version::R2010, Curves::Splines),
                (Version::R12, Curves::Arcs),
            ]
            .map(|(version, curves)| {
                write(&sample(), version, curves, tolerance()).expect("written")
            })
        };
        let first = every();
        std::thread::sleep(std::time::Duration::from_millis(1100));
        assert!(first == every());
    }

    #[test]
    fn what_the_format_has_not_is_refused() {
        assert!(matches!(
            write(&sample(), Version::R12, Curves::Splines, tolerance()),
            Err(DxfError::SplinesInR12)
        ));
        let mut drawing = sample();
        drawing.draw("NOWHERE", EntityShape::Mark(Point::origin()));
        assert!(matches!(
            write(&drawing, Version::R2010, Curves::Arcs, tolerance()),
            Err(DxfError::Layer { .. })
        ));
    }
}
