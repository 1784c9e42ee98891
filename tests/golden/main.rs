//! Goldens: every design of `tests/designs/`, its figures, findings and files, against `tests/golden/`.
//!
//! `UPDATE_GOLDEN=1 cargo test -p centrode-tests --test golden` writes them anew; read the diff.

mod entities;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, iter, thread};

use centrode::FAMILIES;
use centrode::family::Mechanism;
use centrode_export::Options;
use centrode_formats::{Bundle, Format};
use centrode_geometry::Tolerance;
use serde_json::{Value, json};

/// Maximum difference of a figure, of its size or of 1 mm or 1 rad, whichever is more.
const DIFFERENCE: f64 = 1e-9;

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Names of the files with an extension, without it.
fn stems(folder: &Path, extension: &str) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder is checked in");
    let paths = entries.map(|entry| entry.expect("entry").path());
    let mut names: Vec<String> = paths
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .map(|path| {
            path.file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

/// What a golden holds: figures, findings without their words, files and what is in them.
fn outcome(name: &str) -> Value {
    let path = folder("designs").join(format!("{name}.toml"));
    let design = FAMILIES
        .read(&fs::read(path).expect("readable"))
        .expect("a design");
    let mechanism = design.mechanism().expect("a mechanism");
    let report = mechanism.check();
    let findings: Vec<Value> = report
        .findings
        .iter()
        .map(|f| json!({"rule": f.rule, "severity": f.severity, "part": f.place.part, "teeth": f.place.teeth}))
        .collect();
    for key in report.values.keys() {
        let titled = report.groups.iter().flat_map(|group| group.rows);
        let places = titled.filter(|row| row.keys.contains(key)).count();
        assert_eq!(places, 1, "{name}: titles of the figure {key}");
    }
    let figures = json!(report);
    let mut outcome = json!({"values": figures["values"], "findings": findings, "files": written(mechanism.as_ref())});
    for (i, goal) in report.goals.iter().enumerate() {
        let value = &figures["goals"][i]["value"];
        outcome["goals"][&*goal.name] = json!({"value": value, "met": goal.met()});
    }
    for (i, table) in report.tables.iter().enumerate() {
        outcome["tables"][table.name] = figures["tables"][i]["rows"].clone();
    }
    outcome
}

/// Outcomes of designs, in their order, on every core.
fn outcomes(designs: &[String]) -> Vec<Value> {
    let next = AtomicUsize::new(0);
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let mut outcomes: Vec<(usize, Value)> = thread::scope(|scope| {
        let worker = || {
            let numbers = iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
            let designs = numbers.map_while(|number| Some((number, designs.get(number)?)));
            designs
                .map(|(number, name)| (number, outcome(name)))
                .collect::<Vec<_>>()
        };
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(worker)).collect();
        workers
            .into_iter()
            .flat_map(|worker| worker.join().expect("an outcome"))
            .collect()
    });
    outcomes.sort_by_key(|(number, _)| *number);
    outcomes.into_iter().map(|(_, outcome)| outcome).collect()
}

/// The files of a mechanism and what is in them.
fn written(mechanism: &dyn Mechanism) -> BTreeMap<String, Value> {
    let family = mechanism.design().family().word;
    // A shaft at the gears' tolerance would be millions of digits.
    let tolerance = match family {
        "spiral-shaft" | "moving-box" => 2e-2,
        _ => 1e-3,
    };
    let options = Options::new(Tolerance::new(tolerance).expect("positive"));
    let bundle = match mechanism.files(&Format::ALL, &options) {
        Ok(bundle) => bundle,
        Err(error) => return BTreeMap::from([("refused".to_owned(), json!(error.to_string()))]),
    };
    // Of a pair, how many bodies there are to touch with is enough.
    named_files_are_there(mechanism, &bundle);
    let (bodies, others): (Vec<_>, Vec<_>) = bundle
        .files()
        .partition(|(name, _)| family == "gear-pair" && name.starts_with("collision/"));
    let mut counts: BTreeMap<String, Value> = others
        .into_iter()
        .map(|(name, bytes)| (name.to_owned(), json!(entities::count(name, bytes))))
        .collect();
    if family == "gear-pair" {
        counts.insert("collision".to_owned(), json!(bodies.len()));
    }
    counts
}

/// Checks that the parts list names no files that are not written.
fn named_files_are_there(mechanism: &dyn Mechanism, bundle: &Bundle) {
    let machine = mechanism.machine().expect("written above");
    let solids = [".step", ".stl"];
    for part in machine.parts.iter().filter(|part| !part.file.is_empty()) {
        let made = |end: &str| {
            bundle
                .files()
                .any(|(name, _)| name == format!("{}{end}", part.file))
        };
        let (drawn, solid) = (made(".dxf"), solids.iter().any(|end| made(end)));
        assert!(
            drawn && solid,
            "{}: {}",
            mechanism.design().name(),
            part.file
        );
    }
    assert!(machine.parts.iter().any(|part| !part.file.is_empty()));
}

/// A golden as text: one line per figure, finding, goal, file and row of a table.
fn lines(outcome: &Value) -> String {
    let parts = outcome.as_object().expect("parts of an outcome");
    let parts = parts.iter().map(|(name, part)| {
        let depth = if name == "tables" { 2 } else { 1 };
        format!("  {}: {}", json!(name), nested(part, depth, "  "))
    });
    format!("{{\n{}\n}}\n", parts.collect::<Vec<_>>().join(",\n"))
}

/// JSON with `depth` levels on lines of their own, and what is deeper on one line.
fn nested(value: &Value, depth: usize, indent: &str) -> String {
    let inner = format!("{indent}  ");
    let (open, close, items): (_, _, Vec<String>) = match value {
        Value::Object(fields) if depth > 0 && !fields.is_empty() => {
            let field =
                |(key, value)| format!("{}: {}", json!(key), nested(value, depth - 1, &inner));
            ('{', '}', fields.iter().map(field).collect())
        }
        Value::Array(items) if depth > 0 && !items.is_empty() => {
            let item = |value| nested(value, depth - 1, &inner);
            ('[', ']', items.iter().map(item).collect())
        }
        _ => return value.to_string(),
    };
    let separator = format!(",\n{inner}");
    format!("{open}\n{inner}{}\n{indent}{close}", items.join(&separator))
}

/// Every place where two values differ, numbers within [`DIFFERENCE`] aside.
fn differences(place: &str, golden: &Value, now: &Value, found: &mut Vec<String>) {
    match (golden, now) {
        (Value::Number(a), Value::Number(b)) => {
            let [a, b] = [a, b].map(|n| n.as_f64().expect("a float"));
            if (a - b).abs() > DIFFERENCE * a.abs().max(1.0) {
                found.push(format!("{place}: {a:e} was golden, now {b:e}"));
            }
        }
        (Value::Object(a), Value::Object(b)) => {
            for key in a.keys().chain(b.keys().filter(|key| !a.contains_key(*key))) {
                let side = |object: &serde_json::Map<String, Value>| {
                    object.get(key).cloned().unwrap_or(json!("absent"))
                };
                differences(&format!("{place}.{key}"), &side(a), &side(b), found);
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (index, (golden, now)) in a.iter().zip(b).enumerate() {
                differences(&format!("{place}[{index}]"), golden, now, found);
            }
        }
        _ if golden == now => {}
        _ => found.push(format!("{place}: {golden} was golden, now {now}")),
    }
}

#[test]
fn every_design_is_as_it_was() {
    let goldens = folder("golden");
    let update = std::env::var_os("UPDATE_GOLDEN").is_some();
    let designs = stems(&folder("designs"), "toml");
    assert!(!designs.is_empty(), "no design in tests/designs");
    let mut found = Vec::new();
    for (name, now) in designs.iter().zip(outcomes(&designs)) {
        let file = goldens.join(format!("{name}.json"));
        if update {
            fs::write(&file, lines(&now)).expect("written");
            continue;
        }
        match fs::read(&file) {
            Ok(bytes) => {
                let golden = serde_json::from_slice(&bytes).expect("a golden is JSON");
                differences(name, &golden, &now, &mut found);
            }
            Err(_) => found.push(format!("{name}: no golden")),
        }
    }
    for name in stems(&goldens, "json") {
        if !designs.contains(&name) {
            found.push(format!("{name}: a golden without a design"));
        }
    }
    assert!(
        found.is_empty(),
        "{}\nRight so? UPDATE_GOLDEN=1 cargo test -p centrode-tests --test golden",
        found.join("\n")
    );
}

#[test]
fn a_difference_is_found_and_rounding_is_not() {
    let golden = json!({"values": {"a": 50.0, "b": null}, "files": {"x.dxf": {"LINE": 2}}});
    let mut found = Vec::new();
    let close = json!({"values": {"a": 50.000_000_01, "b": null}, "files": {"x.dxf": {"LINE": 2}}});
    differences("pair", &golden, &close, &mut found);
    assert!(found.is_empty(), "{found:?}");
    let other =
        json!({"values": {"a": 50.000_001, "b": 1.0}, "files": {"x.dxf": {"LINE": 3}, "y": {}}});
    differences("pair", &golden, &other, &mut found);
    assert_eq!(found.len(), 4, "{found:?}");
    let mut found = Vec::new();
    let rows = |last: f64| json!({"table": [["crank", [1.5, last]]]});
    differences("pair", &rows(0.1), &rows(0.1_f64.next_up()), &mut found);
    assert!(found.is_empty(), "{found:?}");
    differences("pair", &rows(0.1), &rows(0.100_001), &mut found);
    differences("pair", &rows(0.1), &json!({"table": []}), &mut found);
    assert_eq!(found.len(), 2, "{found:?}");
}
