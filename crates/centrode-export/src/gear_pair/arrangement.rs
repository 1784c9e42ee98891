use crate::fit;
use crate::grade::grade;
use crate::number::range;
use centrode_formats::sheet::number;
use centrode_gear::design::BodySpec;
use centrode_gear::{Gear, GearPair, Member};
use centrode_kinematics::machine::{Blank, Callout, Datum, Key, LinkedMachine, Part};

/// Material of keys; their mass belongs to the link of the shaft, which the customer provides.
const KEY: &str = "steel";

/// Findings of an analysis of the contact, for the tables of sheets: minimum and maximum number of pairs of teeth in contact,
/// minimum and maximum backlash along the common normal, mm.
#[must_use]
pub fn contact_data(contact_ratio: [f64; 2], backlash: [f64; 2]) -> Vec<Datum> {
    vec![
        Datum::new("Backlash, as checked, normal", "jn", range(backlash, 4)),
        Datum::new("Pairs of teeth in contact", "", range(contact_ratio, 0)),
    ]
}

/// Lists the gears and fills the pair's arrangement.
pub(super) fn annotate(pair: &GearPair, machine: &mut LinkedMachine) {
    list_pair(pair, "", &[Member::Driver, Member::Driven], machine);
    let stated = &mut machine.arrangement;
    stated.title = "Gear pair".into();
    stated.drawing = pair.drawing().clone();
    stated.data = data(pair);
    stated.columns = vec![0, 1, 2];
    stated.notes = [
        "Shown at φ = 0: pitch point on the line of centres.",
        "φ is the polar angle of the pitch point on the driver;",
        "the driver has then turned clockwise by φ,",
        "the driven gear counter-clockwise by the angle of the table.",
        "Driver tooth k runs in driven space k - 1,",
        "driven tooth k in driver space k.",
    ]
    .map(String::from)
    .into();
    if pair.driver().tooth_count() != pair.driven().tooth_count() {
        stated
            .notes
            .push("Teeth and spaces are counted on through the turns.".into());
    }
    let last = pair.driven().tooth_count() - 1;
    let first = [
        (
            Member::Driver,
            "driver tooth 0",
            format!("in driven space {last}"),
        ),
        (Member::Driven, "driven tooth 0", "in driver space 0".into()),
    ];
    for (member, tooth, space) in first {
        let at = first_tooth(pair, member);
        if let Some(place) = machine.place_on(member.name(), at) {
            let words = vec![tooth.into(), space];
            machine.arrangement.callouts.push(Callout { place, words });
        }
    }
}

/// Lists both gears of a pair, with the prefix before the names of their files, then the shafts of the gears in `shafts`.
pub(crate) fn list_pair(
    pair: &GearPair,
    prefix: &str,
    shafts: &[Member],
    machine: &mut LinkedMachine,
) {
    let links =
        |machine: &LinkedMachine, member: Member| Vec::from_iter(machine.link_named(member.name()));
    for (member, name) in [
        (Member::Driver, "Driver gear"),
        (Member::Driven, "Driven gear"),
    ] {
        let (file, links) = (format!("{prefix}{}", member.name()), links(machine, member));
        let gear = pair.gear(member);
        list(machine, gear, name, &file, member.name(), links);
    }
    for &member in shafts {
        let (name, links) = (
            format!("Shaft of the {} gear", member.name()),
            links(machine, member),
        );
        list_shafts(machine, pair.gear(member), &name, links);
    }
}

/// Lists a gear: its name, the name of its files, the figure that shows it.
pub(crate) fn list(
    machine: &mut LinkedMachine,
    gear: &Gear,
    name: &str,
    file: &str,
    figure: &str,
    links: Vec<usize>,
) {
    machine.part(Part {
        name: name.into(),
        links,
        material: gear.body().material.clone(),
        blank: Blank::round(gear.outline(), gear.body().width),
        mass: Some(mass(gear)),
        file: file.into(),
        remark: format!("{} teeth", gear.tooth_count()),
        place: machine.place_on_edge(figure, gear.outline()),
        ..Part::default()
    });
}

/// Lists the keys of a body, one for each of the links, where a standard one fits its keyway.
pub(crate) fn list_keys(machine: &mut LinkedMachine, body: &BodySpec, links: Vec<usize>) {
    let key = body.keyway.and_then(|hub| Key::fitting(hub, body.width));
    if let Some(key) = key {
        machine.part(Part {
            material: KEY.into(),
            ..Part::bought(key.name(), links)
        });
    }
}

/// Lists the shafts in the bores of gears, one for each of the links. They belong to the machine around the gears: its bearings
/// determine their lengths.
fn list_shafts(machine: &mut LinkedMachine, gear: &Gear, name: &str, links: Vec<usize>) {
    if gear.body().bore > 0.0 && !links.is_empty() {
        let body = gear.body();
        let fit = body.seat(name);
        machine.part(Part::given(name, links.clone(), fit::shaft(&fit)));
        machine.fit(fit);
        list_keys(machine, body, links);
    }
}

/// Mass of a gear, kg.
pub(super) fn mass(gear: &Gear) -> f64 {
    let body = gear.body();
    let bore = gear.bore().map_or(0.0, |bore| bore.area());
    let volume = (gear.outline().area() - bore) * body.width;
    volume * body.density * 1e-9
}

/// Middle of the first tooth half its addendum above the pitch curve, in the gear's frame.
fn first_tooth(pair: &GearPair, member: Member) -> [f64; 2] {
    let frame = super::sheets::middle(pair, member, 0.0);
    let at = frame.point + frame.normal * (0.5 * pair.teeth().tool(member).addendum);
    at.coords.into()
}

/// Data of the pair.
fn data(pair: &GearPair) -> Vec<Datum> {
    let [z1, z2] = [pair.driver(), pair.driven()].map(|gear| gear.tooth_count());
    let degrees = pair.teeth().pressure_angle().to_degrees();
    let mut data = vec![
        Datum::new("Number of teeth", "z1 / z2", format!("{z1} / {z2}")),
        Datum::new("Module", "m", number(pair.module(), 6)),
        Datum::new("Pressure angle", "α", format!("{}°", number(degrees, 4))),
        Datum::new("Driver's pitch curve", "", pair.definition()),
    ];
    data.extend(of_both(pair, None));
    let radius = number(pair.rolling().radius(0.0), 6);
    data.push(Datum::new("Pitch point at φ = 0, from driver", "r", radius));
    let ratio = number(pair.ratio(0.0).recip(), 6);
    data.push(Datum::new("Ratio at φ = 0", "i", ratio));
    data
}

/// Data that both gears have in common.
pub(crate) fn of_both(pair: &GearPair, of: Option<Member>) -> Vec<Datum> {
    let (driver, driven) = pair.mean_ratio();
    let a = pair.center_distance();
    let (minimum, maximum) = pair.rolling().radii(Member::Driver);
    let [low, high] = [a / maximum - 1.0, a / minimum - 1.0];
    // In a machine of several meshes either gear may drive the other.
    let (gears, turns, ratios) = match of {
        None => ("driver : driven", [driver, driven], [low, high]),
        Some(Member::Driver) => ("this gear : mate", [driver, driven], [low, high]),
        Some(Member::Driven) => {
            let inverse = [high.recip(), low.recip()];
            ("this gear : mate", [driven, driver], inverse)
        }
    };
    let turns = format!("{}:{}", turns[0], turns[1]);
    let mut data = vec![
        Datum::new(&format!("Mean ratio, turns {gears}"), "", turns),
        Datum::new(&format!("Ratio, {gears} speed"), "i", range(ratios, 6)),
        Datum::new("Centre distance", "a", number(a, 6)),
        Datum::new(
            "Backlash, as designed, normal",
            "jn",
            number(pair.backlash(), 4),
        ),
    ];
    data.extend(by_thickness(pair, pair.backlash()));
    data
}

/// Half of the decrease of the centre distance that the normal backlash of a pair permits, mm; `None` if the pair has
/// no backlash.
pub(crate) fn half_backlash(pair: &GearPair, backlash: f64) -> Option<f64> {
    let [minimum, _] = pair.backlash_limits(backlash);
    (minimum > 0.0).then(|| 0.5 * shorter(pair, minimum))
}

/// Decrease of the centre distance that a normal backlash permits, mm.
fn shorter(pair: &GearPair, backlash: f64) -> f64 {
    // A shorter distance reduces the backlash most where the pitch curves are normal to the line of centres: there by twice its
    // component normal to a flank.
    backlash / (2.0 * pair.pressure_angle().sin())
}

/// Centre distance with the tolerance that the normal backlash of a pair (mm) permits; with deviations of tooth thickness also
/// the limits of the backlash and the minimum centre distance.
pub(crate) fn by_thickness(pair: &GearPair, backlash: f64) -> Vec<Datum> {
    let (a, mut data) = (pair.center_distance(), Vec::new());
    if let Some(half) = half_backlash(pair, backlash) {
        let within = format!("{} ±{}", number(a, 4), number(half, 3));
        let name = "Centre distance, by half the backlash";
        data.push(Datum::new(name, "a", within));
    } else if let Some(width) = grade(a, "H8") {
        let within = format!("{} +{} / 0", number(a, 4), number(width, 3));
        let name = "Centre distance, no backlash to give";
        data.push(Datum::new(name, "a", within));
    }
    let stated = [Member::Driver, Member::Driven].map(|member| pair.thickness_deviations(member));
    if stated == [None; 2] {
        return data;
    }
    let limits = pair.backlash_limits(backlash);
    data.extend([
        Datum::new("Backlash by thickness, normal", "jn", range(limits, 4)),
        Datum::new(
            "Centre distance, minimum by backlash",
            "a",
            number(a - shorter(pair, limits[0]), 4),
        ),
    ]);
    data
}
