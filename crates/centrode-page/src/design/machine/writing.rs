//! The new dyad in the text of its design.

use serde_json::{Map, Value as Json, json};
use toml_edit::{DocumentMut, Item};

use super::super::edit::{Step, container, replace};
use super::super::kind::fresh;
use super::course::Course;
use super::{Form, Retype, short};

/// Keys of a dyad that every type has.
const CACHED: [&str; 2] = ["type", "bodies"];

impl Retype<'_> {
    /// Design with a form of the dyad.
    pub(super) fn with(
        &self,
        form: &Form,
        held: &[String; 2],
        course: Option<&Course>,
        is_turned: bool,
    ) -> Option<DocumentMut> {
        let mut made = self.document.clone();
        let mut keys = form.keys.clone();
        let holder = held[1].split('.').next()?.to_owned();
        let mut line = held[1].clone();
        if let (Some(at), true) = (form.point, course.is_some()) {
            let point = self.free("guide", |body| body == holder);
            put_point(&mut made, &holder, &point, at)?;
            line = format!("{holder}.{point}");
        }
        let alone = keys.remove("alone") == Some(true.into());
        let words: &[(&str, &String)] = match self.word {
            "RRR" | "RPR" => &[("from", &held[0]), ("to", &held[1])],
            "RRP" | "RPP" => &[("from", &held[0]), ("line", &line)],
            _ if alone => &[("line", &held[1]), ("second_line", &line)],
            _ => &[("line", &held[0]), ("second_line", &line)],
        };
        for (key, word) in words {
            keys.insert((*key).into(), word.as_str().into());
        }
        let steps = [Step::named("dyads"), Step::named(self.name)];
        let table = container(made.as_item_mut(), &steps, true)?.as_table_like_mut()?;
        let old: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
        for key in old.iter().filter(|key| !CACHED.contains(&key.as_str())) {
            table.remove(key);
        }
        let kind = table.get_mut("type").and_then(Item::as_value_mut)?;
        replace(kind, self.word.into());
        let bodies: Vec<String> = serde_json::from_value(self.spec.get("bodies")?.clone()).ok()?;
        if is_turned {
            let turned: Vec<Json> = bodies
                .iter()
                .rev()
                .map(|body| body.as_str().into())
                .collect();
            let bodies = table.get_mut("bodies").and_then(Item::as_value_mut)?;
            replace(bodies, fresh(&turned.into())?);
        }
        for (key, value) in &keys {
            table.insert(key, Item::Value(fresh(value)?));
        }
        if let Some(course) = course {
            self.keep_points(&mut made, form, course, &bodies, is_turned, &keys)?;
        }
        Some(made)
    }

    /// Whether a corner of a body is measured from a point.
    fn is_corner(&self, body: &str, name: &str) -> bool {
        let own = self
            .design
            .get("bodies")
            .and_then(|bodies| bodies.get(body));
        let corners = own
            .and_then(|own| own.get("corners"))
            .and_then(Json::as_object);
        let mut corners = corners.into_iter().flat_map(Map::values);
        corners.any(|corner| {
            let from = corner.get("from").and_then(Json::as_array);
            from.is_some_and(|from| from.iter().any(|own| own == name))
        })
    }

    /// Writes points of the old type into its bodies, if other bodies are held by them and the new type has no points of these
    /// names.
    fn keep_points(
        &self,
        made: &mut DocumentMut,
        form: &Form,
        course: &Course,
        bodies: &[String],
        is_turned: bool,
        keys: &Map<String, Json>,
    ) -> Option<()> {
        let text = self.document.to_string();
        let pin = |key: &str| {
            let word = keys.get(key)?.as_str()?;
            Some(word.rsplit('.').next()?.to_owned())
        };
        let joint = keys.get("joint").and_then(Json::as_str).map(str::to_owned);
        let (from, to) = (pin("from"), pin("to"));
        let now: [Vec<Option<String>>; 2] = match self.word {
            "RRR" => [vec![from, joint.clone()], vec![to, joint]],
            "RRP" => [vec![from, joint.clone()], vec![joint]],
            "RPR" => [vec![from], vec![to]],
            "PRP" => [vec![joint.clone()], vec![joint]],
            _ => [vec![from], vec![joint]],
        };
        for (number, given) in course.given.iter().enumerate() {
            let body = &bodies[if is_turned { 1 - number } else { number }];
            // These points were written for an earlier type, and the new type has them itself.
            for name in now[number].iter().flatten() {
                let steps = ["bodies", body, "points"].map(Step::named);
                let points = container(made.as_item_mut(), &steps, true);
                if let Some(points) = points.and_then(Item::as_table_like_mut) {
                    points.remove(name);
                }
            }
            for (name, places) in given {
                let is_there = now[number].iter().flatten().any(|own| own == name);
                let word = format!("{body}.{name}");
                // Corners name points of their own body without the body's name.
                let is_held = text.contains(&format!("\"{word}\"")) || self.is_corner(body, name);
                if is_there || !is_held {
                    continue;
                }
                let at = form.frames[number].seen(places[form.stand]);
                put_point(made, body, name, [short(at.x), short(at.y)])?;
            }
        }
        Some(())
    }
}

/// Adds a point to a body.
pub(in crate::design) fn put_point(
    made: &mut DocumentMut,
    body: &str,
    name: &str,
    at: [f64; 2],
) -> Option<()> {
    let steps: Vec<Step> = match body {
        "frame" => vec![Step::named("frame"), Step::named("points")],
        body => ["bodies", body, "points"].map(Step::named).into(),
    };
    let table = container(made.as_item_mut(), &steps, false)?.as_table_like_mut()?;
    table.insert(name, Item::Value(fresh(&json!(at))?));
    Some(())
}
