use centrode_mechanism::cam::Cam;

use crate::drawing::Anchor;
use crate::plate::Plate;
use crate::sheet::Table;

/// Step of the table of the profile, degrees.
const STEP: u32 = 5;

/// A cam as a plate, with its profile by cam angle; in a machine that has so many of it.
pub(crate) fn plate(cam: &Cam, [name, title]: [&str; 2], quantity: usize) -> Plate {
    let (body, disc) = (cam.body(), cam.disc());
    let base = format!("Base radius {:.4} mm", disc.base_radius());
    let follower = match disc.follower().roller_radius() {
        Some(radius) => format!("{base}, roller Ø{:.3}.", 2.0 * radius),
        None => format!("{base}, flat face."),
    };
    let outline = cam.profile().outline().clone();
    Plate {
        quantity,
        notes: vec![
            format!("Exact profile: {name}.step, points {name}.csv."),
            follower,
        ],
        tables: vec![profile(cam, name)],
        ..Plate::of_body([name, title], outline, cam.bore(), body)
    }
}

/// The profile by cam angle.
fn profile(cam: &Cam, name: &str) -> Table {
    let disc = cam.disc();
    // A follower that swings moves in degrees.
    let (lift, scale) = match disc.follower().swings() {
        true => ("follower °", 1.0_f64.to_degrees()),
        false => ("lift", 1.0),
    };
    let rows = (0..360 / STEP).map(|i| {
        let degrees = f64::from(STEP * i);
        let contact = disc.contact(degrees.to_radians());
        let at = contact.point;
        let polar = at.y.atan2(at.x).to_degrees().rem_euclid(360.0);
        vec![
            format!("{degrees:.0}"),
            format!("{polar:.3}"),
            format!("{:.4}", at.coords.norm()),
            format!("{:.4}", scale * contact.motion.position),
            format!("{:.2}", contact.pressure_angle.to_degrees()),
        ]
    });
    Table {
        title: "Profile".into(),
        headings: ["cam °", "polar °", "R", lift, "pressure °"]
            .map(String::from)
            .to_vec(),
        columns: vec![Anchor::Right; 5],
        rows: rows.collect(),
        notes: vec![format!("all points: {name}.csv")],
    }
}
