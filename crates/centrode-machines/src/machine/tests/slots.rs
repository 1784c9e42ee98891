use centrode_geometry::Solid;

use super::*;

/// A crank of 24 mm whose block slides in a lever; `more` follows.
fn quick_return(more: &str) -> String {
    format!(
        r#"
family = "machine"
hardware = "full"
[frame.points]
O = [0, 0]
P = [0, -60]
[bodies.crank]
on = "frame.O"
law = {{ ratio = 1 }}
points = {{ A = [24, 0] }}
[dyads.drive]
type = "RPR"
from = "crank.A"
to = "frame.P"
side = "forward"
bodies = ["block", "lever"]
{more}"#
    )
}

const YOKE: &str = r#"
family = "machine"
hardware = "full"
[frame.points]
O = [0, 0]
[bodies.crank]
on = "frame.O"
law = { ratio = 1 }
points = { A = [30, 0] }
[dyads.drive]
type = "RPP"
from = "crank.A"
line = "frame.O"
line_deg = 0
slot_deg = 90
bodies = ["block", "yoke"]
"#;

fn body(machine: &Machine, name: &str) -> usize {
    machine.body_named(name).expect(name)
}

#[test]
fn a_lever_has_a_slot_as_long_as_its_block_travels() {
    let machine = made(&quick_return(""));
    let [lever, block] = ["lever", "block"].map(|name| body(&machine, name));
    // The block is 36 to 84 mm from the pin, 16 mm long and 9.6 mm high; the gap is 1 mm.
    let slots = machine.slots(lever);
    let [slot] = &slots[..] else {
        panic!("{slots:?}");
    };
    assert_eq!(slot.block, block);
    for (end, x) in slot.ends.iter().zip([27.0, 93.0]) {
        assert!((end - Point::new(x, 0.0)).norm() < 1e-9, "{end}");
    }
    assert!((slot.width - 9.6).abs() < 1e-12);
    assert!((slot.depth(Point::new(60.0, 1.0)) - 3.8).abs() < 1e-12);
    // Both are in the layer next to the crank's.
    assert_eq!(machine.bottom(block), machine.bottom(lever));
    assert_eq!(machine.bottom(lever), 6.0);
    let plate = machine.plate(lever).expect("a solid").expect("a plate");
    let [pin, cut] = plate.holes() else {
        panic!("a pin and a slot");
    };
    let bounds = cut.bounds();
    let [low, high] = [bounds.min.x, bounds.max.x];
    assert!((low - 22.2).abs() < 1e-9 && (high - 97.8).abs() < 1e-9);
    // The wall is that of a plate of 8 mm round a pin of 3 mm.
    let bounds = plate.outline().bounds();
    let [reach, half] = [bounds.max.x, bounds.max.y];
    assert!((reach - 100.3).abs() < 1e-9 && (half - 7.3).abs() < 1e-9);
    let solid = Solid::new(plate.outline().clone(), vec![pin.clone()], 0.0, 5.0);
    let cut = 5.0 * (66.0 * 9.6 + std::f64::consts::PI * 4.8 * 4.8);
    let less = solid.expect("a solid").volume() - plate.volume();
    assert!((less - cut).abs() < 1e-6, "{less} {cut}");
    let twice = made(&quick_return("[plates]\nwidth = 16\npin_diameter = 6"));
    assert!((twice.slots(lever)[0].width - 19.2).abs() < 1e-12);
}

#[test]
fn a_block_on_another_layer_has_no_slot() {
    let machine = made(&quick_return(
        "[bodies.block]\nlayer = 2\n[bodies.lever]\nlayer = 1",
    ));
    assert_eq!(machine.slots(body(&machine, "lever")), []);
    let machine = made(&quick_return(
        "[bodies.block]\nlayer = 3\n[bodies.lever]\nlayer = 3",
    ));
    assert_eq!(machine.slots(body(&machine, "lever")).len(), 1);
    // Nor has one that is drawn by hand.
    let drawn = "[bodies.block]\ncircle = { radius = 3 }";
    let machine = made(&quick_return(drawn));
    assert_eq!(machine.slots(body(&machine, "lever")), []);
}

#[test]
fn a_slot_lies_within_an_outline_drawn_by_hand_or_the_file_is_refused() {
    let outline = |end: f64| {
        format!("[bodies.lever]\noutline = [[-5, -8], [{end}, -8], [{end}, 8], [-5, 8]]")
    };
    let machine = made(&quick_return(&outline(100.0)));
    let lever = body(&machine, "lever");
    let (contour, holes) = machine.contours(lever).expect("a plate");
    assert_eq!((contour.segments().len(), holes.len()), (4, 2));
    let error = refused(&quick_return(&outline(95.0)));
    assert!(error.contains("bodies.lever.outline"), "{error}");
    let slot = "the slot of 9.6 mm for block, with round ends about 27, 0 and 93, 0 mm, is not inside the outline";
    assert!(error.contains(slot), "{error}");
}

#[test]
fn a_slot_that_overlaps_a_hole_is_reported() {
    assert_eq!(made(&quick_return("")).overlapping_holes(), None);
    let wide = made(&quick_return("[bodies.block]\nwidth = 22"));
    let words = wide.overlapping_holes().expect("they overlap");
    // The slot ends 36 - 22 - 1 - 13.2 mm from the axis of the pin, which reaches to 1.5 mm.
    let expected =
        "in body lever, the slot of 26.4 mm for block overlaps the hole of axis P by 1.7 mm";
    assert!(words.contains(expected), "{words}");
}

#[test]
fn a_yoke_has_a_slot_across_and_a_stem_for_its_guides() {
    let machine = made(YOKE);
    let yoke = body(&machine, "yoke");
    let slots = machine.slots(yoke);
    for (end, y) in slots[0].ends.iter().zip([-39.0, 39.0]) {
        assert!((end - Point::new(0.0, y)).norm() < 1e-9, "{end}");
    }
    // The wall is at 4.8 + 2.5 mm, the stem is longer by the stroke of 60 mm and 2 widths.
    let (outline, _) = machine.contours(yoke).expect("a plate");
    let bounds = outline.bounds();
    for (found, expected) in [(bounds.min, [-83.3, -46.3]), (bounds.max, [83.3, 46.3])] {
        assert!((found - Point::from(expected)).norm() < 1e-9, "{found}");
    }
    assert!(outline.contains(Point::new(80.0, 4.79)) && !outline.contains(Point::new(80.0, 4.81)));
    assert_eq!(machine.guided(yoke), Some(9.6));
    let solid = machine.plate(yoke).expect("a solid").expect("a plate");
    let [stem, slot] = [
        2.0 * 76.0 * 9.6,
        78.0 * 9.6 + std::f64::consts::PI * 4.8 * 4.8,
    ];
    let around = 78.0 * 14.6 + std::f64::consts::PI * 7.3 * 7.3;
    let volume = 5.0 * (around + stem - slot);
    assert!((solid.volume() - volume).abs() < 1e-6);
}

#[test]
fn two_blocks_slide_in_slots_of_the_bodies_that_have_their_lines() {
    let blocks = r#"
family = "machine"
hardware = "full"
[frame.points]
O = [0, 0]
Q = [0, 50]
[bodies.crank]
on = "frame.O"
law = { expression = "0.2*sin(phi)" }
points = { A = [40, 0] }
[bodies.arm]
on = "frame.Q"
law = { expression = "0.3*cos(phi)" }
points = { B = [40, 0] }
[dyads.cross]
type = "PRP"
line = "crank.A"
line_deg = 0
second_line = "arm.B"
second_line_deg = -60
bodies = ["one", "other"]
joint = "J"
"#;
    let machine = made(blocks);
    for (guide, block) in [("crank", "one"), ("arm", "other")] {
        let [guide, block] = [guide, block].map(|name| body(&machine, name));
        let slots = machine.slots(guide);
        assert_eq!(
            slots.iter().map(|slot| slot.block).collect::<Vec<_>>(),
            [block]
        );
        // The block stays off both round ends all through the cycle.
        let inputs = (0..100).map(|k| f64::from(k) * TAU / 100.0);
        let frames = machine.frames(&inputs.collect::<Vec<_>>());
        let corners = [[8.0, 4.8], [-8.0, 4.8], [8.0, -4.8], [-8.0, -4.8]].map(Point::from);
        for at in corners {
            let mut path = frames.path(guide, BodyPoint { body: block, at });
            assert!(path.all(|at| slots[0].depth(at) > -1e-9));
        }
    }
}

#[test]
fn a_clearance_of_a_block_and_its_slot_is_refused() {
    let goal =
        "[goals.free]\nfigure = \"clearance(block, lever)\"\nover = \"minimum\"\nminimum = 0";
    let error = refused(&quick_return(goal));
    assert!(error.contains("slide on each other in a slot"), "{error}");
}
