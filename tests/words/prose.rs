//! Docs, help texts and stubs: short sentences, in the words of the field.

use super::{files, read};
use std::{io, path::Path};

/// Words of a sentence at most: longer ones become two, a list or a table.
const MOST: usize = 30;

/// Words that were replaced by the field's own.
const RETIRED: [&str; 33] = [
    "told",
    "tell",
    "tells",
    "ask",
    "asks",
    "asked",
    "want",
    "wants",
    "wanted",
    "stands",
    "stood",
    "sought",
    "beside",
    "mend",
    "shall",
    "alike",
    "kept",
    "place",
    "places",
    "way",
    "ways",
    "least",
    "greatest",
    "so far",
    "as such",
    "of which",
    "left out",
    "looked at",
    "looked for",
    "hangs on",
    "in place of",
    "in the place of",
    "none where",
];

/// Phrases in which they are right, and names in the stubs.
const IDIOMS: [&str; 3] = ["at least", "least squares", "def places"];

/// Stretch of a page that is read on its own: a paragraph, an item of a list, a cell of a table.
struct Block {
    /// Line at which it begins.
    line: usize,
    /// Its words, without code and addresses.
    words: String,
}

/// Pages of the docs, and those at the root of the repository.
fn pages(root: &Path) -> io::Result<Vec<(String, String)>> {
    let mut paths = Vec::new();
    files(&root.join("docs"), "md", &mut paths)?;
    for name in ["README", "ARCHITECTURE", "CONTRIBUTING", "CHANGELOG"] {
        paths.push(root.join(name).with_extension("md"));
    }
    assert!(paths.len() > 30, "only {} pages found", paths.len());
    read(paths, root)
}

/// Words of the command's help, and stubs of the Python package, line by line.
fn help(root: &Path) -> io::Result<Vec<(String, String)>> {
    let mut paths = vec![root.join("crates/centrode/src/cli/args.rs")];
    files(&root.join("crates/centrode/src/cli/args"), "rs", &mut paths)?;
    files(&root.join("python/centrode"), "pyi", &mut paths)?;
    let mut found = read(paths, root)?;
    for (name, text) in &mut found {
        if name.ends_with(".rs") {
            let is_shown =
                |line: &&str| line.trim_start().starts_with("///") || line.contains("_help");
            *text = text.lines().filter(is_shown).collect::<Vec<_>>().join("\n");
        }
    }
    Ok(found)
}

/// Text with each span between two equal marks replaced by one word.
fn without(text: &str, mark: char) -> String {
    let (mut out, mut rest) = (String::new(), text);
    while let Some(start) = rest.find(mark) {
        let opened = &rest[start..];
        let width = opened.len() - opened.trim_start_matches(mark).len();
        let Some(end) = opened[width..].find(&opened[..width]) else {
            break;
        };
        out.push_str(&rest[..start]);
        out.push_str("CODE");
        rest = &opened[end + 2 * width..];
    }
    out + rest
}

/// Text without code, formulas and addresses of links.
fn plain(text: &str) -> String {
    let text = without(&without(text, '`'), '$');
    let mut parts = text.split("](");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |out, part| {
        out + "] " + part.split_once(')').map_or("", |(_, rest)| rest)
    })
}

/// Whether a line begins an item of a list.
fn is_item(line: &str) -> bool {
    let number = line.trim_start_matches(|c: char| c.is_ascii_digit());
    line.starts_with("- ") || number.len() < line.len() && number.starts_with(". ")
}

/// Blocks of a page; headings, code, formulas and pictures are none.
fn blocks(page: &str) -> Vec<Block> {
    let (mut found, mut fence, mut is_open): (Vec<Block>, Option<&str>, bool) =
        (Vec::new(), None, false);
    for (index, whole) in page.lines().enumerate() {
        let line = whole.trim();
        let formula = line.starts_with("$$");
        if let Some(mark) = fence {
            if line.starts_with(mark) || mark == "$$" && line.ends_with(mark) {
                fence = None;
            }
            continue;
        }
        let code = whole.starts_with("    ") && !is_open;
        if line.starts_with("```") || formula {
            let is_closed = formula && line.len() > 2 && line.ends_with("$$");
            fence = (!is_closed).then_some(if formula { "$$" } else { "```" });
            is_open = false;
        } else if line.is_empty()
            || code
            || ["#", "<!--", "!["]
                .iter()
                .any(|mark| line.starts_with(mark))
        {
            is_open = false;
        } else if line.starts_with('|') {
            let cells = line.replace("\\|", " ");
            let block = |cell: &str| Block {
                line: index + 1,
                words: cell.to_owned(),
            };
            found.extend(cells.split('|').map(block));
            is_open = false;
        } else if let (true, false, Some(last)) = (is_open, is_item(line), found.last_mut()) {
            last.words += " ";
            last.words += line;
        } else {
            found.push(Block {
                line: index + 1,
                words: line.to_owned(),
            });
            is_open = true;
        }
    }
    for block in &mut found {
        block.words = plain(&block.words);
    }
    found
}

/// Retired words in a text without code.
fn retired(text: &str) -> impl Iterator<Item = &'static str> {
    let words: Vec<String> = text
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
        .map(str::to_lowercase)
        .collect();
    let mut words = format!(" {} ", words.join(" "));
    for idiom in IDIOMS {
        words = words.replace(&format!(" {idiom} "), " ");
    }
    let is_in = move |word: &&str| words.contains(&format!(" {word} "));
    RETIRED.into_iter().filter(is_in)
}

/// Number of words of each sentence of a block, with its first words.
fn sentences(words: &str) -> Vec<(usize, String)> {
    let mut found = vec![(0, String::new())];
    for word in words.split_whitespace() {
        if let Some((count, start)) = found.last_mut()
            && word.contains(char::is_alphanumeric)
        {
            *count += 1;
            if *count < 8 {
                *start += word;
                *start += " ";
            }
        }
        if word
            .trim_end_matches(['"', ')', '*', ']'])
            .ends_with(['.', '!', '?'])
        {
            found.push((0, String::new()));
        }
    }
    found
}

#[test]
fn retired_words_stay_out_of_docs_and_help() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for (name, page) in pages(&root)? {
        for block in blocks(&page) {
            found
                .extend(retired(&block.words).map(|word| format!("{name}:{}: {word}", block.line)));
        }
    }
    for (name, text) in help(&root)? {
        for line in text.lines() {
            found.extend(retired(&plain(line)).map(|word| format!("{name}: {word}: {line}")));
        }
    }
    assert!(
        found.is_empty(),
        "say it in the field's words:\n{}",
        found.join("\n")
    );
    Ok(())
}

#[test]
fn sentences_of_the_docs_have_at_most_thirty_words() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for (name, page) in pages(&root)? {
        for block in blocks(&page) {
            for (count, start) in sentences(&block.words) {
                if count > MOST {
                    found.push(format!("{name}:{}: {count} words: {start}...", block.line));
                }
            }
        }
    }
    assert!(found.is_empty(), "cut in two:\n{}", found.join("\n"));
    Ok(())
}

#[test]
fn a_long_sentence_and_a_retired_word_are_found() {
    let long = "word ".repeat(MOST + 1);
    let page =
        format!("# {long}\n\n```\n{long}\n```\n\n- {long}\n  goes on. `told` [short](asks).\n");
    let found = blocks(&page);
    assert_eq!(found.len(), 1);
    let counts: Vec<usize> = sentences(&found[0].words).iter().map(|one| one.0).collect();
    assert_eq!(counts, [MOST + 3, 2, 0]);
    assert_eq!(retired(&found[0].words).count(), 0);
    assert_eq!(
        retired("It stands at least so far.").collect::<Vec<_>>(),
        ["stands", "so far"]
    );
}
