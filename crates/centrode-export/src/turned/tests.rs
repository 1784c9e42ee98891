use centrode_kinematics::machine::TurnedStep;

use super::*;

#[test]
fn a_silhouette_has_the_area_of_its_steps() {
    let steps = [(10.0, 0.6), (9.6, 1.1), (10.0, 18.0)];
    let pin = TurnedPart {
        name: "pin".into(),
        title: "Pin".into(),
        steps: steps
            .map(|(diameter, length)| TurnedStep::plain(diameter, length, "f7"))
            .into(),
        keyway: None,
        held: Vec::new(),
        chamfer: 0.3,
        material: "steel".into(),
        density: 7850.0,
        heat_treatment: String::new(),
        notes: Vec::new(),
    };
    let whole: f64 = steps
        .iter()
        .map(|(diameter, length)| diameter * length)
        .sum();
    let area = Drawn(&pin).silhouette().area();
    assert!((area - whole + 2.0 * pin.chamfer * pin.chamfer).abs() < 1e-9);
}
