//! Points of a curve in the other plane, when its key `plane` changes.

use toml_edit::{Array, DocumentMut, Item, Value};

use super::edit::{Step, container, replace};

/// Digits after the point of a converted coordinate.
const DIGITS: i32 = 6;

/// Names of the coordinates of both planes, by the word of the plane.
const PLANES: [(&str, [&str; 2]); 2] = [
    ("polar", ["radius", "angle_deg"]),
    ("cartesian", ["x", "y"]),
];

/// Design with the points of the table at a path in the coordinates of another plane, at the same positions; `None` if the table
/// has no points of the old plane, or already has points of the new one.
pub(super) fn moved(document: &DocumentMut, steps: &[Step], plane: &str) -> Option<DocumentMut> {
    let to = PLANES.iter().position(|(word, _)| *word == plane)?;
    let [(before, old), (_, new)] = [PLANES[1 - to], PLANES[to]];
    let mut made = document.clone();
    let table = container(made.as_item_mut(), steps, true)?.as_table_like_mut()?;
    // A table without the key is polar.
    let now = table.get("plane").and_then(Item::as_str).unwrap_or("polar");
    if now != before || new.iter().any(|name| table.contains_key(name)) {
        return None;
    }
    let lists = old.map(|name| numbers(table.get(name)));
    let [Some(first), Some(second)] = lists else {
        return None;
    };
    let points: Vec<[f64; 2]> = first.into_iter().zip(second).map(|(a, b)| [a, b]).collect();
    let mut points = match plane {
        "polar" => polar(&points),
        _ => points
            .iter()
            .map(|&[radius, angle]| place(radius, angle))
            .collect(),
    };
    for point in &mut points {
        *point = point.map(rounded);
    }
    for (k, (old, new)) in old.into_iter().zip(new).enumerate() {
        let mut item = table.remove(old)?;
        let list: Array = points.iter().map(|point| point[k]).collect();
        // Lines and comments of the list stay.
        replace(item.as_value_mut()?, Value::Array(list));
        table.insert(new, item);
    }
    match table.get_mut("plane").and_then(Item::as_value_mut) {
        Some(word) => replace(word, plane.into()),
        None => drop(table.insert("plane", Item::Value(plane.into()))),
    }
    Some(made)
}

/// The numbers of a list.
fn numbers(item: Option<&Item>) -> Option<Vec<f64>> {
    let list = item?.as_array()?.iter();
    list.map(|value| {
        value
            .as_float()
            .or_else(|| Some(value.as_integer()? as f64))
    })
    .collect()
}

fn place(radius: f64, degrees: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [radius * cos, radius * sin]
}

/// Radii and angles of points; the angles increase from the first point on.
fn polar(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut before = -180.0;
    let mut polar = |&[x, y]: &[f64; 2]| {
        let angle = y.atan2(x).to_degrees();
        before += (angle - before).rem_euclid(360.0);
        [x.hypot(y), before]
    };
    points.iter().map(&mut polar).collect()
}

fn rounded(value: f64) -> f64 {
    let scale = 10_f64.powi(DIGITS);
    // Adding zero removes the sign of a zero.
    (value * scale).round() / scale + 0.0
}

#[cfg(test)]
mod tests {
    use super::super::edit::{Edit, edited};
    use super::super::kind::mechanism;
    use super::super::kind::tests::designs;

    /// Points of the curve of a text, x and y.
    fn points(text: &str) -> Vec<[f64; 2]> {
        let design: toml::Table = text.parse().expect("TOML");
        let list = |name: &str| -> Option<Vec<f64>> {
            let list = design["pitch"].get(name)?.as_array()?.iter();
            Some(
                list.map(|v| {
                    v.as_float()
                        .or(v.as_integer().map(|i| i as f64))
                        .expect("a number")
                })
                .collect(),
            )
        };
        match (list("x"), list("y"), list("radius"), list("angle_deg")) {
            (Some(x), Some(y), None, None) => x.into_iter().zip(y).map(|(x, y)| [x, y]).collect(),
            (None, None, Some(r), Some(a)) => {
                let turned =
                    |(r, a): (f64, f64)| [r * a.to_radians().cos(), r * a.to_radians().sin()];
                r.into_iter().zip(a).map(turned).collect()
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn points_stay_where_they_are_in_the_other_plane_and_the_design_a_mechanism() {
        let mut tried = 0;
        for (name, text) in designs() {
            let design: toml::Table = text.parse().expect("TOML");
            let Some(pitch) = design
                .get("pitch")
                .filter(|pitch| pitch.get("plane").is_some())
            else {
                continue;
            };
            let (own, other) = match pitch["plane"].as_str() {
                Some("polar") => ("polar", "cartesian"),
                _ => ("cartesian", "polar"),
            };
            let there = edited(&text, &[Edit::word("pitch.plane", other)]).expect("edited");
            let back = edited(&there, &[Edit::word("pitch.plane", own)]).expect("edited");
            for moved in [&there, &back] {
                assert!(
                    mechanism(moved).is_ok(),
                    "{name}: {:?}\n{moved}",
                    mechanism(moved)
                );
                for (a, b) in points(&text).into_iter().zip(points(moved)) {
                    assert!(
                        (a[0] - b[0]).hypot(a[1] - b[1]) < 2e-6,
                        "{name}: {a:?} {b:?}"
                    );
                }
            }
            assert_ne!(there, text);
            tried += 1;
        }
        assert!(tried > 3, "{tried}");
    }

    #[test]
    fn comments_of_the_lists_stay_and_a_table_without_points_takes_the_word() {
        let text = "[pitch]\nkind = \"bspline\"\nradius = [\n    1,  # first\n    2,\n]\nangle_deg = [0, 90] # both\n";
        let moved = edited(text, &[Edit::word("pitch.plane", "cartesian")]).expect("edited");
        assert!(
            moved.contains("x = [\n    1.0,  # first\n    0.0,\n]"),
            "{moved}"
        );
        assert!(
            moved.contains("y = [0.0, 2.0] # both") && moved.contains("plane = \"cartesian\""),
            "{moved}"
        );
        let bare = edited(
            "[pitch]\nplane = \"polar\"\n",
            &[Edit::word("pitch.plane", "cartesian")],
        );
        assert_eq!(bare.expect("edited"), "[pitch]\nplane = \"cartesian\"\n");
    }
}
