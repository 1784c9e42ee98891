//! `centrode optimise` and `centrode response`.

use std::fs;

use super::{centrode, shipped, text};

/// A design that misses an angle by a tilt; only the carrier's start and the working points may mend it.
fn tilted() -> String {
    let held: Vec<String> = (1..=12)
        .map(|i| format!("\"r{i}\", \"theta{i}\""))
        .collect();
    let design = fs::read_to_string(shipped("three-arm-all-goals.toml")).expect("shipped");
    let line = design
        .lines()
        .find(|line| line.starts_with("carrier_start_deg"))
        .expect("there");
    let tilted = design.replace(line, "carrier_start_deg = 101 # tilted");
    format!("{tilted}\n[optimise]\nhold = [{}]\n", held.join(", "))
}

#[test]
fn a_better_design_is_written_with_its_comments_and_its_search() {
    let folder = tempfile::tempdir().expect("a place to write");
    let (start, better) = (
        folder.path().join("a.toml"),
        folder.path().join("better.toml"),
    );
    fs::write(&start, tilted()).expect("written");
    let (from, to) = (start.display().to_string(), better.display().to_string());
    let run = ["optimise", &from, "--evaluations", "300", "-o", &to];
    let found = centrode(&run);
    let told = text(&found.stdout);
    assert_eq!(
        found.status.code(),
        Some(0),
        "{told}{}",
        text(&found.stderr)
    );
    for line in ["carrier_start 101 ->", "every goal is reached"] {
        assert!(told.contains(line), "{line} in {told}");
    }
    let written = fs::read_to_string(&better).expect("written");
    assert!(written.contains("# tilted") && !written.contains("carrier_start_deg = 101 "));
    let check = centrode(&["check", &to]);
    assert!(
        !text(&check.stdout).contains("missed by"),
        "{}",
        text(&check.stdout)
    );
    assert!(folder.path().join("better.search.json").exists());
    // The same again is the same file.
    centrode(&run);
    assert_eq!(fs::read_to_string(&better).expect("written"), written);
}

#[test]
fn a_stored_search_goes_on_as_if_never_stopped() {
    let folder = tempfile::tempdir().expect("a place to write");
    let file = |name: &str| folder.path().join(name).display().to_string();
    let published = shipped("three-arm-2021.toml");
    let search = |to: &str, evaluations: &str, more: &[&str]| {
        let mut words = vec![
            "optimise",
            &published,
            "--method",
            "de",
            "--population",
            "20",
        ];
        words.extend(["--evaluations", evaluations, "-o", to]);
        words.extend(more);
        let run = centrode(&words);
        // Some goals are still missed.
        assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
        fs::read_to_string(to).expect("written")
    };
    let whole = search(&file("whole.toml"), "400", &[]);
    search(&file("part.toml"), "200", &[]);
    let part = search(&file("part.toml"), "400", &["--resume"]);
    assert_eq!(whole, part);
    let other = file("other.toml");
    fs::write(&other, tilted()).expect("written");
    let refused = centrode(&["optimise", &other, "--resume", "-o", &file("part.toml")]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("search of another design"));
    let pair = centrode(&[
        "optimise",
        &shipped("circular-pair.toml"),
        "-o",
        &file("p.toml"),
    ]);
    assert_eq!(pair.status.code(), Some(2));
    assert!(
        text(&pair.stderr).contains("no search"),
        "{}",
        text(&pair.stderr)
    );
}

#[test]
fn a_response_is_told_as_table_and_written_as_csv() {
    let folder = tempfile::tempdir().expect("a place to write");
    let csv = folder.path().join("r1.csv");
    let to = csv.display().to_string();
    let arms = shipped("three-arm-2021.toml");
    let asked = [
        "response",
        &arms,
        "--parameter",
        "r1",
        "--from",
        "15",
        "--to",
        "27",
    ];
    let mut words = asked.to_vec();
    words.extend([
        "--count",
        "3",
        "--of",
        "trajectory-height,picking_speed",
        "--csv",
        &to,
    ]);
    let told = centrode(&words);
    assert_eq!(told.status.code(), Some(0), "{}", text(&told.stderr));
    let table = text(&told.stdout);
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 4, "{table}");
    assert!(
        lines[0].contains("pitch.radius[0]") && lines[2].contains("370.8206"),
        "{table}"
    );
    let written = fs::read_to_string(&csv).expect("written");
    assert!(
        written.starts_with("pitch.radius[0],arm-clearance,pick-angle,"),
        "{written}"
    );
    assert_eq!(written.lines().count(), 4);
    let mut unknown = asked.to_vec();
    unknown[3] = "arm.tip_distanc";
    let refused = centrode(&unknown);
    assert_eq!(refused.status.code(), Some(2));
    let mut strange = asked.to_vec();
    strange.extend(["--of", "nothing"]);
    assert!(text(&centrode(&strange).stderr).contains("no figure \"nothing\""));
}
