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
    let stated = text(&found.stdout);
    assert_eq!(
        found.status.code(),
        Some(0),
        "{stated}{}",
        text(&found.stderr)
    );
    for line in ["carrier_start 101 ->", "every goal is reached"] {
        assert!(stated.contains(line), "{line} in {stated}");
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
    // A second run gives an equal file.
    centrode(&run);
    assert_eq!(fs::read_to_string(&better).expect("written"), written);
}

#[test]
fn a_search_of_no_evaluations_is_refused_in_words() {
    let design = shipped("three-arm-2021.toml");
    let run = ["optimise", &design, "--evaluations", "0", "-o", "-"];
    for run in [&run[..], &[&run[..], &["--resume"]].concat()] {
        let refused = centrode(run);
        assert_eq!(refused.status.code(), Some(2));
        let stated = text(&refused.stderr);
        assert!(stated.contains("--evaluations"), "{stated}");
    }
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
fn an_altered_search_is_not_gone_on_with() {
    let folder = tempfile::tempdir().expect("a place to write");
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (from, to, stored) = (file("a.toml"), file("b.toml"), file("b.search.json"));
    let design = fs::read_to_string(shipped("feeder-2022.toml")).expect("shipped");
    fs::write(&from, &design).expect("written");
    let run = |more: &[&str]| {
        let mut words = vec!["optimise", &from, "-o", &to];
        words.extend(more);
        centrode(&words)
    };
    run(&["--method", "de", "--population", "8", "--evaluations", "40"]);
    let sound = fs::read_to_string(&stored).expect("stored");
    let resumed = run(&["--resume", "--evaluations", "48"]);
    assert_ne!(resumed.status.code(), Some(2), "{}", text(&resumed.stderr));
    let refused = |more: &[&str], why: &str| {
        let mut words = vec!["--resume"];
        words.extend(more);
        let done = run(&words);
        assert_eq!(done.status.code(), Some(2), "{why}: {}", text(&done.stdout));
        assert!(text(&done.stderr).contains(why), "{}", text(&done.stderr));
    };
    let number = sound.find("\"objective\":").expect("a number") + 12;
    let digit = number
        + sound[number..]
            .find(|c: char| c.is_ascii_digit())
            .expect("one");
    let mut edited = sound.clone();
    let other = if &sound[digit..=digit] == "7" {
        "8"
    } else {
        "7"
    };
    edited.replace_range(digit..=digit, other);
    let unsealed = sound.replacen("\"seal\":", "\"sail\":", 1);
    for altered in [
        &edited,
        &sound.replacen("\"seed\":1", "\"seed\":2", 1),
        &sound.replacen("\"evaluations\":40", "\"evaluations\":39", 1),
        &unsealed,
        &sound[..sound.len() - 20],
        "",
    ] {
        assert_ne!(altered, sound);
        fs::write(&stored, altered).expect("written");
        refused(&[], "b.search.json is not a valid stored search");
    }
    fs::write(&stored, &sound).expect("written");
    refused(
        &["--seed", "2"],
        "--seed 2: the search in b.search.json has seed 1",
    );
    refused(
        &["--method", "ga"],
        "--method ga: the search in b.search.json has method de",
    );
    // A number that the search does not move.
    let line = design
        .lines()
        .find(|line| line.starts_with("effector_length"));
    let other = design.replace(line.expect("there"), "effector_length = 201");
    fs::write(&from, other).expect("written");
    refused(&[], "the design has changed since");
}

#[test]
fn a_population_too_small_is_refused_by_its_flag() {
    let folder = tempfile::tempdir().expect("a place to write");
    let to = folder.path().join("a.toml").display().to_string();
    for method in ["guided", "de", "ga", "cma-es"] {
        for count in ["0", "4"] {
            let design = shipped("feeder-2022.toml");
            let words = ["--method", method, "--population", count, "-o", &to];
            let done = centrode(&[&["optimise", &design], &words[..]].concat());
            assert_eq!(done.status.code(), Some(2));
            let stated = format!("--population: population is {count}, but it must be at least 5");
            assert!(
                text(&done.stderr).contains(&stated),
                "{}",
                text(&done.stderr)
            );
        }
    }
    assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 0);
}

#[test]
fn a_response_is_told_as_table_and_written_as_csv() {
    let folder = tempfile::tempdir().expect("a place to write");
    let csv = folder.path().join("r1.csv");
    let to = csv.display().to_string();
    let arms = shipped("three-arm-2021.toml");
    let requested = [
        "response",
        &arms,
        "--parameter",
        "r1",
        "--from",
        "15",
        "--to",
        "27",
    ];
    let mut words = requested.to_vec();
    words.extend([
        "--count",
        "3",
        "--of",
        "trajectory-height,picking_speed",
        "--csv",
        &to,
    ]);
    let stated = centrode(&words);
    assert_eq!(stated.status.code(), Some(0), "{}", text(&stated.stderr));
    let table = text(&stated.stdout);
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
    let mut unknown = requested.to_vec();
    unknown[3] = "arm.tip_distanc";
    let refused = centrode(&unknown);
    assert_eq!(refused.status.code(), Some(2));
    let mut strange = requested.to_vec();
    strange.extend(["--of", "nothing"]);
    assert!(text(&centrode(&strange).stderr).contains("unknown figure \"nothing\""));
}

#[test]
fn a_response_without_goals_tells_what_changes_and_why_there_is_no_mechanism() {
    let folder = tempfile::tempdir().expect("a place to write");
    let design = folder.path().join("fitted.toml");
    let text_of = |fit: &str| {
        format!(
            "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\neccentricity = 0.3\nmodule = 2\ntooth_count = 23\n\
             [teeth]\naddendum = \"fitted\"\n{fit}\n[tool]\nkind = \"rack\"\npressure_angle_deg = 20\n"
        )
    };
    let name = design.display().to_string();
    let ask = |of: &[&str]| {
        let key = ["response", &name, "--parameter", "tool.pressure_angle_deg"];
        let ends = ["--from", "18", "--to", "26", "--count", "3"];
        text(&centrode(&[&key[..], &ends, of].concat()).stdout)
    };
    fs::write(&design, text_of("")).expect("written");
    let stated = ask(&["--depth", "whole"]);
    let lines: Vec<&str> = stated.lines().collect();
    // Figures by lines: there are more of them than values. What does not change is omitted.
    assert!(
        lines[0]
            .trim_start()
            .starts_with("tool.pressure_angle_deg  "),
        "{stated}"
    );
    assert!(lines[0].ends_with(" 26"), "{stated}");
    assert!(
        stated.contains("contact_ratio_mean") && !stated.contains("driver_tooth_count"),
        "{stated}"
    );
    assert!(stated.contains("no mechanism at 26: tool"), "{stated}");
    let other = ask(&["--of", "contact-ratio-mean"]);
    assert!(other.contains("contact_ratio_mean"), "{other}");
    // A number that the fit chooses changes nothing.
    fs::write(&design, text_of("fit = [\"pressure_angle\"]")).expect("written");
    assert!(ask(&[]).contains("no figure changes with tool.pressure_angle_deg"));
}

#[test]
fn a_search_does_not_write_over_its_design() {
    let folder = tempfile::tempdir().expect("a place to write");
    let design = folder.path().join("a.toml");
    let before = fs::read(shipped("feeder-2022.toml")).expect("shipped");
    fs::write(&design, &before).expect("written");
    let name = design.display().to_string();
    let few = ["--evaluations", "10"];
    for more in [&few[..], &["--widen"]] {
        let run = [&["optimise", &name, "-o", &name], more].concat();
        let refused = centrode(&run);
        assert_eq!(refused.status.code(), Some(2));
        let stated = text(&refused.stderr);
        assert!(
            stated.contains("is the design: choose another output file"),
            "{stated}"
        );
        assert_eq!(fs::read(&design).expect("there"), before);
    }
}

#[test]
fn a_response_to_what_is_no_number_is_refused() {
    for (design, key) in [
        ("jansen-leg.toml", "copies"),
        ("jansen-leg.toml", "pairs"),
        ("two-stage.toml", "pairs"),
        ("two-stage.toml", "name"),
    ] {
        let design = shipped(design);
        let ends = ["--from", "1", "--to", "3", "--count", "3"];
        let requested = centrode(&[&["response", &design, "--parameter", key][..], &ends].concat());
        let stated = text(&requested.stderr);
        assert_eq!(requested.status.code(), Some(2), "{key}: {stated}");
        assert!(
            stated.contains(&format!("{key}: is not a number")),
            "{stated}"
        );
    }
}

#[test]
fn a_response_to_a_count_is_told_with_the_counts_checked() {
    let design = shipped("circular-pair.toml");
    let ends = ["--from", "20", "--to", "21", "--count", "4", "--json"];
    let key = ["--parameter", "pitch.tooth_count"];
    let requested = centrode(&[&["response", &design][..], &key, &ends].concat());
    let stated: serde_json::Value = serde_json::from_slice(&requested.stdout).expect("JSON");
    assert_eq!(
        stated["values"],
        serde_json::json!([20.0, 20.0, 21.0, 21.0])
    );
}

#[test]
fn a_feeder_is_searched_and_told_infeasible_with_the_best_attainable() {
    let folder = tempfile::tempdir().expect("a place to write");
    let file = |name: &str| folder.path().join(name).display().to_string();
    let published = shipped("feeder-2022.toml");
    let words = |from: &str, to: &str| {
        let found = centrode(&["optimise", from, "--method", "de", "--seed", "1", "-o", to]);
        (found.status.code(), text(&found.stdout))
    };
    let (code, stated) = words(&published, &file("best.toml"));
    assert_eq!(code, Some(1), "{stated}");
    for line in [
        "infeasible: the maximum found within the bounds is 12.312 deg",
        "widen them by 22.443 %",
    ] {
        assert!(stated.contains(line), "{line} in {stated}");
    }
    // Without constraint (16), half a turn is reached within a millionth of a degree, and the file has it.
    let without = fs::read_to_string(&published).expect("shipped");
    let without = without.replace("transmission_angle_deg = 40", "transmission_angle_deg = 0");
    fs::write(
        file("without.toml"),
        without.replace("crank = 77\n", "crank = 78.5\n"),
    )
    .expect("written");
    let (code, stated) = words(&file("without.toml"), &file("half-turn.toml"));
    assert_eq!(code, Some(0), "{stated}");
    assert!(stated.contains("every goal is reached"), "{stated}");
    let json = centrode(&["check", &file("half-turn.toml"), "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    let swing = report["values"]["swing"].as_f64().expect("a figure");
    assert!((swing.to_degrees() - 180.0).abs() < 1e-6, "{swing}");
    assert!(folder.path().join("half-turn.search.json").exists());
}

#[test]
fn the_least_widening_is_written_as_shipped() {
    let folder = tempfile::tempdir().expect("a place to write");
    let to = folder.path().join("widened.toml").display().to_string();
    let published = shipped("feeder-2022.toml");
    let found = centrode(&["optimise", &published, "--widen", "-o", &to]);
    let stated = text(&found.stdout);
    assert_eq!(found.status.code(), Some(0), "{}", text(&found.stderr));
    assert!(stated.contains("bounds widened by 22.4432 %"), "{stated}");
    let numbers = |path: &str| {
        let written = fs::read_to_string(path).expect("written");
        let root: toml_edit::DocumentMut = written.parse().expect("TOML");
        let of = |table: &str| root[table].to_string();
        [of("linkage"), of("bounds")]
    };
    assert_eq!(numbers(&to), numbers(&shipped("feeder-widened.toml")));
    for (design, why) in [
        (shipped("feeder-widened.toml"), "need not be widened"),
        (
            shipped("circular-pair.toml"),
            "the bounds of a gear pair cannot be widened",
        ),
    ] {
        let refused = centrode(&["optimise", &design, "--widen", "-o", &to]);
        assert_eq!(refused.status.code(), Some(2));
        assert!(text(&refused.stderr).contains(why));
    }
}

/// Whether a process of this number catches Ctrl-C.
#[cfg(target_os = "linux")]
fn catches_interrupt(id: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{id}/status")).unwrap_or_default();
    let caught = status.lines().find_map(|l| l.strip_prefix("SigCgt:"));
    let mask = caught.and_then(|hex| u64::from_str_radix(hex.trim(), 16).ok());
    // Signals are counted from one, and this is the second.
    mask.is_some_and(|mask| mask & 2 != 0)
}

/// Output of a command that is interrupted as Ctrl-C does, a while after it listens.
#[cfg(target_os = "linux")]
pub(crate) fn interrupted(words: &[&str]) -> std::process::Output {
    ended_by("-INT", words)
}

#[cfg(target_os = "linux")]
fn ended_by(signal: &str, words: &[&str]) -> std::process::Output {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    let child = Command::new(env!("CARGO_BIN_EXE_centrode"))
        .args(words)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("runs");
    let id = child.id();
    let begun = Instant::now();
    while !catches_interrupt(id) {
        assert!(begun.elapsed() < Duration::from_secs(60), "never listens");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(200));
    let sent = Command::new("kill")
        .args([signal, &id.to_string()])
        .status();
    assert!(sent.expect("kill is there").success());
    child.wait_with_output().expect("ends")
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_and_the_system_end_a_search_that_keeps_the_best_so_far() {
    let folder = tempfile::tempdir().expect("a place to write");
    let to = folder.path().join("best.toml").display().to_string();
    let published = shipped("feeder-2022.toml");
    let words = ["optimise", &published, "--method", "de", "-o", &to];
    let endless = ["--evaluations", "1000000000000"];
    for signal in ["-INT", "-TERM"] {
        let ended = ended_by(signal, &[&words[..], &endless].concat());
        let stated = text(&ended.stdout);
        assert_eq!(
            ended.status.code(),
            Some(1),
            "{stated}{}",
            text(&ended.stderr)
        );
        assert!(
            stated.contains("; stopped") && stated.contains("infeasible"),
            "{signal}: {stated}"
        );
    }
    // The best found is better than the start, a design, and a search to go on with.
    let json = centrode(&["check", &to, "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    let angle = report["values"]["transmission_angle_min"]
        .as_f64()
        .expect("a figure");
    assert!(angle.to_degrees() > 10.0, "{angle}");
    let stored = fs::read_to_string(folder.path().join("best.search.json")).expect("stored");
    let stored: serde_json::Value = serde_json::from_str(&stored).expect("JSON");
    let history = stored["state"]["Global"]["history"]
        .as_array()
        .expect("there");
    let done = history.last().expect("a generation")["evaluations"]
        .as_u64()
        .expect("a count");
    let more = (done + 400).to_string();
    let mut resumed = words.to_vec();
    resumed.extend(["--evaluations", &more, "--resume", "--json"]);
    let stated: serde_json::Value =
        serde_json::from_slice(&centrode(&resumed).stdout).expect("JSON");
    let gone = stated["progress"]["evaluations"].as_u64().expect("a count");
    assert!(
        (done + 400..done + 800).contains(&gone),
        "{gone} after {done}"
    );
}
