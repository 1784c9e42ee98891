//! Names of new parts.

use std::collections::BTreeSet;

use serde_json::Value as Json;

use super::references::{TABLES, body_names};

/// Letters of new points, on the frame and on other bodies.
const FRAME: &str = "OPQRSTUVWXYZ";
const BODY: &str = "ABCDEFGHIJKLMN";

/// A name for a point of a body that no point of the design has.
pub(super) fn point(design: &Json, body: &str) -> String {
    let taken = points(design);
    let letters = if body == "frame" { FRAME } else { BODY };
    let numbered = (1..).flat_map(|i| {
        let letters = letters.chars();
        letters.map(move |letter| match i {
            1 => letter.to_string(),
            _ => format!("{letter}{i}"),
        })
    });
    first_free(numbered, &taken)
}

/// A name for a part of a table that no body, dyad, gear, cam or other part has: `rod`, `rod2` and so on. A number after a
/// hyphen would be the name of a copy.
pub(super) fn part(design: &Json, word: &str) -> String {
    let word = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let names = (1..).map(|i| match i {
        1 => word.to_owned(),
        _ => format!("{word}{i}"),
    });
    first_free(names, &parts(design))
}

fn first_free(mut names: impl Iterator<Item = String>, taken: &BTreeSet<String>) -> String {
    names.find(|name| !taken.contains(name)).unwrap_or_default()
}

/// Whether another part of the table has this name. Bodies and obstacles share their names, because clearances name both.
pub(super) fn is_taken(design: &Json, table: &str, name: &str) -> bool {
    let tables: &[&str] = match table {
        "bodies" | "obstacles" => &["bodies", "obstacles"],
        _ => &[table],
    };
    let own = |table: &&str| design[*table].get(name).is_some();
    tables.iter().any(own)
        || tables.contains(&"bodies") && (name == "frame" || body_names(design).contains(name))
}

/// A name for a part of a table that no other part of it has.
pub(super) fn within(design: &Json, table: &str, word: &str) -> String {
    let names = (1..).map(|i| match i {
        1 => word.to_owned(),
        _ => format!("{word}{i}"),
    });
    let mut free = names.filter(|name| !is_taken(design, table, name));
    free.next().unwrap_or_default()
}

/// Names of all parts.
fn parts(design: &Json) -> BTreeSet<String> {
    let mut taken = BTreeSet::from(["frame".to_owned(), "input".to_owned()]);
    for table in TABLES {
        let names = design[table].as_object().into_iter().flatten();
        taken.extend(names.map(|(name, _)| name.clone()));
    }
    taken.extend(body_names(design));
    taken
}

/// Names of all points.
fn points(design: &Json) -> BTreeSet<String> {
    let mut taken = BTreeSet::new();
    let bodies = design["bodies"]
        .as_object()
        .into_iter()
        .flat_map(|all| all.values());
    for body in bodies.chain(design.get("frame")) {
        for kind in ["points", "corners"] {
            let names = body[kind].as_object().into_iter().flatten();
            taken.extend(names.map(|(name, _)| name.clone()));
        }
    }
    let dyads = design["dyads"]
        .as_object()
        .into_iter()
        .flat_map(|all| all.values());
    taken.extend(dyads.filter_map(|dyad| Some(dyad["joint"].as_str()?.to_owned())));
    taken
}
