//! New disc cams with their levers.

use centrode_geometry::Vector;
use serde_json::Value as Json;

use super::adding::{apex, degrees, numbers};
use super::scene::{Scene, clicked, line};
use super::writing::{digits, put};
use super::{Composed, Pin, Place, Refusal, naming};

/// Radius of the roller, as a share of its distance from the axis of the cam.
const ROLLER: f64 = 0.2;
/// Swing of a new lever, deg.
const SWING: f64 = 15.0;

/// A cam on a body that turns, and a lever whose roller rests on the base circle where it was clicked. At the input shown the
/// rise begins.
pub(super) fn cam(
    mut scene: Scene,
    on: &str,
    pin: &Pin,
    at: Option<Place>,
    [length, radius, swing]: [Option<f64>; 3],
) -> Result<Composed, Box<Refusal>> {
    let index = scene.body(on)?;
    let axis = scene.origin(index);
    let pin = scene.pin(pin)?;
    let both = "length and radius";
    let apart = pin.at - axis;
    let length = match length {
        Some(length) => length,
        None => digits((clicked(at, both)? - pin.at).norm()),
    };
    let (base, roller) = match radius {
        Some(base) => (base, digits(base * ROLLER / (1.0 - ROLLER))),
        None => {
            let reach = (clicked(at, both)? - axis).norm();
            let roller = digits(ROLLER * reach);
            (digits(reach - roller), roller)
        }
    };
    let Some([left, right]) = apex([axis, pin.at], [base + roller, length]) else {
        let why = format!(
            "an arm of {length} mm does not reach the base circle: the axes are {} mm apart",
            digits(apart.norm())
        );
        return Err(Box::new(Refusal::because(why)));
    };
    // The roller is on the side that was clicked; without a click on the left of the line from the cam to the pin.
    let place = match at {
        Some([x, y]) if apart.perp(&(Vector::new(x, y) - axis.coords)) < 0.0 => right,
        _ => left,
    };
    let arm = place - pin.at;
    let lifts = match Vector::new(-arm.y, arm.x).dot(&(place - axis)) > 0.0 {
        true => "counter-clockwise",
        false => "clockwise",
    };
    let swing = swing.unwrap_or(SWING);
    let mount = degrees(apart.y.atan2(apart.x) - scene.angle(index));
    let mount = if mount == 0.0 {
        String::new()
    } else {
        format!("mount_deg = {mount}\n")
    };
    let cam = naming::part(&scene.design, "lift");
    let lever = naming::part(&scene.design, "lever");
    let stroke =
        |kind: &str| format!("\n    {{ kind = \"{kind}\", span_deg = 120, swing_deg = {swing} }},");
    let dwell = "\n    { kind = \"dwell\", span_deg = 60 },";
    let segments = [&stroke("rise"), dwell, &stroke("return"), dwell].concat();
    let text = format!(
        "on = \"{on}\"\n{mount}base_radius = {base}\nfollower = {{ kind = \"swinging-roller\", roller_radius = {roller}, arm_length = {length}, lifts = \"{lifts}\" }}\n\n[cams.{cam}.motion]\nsegments = [{segments}\n]\n"
    );
    put(&mut scene.document, "cams", &cam, &text)?;
    let law = format!("on = \"{}\"\nlaw = {{ follows = \"{cam}\" }}\n", pin.word);
    put(&mut scene.document, "bodies", &lever, &law)?;
    scene.reread();
    let part = Composed {
        numbers: numbers([
            ("length", length.into()),
            ("radius", base.into()),
            ("swing_deg", Json::from(swing)),
        ]),
        lines: vec![line(axis, place), line(pin.at, place)],
        ..Composed::default()
    };
    scene.finish(&format!("bodies.{lever}"), part)
}
