use std::f64::consts::TAU;

use centrode::analysis::FeederForces;
use centrode::export::feeder::{self, Teeth};
use centrode::export::page::{Curve, Handle, HandlePlane, Picture};
use centrode::geometry::Tolerance;
use centrode::mechanism::feeder::{Feeder, Part};

/// Places of a cycle at which the torque is worked out.
const LOOKS: u32 = 360;

/// Tolerance of the picture, as a share of the frame.
const DRAWN: f64 = 1e-4;

/// The six-bar as it moves, with the path of its tip; its joints can be drawn aside. The gears are plain: cutting their teeth
/// takes longer than an eye waits.
pub(super) fn picture(machine: &Feeder) -> Picture {
    drawn(machine, Teeth::Plain)
}

/// The same with the teeth of its gears, where they can be cut.
pub(super) fn with_teeth(machine: &Feeder) -> Option<Picture> {
    let pair = machine.gears().ok()?;
    Some(drawn(machine, Teeth::Cut(&pair)))
}

/// Torque of the crank along the cycle; none where a link makes no plate.
pub(super) fn checked_curves(machine: &Feeder) -> Vec<Curve> {
    let Ok(system) = FeederForces::of(machine) else {
        return Vec::new();
    };
    let input: Vec<f64> = (0..=LOOKS)
        .map(|i| TAU * f64::from(i) / f64::from(LOOKS))
        .collect();
    let curve = |name, moving| {
        let torque = |&phi: &f64| system.at(phi, moving).map_or(f64::NAN, |f| f.torque);
        Curve {
            chart: "Torque of the crank",
            name,
            unit: "N·mm",
            count: false,
            value: input.iter().map(torque).collect(),
            input: input.clone(),
        }
    };
    vec![curve("moving", true), curve("held still", false)]
}

fn drawn(machine: &Feeder, teeth: Teeth<'_>) -> Picture {
    let frame = machine.six_bar().four_bar().lengths()[3];
    let Ok(tolerance) = Tolerance::new(DRAWN * frame) else {
        return Picture::default();
    };
    let mut picture = feeder::picture(machine, teeth, tolerance);
    let link = |part: Part| picture.links.iter().position(|l| l.name == part.name());
    let handles = joints(machine).into_iter().filter_map(|(part, handle)| {
        let link = link(part)?;
        Some(Handle { link, ..handle })
    });
    picture.handles = handles.collect();
    picture
}

/// A point of each part that stands for one of the linkage's numbers.
fn joints(machine: &Feeder) -> [(Part, Handle); 6] {
    let spec = &machine.design().linkage;
    let handle = |name: &str, plane, keys: [&str; 2], values, scale| Handle {
        name: name.into(),
        link: 0,
        plane,
        keys: keys.map(|key| match key {
            "" => String::new(),
            key => format!("linkage.{key}"),
        }),
        values,
        scale,
        origin: [0.0; 2],
        chained: false,
    };
    // A length reaches along its own link, at whatever angle that stands.
    let reach = |name, key, length, scale| {
        handle(name, HandlePlane::Polar, [key, ""], [length, 0.0], scale)
    };
    let place = |name, keys, values| handle(name, HandlePlane::Cartesian, keys, values, 1.0);
    [
        (
            Part::Frame,
            place("axis of the rocker", ["frame", ""], [spec.frame, 0.0]),
        ),
        (
            Part::Crank,
            reach("end of the crank", "crank", spec.crank, 1.0),
        ),
        // Both end in one joint: each is held in its middle.
        (
            Part::Coupler,
            reach("middle of the coupler", "coupler", spec.coupler, 0.5),
        ),
        (
            Part::Rocker,
            reach("middle of the rocker", "rocker", spec.rocker, 0.5),
        ),
        (
            Part::Effector,
            reach(
                "tip of the effector",
                "effector_length",
                spec.effector_length,
                1.0,
            ),
        ),
        // On top: a coupler that passes over it must not keep it from being reached.
        (
            Part::Frame,
            place(
                "pivot of the effector",
                ["pivot[0]", "pivot[1]"],
                spec.pivot,
            ),
        ),
    ]
}
