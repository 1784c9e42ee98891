use super::{LEG, MachineDesign, made, read, refused};
use centrode_spec::{Design, DesignSpec as _};

#[test]
fn numbers_beyond_any_machine_are_refused_by_key() {
    for (from, to, stated) in [
        (
            "width = 8",
            "width = 1e9",
            "plates.width: must be -100000 to 100000 mm, not 1000000000 mm",
        ),
        (
            "[frame.points]",
            "[frame.points]\nfar = [0, 3e5]",
            "frame.points.far[1]: must be -100000 to 100000 mm, not 300000 mm",
        ),
        (
            "[frame.points]",
            "[obstacles.x]\ncircle = { center = [0, 0], radius = 1e12 }\n[frame.points]",
            "obstacles.x.circle.radius: must be -100000 to 100000 mm",
        ),
        (
            "[frame.points]",
            "[loads.x]\non = \"crank\"\ntorque = 1e10\n[frame.points]",
            "loads.x.torque: must be -1000000000 to 1000000000",
        ),
    ] {
        let text = LEG.replacen(from, to, 1);
        assert_ne!(text, LEG);
        let found = refused(&text);
        assert!(found.contains(stated), "{found}\n  {stated}");
    }
    let bare = "family = \"machine\"\n[frame.points]\nO = [0, 0]\n";
    let found = refused(bare);
    assert!(
        found.contains("bodies: is needed with at least one body"),
        "{found}"
    );
}

#[test]
fn parts_whose_files_would_have_one_name_are_refused() {
    let more =
        |name: &str| format!("{LEG}\n[bodies.{name}]\non = \"frame.O\"\nlaw = {{ ratio = 1 }}\n");
    for (name, stated) in [
        ("Crank", "would have the same name"),
        ("assembly", "a file of the whole machine is named assembly"),
        ("con", "is not allowed as the name of a file"),
        ("sheets", "a file of the whole machine is named sheets"),
        ("Sheets", "a file of the whole machine is named sheets"),
        (
            "assembly-sheet",
            "a file of the whole machine is named assembly-sheet",
        ),
        (
            "assembly-sheet-2",
            "a file of the whole machine is named assembly-sheet-2",
        ),
        (
            "sheets-sheet",
            "a file of the whole machine is named sheets-sheet",
        ),
        (
            "crank-sheet",
            "the files of bodies.crank-sheet and bodies.crank would have the same name",
        ),
        (
            "CRANK-SHEET-12",
            "the files of bodies.CRANK-SHEET-12 and bodies.crank would have the same name",
        ),
    ] {
        let found = refused(&more(name));
        assert!(found.contains(stated), "{found}");
    }
    for name in [
        "winch",
        "sheet",
        "sheets-2",
        "crank-sheets",
        "crank-2",
        "winch-sheet",
        "motion",
        "parts",
    ] {
        made(&more(name));
    }
}

#[test]
fn a_search_moves_numbers_of_the_machine_alone() {
    let goal = "[goals.low]\nfigure = \"foot.y\"\nover = \"minimum\"\nminimum = -90\n";
    for (key, stated) in [
        ("goals.low.minimum", "is a requirement"),
        ("input.turns", "is a requirement"),
        ("bodies.crank.points.Z[0]", "unknown key"),
    ] {
        let design = read(&format!("{LEG}\n{goal}[vary]\n\"{key}\" = [1, 2]\n"));
        let error = design.check_vary().expect_err(key);
        assert_eq!(error.key, format!("vary.{key}"));
        assert!(error.to_string().contains(stated), "{error}");
    }
    let known = "bodies.crank.points.A[0]";
    let design = read(&format!("{LEG}\n{goal}[vary]\n\"{known}\" = [1, 2]\n"));
    assert!(design.check_vary().is_ok());
    assert!(Design::numbered(&design, &[known]).is_ok());
}

#[test]
fn only_goals_for_one_value_contradict_each_other() {
    let goals = |first: &str, second: &str| {
        let goal = |name: &str, within: &str, limit: &str| {
            format!(
                "[goals.{name}]\nfigure = \"crank.A.x\"\nover = \"maximum\"\nwithin_deg = {within}\n{limit}\n"
            )
        };
        let goals = goal("high", first, "minimum = 9") + &goal("low", second, "maximum = 5");
        MachineDesign::from_toml(&format!("{LEG}\n{goals}"))
    };
    assert!(goals("[0, 90]", "[90, 180]").is_ok());
    let error = goals("[0, 90]", "[0, 90]").expect_err("a contradiction");
    assert_eq!(error.key, "goals.low");
    let words = "contradicts goals.high: maximum crank.A.x within 0 to 90 deg cannot be at least 9 and at most 5";
    assert!(error.message().contains(words), "{}", error.message());
}

/// A machine of so many bodies: of their own, of a dyad each two, and copies of one body in so many pieces each.
fn of_bodies(own: usize, dyads: usize, copies: &[u32]) -> String {
    let mut text = String::from("family = \"machine\"\nname = \"m\"\n[frame.points]\nO = [0, 0]\n");
    for i in 0..own {
        text += &format!("[bodies.b{i}]\non = \"frame.O\"\nlaw = {{ expression = \"phi\" }}\n");
    }
    for i in 0..dyads {
        text += &format!(
            "[dyads.d{i}]\ntype = \"RRR\"\nfrom = \"frame.O\"\nto = \"b0.P\"\nlengths = [60, 25]\njoint = \"A\"\nside = \"left\"\nbodies = [\"l{i}\", \"r{i}\"]\n"
        );
    }
    for (i, count) in copies.iter().enumerate() {
        text += &format!("[copies.c{i}]\nbodies = [\"b{i}\"]\ncount = {count}\n");
    }
    text
}

#[test]
fn more_than_400_bodies_are_refused() {
    for (own, dyads, copies) in [
        (401, 0, &[][..]),
        (402, 0, &[]),
        (800, 0, &[]),
        (5000, 0, &[]),
        (1, 200, &[]),
        (399, 1, &[]),
        (400, 1, &[]),
        (400, 0, &[2]),
        (342, 0, &[60]),
        (10, 0, &[60, 60, 60, 60, 60, 60, 60]),
        (1, 300, &[]),
        (341, 1, &[59]),
    ] {
        let count = own + 2 * dyads + copies.iter().map(|n| *n as usize - 1).sum::<usize>();
        let refused = MachineDesign::from_toml(&of_bodies(own, dyads, copies));
        let message = refused.expect_err("too many").message();
        assert_eq!(message, format!("bodies: must be 0 to 400, not {count}"));
    }
    for (own, dyads, copies) in [
        (400, 0, &[][..]),
        (2, 199, &[]),
        (398, 1, &[]),
        (341, 0, &[60]),
        (399, 0, &[2]),
    ] {
        let read = MachineDesign::from_toml(&of_bodies(own, dyads, copies));
        assert!(read.is_ok(), "{}", read.expect_err("a fault"));
    }
}
