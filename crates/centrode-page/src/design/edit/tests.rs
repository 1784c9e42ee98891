use super::super::field::tables;
use super::*;
use centrode_families::FAMILIES;
use centrode_spec::DesignError;

const TEXT: &str = "# head\nfamily = \"gear-pair\" # a pair\n\n[pitch] # the curve\nkind = \"bspline\"\n\
                    radius = [1, 2, # two\n  3]\nmodule = 2.250 # mm\n# tail\n[driver]\nkeyway = { width = 4, depth = 1.8 }\n";

fn edit(key: &str, value: impl Into<Json>) -> Edit {
    Edit {
        key: key.into(),
        value: value.into(),
    }
}

fn after(edits: &[Edit]) -> String {
    edited(TEXT, edits).expect("edited")
}

#[test]
fn only_the_value_changes() {
    assert_eq!(after(&[]), TEXT);
    assert_eq!(
        after(&[edit("pitch.module", 3)]),
        TEXT.replace("2.250", "3")
    );
    assert_eq!(
        after(&[edit("pitch.radius[1]", 2.5)]),
        TEXT.replace("1, 2,", "1, 2.5,")
    );
    assert_eq!(
        after(&[edit("pitch.radius", vec![1.0, 7.5, 3.0])]),
        TEXT.replace("1, 2,", "1.0, 7.5,").replace("  3]", "  3.0]")
    );
    assert_eq!(
        after(&[edit("driver.keyway.width", 5)]),
        TEXT.replace("width = 4", "width = 5")
    );
}

#[test]
fn new_keys_go_into_their_table() {
    let text = after(&[
        edit("pitch.tooth_count", 23),
        edit("teeth.backlash", 0.1),
        edit("title", "A \"pair\""),
    ]);
    let read: toml::Table = text.parse().expect("toml");
    assert_eq!(read["pitch"]["tooth_count"].as_integer(), Some(23));
    assert_eq!(read["teeth"]["backlash"].as_float(), Some(0.1));
    assert_eq!(read["title"].as_str(), Some("A \"pair\""));
    for kept in [
        "# head",
        "# a pair",
        "# the curve",
        "# two",
        "# mm",
        "# tail",
    ] {
        assert!(text.contains(kept), "{kept} in {text}");
    }
}

#[test]
fn a_new_table_has_what_it_cannot_be_without() {
    for family in FAMILIES.words() {
        let text = FAMILIES.template(family).expect("a template");
        let fields = tables(text).into_iter().flat_map(|table| table.fields);
        for field in fields {
            let (key, value) = match &field.value {
                Json::Number(_) => (field.key.clone(), field.value.clone()),
                Json::Array(list) if !list.is_empty() => {
                    (format!("{}[0]", field.key), list[0].clone())
                }
                _ => continue,
            };
            let edits = [edit(&key, value)];
            let changed = edited(text, &edits).expect("edited");
            let read = FAMILIES.read(changed.as_bytes());
            // Other keys may not go with the new table, which is for who adds it to settle.
            let (table, _) = key.rsplit_once('.').unwrap_or_default();
            let own = format!("{table}.");
            let whole = |error: &DesignError| !error.key.starts_with(&own);
            assert!(
                read.is_ok() || read.as_ref().is_err_and(whole),
                "{} of {family}: {read:?}",
                field.key,
            );
        }
    }
    let changed = after(&[edit("tool.pressure_angle_deg", 25)]);
    let read: toml::Table = changed.parse().expect("toml");
    assert_eq!(read["tool"]["kind"].as_str(), Some("rack"));
    assert_eq!(read["tool"]["pressure_angle_deg"].as_integer(), Some(25));
    assert_eq!(read["tool"].as_table().map(toml::Table::len), Some(2));
}

#[test]
fn null_takes_a_key_out() {
    assert!(!after(&[edit("pitch.module", Json::Null)]).contains("2.250"));
    assert_eq!(after(&[edit("teeth.backlash", Json::Null)]), TEXT);
}

#[test]
fn a_new_kind_takes_out_what_does_not_belong_to_it() {
    let text = after(&[edit("pitch.kind", "circle")]);
    let read: toml::Table = text.parse().expect("toml");
    let keys: Vec<&String> = read["pitch"].as_table().expect("a table").keys().collect();
    assert!(!keys.iter().any(|k| *k == "degree"), "{keys:?}");
    assert!(keys.iter().any(|k| *k == "module"), "{keys:?}");
}

#[test]
fn paths_that_lead_nowhere_are_refused() {
    for key in [
        "",
        ".",
        "a..b",
        "pitch.radius[9]",
        "pitch.radius[x]",
        "pitch.radius[-1]",
        "family.x",
        "a b",
        "x]",
    ] {
        assert!(edited(TEXT, &[edit(key, 1)]).is_err(), "{key}");
    }
    let table = Edit {
        key: "pitch.module".into(),
        value: serde_json::json!({"a": 1}),
    };
    assert!(matches!(
        edited(TEXT, &[table]),
        Err(EditError::Value { .. })
    ));
    assert!(matches!(edited("= x", &[]), Err(EditError::Syntax(_))));
}

#[test]
fn a_list_that_grows_or_shrinks_keeps_its_lines_and_comments() {
    let text = "[pitch]\nradius = [\n    1,  # first\n    2.5,\n]\nangle_deg = [ 1, 2 ] # flat\n";
    let list = |key: &str, values: &[f64]| Edit::list(key, values);
    let grown = edited(
        text,
        &[
            list("pitch.radius", &[1.0, 2.0, 3.0]),
            list("pitch.angle_deg", &[1.0, 2.0, 3.0]),
        ],
    );
    let lines = "[pitch]\nradius = [\n    1.0,  # first\n    2.0,\n    3.0,\n]\nangle_deg = [ 1.0, 2.0 , 3.0] # flat\n";
    assert_eq!(grown.expect("edited"), lines);
    let shrunk = edited(lines, &[list("pitch.radius", &[4.0])]);
    let shrunk = shrunk.expect("edited");
    assert!(
        shrunk.starts_with("[pitch]\nradius = [\n    4.0,"),
        "{shrunk}"
    );
    assert!(shrunk.ends_with("] # flat\n"), "{shrunk}");
    shrunk.parse::<toml::Table>().expect("toml");
}

#[test]
fn a_table_that_is_added_gives_a_mechanism_or_is_refused_with_the_reason() {
    let (mut added, mut refused) = (0, 0);
    for family in FAMILIES.words() {
        let text = FAMILIES.template(family).expect("a template");
        let comments = |text: &str| text.lines().filter(|line| line.contains('#')).count();
        for table in tables(text).into_iter().filter(|table| table.addable) {
            let key = &table.key;
            match with_table(text, key) {
                Ok(made) => {
                    let now = tables(&made).into_iter().find(|own| own.key == *key);
                    assert!(now.is_some_and(|own| !own.absent), "{key}\n{made}");
                    assert_eq!(comments(&made), comments(text), "{key}");
                    added += 1;
                }
                // A law does not fit every body, and a keyway needs a bore.
                Err(reason) => {
                    assert!(
                        key.starts_with("bodies.")
                            || key == "frame.circle"
                            || reason.contains("bore"),
                        "{key}: {reason}"
                    );
                    refused += 1;
                }
            }
        }
    }
    assert!(added > 10 && refused > 0, "{added} {refused}");
    let leg = FAMILIES.template("machine").expect("a template");
    let still = with_table(leg, "bodies.crank.law.cam").expect_err("no segments are known");
    assert!(still.contains("segments"), "{still}");
    let pair = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\neccentricity = 0.2\nmodule = 2\ntooth_count = 23\n[driver]\nbore = 12\n";
    let keyed = with_table(pair, "driver.keyway").expect("a keyway");
    assert!(
        keyed.contains("keyway = { width = 4, depth = 1.8 }"),
        "{keyed}"
    );
}
