use super::ThreeArmPart;
use super::machine::{PASSING, Parts};
use crate::{fit, gear_pair, turned};
use centrode_formats::sheet::number;
use centrode_gear::Member;
use centrode_gear::design::BodySpec;
use centrode_geometry::Point;
use centrode_kinematics::machine::{self, Axis, Callout, Datum, Dimension, Fit};
use centrode_machines::three_arm::ThreeArm;

/// Lists the parts and fills the arrangement: the mechanism while its first arm picks.
pub(super) fn annotate(parts: &Parts<'_>, machine: &mut machine::LinkedMachine) {
    let mechanism = parts.mechanism;
    for part in ThreeArmPart::ALL {
        if part != ThreeArmPart::Assembly {
            list(parts, part, machine);
        }
    }
    for fit in parts.fits() {
        machine.fit(fit);
    }
    turned::list(&parts.turned(), machine);
    given(parts, machine);
    let carrier = machine.place_on("carrier", [0.0; 2]);
    let stated = &mut machine.arrangement;
    stated
        .seen_through
        .extend(carrier.map(|place| place.figure));
    stated.title = ThreeArmPart::Assembly.title().into();
    stated.drawing = mechanism.design().drawing.clone();
    stated.input = mechanism.picking(0);
    stated.data = data(parts);
    stated.notes = [
        "Shown as arm I picks; arms II and III follow it.",
        "Gears seen through the front plate of the carrier.",
        "Tooth k of the sun or of a planet gear runs in space k - 1 of an intermediate gear.",
        "Dash-dotted: pitch curves, path of the tips.",
        "Springs: bought, not listed.",
    ]
    .map(String::from)
    .into();
    surroundings(mechanism, machine);
}

/// Lists the customer's parts that hold sun, cams and arms; the remark states the sizes that they must fit.
fn given(parts: &Parts<'_>, machine: &mut machine::LinkedMachine) {
    let design = parts.mechanism.design();
    let on_shaft = |body: &BodySpec| (body.bore > 0.0).then(|| fit::shaft(&body.seat("")));
    let cam = parts.pusher.cam().body();
    // Heights above the outer face of the carrier's front plate.
    let [[rear, _], [_, front]] = parts.gearbox.spans;
    let level = parts.mechanism.arm_level() - front;
    let [_, cam_end] = parts.pusher.cam_span();
    let cover = parts
        .of_arm("cover-front")
        .map_or(0.0, |cover| cover.span[1]);
    let [of_sleeve, of_hub] = [cam_end, cover].map(|z| number(level + z, 3));
    let shaft = parts.mechanism.carrier_shaft();
    let behind = shaft.and_then(|shaft| Some(rear - shaft.pieces.first()?.at[2]));
    let behind = number(behind.unwrap_or_default(), 3);
    let bore = Fit::new("", parts.mechanism.arm_sizes().housing.bore, PASSING);
    let in_cover = match bore.size > 0.0 {
        true => format!(", in the front cover {}", fit::shaft(&bore)),
        false => String::new(),
    };
    let inside = number(design.planet.bore, 4);
    let apart = number(parts.mechanism.arm_sizes().clamp.opening, 3);
    let links = |part| links(part, parts.mechanism.arms(), machine);
    let base = machine.link_named("base").into_iter().collect();
    let all = [
        (
            "Stand",
            base,
            on_shaft(&design.sun).map(|shaft| {
                format!("holds the carrier's shaft, {shaft}, {behind} long, up to the rear plate")
            }),
        ),
        (
            "Sleeve of a cam",
            links(ThreeArmPart::Cam),
            on_shaft(cam).map(|seat| {
                format!("{seat}, clear of Ø{inside} inside, {of_sleeve} long from the front plate, fixed to it and to the cam")
            }),
        ),
        (
            "Hub of an arm",
            links(ThreeArmPart::CoverFront),
            on_shaft(&design.planet).map(|shaft| {
                format!("on the planet's shaft, {shaft}, from {of_sleeve} to {of_hub} before the front plate{in_cover}, fixed to both")
            }),
        ),
        (
            "Seat of a clamp",
            links(ThreeArmPart::CoverFront),
            parts.of_arm("flake-left").map(|_| {
                format!("holds the roots of two flakes {apart} apart in the housing's front wall, which it goes through")
            }),
        ),
    ];
    for (name, links, remark) in all {
        if let Some(remark) = remark {
            machine.part(machine::Part::given(name, links, remark));
        }
    }
}

/// Adds dimensions and callouts of tray, ground and plants.
fn surroundings(mechanism: &ThreeArm, machine: &mut machine::LinkedMachine) {
    let on =
        |machine: &machine::LinkedMachine, at: Point| machine.place_on("machine", at.coords.into());
    let tip = mechanism.tip(mechanism.picking(0), 0).position;
    let ground = Point::new(0.0, mechanism.ground());
    let origin = on(machine, Point::origin());
    let seedlings = ["planted seedling 1", "planted seedling 2"];
    let dimensions = [
        (origin, on(machine, tip), Axis::X),
        (origin, on(machine, ground), Axis::Y),
        (
            machine.place_on(seedlings[0], [0.0; 2]),
            machine.place_on(seedlings[1], [0.0; 2]),
            Axis::X,
        ),
    ];
    for (from, to, along) in dimensions {
        if let (Some(from), Some(to)) = (from, to) {
            let ends = [from, to];
            machine
                .arrangement
                .dimensions
                .push(Dimension { ends, along });
        }
    }
    let tray = mechanism.tray_body().place * Point::new(0.0, mechanism.design().tray.hole_spacing);
    let words = [("ground", ground), ("surface of the tray", tray)];
    for (words, at) in words {
        if let Some(place) = on(machine, at) {
            let words = vec![words.into()];
            machine.arrangement.callouts.push(Callout { place, words });
        }
    }
}

/// Links that carry the pieces of a part.
pub(super) fn links(part: ThreeArmPart, arms: u32, machine: &machine::LinkedMachine) -> Vec<usize> {
    let chains = |name: &str, each: usize| {
        let names = (0..arms).flat_map(|k| std::iter::repeat_n(format!("{name}_{k}"), each));
        names.filter_map(|name| machine.link_named(&name)).collect()
    };
    let alone = |name: &str, count: usize| {
        let link = machine.link_named(name);
        link.into_iter().cycle().take(count).collect()
    };
    match part {
        ThreeArmPart::Assembly => Vec::new(),
        ThreeArmPart::Sun => alone("sun", 1),
        ThreeArmPart::Carrier => alone("carrier", 2),
        ThreeArmPart::Spacer => alone("carrier", part.quantity(arms) as usize),
        ThreeArmPart::Intermediate => chains("intermediate", 1),
        ThreeArmPart::Planet => chains("planet", 1),
        ThreeArmPart::Cam => chains("cam", 1),
        ThreeArmPart::Fork | ThreeArmPart::Roller => chains("fork", 1),
        ThreeArmPart::Housing | ThreeArmPart::CoverRear | ThreeArmPart::CoverFront => {
            chains("arm", 1)
        }
        ThreeArmPart::Clamp => chains("arm", 2),
        ThreeArmPart::PushRod => chains("push_rod", 1),
    }
}

/// Lists a part; its number points to a piece on an arm where the other numbers have room.
fn list(parts: &Parts<'_>, part: ThreeArmPart, machine: &mut machine::LinkedMachine) {
    let arms = parts.mechanism.arms();
    let links = links(part, arms, machine);
    let arm = |name: &str, k: u32| format!("{name} {}", k % arms + 1);
    if let Some((pair, member)) = parts.gear(part) {
        let figure = match part {
            ThreeArmPart::Sun => "sun".into(),
            ThreeArmPart::Intermediate => arm("intermediate gear", 1),
            _ => arm("planet", 2),
        };
        let (gear, title, file) = (pair.gear(member), part.title(), part.name());
        return gear_pair::list(machine, gear, title, file, &figure, links);
    }
    let Some(plate) = parts.plate_of(part) else {
        return;
    };
    let edge = |machine: &machine::LinkedMachine, figure: String| {
        machine.place_on_edge(&figure, &plate.outline)
    };
    let place = match part {
        ThreeArmPart::Cam => edge(machine, arm("cam", 1)),
        ThreeArmPart::Fork => edge(machine, arm("fork", 2)),
        ThreeArmPart::Roller => {
            let spec = parts.pusher.fork_spec();
            let rim = [spec.arm_length + spec.roller_radius, 0.0];
            machine.place_on(&arm("fork", 0), rim)
        }
        ThreeArmPart::Carrier => edge(machine, "carrier".into()),
        // The covers have the contour of the housing.
        ThreeArmPart::Housing | ThreeArmPart::CoverRear | ThreeArmPart::CoverFront => {
            let wall = parts.of_arm("housing").map(|part| &part.outline);
            wall.and_then(|wall| machine.place_on_edge(&arm("arm", 1), wall))
        }
        ThreeArmPart::Clamp => edge(machine, arm("arm", 2)),
        ThreeArmPart::PushRod => edge(machine, arm("push rod", 0)),
        _ => None,
    };
    machine.part(machine::Part {
        remark: format!("{} thick", number(plate.thickness, 3)),
        place,
        ..plate.listed(links)
    });
}

fn data(parts: &Parts<'_>) -> Vec<Datum> {
    let mechanism = parts.mechanism;
    let design = mechanism.design();
    let number = |x: f64| number(x, 2);
    let degrees = |angle: f64| format!("{}°", number(angle.to_degrees()));
    let teeth = parts.pairs[0].gear(Member::Driver).tooth_count();
    let [planted, picked] = [mechanism.planting(0), mechanism.picking(0)].map(degrees);
    [
        ("centre distance", "a", number(mechanism.center_distance())),
        ("teeth of every gear", "z", teeth.to_string()),
        ("module", "m", number(parts.pairs[0].module())),
        ("bend", "γ0", degrees(design.bend)),
        (
            "arm's mounting angle",
            "β0",
            degrees(design.arm.mounting_angle),
        ),
        (
            "tip from the planet's axis",
            "S",
            number(design.arm.tip_distance),
        ),
        (
            "pusher's axis from it",
            "H1",
            number(design.arm.pusher_offset),
        ),
        (
            "gearbox sweeps a radius of",
            "",
            number(mechanism.gearbox_radius()),
        ),
        ("arms pick at a carrier turn of", "", picked),
        ("and plant at", "", planted),
        (
            "seedlings per minute",
            "",
            number(design.work.rate_per_minute),
        ),
        ("plants apart", "", number(design.work.plant_spacing)),
        (
            "holes of the tray apart",
            "",
            number(design.tray.hole_spacing),
        ),
    ]
    .map(|(name, symbol, value)| Datum::new(name, symbol, value))
    .into()
}
