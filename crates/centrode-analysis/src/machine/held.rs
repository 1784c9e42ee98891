//! Parts that nothing holds, and shafts that are held at one end, of machines with full hardware.

use std::f64::consts::PI;

use centrode_kinematics::machine::allowed_pressure;
use centrode_machines::machine::{Hardware, Hold, Machine, Overhang};

use crate::rounding::exceeds;
use crate::{Finding, Report, Severity, Unit};

/// Number of retaining rings that hold the parts on a pin or shaft, one at each end.
const RINGS: usize = 2;

/// Checks that rings and keys hold every part, and that overhung shafts, held in the frame at one end only, can take the
/// forces of `report`.
pub(super) fn held(composed: &Machine, report: &mut Report) {
    if composed.design().hardware() != Hardware::Full {
        return;
    }
    let finding = |part: &str, severity: Severity, message: String| {
        Finding::new("not-held", severity, message).on(part)
    };
    for pieces in composed.turned_in_plates() {
        let rings = pieces.part.steps.iter();
        let rings = rings.filter(|step| step.ring.is_some()).count();
        if rings < RINGS {
            let name = &pieces.part.name;
            let found = match rings {
                0 => "no retaining ring",
                _ => "one retaining ring",
            };
            let message = format!("{name} has room for {found}: the parts on it can slide off");
            report.findings.push(
                finding(name, Severity::Error, message)
                    .measured(rings as f64, RINGS as f64, Unit::Count)
                    .remedy("a wider plates.gap, another layer, or a diameter of DIN 471"),
            );
        }
    }
    for shaft in composed.shafts() {
        for part in &shaft.parts {
            let (why, remedy) = match part.hold {
                Hold::Given => (
                    "without a key",
                    "a gear or cam with a keyway, or plates.pin_diameter of 6 mm or more",
                ),
                Hold::Loose => (
                    "but its bore or keyway differs from that of the shaft",
                    "the bore and keyway of the first gear on the shaft",
                ),
                _ => continue,
            };
            let message = format!("{} turns with the shaft of {} {why}", part.name, shaft.name);
            report
                .findings
                .push(finding(&part.name, Severity::Error, message).remedy(remedy));
        }
    }
    let mut maximum: Option<f64> = None;
    for overhang in composed.overhangs() {
        let Some(force) = force(composed, &overhang, report) else {
            continue;
        };
        let stress = stress(&overhang, force);
        maximum = Some(maximum.map_or(stress, |known| known.max(stress)));
        let Overhang {
            name,
            length,
            arm,
            materials,
            ..
        } = &overhang;
        let allowed = materials.iter().map(|material| allowed_pressure(material));
        let allowed = allowed.collect::<Option<Vec<f64>>>();
        let allowed = allowed.map(|all| all.into_iter().fold(f64::INFINITY, f64::min));
        let overhung = format!(
            "{name} is held at one end only, over {length:.3} mm of the frame, with the load {arm:.3} mm away: {force:.3} N causes a stress of {stress:.3} N/mm²"
        );
        let (severity, message) = match allowed {
            Some(allowed) if !exceeds(stress, allowed) => continue,
            Some(allowed) => (
                Severity::Error,
                format!("{overhung}; {allowed:.1} N/mm² is allowed"),
            ),
            None => {
                let materials = materials.join(" and ");
                let message = format!("{overhung}; the strength of {materials} is not known");
                (Severity::Note, message)
            }
        };
        Finding::new("overhung", severity, message)
            .measured(stress, allowed, Unit::NewtonPerSquareMillimetre)
            .remedy("a thicker frame, a wider shaft, or a layer nearer to the frame")
            .on(name)
            .add_to(report);
    }
    report
        .values
        .extend(maximum.map(|stress| ("overhung_stress_max", stress)));
}

/// Sum of the maximum forces that the bodies on an axis exert on the frame, N; `None` if they are not determined.
fn force(composed: &Machine, overhang: &Overhang, report: &Report) -> Option<f64> {
    let mut tables = report.tables.iter();
    let forces = tables.find(|table| table.name == "joint-forces")?;
    let of = |body: &usize| {
        let name = &composed.bodies()[*body].name;
        let row = forces.rows.iter().find(|(joint, _)| joint == name)?;
        row.1.first().copied()
    };
    overhang.bodies.iter().map(of).sum()
}

/// Maximum stress of a shaft that is held over one part of its length and loaded beyond that part, N/mm²: the larger one of
/// the pressure at the edge of the bore, F/(d l) (1 + 6 e/l), and the bending stress, 32 F e/(pi d^3).
///
/// The pressure is assumed to vary linearly along the bore; e is the distance of the load from the middle of the bore.
fn stress(overhang: &Overhang, force: f64) -> f64 {
    let &Overhang {
        diameter,
        length,
        arm,
        ..
    } = overhang;
    let pressure = force / (diameter * length) * (1.0 + 6.0 * arm / length);
    let bending = 32.0 * force * arm / (PI * diameter.powi(3));
    pressure.max(bending)
}
