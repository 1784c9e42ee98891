//! Words of sources, docs and help texts. Summary lines of doc comments begin with a noun or a verb: an index shows them alone.

mod prose;

use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// First words that say nothing without the item, or the neighbour, they refer to.
const VAGUE: [&str; 3] = ["What ", "The same", "As "];

/// Files below a folder with an ending, sorted.
fn files(folder: &Path, ending: &str, out: &mut Vec<PathBuf>) -> io::Result<()> {
    let mut entries = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<io::Result<Vec<_>>>()?;
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, ending, out)?;
        } else if path.extension().is_some_and(|found| found == ending) {
            out.push(path);
        }
    }
    Ok(())
}

/// Line number and text of the first line of each doc comment.
fn summaries(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let doc = |line: &'_ str| line.starts_with("///") || line.starts_with("//!");
    let mut inside = false;
    text.lines().enumerate().filter_map(move |(index, line)| {
        let line = line.trim_start();
        let first = doc(line) && !inside;
        inside = doc(line);
        first.then(|| (index + 1, line[3..].trim_start()))
    })
}

/// Name and text of files, the name from the repository on.
fn read(paths: Vec<PathBuf>, root: &Path) -> io::Result<Vec<(String, String)>> {
    let one = |path: PathBuf| {
        let name = path.strip_prefix(root).unwrap_or(&path).display();
        let name = name.to_string().replace('\\', "/");
        Ok((name, fs::read_to_string(&path)?))
    };
    paths.into_iter().map(one).collect()
}

/// Name and text of every Rust source of the crates and of the Python module.
fn sources() -> io::Result<Vec<(String, String)>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut paths = Vec::new();
    for folder in ["crates", "python/src"] {
        files(&root.join(folder), "rs", &mut paths)?;
    }
    assert!(paths.len() > 100, "only {} files found", paths.len());
    read(paths, &root)
}

#[test]
fn summary_lines_stand_alone() -> io::Result<()> {
    let mut found = Vec::new();
    for (name, text) in sources()? {
        for (line, summary) in summaries(&text) {
            if VAGUE.iter().any(|word| summary.starts_with(word)) {
                found.push(format!("{name}:{line}: {summary}"));
            }
        }
    }
    assert!(
        found.is_empty(),
        "begin with a noun or a verb:\n{}",
        found.join("\n")
    );
    Ok(())
}

/// Words that were replaced by the field's own.
const GONE: [&str; 8] = [
    "by chance",
    "upright box",
    "looked over",
    "incomplete gear",
    "incompletepair",
    "contact_ratio_min",
    "contact_ratio_max",
    "overlap_max",
];

#[test]
fn replaced_words_stay_gone() -> io::Result<()> {
    let mut found = Vec::new();
    for (name, text) in sources()? {
        for (index, line) in text.lines().enumerate() {
            let line = line.to_lowercase();
            let gone = GONE.iter().filter(|word| line.contains(**word));
            found.extend(gone.map(|word| format!("{name}:{}: {word}", index + 1)));
        }
    }
    assert!(
        found.is_empty(),
        "say it in the field's words:\n{}",
        found.join("\n")
    );
    Ok(())
}

/// Files that name the old keys.
const OLD_KEYS: [&str; 2] = [
    "crates/centrode-spec/src/fault.rs",
    "crates/centrode-machines/tests/design_file.rs",
];

#[test]
fn extremes_are_called_minimum_and_maximum() -> io::Result<()> {
    let mut found = Vec::new();
    for (name, text) in sources()? {
        if OLD_KEYS.contains(&&*name) {
            continue;
        }
        let words: Vec<&str> = text
            .split(|c: char| !c.is_alphanumeric() && c != '_')
            .filter(|word| !word.is_empty())
            .collect();
        for around in words.windows(3) {
            let [before, word, after] = around else {
                continue;
            };
            let is_usual =
                before.eq_ignore_ascii_case("at") || ["squares", "common", "known"].contains(after);
            if ["least", "greatest"].contains(&&*word.to_lowercase()) && !is_usual {
                found.push(format!("{name}: {}", around.join(" ")));
            }
        }
    }
    assert!(
        found.is_empty(),
        "say minimum or maximum:\n{}",
        found.join("\n")
    );
    Ok(())
}

/// Names of the rules in the findings of a source.
fn rules(text: &str) -> impl Iterator<Item = &str> {
    let found = text.split("Finding::new(").skip(1);
    found.filter_map(|rest| rest.trim_start().strip_prefix('"')?.split('"').next())
}

#[test]
fn every_rule_of_a_finding_is_in_the_table_of_severities() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let table = fs::read_to_string(root.join("docs/findings.md"))?;
    let sources = sources()?;
    let own = sources.iter().filter(|(name, _)| {
        name.starts_with("crates/centrode-analysis/src") && !name.contains("test")
    });
    let rules: std::collections::BTreeSet<&str> = own.flat_map(|(_, text)| rules(text)).collect();
    assert!(rules.len() > 40, "only {rules:?}");
    let missing: Vec<_> = rules
        .into_iter()
        .filter(|rule| !table.contains(&format!("`{rule}`")))
        .collect();
    assert!(missing.is_empty(), "not in docs/findings.md: {missing:?}");
    Ok(())
}
