//! A machine made from a path: what is printed, the file, and every way in which a path is bad.

use std::fs;
use std::path::Path;

use crate::{centrode, fed, text};

const DRAWN: &str = "x,y\n0,0\n60,70\n150,150\n230,215\n262,262\n235,300\n170,330\n100,330\n40,300\n-5,250\n-30,190\n-38,130\n-30,60\n";

/// Path of a machine that is nearly even: a circle of 60 mm about a position off the axis, a little bent.
fn mild() -> String {
    let point = |i: u32| {
        let t = f64::from(i) * std::f64::consts::TAU / 40.0;
        let radius = 60.0 + 1.5 * (2.0 * t).cos();
        format!("{},{}\n", 100.0 + radius * t.cos(), radius * t.sin())
    };
    (0..40).map(point).collect()
}

/// Number after some words in the line that begins with a name.
fn figure(stated: &str, name: &str, before: &str) -> f64 {
    let line = stated.lines().find(|line| line.starts_with(name));
    let after = line.and_then(|line| line.split(before).nth(1));
    let word = after.and_then(|words| words.split(' ').next());
    word.and_then(|x| x.parse().ok()).expect("a number")
}

#[test]
fn what_was_chosen_is_printed() {
    let run = fed(
        &["reverse", "-", "--axis", "260,160", "--bend", "40"],
        DRAWN.as_bytes(),
    );
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    for line in [
        "axis of the carrier     260.0000, 160.0000 mm, as given",
        "carrier                 125.6121 mm, turns counter-clockwise",
        "arm                     186.5937 mm",
        "ratio                   0.5155 to 2.1793",
        "tip to shaft, minimum   60.9816 mm",
        "split                   powers, bend 40 deg, 1 arm",
        "split one-pair          the same pair twice does not work for this path: the planet must lag by 0.611111 turns, 11/18,",
    ] {
        assert!(stated.contains(line), "{line}\n{stated}");
    }
}

/// Four key poses of a machine with a carrier of 70 mm and an arm of 160 mm.
fn poses() -> String {
    let pose = |share: f64| {
        let psi = std::f64::consts::TAU * share;
        let arm = 0.4 - 0.3 * psi.sin();
        let x = 30.0 + 70.0 * psi.cos() + 160.0 * arm.cos();
        let y = -20.0 + 70.0 * psi.sin() + 160.0 * arm.sin();
        format!("{x},{y},{}\n", (arm + 0.25).to_degrees())
    };
    [0.05, 0.3, 0.55, 0.8].map(pose).concat()
}

#[test]
fn key_poses_are_met_and_bad_ones_refused() {
    let csv = format!("x,y,direction_deg\n{}", poses());
    let run = fed(&["reverse", "-", "--poses", "--bend", "40"], csv.as_bytes());
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    for number in 1..=4 {
        let line = stated
            .lines()
            .find(|line| line.starts_with(&format!("pose {number} ")));
        let line = line.unwrap_or_else(|| panic!("pose {number}: {stated}"));
        let mut numbers = line.split(' ').filter_map(|word| word.parse::<f64>().ok());
        let [_, off, turned] = [(); 3].map(|()| numbers.next().expect("a number"));
        assert!(off < 0.1 && turned < 0.1, "{line}");
    }
    assert!(
        stated.contains("starts that meet the poses in order"),
        "{stated}"
    );
    for (csv, wrong) in [
        (
            "0,0,0\n10,0,0\n",
            "2 key poses are given; there must be 3 to 7",
        ),
        ("0,0,0\n10,0\n20,5,1\n", "line 2 has 2 values"),
        ("1,1,0\n1,1,5\n1,1,9\n", "all key poses are at one position"),
    ] {
        let run = fed(&["reverse", "-", "--poses"], csv.as_bytes());
        assert_eq!(run.status.code(), Some(2), "{csv}");
        assert!(text(&run.stderr).contains(wrong), "{}", text(&run.stderr));
    }
    let both = fed(
        &["reverse", "-", "--poses", "--axis", "0,0"],
        csv.as_bytes(),
    );
    assert_eq!(both.status.code(), Some(2));
}

#[test]
fn the_design_written_resolves_and_its_tip_runs_along_the_path() {
    let folder = tempfile::tempdir().expect("a folder");
    let [path, design, table] =
        ["path.csv", "arms.toml", "out"].map(|name| folder.path().join(name));
    fs::write(&path, mild()).expect("written");
    let [path, design, table] = [path, design, table].map(|p| p.display().to_string());
    let run = centrode(&[
        "reverse", &path, "--axis", "0,0", "--bend", "60", "-o", &design,
    ]);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    assert!(
        text(&run.stdout).contains("teeth of first-stage"),
        "{}",
        text(&run.stdout)
    );
    let check = centrode(&["check", &design]);
    let report = text(&check.stdout);
    assert_eq!(
        check.status.code(),
        Some(0),
        "{report}{}",
        text(&check.stderr)
    );
    let export = centrode(&["export", &design, "--to", &table, "--format", "csv"]);
    assert_eq!(export.status.code(), Some(0), "{}", text(&export.stderr));
    // Nothing is written over the path.
    let over = centrode(&["reverse", &path, "-o", &path]);
    assert_eq!(over.status.code(), Some(2));
    assert!(
        text(&over.stderr).contains("is the path"),
        "{}",
        text(&over.stderr)
    );
}

#[test]
fn a_bad_path_is_refused_with_the_reason_and_nothing_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let design = folder.path().join("arms.toml");
    let shown = design.display().to_string();
    let half: String = (0..20)
        .map(|i| (f64::from(i) * 0.15).sin_cos())
        .map(|(y, x)| format!("{},{}\n", 100.0 * x, 100.0 * y))
        .collect();
    let eight: String = (0..24)
        .map(|i| f64::from(i) * std::f64::consts::TAU / 24.0)
        .map(|t| format!("{},{}\n", 50.0 * t.sin(), 30.0 * (2.0 * t).sin()))
        .collect();
    let large = "0,0\n".repeat(1 << 21);
    for (path, axis, why) in [
        (half.as_str(), "0,0", "the path is open"),
        (&eight, "100,0", "crosses itself"),
        ("0,0\n1,0\n1,1\n", "0,0", "has 3 points"),
        ("0,0\n1,NaN\n1,1\n0,1\n", "0,0", "point 2 of the path"),
        ("0,0\n1,b\n1,1\n0,1\n", "0,0", "line 2"),
        (&large, "0,0", "the limit is"),
        (DRAWN, "60,200", "--axis: "),
        (DRAWN, "1,2,3", "--axis"),
        (DRAWN, "1e300,0", "--axis"),
    ] {
        let run = fed(
            &["reverse", "-", "--axis", axis, "-o", &shown],
            path.as_bytes(),
        );
        let stated = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{stated}");
        assert!(stated.contains(why), "{why}: {stated}");
        assert!(!design.exists());
    }
    let bend = fed(
        &["reverse", "-", "--axis", "260,160", "--bend", "180"],
        DRAWN.as_bytes(),
    );
    assert_eq!(bend.status.code(), Some(2));
    assert!(
        text(&bend.stderr).contains("the bend must be at most"),
        "{}",
        text(&bend.stderr)
    );
}

#[test]
fn a_drawn_path_is_taken_within_the_distance_asked_for() {
    let page = |data: &str| {
        format!("<svg width=\"200mm\" viewBox=\"0 0 200 100\"><path d=\"{data}\"/></svg>")
    };
    let oval = page("M 20 50 C 20 0 180 0 180 50 C 180 100 20 100 20 50 Z");
    let at = ["reverse", "-", "--axis", "230,40", "--bend", "40"];
    let run = fed(&at, oval.as_bytes());
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    assert!(
        stated.starts_with("path                    through 64 points, within 1.4e-3 mm"),
        "{stated}"
    );
    let finer = fed(&[&at[..], &["--within", "1e-5"]].concat(), oval.as_bytes());
    assert!(
        text(&finer.stdout).contains("through 256 points, within "),
        "{}",
        text(&finer.stdout)
    );
    let corner = fed(&at, page("M 20 20 H 120 V 80 Z").as_bytes());
    assert_eq!(corner.status.code(), Some(2));
    let stated = text(&corner.stderr);
    assert!(
        stated.contains("standard input: ") && stated.contains("round corners"),
        "{stated}"
    );
}

/// Key poses of the shipped design, the last with a direction of its own.
fn transplanter(planting: &str) -> String {
    format!("240,40,5\n288,-6,17\n240,-165,-4\n85,-272,-33\n-70,-268,{planting}\n")
}

#[test]
fn a_transplanter_is_made_from_its_poses_and_its_parts_with_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let [design, parts] = ["arms.toml", "out"].map(|name| folder.path().join(name));
    let [shown, to] = [&design, &parts].map(|path| path.to_str().expect("text"));
    let command = ["reverse", "-", "--poses", "--three-arm", "--arms", "3"];
    let run = fed(
        &[&command[..], &["-o", shown, "--to", to]].concat(),
        transplanter("-54").as_bytes(),
    );
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{stated}{}", text(&run.stderr));
    let lines = |begin: &str| {
        stated
            .lines()
            .filter(|line| line.starts_with(begin))
            .count()
    };
    assert_eq!((lines("pose "), lines("goal ")), (5, 9), "{stated}");
    assert!(!stated.contains("missed\n"), "{stated}");
    assert!(parts.join("sun.step").exists() && parts.join("sheets.pdf").exists());
    // What was written reaches its goals by itself.
    let checked = centrode(&["check", shown]);
    assert_eq!(checked.status.code(), Some(0));
    let report = text(&checked.stdout);
    assert!(report.contains("Goals: 9 of 9 reached"), "{report}");
    for wrong in [
        &["reverse", "-", "--three-arm"][..],
        &["reverse", "-", "--poses", "--three-arm", "--bend", "40"],
        &["reverse", "-", "--poses", "--to", to],
    ] {
        assert_eq!(fed(wrong, b"").status.code(), Some(2), "{wrong:?}");
    }
}

#[test]
fn poses_that_no_goal_allows_are_told_with_the_goal() {
    // From 5 deg above the horizontal to 60 below it the clamp turns by 65 deg, and goal 4 allows 60.
    let run = fed(
        &["reverse", "-", "--poses", "--three-arm", "--arms", "3"],
        transplanter("-60").as_bytes(),
    );
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let missed: Vec<&str> = stated
        .lines()
        .filter(|line| line.ends_with("missed"))
        .collect();
    assert_eq!(missed.len(), 1, "{stated}");
    assert!(
        missed[0].starts_with("goal 4 ") && missed[0].contains("65.0000 deg"),
        "{stated}"
    );
}

#[test]
fn a_path_is_eased_within_a_band_until_full_teeth_are_large() {
    let folder = tempfile::tempdir().expect("a folder");
    let to = folder.path().join("eased.toml");
    let to = to.to_str().expect("a name");
    let requested = [
        "reverse", "-", "--axis", "260,160", "--bend", "40", "--band", "5", "-o", to,
    ];
    let run = fed(&requested, DRAWN.as_bytes());
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let figure = |name: &str, before: &str| figure(&stated, name, before);
    assert!(figure("path eased", "by ") <= 5.0, "{stated}");
    assert!(
        figure("full teeth", "module ") > 2.0 && figure("full teeth", "mm, ") < 0.2,
        "{stated}"
    );
    for pair in ["first", "second"] {
        let name = format!("teeth of {pair}-stage");
        assert!(stated.contains(" full teeth, module 2."), "{stated}");
        assert!(figure(&name, "module ") > 2.0, "{stated}");
    }
    let checked = centrode(&["check", to]);
    assert_eq!(checked.status.code(), Some(0), "{}", text(&checked.stdout));
}

#[test]
fn a_column_of_tolerances_bounds_each_point_and_a_module_is_asked_for() {
    let lines = DRAWN.lines().enumerate();
    let with = lines.map(|(i, line)| match i {
        0 => format!("{line},tolerance\n"),
        // The ends of the stroke stay.
        1 | 5 => format!("{line},0\n"),
        _ => format!("{line},6\n"),
    });
    let csv: String = with.collect();
    let axis = ["reverse", "-", "--axis", "260,160", "--bend", "40"];
    let requested = [&axis[..], &["--module", "0.5"]].concat();
    let run = fed(&requested, csv.as_bytes());
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    assert!(
        stated.contains("guaranteed up to module 0.5000 mm, 0.1127 mm before"),
        "{stated}"
    );
    // What is out of reach is reported, and the exit status is that of a finding.
    let requested = [&axis[..], &["--module", "20"]].concat();
    let run = fed(&requested, csv.as_bytes());
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let stated = text(&run.stdout);
    assert!(
        stated.contains(", not 20.0000 mm: use a larger band"),
        "{stated}"
    );
}

#[test]
fn bands_and_modules_that_are_none_are_refused() {
    let axis = ["reverse", "-", "--axis", "260,160"];
    let negative = DRAWN
        .replace("x,y", "x,y,tolerance")
        .replace("0,0\n", "0,0,-2\n");
    for (more, csv, words) in [
        (
            &["--band", "-1"][..],
            DRAWN,
            "the band of point 1 must be zero or more, in mm, not -1",
        ),
        (
            &["--band", "nan"],
            DRAWN,
            "the band of point 1 must be zero or more",
        ),
        (
            &["--band", "5", "--module", "0"],
            DRAWN,
            "--module must be greater than zero, in mm, not 0",
        ),
        (
            &["--module", "1"],
            DRAWN,
            "give --band, or a column headed tolerance",
        ),
        (
            &["--module", "1"],
            &negative,
            "line 2: the tolerance of a point must be zero or more, in mm, not -2",
        ),
        (&["--band", "1", "--poses"], DRAWN, "cannot be used with"),
    ] {
        let run = fed(&[&axis[..], more].concat(), csv.as_bytes());
        assert_eq!(run.status.code(), Some(2), "{more:?}");
        assert!(
            text(&run.stderr).contains(words),
            "{more:?}: {}",
            text(&run.stderr)
        );
    }
}

#[test]
fn the_return_of_a_stroke_may_be_free() {
    let stroke: String = DRAWN
        .lines()
        .take(7)
        .map(|line| format!("{line}\n"))
        .collect();
    let run = fed(
        &["reverse", "-", "--open", "--bend", "40"],
        stroke.as_bytes(),
    );
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    assert!(
        stated.contains("free return             through "),
        "{stated}"
    );
    assert!(!stated.contains("path eased"), "{stated}");
    let line = stated
        .lines()
        .find(|line| line.starts_with("full teeth"))
        .expect("a line");
    let module = line
        .split("module ")
        .nth(1)
        .and_then(|x| x.split(' ').next());
    let module: f64 = module.and_then(|x| x.parse().ok()).expect("a number");
    assert!(module > 1.0, "{stated}");
    let run = fed(&["reverse", "-", "--open"], b"0,0\n1,1\n");
    assert!(
        text(&run.stderr).contains("3 points or more, not 2"),
        "{}",
        text(&run.stderr)
    );
}

/// A design of the drawn path with wishes.
fn wished(wishes: &str) -> String {
    let points = DRAWN.lines().skip(1).map(|line| format!("[{line}], "));
    let points: String = points.collect();
    format!("family = \"path\"\nbend_deg = 40\n[path]\npoints = [{points}]\n[wishes]\n{wishes}\n")
}

#[test]
fn wishes_are_reported_with_their_figures_and_what_is_out_of_reach_with_the_miss() {
    let design =
        wished("carrier = { maximum = 120 }\nturn = { from = 1, to = 5, between_deg = [20, 150] }");
    let run = fed(&["reverse", "-"], design.as_bytes());
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{stated}{}", text(&run.stderr));
    assert!(
        stated.contains("mm, required at most 120.0000 mm\n"),
        "{stated}"
    );
    assert!(
        stated.contains("goal 2                  turn of the carrier from point 1 to point 5"),
        "{stated}"
    );
    // Values of the command line replace those of the file.
    let run = fed(
        &["reverse", "-", "--axis", "260,160", "--arms", "2"],
        design.as_bytes(),
    );
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(1), "{stated}{}", text(&run.stderr));
    assert!(
        stated.contains("2 arms") && stated.contains("260.0000, 160.0000 mm, as given"),
        "{stated}"
    );
    let figure = |name: &str, before: &str| figure(&stated, name, before);
    let missed = figure("goal 1", "missed by ");
    assert!(missed > 5.0, "{stated}");
    assert!(
        (figure("goal 1", "carrier ") - 120.0 - missed).abs() < 2e-4,
        "{stated}"
    );
}

#[test]
fn a_wish_that_breaks_a_rule_is_shown_at_its_line() {
    for (wishes, word) in [
        (
            "carrier = { minimum = 5, maximum = 3 }",
            "wishes.carrier.maximum",
        ),
        (
            "directions = [{ point = 14, direction_deg = 3 }]",
            "1 to 13",
        ),
        ("keep_out.tray.radius = 3", "wishes.keep_out.tray.center"),
        (
            "keep_out.tray = { corners = [[0, 0], [1, 1]] }",
            "three corners or more",
        ),
        ("carier = { maximum = 3 }", "carier"),
    ] {
        let run = fed(&["reverse", "-"], wished(wishes).as_bytes());
        let stated = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{stated}");
        assert!(
            stated.contains(word) && stated.contains("input:6:"),
            "{wishes}: {stated}"
        );
    }
}

#[test]
fn the_template_of_a_path_is_a_good_design() {
    let template = centrode(&["reverse", "--template"]);
    let run = fed(&["reverse", "-"], &template.stdout);
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{stated}{}", text(&run.stderr));
    assert!(stated.contains("distance of the arm from tray"), "{stated}");
}

#[test]
fn directions_stand_in_a_column_of_their_own_and_points_in_a_file_beside_the_design() {
    let folder = tempfile::tempdir().expect("a folder");
    let rows = DRAWN.lines().enumerate();
    let rows = rows.map(|(i, line)| match i {
        0 => "x,y,direction_deg\n".to_owned(),
        5 => format!("{line},40\n"),
        9 => format!("{line},86\n"),
        _ => format!("{line},\n"),
    });
    fs::write(folder.path().join("path.csv"), rows.collect::<String>()).expect("written");
    let design = "family = \"path\"\nbend_deg = 40\naxis = [260, 160]\n[path]\nfile = \"path.csv\"\nband = 5\n";
    let path = folder.path().join("path.toml");
    fs::write(&path, design).expect("written");
    let run = centrode(&["reverse", path.to_str().expect("a name")]);
    let stated = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{stated}{}", text(&run.stderr));
    for (goal, point) in [(1, 5), (2, 9)] {
        let words = format!("goal {goal}                  clamp direction error at point {point}");
        assert!(stated.contains(&words), "{stated}");
    }
    assert!(
        stated.contains("required -2.0000 deg to 2.0000 deg"),
        "{stated}"
    );
}

/// Path of a file in a folder, as a word of the command line.
fn written(folder: &Path, name: &str, contents: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, contents).expect("written");
    path.display().to_string()
}

#[test]
fn a_wish_about_a_point_that_the_file_lacks_is_shown_at_the_line_of_the_design() {
    let folder = tempfile::tempdir().expect("a folder");
    written(folder.path(), "path.csv", DRAWN);
    let design =
        "family = \"path\"\n[path]\nfile = \"path.csv\"\n[wishes]\narm = { minimum = 5 }\n";
    for (wish, word) in [
        (
            "directions = [{ point = 14, direction_deg = 3 }]",
            "wishes.directions[0].point: must be 1 to 13, not 14",
        ),
        (
            "turn = { from = 1, to = 20, between_deg = [3, 5] }",
            "wishes.turn.to: must be 1 to 13, not 20",
        ),
    ] {
        let path = written(folder.path(), "path.toml", &format!("{design}{wish}\n"));
        let run = centrode(&["reverse", &path]);
        let stated = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{stated}");
        assert!(
            stated.contains(word) && stated.contains("path.toml:6:"),
            "{stated}"
        );
        assert!(!stated.contains("path.csv"), "{stated}");
    }
}

#[test]
fn an_axis_at_the_border_of_its_box_is_told_with_the_side() {
    let narrow = [
        "reverse",
        "-",
        "--axis-box",
        "240,150,200,100",
        "--bend",
        "40",
    ];
    let stated = fed(&narrow, DRAWN.as_bytes());
    let stated = text(&stated.stdout);
    let line = stated
        .lines()
        .find(|line| line.starts_with("axis-at-border"));
    let line = line.unwrap_or_else(|| panic!("{stated}"));
    assert!(
        line.contains("where x ends at 240.0000 mm and y ends at 150.0000 mm:"),
        "{line}"
    );
    assert!(line.contains("remedy: a larger axis_box"), "{line}");
    // The axis lies in the box, and is no better than one of a wider box.
    let axis = stated
        .lines()
        .find_map(|line| line.strip_prefix("axis of the carrier"));
    let axis = axis
        .and_then(|words| words.split(" mm").next())
        .unwrap_or_default();
    let axis = axis.split(',').map(|x| x.trim().parse().expect("a number"));
    let axis: Vec<f64> = axis.collect();
    assert!(
        (200.0..=240.0).contains(&axis[0]) && (100.0..=150.0).contains(&axis[1]),
        "{stated}"
    );
    let wide = fed(
        &[
            "reverse",
            "-",
            "--axis-box",
            "200,100,420,400",
            "--bend",
            "40",
        ],
        DRAWN.as_bytes(),
    );
    let wide = text(&wide.stdout);
    let unevenness = |stated: &str| figure(stated, "ratio", "factor of ");
    assert!(unevenness(&wide) < unevenness(&stated), "{wide}");
    // The search that eases a path shows it, too.
    let design = wished("").replace(
        "[path]",
        "aim = \"mild\"\naxis_box = [[200, 100], [240, 150]]\n[path]",
    );
    let eased = fed(&["reverse", "-"], design.as_bytes());
    assert!(
        text(&eased.stdout).contains("axis-at-border"),
        "{}",
        text(&eased.stdout)
    );
    for (words, wrong) in [
        (&["--axis-box", "1,2,1,5"][..], "two corners that differ"),
        (&["--axis-box", "1,2,3"], "two corners that differ"),
        (
            &["--axis-box", "1,2,3,4", "--axis", "1,2"],
            "cannot be used with",
        ),
    ] {
        let run = fed(&[&["reverse", "-"], words].concat(), DRAWN.as_bytes());
        assert_eq!(run.status.code(), Some(2));
        assert!(text(&run.stderr).contains(wrong), "{}", text(&run.stderr));
    }
    let both = design.replace("axis_box", "axis = [1, 2]\naxis_box");
    let run = fed(&["reverse", "-"], both.as_bytes());
    let stated = text(&run.stderr);
    assert!(
        stated.contains("axis_box: cannot be given together with axis")
            && stated.contains("input:5:"),
        "{stated}"
    );
}

#[test]
fn a_message_names_the_key_of_the_file_or_the_option_and_has_few_digits() {
    let folder = tempfile::tempdir().expect("a folder");
    written(folder.path(), "path.csv", DRAWN);
    let tolerances = DRAWN.lines().enumerate();
    let tolerances: String = tolerances
        .map(|(i, line)| format!("{line},{}\n", if i == 0 { "tolerance" } else { "1" }))
        .collect();
    written(folder.path(), "bands.csv", &tolerances);
    let eight = "x,y\n0,0\n50,50\n100,0\n100,50\n50,0\n0,50\n";
    written(folder.path(), "eight.csv", eight);
    let design = |keys: &str, file: &str, more: &str| {
        let text = format!("family = \"path\"\n{keys}\n[path]\nfile = \"{file}.csv\"\n{more}\n");
        written(folder.path(), "path.toml", &text)
    };
    let csv = |name: &str| folder.path().join(name).display().to_string();
    let far = "1".repeat(300);
    let far_box = format!("-{far},0,{far},9");
    let big = "-1e9,-1e9,1e9,1e9";
    for (keys, file, more, options, words) in [
        (
            "axis = [60, 200]",
            "path",
            "",
            &[][..],
            "error: axis: the distance",
        ),
        (
            "axis = [1e300, 0]",
            "path",
            "",
            &[],
            "error: axis: the axis (1e300, 0) must",
        ),
        (
            "axis = [1e8, 0]",
            "path",
            "",
            &[],
            "error: axis: the axis is 99999738 mm from",
        ),
        (
            "axis_box = [[0, 0], [1e9, 1e9]]",
            "path",
            "",
            &[],
            "error: axis_box: must be -",
        ),
        (
            "axis_box = [[0, 0], [1e300, 9]]",
            "path",
            "",
            &[],
            "error: axis_box: must be -1000000000 to 1000000000 mm, not 1e300 mm",
        ),
        (
            "bend_deg = 1e300",
            "path",
            "",
            &[],
            "error: bend_deg: the bend must be at most",
        ),
        (
            "bend_deg = -179.5",
            "path",
            "",
            &[],
            "error: bend_deg: the bend must be at most",
        ),
        (
            "",
            "path",
            "module = 1",
            &[],
            "error: path.module: it limits how far a path is eased: give path.band",
        ),
        (
            "",
            "bands",
            "band = 2",
            &[],
            "error: path.band: the file has a tolerance for each point",
        ),
        (
            "axis = [60, 200]",
            "path",
            "",
            &["--axis", "50,200"],
            "error: --axis: the distance",
        ),
        (
            "",
            "bands",
            "",
            &["--band", "2"],
            "error: --band: the file has",
        ),
        (
            "",
            "path",
            "",
            &["--bend", "1e300"],
            "error: --bend: the bend must be at most",
        ),
        (
            "",
            "path",
            "",
            &["--module", "1"],
            "error: --module: it limits how far a path is eased: give --band",
        ),
        (
            "",
            "path",
            "",
            &["--axis-box", big],
            "error: --axis-box: must be -",
        ),
        (
            "axis = [60, 200]",
            "path",
            "",
            &["--axis-box", &far_box],
            "error: --axis-box: must be -1000000000 to 1000000000 mm, not -1.111111111e299 mm",
        ),
        (
            "",
            "eight",
            "",
            &[],
            "To accept such a path, use path.crossing = true.",
        ),
    ] {
        let path = design(keys, file, more);
        let run = centrode(&[&["reverse", &path], options].concat());
        let message = text(&run.stderr);
        assert_eq!(
            run.status.code(),
            Some(2),
            "{keys} {more} {options:?} {message}"
        );
        assert!(
            message.contains(words),
            "{keys} {more} {options:?}: {message}"
        );
        // A key of the file is shown at its line.
        let is_key = !(words.contains("--") || file == "eight");
        assert_eq!(message.contains("path.toml:"), is_key, "{message}");
        assert!(
            message.lines().next().expect("a line").len() < 250,
            "{message}"
        );
    }
    for (name, options, words) in [
        (
            "path.csv",
            &["--axis", "60,200"][..],
            "error: --axis: the distance",
        ),
        (
            "path.csv",
            &["--axis-box", big],
            "error: --axis-box: must be -",
        ),
        (
            "path.csv",
            &["--axis-box", "1e9,1e9,2e9,2e9", "--band", "2"],
            "error: --axis-box: must be -",
        ),
        (
            "path.csv",
            &["--axis-box", "0,0,6e5,6e5"],
            "error: --axis-box: must be -",
        ),
        (
            "path.csv",
            &["--axis", "1e9,0"],
            "error: --axis: the axis is 999999738 mm from",
        ),
        (
            "path.csv",
            &["--bend", "175"],
            "error: --bend: the bend must be at most",
        ),
        ("eight.csv", &[], "To accept such a path, use --crossing."),
    ] {
        let run = centrode(&[&["reverse", &csv(name)], options].concat());
        let message = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{options:?} {message}");
        assert!(message.contains(words), "{options:?}: {message}");
        assert!(message.len() < 300, "{message}");
    }
}

#[test]
fn points_of_three_numbers_and_second_directions_are_refused_where_they_stand() {
    let points = "[[0, 0], [60, 70, 1], [150, 150], [90, 200]]";
    for (text_of, message) in [
        (
            format!("family = \"path\"\n[path]\npoints = {points}\n"),
            "path.points[1]: must have 2 values, not 3",
        ),
        (
            format!(
                "family = \"path\"\n[path]\npoints = {}\n[wishes]\ndirections = [{{ point = 2, direction_deg = 0 }}, {{ point = 2, direction_deg = 90 }}]\n",
                points.replace(", 1]", "]")
            ),
            "wishes.directions[1].point: is 2 again, as in an earlier entry",
        ),
    ] {
        let run = fed(&["reverse", "-"], text_of.as_bytes());
        let stated = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{stated}");
        assert!(stated.contains(message), "{stated}");
    }
}

#[test]
fn a_wish_that_is_met_changes_nothing_where_nothing_may_move() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), "path.csv", &mild());
    let design = |wishes: &str| {
        let name = format!("path{}.toml", wishes.len());
        let content = format!(
            "family = \"path\"\naxis = [0, 0]\n[path]\nfile = {:?}\n{wishes}",
            Path::new(&path).file_name().expect("a name")
        );
        fs::write(folder.path().join(&name), content).expect("written");
        let name = folder.path().join(name).display().to_string();
        let run = centrode(&["reverse", &name]);
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        figure(&text(&run.stdout), "carrier", &format!("{:24}", "carrier"))
    };
    let plain = design("");
    let wished = design("[wishes]\ncarrier = { minimum = 1 }\n");
    assert!((plain - wished).abs() < 1e-9, "{plain} {wished}");
}

#[test]
fn arms_that_collide_are_told_as_the_check_tells_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), "path.csv", &mild());
    let to = folder.path().join("arms.toml").display().to_string();
    let run = |arms: &str, status: i32| {
        let axis = ["--axis", "0,0", "--arms", arms, "-o", &to];
        let run = centrode(&[&["reverse", &path][..], &axis].concat());
        assert_eq!(run.status.code(), Some(status), "{}", text(&run.stderr));
        text(&run.stdout)
    };
    assert!(!run("1", 0).contains("collide"));
    let stated = run("6", 1);
    let line = stated
        .lines()
        .find(|line| line.starts_with("gears-collide"));
    let line = line.unwrap_or_else(|| panic!("{stated}"));
    let check = centrode(&["check", &to, "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&check.stdout).expect("JSON");
    let found = report["findings"].as_array().expect("a list").iter();
    let collide: Vec<&serde_json::Value> = found.filter(|f| f["rule"] == "gears-collide").collect();
    let deep = |finding: &&&serde_json::Value| finding["measured"].as_f64().expect("a depth");
    let deepest = collide
        .iter()
        .min_by(|a, b| deep(a).total_cmp(&deep(b)))
        .expect("one");
    let message = deepest["message"].as_str().expect("words");
    assert!(
        message.contains("at an input of") && line.contains(message),
        "{line}\n{message}"
    );
    let more = format!("({} more pairs collide, none deeper)", collide.len() - 1);
    assert!(line.contains(&more), "{line}");
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_ends_the_search_and_keeps_the_best() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), "path.csv", &mild());
    let to = folder.path().join("arms.toml");
    let made = to.display().to_string();
    let ended = crate::search::interrupted(&["reverse", &path, "--band", "2", "-o", &made]);
    let stated = text(&ended.stdout);
    assert_eq!(
        ended.status.code(),
        Some(0),
        "{stated}{}",
        text(&ended.stderr)
    );
    let done = figure(&stated, "search", "stopped after ");
    assert!(done > 0.0 && done < 6000.0, "{stated}");
    assert!(figure(&stated, "path eased", "by ") <= 2.0, "{stated}");
    assert!(
        fs::read_to_string(to)
            .expect("a design")
            .starts_with("family = \"machine\"")
    );
}
