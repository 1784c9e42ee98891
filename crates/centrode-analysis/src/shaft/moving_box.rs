use centrode_gear::GearPair;
use centrode_geometry::{extremes, maximum};
use centrode_groove::{EllipticDrive, MovingBox};
use centrode_kinematics::machine::Key;
use centrode_kinematics::transmission::Transmission;

use super::{check_shaft, contact, contact_limit, moved, tables};
use crate::key_pressure::LoadedKey;
use crate::{Finding, Report, Severity, Unit, gear_pair};

/// Checks a moving box: its shaft, and the motion that its drive gives to it. Figures of the box begin with `box_`; the others
/// are those of the shaft at constant speed.
#[must_use]
pub fn check_moving_box(machine: &MovingBox) -> Report {
    let mut report = check_shaft(machine.shaft());
    report.findings.retain(|f| f.rule != "moved-distance");
    let forces = std::mem::take(&mut report.tables);
    report.tables = tables::schemes(machine);
    report.tables.extend(forces);
    let (moves, picks) = (machine.moved_in_window(), machine.schedule());
    moved(machine.shaft(), moves, &picks, &mut report);
    let Some(drive) = machine.drive() else {
        report.worst_first();
        return report;
    };
    seat(machine, &mut report);
    gears(machine, drive, &mut report);
    let values = &mut report.values;
    values.insert("gear_eccentricity", drive.eccentricity);
    let k = drive.eccentricity;
    values.insert("shaft_speed_ratio_min", (1.0 - k) / (1.0 + k));
    values.insert("shaft_speed_ratio_max", (1.0 + k) / (1.0 - k));
    values.insert("box_moved_distance", machine.moved_in_window());
    let load = machine.shaft().load();
    let mean = machine.shaft().law().mean_speed();
    let ends = machine.stroke_pieces();
    let over = |of: &dyn Fn(f64) -> f64| extremes(of, &ends).map(|extreme| extreme.value);
    let [slow, fast] = over(&|input| machine.stroke_at(input).velocity / mean);
    values.insert("box_speed_ratio_min", slow);
    values.insert("box_speed_ratio_max", fast);
    let [braking, speeding] = over(&|input| machine.stroke_at(input).acceleration);
    values.insert("box_acceleration_max", speeding.max(-braking));
    let metres = 1e-3 * load.speed() * load.speed();
    values.insert("box_acceleration_max_m_s2", metres * speeding.max(-braking));
    let limit = contact_limit(machine.shaft(), -braking);
    values.insert("box_contact_limit_rpm", limit);
    let radius = machine.shaft().groove().radius();
    let [minimum, maximum] = over(&|input| {
        let turn = machine.shaft_turn(input).position;
        let lead = (machine.shaft().law().at(turn).velocity / radius).atan();
        load.force(machine.stroke_at(input), lead, radius).normal
    });
    values.insert("box_normal_force_min", minimum);
    values.insert("box_normal_force_max", maximum);
    report.findings.retain(|f| f.rule != "contact-lost");
    contact(limit, load.speed_rpm, &mut report);
    keys(machine, drive, &mut report);
    report.worst_first();
    report
}

/// Reports the pressure on the keys of both gears at the maximum torques that the box requires, and the keys that are
/// overloaded. This replaces the pressure for the shaft at constant speed.
fn keys(machine: &MovingBox, drive: &EllipticDrive, report: &mut Report) {
    let Some(design) = machine.design().gear_pair(drive) else {
        return;
    };
    let shaft = machine.shaft();
    let radius = shaft.groove().radius();
    let torque = |input: f64| {
        let turn = machine.shaft_turn(input);
        let lead = (shaft.law().at(turn.position).velocity / radius).atan();
        let force = shaft.load().force(machine.stroke_at(input), lead, radius);
        (force.torque, turn.velocity)
    };
    let ends = machine.stroke_pieces();
    let of_shaft = maximum(|input| torque(input).0.abs(), &ends);
    // The gears transmit power without loss.
    let of_driver = maximum(
        |input| {
            let (torque, ratio) = torque(input);
            (torque * ratio).abs()
        },
        &ends,
    );
    report.values.insert("box_torque_max", of_shaft.value);
    let at_even_speed =
        |f: &Finding| f.rule == "key-pressure" && f.place.part.as_deref() == Some("shaft");
    report.findings.retain(|f| !at_even_speed(f));
    // The key of the journal is that of the driven gear.
    report.values.remove("key_pressure_max");
    for (part, figure, body, torque) in [
        (
            "driver",
            "driver_key_pressure_max",
            &design.driver,
            of_driver,
        ),
        (
            "driven",
            "driven_key_pressure_max",
            &design.driven,
            of_shaft,
        ),
    ] {
        let key = body
            .keyway
            .and_then(|hub| Some((hub, Key::fitting(hub, body.width)?)));
        let Some((hub, key)) = key else {
            continue;
        };
        let loaded = LoadedKey {
            key,
            hub,
            face: body.width,
            diameter: body.bore,
            materials: match part {
                "driven" => &[&body.material, &shaft.body().material],
                // The driver's shaft is the customer's.
                _ => &[&body.material],
            },
            torque,
            part,
        };
        report.values.insert(figure, loaded.pressure());
        loaded.check(report);
    }
}

/// Reports the findings of the gears, or that none can be cut.
fn gears(machine: &MovingBox, drive: &EllipticDrive, report: &mut Report) {
    let Some(design) = machine.design().gear_pair(drive) else {
        return;
    };
    match GearPair::resolve(&design) {
        Ok(pair) => report.findings.extend(gear_pair::check(&pair).findings),
        Err(error) => Finding::new(
            "no-gears",
            Severity::Error,
            format!("no gears can be cut: {}: {error}", error.key()),
        )
        .on("gears")
        .add_to(report),
    }
}

/// Reports gears with a given bore that differs from the diameter of their journal.
fn seat(machine: &MovingBox, report: &mut Report) {
    let Some(gears) = &machine.design().gears else {
        return;
    };
    let (bore, journal) = (gears.body.bore, machine.shaft().body().journal_diameter);
    if bore == 0.0 || bore == journal {
        return;
    }
    let message = format!(
        "the driven gear's bore of {bore} mm does not fit the shaft's journal of {journal} mm"
    );
    Finding::new("gear-seat", Severity::Error, message)
        .measured(bore, journal, Unit::Millimetre)
        .remedy("omit gears.body.bore, or change shaft.body.journal_diameter")
        .on("gears")
        .add_to(report);
}
