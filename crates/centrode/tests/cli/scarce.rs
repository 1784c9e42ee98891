//! Commands where the system gives few file descriptors and no threads.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::{shipped, text};

/// Runs a line of the shell in a folder; `$c` is the program.
fn shell(folder: &Path, line: &str) -> Output {
    let mut command = Command::new("sh");
    let command = command.current_dir(folder).args(["-c", line]);
    command
        .env("c", env!("CARGO_BIN_EXE_centrode"))
        .output()
        .expect("the shell runs")
}

/// A stack so large that no thread can have it: the system starts none.
const NO_THREADS: &str = "RUST_MIN_STACK=4611686018427387904";

/// Names and contents of all files in a folder, in order.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let mut files: Vec<(String, Vec<u8>)> = entries
        .map(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            (name, fs::read(entry.path()).expect("a file"))
        })
        .collect();
    files.sort();
    files
}

#[test]
fn one_thread_does_what_many_do() {
    let folder = tempfile::tempdir().expect("a place to write");
    let (pair, arms) = (
        shipped("elliptic-pair-2018.toml"),
        shipped("composed-box.toml"),
    );
    let oval = "x,y\n100,0\n60,50\n0,60\n-60,50\n-100,0\n-60,-50\n0,-60\n60,-50\n";
    fs::write(folder.path().join("oval.csv"), oval).expect("written");
    for line in [
        format!("check {pair}"),
        format!("check {pair} --json"),
        format!("check {arms}"),
        format!("export {pair} --to out --format svg"),
        format!("export {arms} --to out --format csv,dxf"),
        format!("report {pair} -o out.html"),
        "new gear-pair".to_owned(),
        "schema".to_owned(),
        "check missing.toml".to_owned(),
        "reverse oval.csv --axis 300,20 --bend 40".to_owned(),
        "reverse oval.csv".to_owned(),
    ] {
        let run = |before: &str| {
            let run = shell(folder.path(), &format!("{before} \"$c\" {line}"));
            let out = folder.path().join("out");
            let written = out.exists().then(|| files(&out));
            let _ = fs::remove_dir_all(out);
            let _ = fs::remove_file(folder.path().join("out.html"));
            (
                run.status.code(),
                text(&run.stdout),
                text(&run.stderr),
                written,
            )
        };
        let usual = run("");
        assert!(usual.0.is_some_and(|code| code < 3), "{line}: {usual:?}");
        let alone = run(NO_THREADS);
        assert_eq!(usual.0, alone.0, "{line}: {}", alone.2);
        assert!(usual == alone, "{line}: {}", alone.2);
    }
}

#[test]
fn few_descriptors_do_for_a_check_and_an_export() {
    let folder = tempfile::tempdir().expect("a place to write");
    let pair = shipped("elliptic-pair-2018.toml");
    let usual = shell(folder.path(), &format!("\"$c\" check {pair}"));
    for number in [6, 7, 8, 9, 10, 11, 12, 16, 20, 24, 40] {
        for threads in ["", NO_THREADS] {
            let limited = |line: &str| {
                let line = format!("ulimit -n {number}; {threads} exec \"$c\" {line}");
                shell(folder.path(), &line)
            };
            let run = limited(&format!("check {pair}"));
            let message = text(&run.stderr);
            assert_eq!(run.status.code(), usual.status.code(), "{number} {message}");
            assert_eq!(run.stdout, usual.stdout, "{number}");
            let run = limited(&format!("export {pair} --to out{number} --format svg"));
            let message = text(&run.stderr);
            assert!(
                run.status.code().is_some_and(|code| code < 2),
                "{number} {message}"
            );
            assert!(!message.contains("page"), "{message}");
        }
        let [one, other] = [6, number].map(|n| files(&folder.path().join(format!("out{n}"))));
        assert!(one == other && !one.is_empty(), "{number}");
    }
    // If not even the files can be opened, the message has this reason.
    for number in [3, 4] {
        let line = format!("ulimit -n {number}; exec \"$c\" export {pair} --to none --format svg");
        let run = shell(folder.path(), &line);
        let message = text(&run.stderr);
        assert!(
            !message.contains("page") && !message.contains("panicked"),
            "{message}"
        );
    }
}
