use super::super::edit::{Edit, edited};
use super::super::kind::tests::designs;
use super::*;

const TYPES: [&str; 5] = ["RRR", "RRP", "RPR", "PRP", "RPP"];

fn retyped(text: &str, name: &str, word: &str) -> String {
    let key = format!("dyads.{name}.type");
    edited(text, &[Edit::word(&key, word)]).expect("edited")
}

/// The dyads of a design, with their types.
fn dyads(text: &str) -> Vec<(String, String)> {
    let table: toml::Table = text.parse().expect("TOML");
    let dyads = table.get("dyads").and_then(toml::Value::as_table);
    let dyads = dyads.into_iter().flatten();
    dyads
        .map(|(name, dyad)| (name.clone(), dyad["type"].as_str().expect("a word").into()))
        .collect()
}

#[test]
fn every_dyad_becomes_one_of_every_type_and_stays_a_mechanism() {
    let mut ways = 0;
    let mut wrong = Vec::new();
    for (design, text) in designs() {
        for (name, own) in dyads(&text) {
            for first in TYPES {
                let one = retyped(&text, &name, first);
                for then in TYPES {
                    let two = retyped(&one, &name, then);
                    let types = dyads(&two);
                    assert!(types.contains(&(name.clone(), then.to_owned())), "{two}");
                    ways += 1;
                    if let Err(error) = mechanism(&two) {
                        // Of two changes the second may leave no place at which all dyads close: that is told.
                        let told = error.to_string();
                        assert!(
                            first != own && told.contains("closes"),
                            "{design}: {name} {own} {first} {then}: {told}"
                        );
                        wrong.push(format!("{design}: {name} {own} {first} {then}: {told}"));
                    }
                }
            }
        }
    }
    assert!(ways > 200, "{ways}");
    assert!(
        wrong.len() * 25 < ways,
        "{} of {ways}:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
