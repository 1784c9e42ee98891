//! Parts that are removed, with all that depends on them.

use std::collections::BTreeSet;

use serde_json::Value as Json;
use toml_edit::Item;

use super::references::{Names, Word, bodies_of, names_in, original, words};
use super::renaming::Named;
use super::scene::Scene;
use super::{Composed, Refusal};
use crate::design::edit::{Step, container};

/// Removes a part. If others depend on it, they are removed with it only if `all` is set.
pub(super) fn deleted(mut scene: Scene, key: &str, all: bool) -> Result<Composed, Box<Refusal>> {
    let design = scene.design.clone();
    let Some(first) = first(&design, key) else {
        return Err(Box::new(Refusal::because(format!(
            "{key} cannot be removed"
        ))));
    };
    let gone = closure(&design, first.clone());
    let own = owned(&design, &first);
    let dependents: Vec<String> = gone.difference(&own).cloned().collect();
    if !dependents.is_empty() && !all {
        return Err(Box::new(Refusal {
            refused: format!("{} depend on {key}", dependents.join(", ")),
            dependents,
            ..Refusal::default()
        }));
    }
    for key in &gone {
        remove(&mut scene, key);
    }
    scene.reread();
    scene.finish("", Composed::default())
}

/// The keys with which a removal begins: a body that a dyad makes goes with the dyad.
fn first(design: &Json, key: &str) -> Option<BTreeSet<String>> {
    let made = key.strip_prefix("bodies.").and_then(|body| {
        let mut dyads = design["dyads"].as_object()?.iter();
        let (name, _) = dyads.find(|(_, dyad)| bodies_of(dyad).iter().any(|own| own == body))?;
        Some(format!("dyads.{name}"))
    });
    let key = made.unwrap_or_else(|| key.to_owned());
    let steps: Vec<Step> = key.split('.').map(Step::named).collect();
    let mut there = steps.iter().filter_map(Step::name);
    there.try_fold(design, |here, key| here.get(key))?;
    Named::new(design, &key)?;
    Some(BTreeSet::from([key]))
}

/// The keys with the bodies that dyads among them make, and with the points of bodies among them.
fn owned(design: &Json, keys: &BTreeSet<String>) -> BTreeSet<String> {
    let mut all = keys.clone();
    for key in keys {
        if let Some(dyad) = key
            .strip_prefix("dyads.")
            .and_then(|name| design["dyads"].get(name))
        {
            all.extend(bodies_of(dyad).map(|body| format!("bodies.{body}")));
        }
    }
    let bodies: Vec<String> = all
        .iter()
        .filter(|key| key.starts_with("bodies."))
        .cloned()
        .collect();
    for key in bodies {
        let corners = design["bodies"].get(key.trim_start_matches("bodies."));
        let corners = corners.and_then(|body| body["corners"].as_object());
        let names = corners.into_iter().flat_map(|all| all.keys());
        all.extend(names.map(|name| format!("{key}.corners.{name}")));
    }
    all
}

/// The keys with all parts that depend on them.
fn closure(design: &Json, first: BTreeSet<String>) -> BTreeSet<String> {
    let words = words(design);
    let mut gone = owned(design, &first);
    loop {
        let mut more = BTreeSet::new();
        for key in &gone {
            let Some(part) = Named::new(design, key) else {
                continue;
            };
            let depends = words.iter().filter(|word| match (&word.names, &part) {
                // A dyad owns its bodies and its joint.
                (Names::Made | Names::Joint(_), _) => false,
                // A point that is written for a body is not the pin from which others have it.
                (_, Named::Point(..)) => {
                    !key.starts_with(&word.owner) && part.is_named(design, &word.text, &word.names)
                }
                (names, Named::Part(table, name)) if table == "copies" => {
                    names_copy(design, &design["copies"][name], word)
                        || part.is_named(design, &word.text, names)
                }
                _ => part.is_named(design, &word.text, &word.names),
            });
            more.extend(depends.map(|word| word.owner.clone()));
        }
        more.extend(orphans(design, &gone));
        let more = owned(design, &more);
        let before = gone.len();
        gone.extend(more);
        if gone.len() == before {
            return gone;
        }
    }
}

/// Whether a word names a copy of one of the copied bodies, `arm-2`.
fn names_copy(design: &Json, copies: &Json, word: &Word) -> bool {
    let names = match word.names {
        Names::Figure => names_in(design, &word.text)
            .into_iter()
            .map(|(_, name, _)| name)
            .collect(),
        Names::BodyOrPoint => vec![word.text.clone()],
        _ => Vec::new(),
    };
    names.iter().any(|name| {
        let body = name.split('.').next().unwrap_or(name);
        let own = original(design, body);
        let copied = copies["bodies"].as_array().into_iter().flatten();
        own != body && copied.filter_map(Json::as_str).any(|one| one == own)
    })
}

/// Pairs without gears, and cams without followers, once these keys are removed.
fn orphans(design: &Json, gone: &BTreeSet<String>) -> Vec<String> {
    let users = words(design)
        .into_iter()
        .filter_map(|word| match word.names {
            Names::Part(table @ ("pairs" | "cams")) => {
                Some((format!("{table}.{}", word.text), word.owner))
            }
            _ => None,
        });
    let users: Vec<(String, String)> = users.collect();
    let used = users.iter().map(|(part, _)| part);
    let orphaned = used.filter(|part| {
        users
            .iter()
            .all(|(own, user)| own != *part || gone.contains(user))
    });
    orphaned.cloned().collect()
}

/// Removes a key, with empty tables around it and ranges of a search within it.
fn remove(scene: &mut Scene, key: &str) {
    let steps: Vec<Step> = key.split('.').map(Step::named).collect();
    for depth in (1..=steps.len()).rev() {
        let (around, last) = steps[..depth].split_at(depth - 1);
        let Some(name) = last.first().and_then(Step::name) else {
            return;
        };
        let parent = container(scene.document.as_item_mut(), around, true);
        let Some(parent) = parent.and_then(Item::as_table_like_mut) else {
            continue;
        };
        let is_empty = |item: &Item| {
            item.as_table_like()
                .is_some_and(toml_edit::TableLike::is_empty)
        };
        let goes = depth == steps.len() || parent.get(name).is_some_and(is_empty);
        // The frame is always there.
        if goes && name != "frame" {
            parent.remove(name);
        }
    }
    let vary = scene
        .document
        .get_mut("vary")
        .and_then(Item::as_table_like_mut);
    if let Some(vary) = vary {
        let keys: Vec<String> = vary.iter().map(|(key, _)| key.to_owned()).collect();
        let within = |own: &String| {
            let rest = own.strip_prefix(key);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        for own in keys.iter().filter(|own| within(own)) {
            vary.remove(own);
        }
    }
}
