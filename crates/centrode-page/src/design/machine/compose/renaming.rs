//! New names of parts: every reference follows.

use std::collections::BTreeSet;

use serde_json::Value as Json;
use toml_edit::{DocumentMut, Item, Key, TableLike};

use super::references::{
    BodyPoint, InFigure, Names, TABLES, names_in, original, same_point, words,
};
use super::scene::Scene;
use super::{Composed, Refusal, naming};
use crate::design::edit::{Step, container, set};

/// A part with its name.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Named {
    Body(String),
    /// All names of one point.
    Point(BTreeSet<BodyPoint>, String),
    /// A part of another table.
    Part(String, String),
}

impl Named {
    /// The part with a key: `bodies.crank`, `bodies.crank.points.A`, `dyads.knee`.
    pub(super) fn new(design: &Json, key: &str) -> Option<Self> {
        let steps: Vec<&str> = key.split('.').collect();
        match steps[..] {
            ["bodies", body] => Some(Self::Body(body.into())),
            ["frame", "points" | "corners", point] => Some(Self::point(design, "frame", point)),
            ["bodies", body, "points" | "corners", point] => Some(Self::point(design, body, point)),
            [table, name] if TABLES.contains(&table) => {
                let is_there = design[table].get(name).is_some();
                is_there.then(|| Self::Part(table.into(), name.into()))
            }
            _ => None,
        }
    }

    fn point(design: &Json, body: &str, name: &str) -> Self {
        let own = (body.to_owned(), name.to_owned());
        Self::Point(same_point(design, own), name.to_owned())
    }

    pub(super) fn name(&self) -> &str {
        match self {
            Self::Body(name) | Self::Point(_, name) | Self::Part(_, name) => name,
        }
    }

    /// The word with the new name of the part; `None` if the word names another part.
    fn replaced(&self, design: &Json, word: &str, names: &Names, to: &str) -> Option<String> {
        match (names, self) {
            (Names::BodyOrPoint | Names::Made, Self::Body(name)) => {
                let (body, rest) = split(word);
                let tail = body.strip_prefix(original(design, body))?;
                (original(design, body) == name).then(|| format!("{to}{tail}{rest}"))
            }
            (Names::BodyOrPoint, Self::Point(all, _)) => {
                let (body, point) = word.split_once('.')?;
                let own = (original(design, body).to_owned(), point.to_owned());
                all.contains(&own).then(|| format!("{body}.{to}"))
            }
            (Names::PointOf(body), Self::Point(all, _)) => all
                .contains(&(body.clone(), word.to_owned()))
                .then(|| to.into()),
            (Names::Joint([body, _]), Self::Point(all, _)) => all
                .contains(&(body.clone(), word.to_owned()))
                .then(|| to.into()),
            (Names::Part(table), Self::Part(own, name)) => {
                (table == own && word == name).then(|| to.into())
            }
            (Names::Figure, _) => {
                let mut made = word.to_owned();
                // From the end, so that earlier positions stay.
                for (at, name, kind) in names_in(design, word).into_iter().rev() {
                    if let Some(new) = self.in_figure(design, &name, &kind, to) {
                        made.replace_range(at..at + name.len(), &new);
                    }
                }
                (made != word).then_some(made)
            }
            _ => None,
        }
    }

    fn in_figure(&self, design: &Json, name: &str, kind: &InFigure, to: &str) -> Option<String> {
        match (kind, self) {
            (InFigure::Point, Self::Point(_, own)) => (own == name).then(|| to.into()),
            (InFigure::Part(table), Self::Part(own, part)) => {
                (table == own && part == name).then(|| to.into())
            }
            (InFigure::BodyOrPoint, Self::Part(table, part)) if table == "obstacles" => {
                (part == name).then(|| to.into())
            }
            (InFigure::BodyOrPoint, _) => self.replaced(design, name, &Names::BodyOrPoint, to),
            _ => None,
        }
    }

    /// Whether the word names the part.
    pub(super) fn is_named(&self, design: &Json, word: &str, names: &Names) -> bool {
        self.replaced(design, word, names, "\u{0}").is_some()
    }

    /// Tables whose key is the name of the part.
    fn tables(&self) -> Vec<(Vec<Step>, &str)> {
        match self {
            Self::Body(name) => vec![(vec![Step::named("bodies")], name)],
            Self::Part(table, name) => vec![(vec![Step::named(table)], name)],
            Self::Point(all, _) => {
                let kinds = all.iter().flat_map(|(body, point)| {
                    ["points", "corners"].map(|kind| match body.as_str() {
                        "frame" => (["frame", kind].map(Step::named).to_vec(), point.as_str()),
                        body => {
                            let path = ["bodies", body, kind];
                            (path.map(Step::named).to_vec(), point.as_str())
                        }
                    })
                });
                kinds.collect()
            }
        }
    }
}

/// Body and the rest of `crank.A`.
fn split(word: &str) -> (&str, &str) {
    word.split_at(word.find('.').unwrap_or(word.len()))
}

/// Gives the part another name.
pub(super) fn renamed(mut scene: Scene, key: &str, to: &str) -> Result<Composed, Box<Refusal>> {
    let refused = |why: String| Err(Box::new(Refusal::because(why)));
    let Some(part) = Named::new(&scene.design, key) else {
        return refused(format!("{key} has no name that can be changed"));
    };
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if to.is_empty() || !to.chars().all(allowed) {
        return refused(format!("{to:?} is no name: use letters, digits, - and _"));
    }
    let table = key.split('.').next().unwrap_or_default();
    let is_point = matches!(part, Named::Point(..));
    if !is_point && part.name() != to && naming::is_taken(&scene.design, table, to) {
        return refused(format!("{to} is the name of another part"));
    }
    rename(&mut scene.document, &scene.design, &part, to);
    scene.reread();
    let (table, _) = key.rsplit_once('.').unwrap_or_default();
    scene.finish(&format!("{table}.{to}"), Composed::default())
}

/// Writes the new name of a part wherever the part is named.
pub(super) fn rename(document: &mut DocumentMut, design: &Json, part: &Named, to: &str) {
    for word in words(design) {
        let Some(new) = part.replaced(design, &word.text, &word.names, to) else {
            continue;
        };
        let mut path = word.path;
        let Some(last) = path.pop() else { continue };
        if let Some(parent) = container(document.as_item_mut(), &path, true) {
            // The path leads to a word that was read from this document.
            let _ = set(parent, &last, new.into());
        }
    }
    for (path, name) in part.tables() {
        let table = container(document.as_item_mut(), &path, true);
        if let Some(table) = table.and_then(Item::as_table_like_mut) {
            change_key(table, name, to);
        }
    }
    let Some(vary) = document.get_mut("vary").and_then(Item::as_table_like_mut) else {
        return;
    };
    let keys: Vec<String> = vary.iter().map(|(key, _)| key.to_owned()).collect();
    for key in keys {
        for (path, name) in part.tables() {
            let names = path.iter().filter_map(Step::name);
            let old: String = names.chain([name]).collect::<Vec<_>>().join(".");
            let rest = key.strip_prefix(&old);
            if let Some(rest) = rest.filter(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
            {
                let (around, _) = old.rsplit_once('.').unwrap_or_default();
                change_key(vary, &key, &format!("{around}.{to}{rest}"));
            }
        }
    }
}

/// Gives an entry of a table another key, at its position and with its comments.
fn change_key(table: &mut dyn TableLike, from: &str, to: &str) {
    if from == to || !table.contains_key(from) {
        return;
    }
    let keys: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
    for key in keys {
        let decors = table
            .key(&key)
            .map(|old| (old.leaf_decor().clone(), old.dotted_decor().clone()));
        let Some(item) = table.remove(&key) else {
            continue;
        };
        let name = if key == from { to } else { &key };
        let mut new = Key::new(name);
        if let Some((leaf, dotted)) = decors {
            *new.leaf_decor_mut() = leaf;
            *new.dotted_decor_mut() = dotted;
        }
        table.entry_format(&new).or_insert(item);
    }
}
