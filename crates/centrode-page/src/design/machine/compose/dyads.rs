//! New dyads: two bars, or a bar and a block on a line.

use centrode_geometry::{Point, Vector};
use serde_json::{Value as Json, json};

use super::adding::{Triangle, apex, degrees, numbers};
use super::scene::{Held, Scene, clicked, line};
use super::writing::{digits, put};
use super::{Composed, Other, Pin, Place, Refusal, naming};
use crate::design::edit::Edit;

/// Share by which nearest lengths keep away from the position in which bars are in one line: about 8 deg of transmission angle.
const SPARE: f64 = 0.01;

/// Two bars from two pins, with given lengths or to the position that was clicked.
pub(super) fn bars(
    mut scene: Scene,
    pins: [&Pin; 2],
    at: Option<Place>,
    lengths: [Option<f64>; 2],
    side: Option<&str>,
) -> Result<Composed, Box<Refusal>> {
    let held = [scene.pin(pins[0])?, scene.pin(pins[1])?];
    movable(&held)?;
    let ends = [held[0].at, held[1].at];
    let triangle = Triangle::new(ends, at, lengths, side)?;
    let name = naming::part(&scene.design, "bars");
    let [rod, rocker] = ["rod", "rocker"].map(|word| naming::part(&scene.design, word));
    let joint = naming::point(&scene.design, &rod);
    let text = format!(
        "type = \"RRR\"\nfrom = \"{}\"\nto = \"{}\"\nlengths = [{}, {}]\nside = \"{}\"\nbodies = [\"{rod}\", \"{rocker}\"]\njoint = \"{joint}\"\n",
        held[0].word, held[1].word, triangle.lengths[0], triangle.lengths[1], triangle.side
    );
    put(&mut scene.document, "dyads", &name, &text)?;
    scene.reread();
    let spread = |joint: Point| ends.map(|end| line(end, joint)).to_vec();
    let key = format!("dyads.{name}");
    let part = Composed {
        numbers: triangle.numbers(),
        lines: triangle
            .joints
            .map(|[joint, _]| spread(joint))
            .unwrap_or_default(),
        other: triangle.joints.map(|[_, joint]| Other {
            lines: spread(joint),
            edits: vec![Edit::word(&format!("{key}.side"), turned(&triangle.side))],
        }),
        ..Composed::default()
    };
    let apart = scene.path(&held[0]).into_iter().zip(scene.path(&held[1]));
    let apart: Vec<f64> = apart.map(|(a, b)| (b - a).norm()).collect();
    scene.finish(&key, part).map_err(|refusal| {
        let [one, other] = reaching(&apart, triangle.lengths);
        let nearest = numbers([("length", one.into()), ("length2", other.into())]);
        unclosed(*refusal, nearest)
    })
}

/// The nearest lengths of two bars that reach each other at all these distances of their pins, mm.
fn reaching(apart: &[f64], [one, other]: [f64; 2]) -> [f64; 2] {
    let most = apart.iter().copied().fold(0.0, f64::max);
    let fewest = apart.iter().copied().fold(f64::INFINITY, f64::min);
    let limit = (1.0 - SPARE) * fewest;
    let difference = (one - other).clamp(-limit, limit);
    let sum = (one + other).max((1.0 + SPARE) * most);
    [0.5 * (sum + difference), 0.5 * (sum - difference)].map(digits)
}

/// A bar from a pin to a block on a line through another, with given numbers or to the position that was clicked.
pub(super) fn slider(
    mut scene: Scene,
    pins: [&Pin; 2],
    at: Option<Place>,
    [length, angle]: [Option<f64>; 2],
    side: Option<&str>,
) -> Result<Composed, Box<Refusal>> {
    let held = [scene.pin(pins[0])?, scene.pin(pins[1])?];
    movable(&held)?;
    let [from, through] = [held[0].at, held[1].at];
    let both = "length and angle";
    let angle = match angle {
        Some(angle) => angle.to_radians(),
        None => {
            let way = clicked(at, both)? - through;
            way.y.atan2(way.x)
        }
    };
    let along = Vector::new(angle.cos(), angle.sin());
    let foot = through + along * along.dot(&(from - through));
    let length = match (length, at) {
        (Some(length), _) => length,
        _ => {
            let block = through + along * along.dot(&(clicked(at, both)? - through));
            digits((block - from).norm())
        }
    };
    let side = match (side, at) {
        (Some(side), _) => side.to_owned(),
        (None, Some(at)) if along.dot(&(Point::from(at) - foot)) < 0.0 => "backward".into(),
        _ => "forward".into(),
    };
    let body = held[1].body;
    let turned_by = degrees(angle - scene.angle(body));
    let name = naming::part(&scene.design, "slide");
    let [rod, block] = ["rod", "slider"].map(|word| naming::part(&scene.design, word));
    let joint = naming::point(&scene.design, &rod);
    let text = format!(
        "type = \"RRP\"\nfrom = \"{}\"\nlengths = [{length}]\nline = \"{}\"\nline_deg = {turned_by}\nside = \"{side}\"\nbodies = [\"{rod}\", \"{block}\"]\njoint = \"{joint}\"\n",
        held[0].word, held[1].word
    );
    put(&mut scene.document, "dyads", &name, &text)?;
    scene.reread();
    let key = format!("dyads.{name}");
    let off = (from - foot).norm();
    let reach = (length * length - off * off).max(0.0).sqrt();
    let sign = if side == "forward" { 1.0 } else { -1.0 };
    let spread = |joint: Point| vec![line(from, joint), line(through, joint)];
    let part = Composed {
        numbers: numbers([
            ("length", length.into()),
            ("angle_deg", degrees(angle).into()),
            ("side", side.as_str().into()),
        ]),
        lines: spread(foot + along * (sign * reach)),
        other: (reach > 0.0).then(|| Other {
            lines: spread(foot - along * (sign * reach)),
            edits: vec![Edit::word(&format!("{key}.side"), turned(&side))],
        }),
        ..Composed::default()
    };
    let line = scene.seen(&held[1], body);
    let local = angle - scene.angle(body);
    let along = Vector::new(local.cos(), local.sin());
    let offs = scene.seen(&held[0], body).into_iter().zip(line);
    let most = offs
        .map(|(a, on)| along.perp(&(a - on)).abs())
        .fold(0.0, f64::max);
    scene.finish(&key, part).map_err(|refusal| {
        let long = digits(length.max((1.0 + SPARE) * most));
        unclosed(*refusal, numbers([("length", long.into())]))
    })
}

/// Refuses pins of one body: nothing would move.
fn movable([one, other]: &[Held; 2]) -> Result<(), Box<Refusal>> {
    if one.body == other.body {
        let why = format!(
            "{} and {} are on one body: choose points of two bodies",
            one.word, other.word
        );
        return Err(Box::new(Refusal::because(why)));
    }
    Ok(())
}

/// The reason why a dyad does not close, with the nearest numbers that do.
fn unclosed(refusal: Refusal, nearest: serde_json::Map<String, Json>) -> Box<Refusal> {
    let closes = refusal.refused.contains("close");
    Box::new(Refusal {
        nearest: closes.then_some(nearest),
        ..refusal
    })
}

/// The word of the other side.
fn turned(side: &str) -> &'static str {
    match side {
        "left" => "right",
        "right" => "left",
        "forward" => "backward",
        _ => "forward",
    }
}

/// The other solution of a dyad at the input shown.
pub(super) fn other(scene: &Scene, key: &str) -> Result<Composed, Box<Refusal>> {
    let none = || Box::new(Refusal::because(format!("{key} has no other solution")));
    let name = key.strip_prefix("dyads.").ok_or_else(none)?;
    let dyad = scene.design["dyads"].get(name).ok_or_else(none)?;
    let word = |key: &str| dyad.get(key).and_then(Json::as_str);
    let side = word("side").ok_or_else(none)?;
    let from = scene.point(word("from").ok_or_else(none)?)?;
    let length = |i: usize| dyad["lengths"][i].as_f64().ok_or_else(none);
    let lines = match word("type") {
        Some("RRR") => {
            let to = scene.point(word("to").ok_or_else(none)?)?;
            let ends = [from.at, to.at];
            let [left, right] = apex(ends, [length(0)?, length(1)?]).ok_or_else(none)?;
            let joint = if side == "left" { right } else { left };
            ends.map(|end| line(end, joint)).to_vec()
        }
        Some("RRP") => {
            let joint = word("joint").ok_or_else(none)?;
            let rod = dyad["bodies"][0].as_str().ok_or_else(none)?;
            let joint = scene.point(&format!("{rod}.{joint}"))?.at;
            let through = scene.point(word("line").ok_or_else(none)?)?;
            let angle = dyad.get("line_deg").and_then(Json::as_f64).unwrap_or(0.0);
            let angle = angle.to_radians() + scene.angle(through.body);
            let along = Vector::new(angle.cos(), angle.sin());
            let mirrored = joint + along * (2.0 * along.dot(&(from.at - joint)));
            vec![line(from.at, mirrored), line(through.at, mirrored)]
        }
        _ => return Err(none()),
    };
    let mut numbers = serde_json::Map::new();
    numbers.insert("side".into(), json!(side));
    Ok(Composed {
        key: key.into(),
        numbers,
        other: Some(Other {
            lines,
            edits: vec![Edit::word(&format!("{key}.side"), turned(side))],
        }),
        ..Composed::default()
    })
}
