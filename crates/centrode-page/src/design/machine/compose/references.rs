//! The words of a machine's design that name other parts of it.

use std::collections::BTreeSet;

use serde_json::Value as Json;

use crate::design::edit::Step;

/// Kind of part that a word names.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Names {
    /// `crank`, or `crank.A`.
    BodyOrPoint,
    /// A point of this body.
    PointOf(String),
    /// A body that the dyad makes.
    Made,
    /// The joint of a dyad with these bodies.
    Joint([String; 2]),
    /// A part of this table: pairs, gears or cams.
    Part(&'static str),
    /// A figure of a goal.
    Figure,
}

/// A word of the design that names a part.
#[derive(Clone, Debug)]
pub(super) struct Word {
    /// Key of the part that has the word: `dyads.knee`.
    pub(super) owner: String,
    pub(super) path: Vec<Step>,
    pub(super) names: Names,
    pub(super) text: String,
}

/// Kinds of parts, by the table that has them.
pub(super) const TABLES: [&str; 10] = [
    "bodies",
    "dyads",
    "pairs",
    "gears",
    "meshes",
    "cams",
    "copies",
    "loads",
    "obstacles",
    "goals",
];

/// All words of a design that name parts.
pub(super) fn words(design: &Json) -> Vec<Word> {
    let mut found = Vec::new();
    corners(design, &["frame"], "frame", &mut found);
    for table in TABLES {
        let parts = design[table].as_object().into_iter().flatten();
        for (name, part) in parts {
            if table == "bodies" {
                corners(design, &["bodies", name], name, &mut found);
            }
            for (keys, names) in keys_of(table, part) {
                let value = keys.iter().fold(part, |value, key| &value[key]);
                let mut add = |value: &Json, index: Option<usize>| {
                    let Some(text) = value.as_str() else { return };
                    let mut path = vec![Step::named(table), Step::named(name)];
                    path.extend(keys.iter().map(|key| Step::named(key)));
                    path.extend(index.map(Step::Index));
                    found.push(Word {
                        owner: format!("{table}.{name}"),
                        path,
                        names: names.clone(),
                        text: text.to_owned(),
                    });
                };
                match value.as_array() {
                    Some(list) => list
                        .iter()
                        .enumerate()
                        .for_each(|(i, value)| add(value, Some(i))),
                    None => add(value, None),
                }
            }
        }
    }
    found
}

/// Keys of a part that name others.
fn keys_of(table: &str, part: &Json) -> Vec<(&'static [&'static str], Names)> {
    use Names::{BodyOrPoint, Figure, Joint, Made, Part};
    match table {
        "bodies" => vec![
            (&["on"], BodyOrPoint),
            (&["fixed_to"], BodyOrPoint),
            (&["mesh", "gear"], Part("gears")),
            (&["mesh", "with"], Part("gears")),
            (&["law", "follows"], Part("cams")),
            (&["law", "by"], BodyOrPoint),
        ],
        "dyads" => vec![
            (&["bodies"], Made),
            (&["joint"], Joint(bodies_of(part))),
            (&["from"], BodyOrPoint),
            (&["to"], BodyOrPoint),
            (&["line"], BodyOrPoint),
            (&["second_line"], BodyOrPoint),
        ],
        "gears" => vec![(&["pair"], Part("pairs")), (&["on"], BodyOrPoint)],
        "meshes" => vec![(&["gears"], Part("gears"))],
        "cams" => vec![
            (&["on"], BodyOrPoint),
            (&["about"], BodyOrPoint),
            (&["cut_to"], BodyOrPoint),
        ],
        "copies" => vec![(&["bodies"], BodyOrPoint), (&["about"], BodyOrPoint)],
        "loads" | "obstacles" => vec![(&["on"], BodyOrPoint)],
        "goals" => vec![(&["figure"], Figure)],
        _ => Vec::new(),
    }
}

/// Names of the two bodies of a dyad.
pub(super) fn bodies_of(dyad: &Json) -> [String; 2] {
    [0, 1].map(|i| dyad["bodies"][i].as_str().unwrap_or_default().to_owned())
}

/// The points from which corners of a body are measured.
fn corners(design: &Json, table: &[&str], body: &str, found: &mut Vec<Word>) {
    let own = table.iter().fold(design, |value, key| &value[key]);
    for (corner, spec) in own["corners"].as_object().into_iter().flatten() {
        for (i, point) in spec["from"].as_array().into_iter().flatten().enumerate() {
            let mut path: Vec<Step> = table.iter().map(|key| Step::named(key)).collect();
            path.extend(["corners", corner, "from"].map(Step::named));
            path.push(Step::Index(i));
            found.push(Word {
                owner: format!("{}.corners.{corner}", table.join(".")),
                path,
                names: Names::PointOf(body.to_owned()),
                text: point.as_str().unwrap_or_default().to_owned(),
            });
        }
    }
}

/// Original of a body: `arm` for its copy `arm-2`.
pub(super) fn original<'a>(design: &Json, name: &'a str) -> &'a str {
    let Some((base, number)) = name.rsplit_once('-') else {
        return name;
    };
    let copies = design["copies"]
        .as_object()
        .into_iter()
        .flat_map(|all| all.values());
    let mut copied = copies.flat_map(|copy| copy["bodies"].as_array().into_iter().flatten());
    match number.parse::<u32>().is_ok() && copied.any(|body| body == base) {
        true => base,
        false => name,
    }
}

/// A point of a body.
pub(super) type BodyPoint = (String, String);

/// All names of a point: bodies pinned to each other share their pin.
pub(super) fn same_point(design: &Json, point: BodyPoint) -> BTreeSet<BodyPoint> {
    let of = |word: &Json| {
        let (body, point) = word.as_str()?.split_once('.')?;
        Some((body.to_owned(), point.to_owned()))
    };
    let mut pairs: Vec<(BodyPoint, BodyPoint)> = Vec::new();
    let mut join = |one: Option<BodyPoint>, body: &str| {
        if let Some((held, name)) = one {
            pairs.push(((held, name.clone()), (body.to_owned(), name)));
        }
    };
    for (name, body) in design["bodies"].as_object().into_iter().flatten() {
        if body.get("slides_deg").is_none() && body.get("mesh").is_none() {
            join(of(&body["on"]), name);
        }
    }
    for dyad in design["dyads"]
        .as_object()
        .into_iter()
        .flat_map(|all| all.values())
    {
        let [one, other] = bodies_of(dyad);
        join(of(&dyad["from"]), &one);
        join(of(&dyad["to"]), &other);
        if let Some(joint) = dyad["joint"].as_str() {
            join(Some((one, joint.to_owned())), &other);
        }
    }
    let mut all = BTreeSet::from([point]);
    loop {
        let next = |(a, b): &(BodyPoint, BodyPoint)| match (all.contains(a), all.contains(b)) {
            (true, false) => Some(b.clone()),
            (false, true) => Some(a.clone()),
            _ => None,
        };
        match pairs.iter().find_map(next) {
            Some(point) => drop(all.insert(point)),
            None => return all,
        }
    }
}

/// A name in a figure, and the part that it may name.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum InFigure {
    /// `crank` or `crank.A`, where a body is meant.
    BodyOrPoint,
    /// A point alone, `foot`.
    Point,
    /// A part of this table.
    Part(&'static str),
}

/// The names in a figure with their positions in the text: `distance(a.P, b.Q)`, `foot.x`, `joint(rod-rocker).force`.
pub(super) fn names_in(design: &Json, figure: &str) -> Vec<(usize, String, InFigure)> {
    let Some((function, rest)) = figure.split_once('(') else {
        let Some((of, part)) = figure.rsplit_once('.') else {
            return Vec::new();
        };
        let is_point = ["x", "y", "speed", "acceleration"].contains(&part);
        let kind = match is_point && !of.contains('.') {
            true => InFigure::Point,
            false => InFigure::BodyOrPoint,
        };
        return match of {
            "input" => Vec::new(),
            _ => vec![(0, of.to_owned(), kind)],
        };
    };
    let inside = rest.split(')').next().unwrap_or(rest);
    let mut at = function.len() + 1;
    let mut found = Vec::new();
    for word in inside.split(',') {
        let name = word.trim();
        let start = at + word.len() - word.trim_start().len();
        at += word.len() + 1;
        let kind = match function.trim() {
            "transmission" => InFigure::Part("dyads"),
            "pair" => InFigure::Part("pairs"),
            _ => InFigure::BodyOrPoint,
        };
        let is_body = |name: &str| body_names(design).contains(original(design, name));
        let pair = name.match_indices('-').find_map(|(i, _)| {
            let (one, other) = (&name[..i], &name[i + 1..]);
            (is_body(one) && is_body(other)).then_some((one, other))
        });
        match pair.filter(|_| function.trim() == "joint" && !is_body(name)) {
            Some((one, other)) => {
                found.push((start, one.to_owned(), kind.clone()));
                found.push((start + one.len() + 1, other.to_owned(), kind));
            }
            None => found.push((start, name.to_owned(), kind)),
        }
    }
    found
}

/// Names of all bodies.
pub(super) fn body_names(design: &Json) -> BTreeSet<String> {
    let own = design["bodies"]
        .as_object()
        .into_iter()
        .flat_map(|all| all.keys().cloned());
    let dyads = design["dyads"]
        .as_object()
        .into_iter()
        .flat_map(|all| all.values());
    own.chain(dyads.flat_map(bodies_of)).collect()
}
