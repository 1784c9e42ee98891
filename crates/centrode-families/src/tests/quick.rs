//! Answers to the design page while a hand moves are those at rest.

use centrode_export::{linked, machine};
use centrode_geometry::Tolerance;
use centrode_machines::machine::Machine;

use super::{FAMILIES, shipped};

#[test]
fn goals_alone_and_pictures_without_parts_are_those_of_the_whole_machine() {
    let mut seen = 0;
    for (name, text) in shipped() {
        let file = FAMILIES.read(text.as_bytes()).expect("a design");
        let mechanism = file.mechanism().expect("a mechanism");
        let Some(of) = mechanism.clone().downcast::<Machine>() else {
            continue;
        };
        seen += 1;
        let (goals, motion) = (mechanism.check_goals(), mechanism.check_motion());
        assert_eq!(goals.goals, motion.goals, "{name}");
        assert_eq!(mechanism.limits(&goals), mechanism.limits(&motion));
        let tolerance = Tolerance::new(0.01).expect("positive");
        let [whole, light] = [machine::machine(&of), machine::outlined(&of)].map(|made| {
            let made = made.expect("links");
            linked::picture(&made, tolerance)
        });
        assert!(whole == light, "{name}");
    }
    assert!(seen >= 8, "{seen}");
}
