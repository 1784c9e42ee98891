//! Laws whose samples are in a file next to the design.

use std::fs;
use std::path::{Path, PathBuf};

use super::{centrode, fed, text};

/// A measured law: driver angle, torque and ratio in three columns.
fn measured() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/laws/measured.csv")
}

/// A design with keys of its pitch curve.
fn design(keys: &str) -> String {
    format!(
        "family = \"gear-pair\"\n\n[pitch]\nkind = \"ratio\"\n{keys}\nmodule = 2\ntooth_count = 24\n\n[teeth]\nbacklash = 0.05\n"
    )
}

/// Rows of the measured law as numbers.
fn rows() -> Vec<Vec<f64>> {
    let text = fs::read_to_string(measured()).expect("there");
    let numbers = |line: &str| line.split(',').map(|word| word.parse().ok()).collect();
    text.lines().filter_map(numbers).collect()
}

/// Files that the export of a design writes, by name.
fn exported(folder: &Path, design: &str, name: &str) -> Vec<(String, Vec<u8>)> {
    let (file, to) = (folder.join(format!("{name}.toml")), folder.join(name));
    fs::write(&file, design).expect("written");
    let [file, to] = [file, to].map(|path| path.display().to_string());
    let done = centrode(&["export", &file, "--to", &to, "--format", "dxf,csv,json"]);
    assert_ne!(done.status.code(), Some(2), "{}", text(&done.stderr));
    let entries = fs::read_dir(&to).expect("a folder");
    let mut files: Vec<_> = entries
        .map(|entry| {
            let entry = entry.expect("an entry");
            let name = entry.file_name().into_string().expect("a name");
            (name, fs::read(entry.path()).expect("a file"))
        })
        .collect();
    files.sort();
    files
}

#[test]
fn a_file_is_the_same_law_as_its_samples_in_the_design() {
    let folder = tempfile::tempdir().expect("a place to write");
    let folder = folder.path();
    let mut csv = fs::read_to_string(measured()).expect("there");
    fs::write(folder.join("law.csv"), &csv).expect("written");
    let smooth = "smooth = { harmonics = 3 }";
    let of_file = design(&format!("file = \"law.csv\"\ncolumn = \"ratio\"\n{smooth}"));
    let found = exported(folder, &of_file, "of-file");
    assert!(found.len() > 4, "{}", found.len());

    let ratio: Vec<f64> = rows().iter().map(|row| row[2]).collect();
    let pasted = design(&format!("ratio = {ratio:?}\n{smooth}"));
    assert!(exported(folder, &pasted, "pasted") == found);
    // By the number of the column, in another folder, with the repeated end and with decimal commas.
    let path = folder.join("law.csv").display().to_string();
    let absolute = design(&format!("file = {path:?}\ncolumn = 3\n{smooth}"));
    assert!(exported(folder, &absolute, "absolute") == found);
    csv += &format!("360,12.0,{}\n", ratio[0]);
    fs::write(folder.join("law.csv"), &csv).expect("written");
    assert!(exported(folder, &of_file, "repeated") == found);
    let german = csv.replace(',', ";").replace('.', ",");
    fs::write(folder.join("law.csv"), german).expect("written");
    assert!(exported(folder, &of_file, "german") == found);
    // Without angles, the values show that the last one repeats the first.
    let mut alone: String = ratio.iter().map(|q| format!("{q}\n")).collect();
    alone += &format!("{}\n", ratio[0]);
    fs::write(folder.join("alone.csv"), alone).expect("written");
    let alone = design(&format!("file = \"alone.csv\"\n{smooth}"));
    assert!(exported(folder, &alone, "alone") == found);
}

#[test]
fn a_noisy_file_is_one_finding_and_its_remedy_removes_it() {
    let folder = tempfile::tempdir().expect("a place to write");
    let checked = |smooth: &str| {
        let file = folder.path().join("pair.toml");
        let path = measured().display().to_string();
        let keys = format!("file = {path:?}\ncolumn = \"ratio\"\n{smooth}");
        fs::write(&file, design(&keys)).expect("written");
        let done = centrode(&["check", &file.display().to_string(), "--json"]);
        let report: serde_json::Value = serde_json::from_slice(&done.stdout).expect("a report");
        report["findings"].as_array().expect("findings").clone()
    };
    let rules = |findings: &[serde_json::Value]| -> Vec<String> {
        let rules = findings
            .iter()
            .filter_map(|finding| finding["rule"].as_str());
        rules.map(str::to_owned).collect()
    };
    let noisy = checked("");
    assert_eq!(rules(&noisy), ["noisy-law", "scaled-mean"]);
    let remedy = noisy[0]["remedy"].as_str().expect("a remedy");
    let smooth = remedy.split(" for ").next().expect("a key");
    assert_eq!(rules(&checked(smooth)), ["scaled-mean"], "{smooth}");
}

#[test]
fn a_file_that_cannot_be_read_is_named_with_key_and_lines() {
    let folder = tempfile::tempdir().expect("a place to write");
    let folder = folder.path();
    let path = folder.join("pair.toml").display().to_string();
    let refused = |csv: &str, keys: &str| {
        fs::write(folder.join("law.csv"), csv).expect("written");
        fs::write(&path, design(keys)).expect("written");
        let done = centrode(&["check", &path]);
        assert_eq!(done.status.code(), Some(2), "{}", text(&done.stdout));
        text(&done.stderr)
    };
    let even = |count: u32| -> String {
        let step = 360.0 / f64::from(count);
        let row = |k: u32| format!("{},{}\n", step * f64::from(k), 1.0 + 0.1 * f64::from(k % 2));
        (0..count).map(row).collect()
    };
    let file = "file = \"law.csv\"";
    for (csv, keys, words) in [
        (
            "1\n",
            "file = \"lost.csv\"",
            &["pitch.file", "lost.csv", "pair.toml:5:1"][..],
        ),
        ("", file, &["pitch.file", "law.csv has no samples"]),
        (
            "phi,q\n0,1\n10,one\n",
            file,
            &["law.csv, line 3: \"one\" in column 2", ":5:1"],
        ),
        (
            "phi,q\n0,1\n10\n",
            file,
            &["law.csv, line 3: \"\" in column 2"],
        ),
        (
            &even(12),
            "column = 3\nfile = \"law.csv\"",
            &["pitch.column", "2 columns", ":6:1"],
        ),
        (
            "phi,q\n0,1\n",
            "file = \"law.csv\"\ncolumn = \"r\"",
            &["no column \"r\"", "phi, q"],
        ),
        (
            &even(12),
            "file = \"law.csv\"\nratio = [1, 1]",
            &["together with ratio"],
        ),
        ("1,1\n2,1\n3,1\n4,1\n", file, &["column 1", "from 1 to 4"]),
        // A wrong column: angles are no ratios.
        (
            &even(12),
            "file = \"law.csv\"\ncolumn = 1",
            &["pitch.ratio"],
        ),
        (
            "1.51\n1.6\n1.7\n1.6\n1.5\n1.4\n1.457\n",
            file,
            &["mean ratio 1:1", "at most 5 %"],
        ),
    ] {
        let message = refused(csv, keys);
        for word in words {
            assert!(message.contains(word), "{word}: {message}");
        }
    }
    let done = fed(&["check", "-"], design(file).as_bytes());
    let message = text(&done.stderr);
    assert!(message.contains("law.csv is named"), "{message}");
    assert!(message.contains("without its folder"), "{message}");
    let message = refused("1\n", "column = 2\nratio = [1, 1, 1, 1, 1, 1]");
    assert!(message.contains("without file"), "{message}");
}
