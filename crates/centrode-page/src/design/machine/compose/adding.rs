//! New points, corners and turning bodies.

use centrode_geometry::{Point, Vector};
use serde_json::{Map, Value as Json, json};

use super::scene::{Scene, clicked, line};
use super::writing::{digits, put, put_in, put_point};
use super::{Composed, Pin, Place, Refusal, naming};

/// An angle from -180 up to 180 degrees, of which only what is above rounding is left, deg.
pub(super) fn degrees(angle: f64) -> f64 {
    let turned = angle.to_degrees().rem_euclid(360.0);
    let turned = if turned > 180.0 {
        turned - 360.0
    } else {
        turned
    };
    let whole = turned.round();
    // The sum of the angles of several bodies is exact to about 1e-12 deg.
    digits(if (turned - whole).abs() < 1e-9 {
        whole
    } else {
        turned
    })
}

/// Numbers of a part by the names of their fields.
pub(super) fn numbers<const N: usize>(pairs: [(&str, Json); N]) -> Map<String, Json> {
    let pairs = pairs.into_iter();
    pairs.map(|(key, value)| (key.to_owned(), value)).collect()
}

/// Two lengths from two points to a third, as given or measured, and the side of the third.
pub(super) struct Triangle {
    pub(super) lengths: [f64; 2],
    pub(super) side: String,
    /// The third point, and the one on the other side; `None` if the lengths do not reach.
    pub(super) joints: Option<[Point; 2]>,
}

impl Triangle {
    pub(super) fn new(
        [a, b]: [Point; 2],
        at: Option<Place>,
        given: [Option<f64>; 2],
        side: Option<&str>,
    ) -> Result<Self, Box<Refusal>> {
        let measured = |end: Point| clicked(at, "both lengths").map(|at| (at - end).norm());
        let length = |given: Option<f64>, end: Point| match given {
            Some(length) => Ok(length),
            None => measured(end).map(digits),
        };
        let lengths = [length(given[0], a)?, length(given[1], b)?];
        let side = match (side, at) {
            (Some(side), _) => side.to_owned(),
            (None, Some(at)) if (b - a).perp(&(Point::from(at) - a)) < 0.0 => "right".into(),
            _ => "left".into(),
        };
        let joints = apex([a, b], lengths).map(|[left, right]| match side.as_str() {
            "left" => [left, right],
            _ => [right, left],
        });
        Ok(Self {
            lengths,
            side,
            joints,
        })
    }

    /// Its numbers by the names of their fields.
    pub(super) fn numbers(&self) -> Map<String, Json> {
        numbers([
            ("length", self.lengths[0].into()),
            ("length2", self.lengths[1].into()),
            ("side", self.side.as_str().into()),
        ])
    }
}

/// The two points at given distances from two others, the left one first; `None` if there is none.
pub(super) fn apex([a, b]: [Point; 2], [one, other]: [f64; 2]) -> Option<[Point; 2]> {
    let way = b - a;
    let apart = way.norm();
    let along = (apart * apart + one * one - other * other) / (2.0 * apart);
    let high = one * one - along * along;
    if apart <= 0.0 || !high.is_finite() || high < 0.0 {
        return None;
    }
    let [unit, across] = [way / apart, Vector::new(-way.y, way.x) / apart];
    let foot = a + unit * along;
    Some([1.0, -1.0].map(|sign| foot + across * (sign * high.sqrt())))
}

/// A point on a body, at given coordinates in its axes or where it was clicked.
pub(super) fn point(
    mut scene: Scene,
    body: &str,
    at: Option<Place>,
    given: [Option<f64>; 2],
) -> Result<Composed, Box<Refusal>> {
    let index = scene.body(body)?;
    let local = match given {
        [Some(x), Some(y)] => [x, y],
        [x, y] => {
            let own = scene.local(index, clicked(at, "both coordinates")?);
            [x.unwrap_or(own[0]), y.unwrap_or(own[1])]
        }
    };
    let name = naming::point(&scene.design, body);
    put_point(&mut scene.document, body, &name, local)?;
    scene.reread();
    let part = Composed {
        numbers: numbers([("x", local[0].into()), ("y", local[1].into())]),
        ..Composed::default()
    };
    let table = if body == "frame" {
        "frame".into()
    } else {
        format!("bodies.{body}")
    };
    scene.finish(&format!("{table}.points.{name}"), part)
}

/// A point at two distances from two points of a body.
pub(super) fn corner(
    mut scene: Scene,
    from: [&str; 2],
    at: Option<Place>,
    lengths: [Option<f64>; 2],
    side: Option<&str>,
) -> Result<Composed, Box<Refusal>> {
    let held = [scene.point(from[0])?, scene.point(from[1])?];
    let ends = [held[0].at, held[1].at];
    let names = from.map(|word| word.rsplit('.').next().unwrap_or(word));
    let near = 1e-6 * (ends[1] - ends[0]).norm();
    // Bodies pinned to each other have the pin as a point of the same name.
    let is_on = |body: &str| {
        (0..2).all(|i| {
            let own = scene.point(&format!("{body}.{}", names[i]));
            own.is_ok_and(|own| (own.at - ends[i]).norm() <= near)
        })
    };
    let bodies = scene.machine.as_ref().map(|machine| machine.bodies());
    let mut found = bodies.into_iter().flatten().map(|body| body.name.clone());
    let Some(body) = found.find(|body| is_on(body)) else {
        let why = format!(
            "{} and {} are not points of one body: click two points of the same bar",
            from[0], from[1]
        );
        return Err(Box::new(Refusal::because(why)));
    };
    let triangle = Triangle::new(ends, at, lengths, side)?;
    let Some([corner, _]) = triangle.joints else {
        let [one, other] = triangle.lengths;
        let why = format!(
            "sides of {one} and {other} mm do not reach between {} and {}, which are {} mm apart",
            names[0],
            names[1],
            digits((ends[1] - ends[0]).norm())
        );
        return Err(Box::new(Refusal::because(why)));
    };
    let name = naming::point(&scene.design, &body);
    let value = format!(
        "{{ from = [\"{}\", \"{}\"], lengths = [{}, {}], side = \"{}\" }}",
        names[0], names[1], triangle.lengths[0], triangle.lengths[1], triangle.side
    );
    put_in(&mut scene.document, &body, "corners", &name, &value)?;
    scene.reread();
    let part = Composed {
        numbers: triangle.numbers(),
        lines: vec![line(ends[0], corner), line(ends[1], corner)],
        ..Composed::default()
    };
    let table = if body == "frame" {
        "frame".into()
    } else {
        format!("bodies.{body}")
    };
    scene.finish(&format!("{table}.corners.{name}"), part)
}

/// A body that turns on a pin, with a point at its end. By default the first one turns with the input, and later ones are fixed.
pub(super) fn body(
    mut scene: Scene,
    on: &Pin,
    at: Option<Place>,
    [length, angle]: [Option<f64>; 2],
    ratio: Option<f64>,
) -> Result<Composed, Box<Refusal>> {
    let is_first = scene.machine.is_none();
    let pin = scene.pin(on)?;
    let both = "length and angle";
    let length = match length {
        Some(length) => length,
        None => digits((clicked(at, both)? - pin.at).norm()),
    };
    let angle = match angle {
        Some(angle) => angle.to_radians(),
        None => {
            let way = clicked(at, both)? - pin.at;
            way.y.atan2(way.x)
        }
    };
    let ratio = ratio.unwrap_or(if is_first { 1.0 } else { 0.0 });
    let start = degrees(angle - scene.angle(pin.body) - ratio * scene.input);
    let law = match (ratio, start) {
        (0.0, _) => format!("{{ start_deg = {start} }}"),
        (_, 0.0) => format!("{{ ratio = {ratio} }}"),
        _ => format!("{{ ratio = {ratio}, start_deg = {start} }}"),
    };
    let name = naming::part(&scene.design, if ratio == 0.0 { "lever" } else { "crank" });
    let end = naming::point(&scene.design, &name);
    let text = format!(
        "on = \"{}\"\nlaw = {law}\npoints = {{ {end} = [{length}, 0] }}\n",
        pin.word
    );
    put(&mut scene.document, "bodies", &name, &text)?;
    scene.reread();
    let tip = pin.at + Vector::new(angle.cos(), angle.sin()) * length;
    let part = Composed {
        numbers: numbers([
            ("length", length.into()),
            ("angle_deg", degrees(angle).into()),
            ("ratio", json!(ratio)),
        ]),
        lines: vec![line(pin.at, tip)],
        ..Composed::default()
    };
    scene.finish(&format!("bodies.{name}"), part)
}
