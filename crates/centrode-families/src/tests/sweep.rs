use centrode_analysis::{Answer, Sweep};
use centrode_spec::{DesignError, DesignSpec as _};

use super::*;

fn template(word: &str) -> OpenDesign {
    let text = FAMILIES.template(word).expect("a family");
    FAMILIES.read(text.as_bytes()).expect("a design")
}

fn response(word: &str, key: &str, values: &[f64], depth: Depth) -> Result<Sweep, DesignError> {
    let file = template(word);
    let variants: Vec<Vec<f64>> = values.iter().map(|&value| vec![value]).collect();
    file.family().sweep(file.design(), &[key], &variants, depth)
}

fn height(radius: f64) -> f64 {
    let text = ThreeArmDesign::TEMPLATE.replace("radius = [21,", &format!("radius = [{radius:?},"));
    let design = FAMILIES.read(text.as_bytes()).expect("a design");
    let report = design.mechanism().expect("a mechanism").check();
    let goal = report
        .goals
        .iter()
        .find(|goal| goal.name == "trajectory-height");
    goal.and_then(|goal| goal.value).expect("a height")
}

#[test]
fn each_answer_is_that_of_the_design_with_the_value() {
    let values = [15.0, 21.0, 27.0];
    let response = response("three-arm", "pitch.radius[0]", &values, Depth::Motion);
    let answers = response.expect("a number").answers();
    let of = |name: &str| answers.iter().find(|a| a.name == name).expect("there");
    let found = &of("trajectory-height").figures;
    let required: Vec<Option<f64>> = values.iter().map(|&r| Some(height(r))).collect();
    assert_eq!(*found, required);
    // "The larger the value of r1, the smaller the trajectory height", section 4.2 of the paper.
    assert!(found[0] > found[1] && found[1] > found[2], "{found:?}");
    assert_eq!(answers.iter().filter(|a| a.name == "module").count(), 1);
}

#[test]
fn values_without_a_mechanism_leave_a_gap() {
    let response = response(
        "three-arm",
        "arm.tip_distance",
        &[-1.0, 145.0],
        Depth::Motion,
    );
    let response = response.expect("a number");
    let refused = response.reports[0].as_ref().expect_err("a negative length");
    assert!(refused.contains("tip_distance"), "{refused}");
    assert!(response.reports[1].is_ok());
    let answers = response.answers();
    assert!(answers.iter().all(|a| a.figures[0].is_none()));
}

#[test]
fn teeth_are_asked_only_for_a_whole_answer() {
    let key = template("three-arm").design().key_of("r1");
    let of = |depth| {
        assert!(response("three-arm", "r1", &[21.0], depth).is_err());
        let response = response("three-arm", &key, &[21.0], depth);
        response.expect("a number").answers()
    };
    let (motion, whole) = (of(Depth::Motion), of(Depth::Whole));
    let has = |answers: &[Answer], name: &str| answers.iter().any(|a| a.name == name);
    assert!(!has(&motion, "mesh_phase_error_max") && has(&whole, "mesh_phase_error_max"));
    for answer in &motion {
        assert!(whole.contains(answer), "{}", answer.name);
    }
}

#[test]
fn other_families_answer_too() {
    let of = |key: &str, values: &[f64]| response("gear-pair", key, values, Depth::Whole);
    let answers = of("teeth.backlash", &[0.02, 0.06]);
    let answers = answers.expect("a number").answers();
    let backlash = answers.iter().find(|a| a.name == "normal_backlash_min");
    let found = &backlash.expect("there").figures;
    assert!(found[1] > found[0], "{found:?}");
    assert!(of("teeth.blacklash.x", &[1.0]).is_err());
}
