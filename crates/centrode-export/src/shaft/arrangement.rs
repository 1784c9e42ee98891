use super::figures;
use super::links::{BOX, GEARS};
use super::machine::Parts;
use super::sheets::data;
use crate::{ExportError, fit, gear_pair, turned};
use centrode_formats::sheet::number;
use centrode_gear::Member;
use centrode_groove::ShaftSolid;
use centrode_kinematics::machine::{Axis, Blank, Datum, Dimension, LinkedMachine, Part};
use std::f64::consts::TAU;

/// Lists shaft, slider, box and gears with their masses, and fills the arrangement: the groove unrolled, the slider in it.
pub(super) fn annotate(parts: &Parts<'_>, machine: &mut LinkedMachine) -> Result<(), ExportError> {
    list(parts, machine)?;
    let shaft = parts.shaft;
    let stated = &mut machine.arrangement;
    stated.title = if parts.gears.is_some() {
        "Moving box"
    } else {
        "Spiral shaft with box"
    }
    .into();
    stated.drawing = shaft.drawing().clone();
    stated.notes = [
        "Surface of the shaft unrolled, seen from outside, its lower edge at 360°.",
        "Above it the box in its rows of holes, drawn next to the shaft.",
        "Slider and box where the cycle begins; thin: edges of the groove,",
        "and of the window in which a seedling is picked.",
    ]
    .map(String::from)
    .into();
    let rows = data(shaft).rows.into_iter();
    let datum = |row: Vec<String>| match &row[..] {
        [name, symbol, value] => Some(Datum::new(name, symbol, value)),
        _ => None,
    };
    stated.data = rows.filter_map(datum).collect();
    let solid = ShaftSolid::new(shaft.groove(), shaft.body())?;
    let [near, far] = solid.whole();
    stated
        .data
        .push(Datum::new("Shaft over all, mm", "", number(far - near, 3)));
    if let Some(gears) = &parts.gears {
        stated
            .notes
            .push("Gears on the near end, seen along the shaft, drawn left of it.".into());
        stated.data.extend(gear_pair::of_both(&gears.pair, None));
    }
    let ([low, high], (first, last)) = (solid.ends(), shaft.traverse().reach());
    let around = -TAU * shaft.groove().radius();
    let dimensions = [
        ([[first, around], [last, around]], Axis::X),
        ([[low, around], [high, around]], Axis::X),
        ([[high, around], [high, 0.0]], Axis::Y),
    ];
    for (ends, along) in dimensions {
        if let [Some(from), Some(to)] = ends.map(|at| machine.place_on("shaft", at)) {
            let ends = [from, to];
            machine
                .arrangement
                .dimensions
                .push(Dimension { ends, along });
        }
    }
    Ok(())
}

fn list(parts: &Parts<'_>, machine: &mut LinkedMachine) -> Result<(), ExportError> {
    let shaft = parts.shaft;
    let (slider, body) = (shaft.slider(), shaft.body());
    let weight =
        |machine: &LinkedMachine, link: usize| machine.links[link].mass.map(|mass| mass.mass);
    let [turned, carriage, slid] =
        ["shaft", BOX, "slider"].map(|name| machine.link_named(name).unwrap_or(0));
    let solid = ShaftSolid::new(shaft.groove(), body)?;
    let ([low, _], [near, far]) = (solid.ends(), solid.whole());
    machine.part(Part {
        name: "Spiral shaft".into(),
        links: vec![turned],
        material: body.material.clone(),
        blank: Some(Blank::Round {
            diameter: 2.0 * shaft.groove().radius(),
            length: far - near,
        }),
        mass: weight(machine, turned),
        file: "shaft".into(),
        place: machine.place_on("shaft", [low, -0.25 * TAU * shaft.groove().radius()]),
        ..Part::default()
    });
    machine.part(Part {
        name: "Slider".into(),
        links: vec![slid],
        material: slider.material.clone(),
        blank: Blank::plate(&slider.outline(shaft.groove().width()), slider.reach),
        mass: weight(machine, slid),
        file: "slider".into(),
        remark: format!("{} long", number(slider.length, 3)),
        place: machine.place_on_edge("slider", &slider.outline(shaft.groove().width())),
        ..Part::default()
    });
    let pin = shaft.pin(BOX);
    let of_pin = pin.part.mass().unwrap_or_default();
    let in_box = format!(
        "all that is moved but slider and pin, takes the pin, {}, over {}",
        fit::shaft(&pin.fit),
        number(pin.part.length() - slider.reach, 3)
    );
    turned::list(std::slice::from_ref(&pin), machine);
    machine.fit(pin.fit);
    machine.part(Part {
        mass: weight(machine, carriage).map(|mass| mass - of_pin),
        place: machine.place_on("box", figures::corner(shaft).coords.into()),
        ..Part::given("Box with its rail", vec![carriage], in_box)
    });
    if let Some(gears) = &parts.gears {
        // The driven gear sits on the grooved shaft.
        gear_pair::list_pair(&gears.pair, GEARS, &[Member::Driver], machine);
        let body = gears.pair.gear(Member::Driven).body();
        gear_pair::list_keys(machine, body, vec![turned]);
    }
    Ok(())
}
