use centrode_formats::csv::Column;
use centrode_gear::cam::{Cam, Contact};
use std::f64::consts::TAU;

/// The profile table of a cam at `rows` equal steps of the cam angle: contact point with outward normal and curvature, the
/// roller's centre, the follower's motion and pressure angle, and whether undercut removes the profile there.
#[must_use]
pub fn columns(cam: &Cam, rows: u32) -> Vec<Column> {
    let disc = cam.disc();
    let contacts: Vec<Contact> = (0..rows)
        .map(|i| disc.contact(TAU * f64::from(i) / f64::from(rows)))
        .collect();
    let numbers = |heading: &str, of: &dyn Fn(&Contact) -> f64| {
        Column::numbers(heading, contacts.iter().map(of))
    };
    let mut columns = vec![
        numbers("cam_angle_rad", &|c| c.input),
        numbers("polar_angle_rad", &|c| c.point.y.atan2(c.point.x)),
        numbers("radius_mm", &|c| c.point.coords.norm()),
        numbers("x_mm", &|c| c.point.x),
        numbers("y_mm", &|c| c.point.y),
        numbers("normal_x", &|c| c.normal.x),
        numbers("normal_y", &|c| c.normal.y),
        numbers("curvature_per_mm", &|c| c.curvature),
    ];
    let roller = |c: &Contact| c.roller.unwrap_or(c.point);
    if disc.follower().roller_radius().is_some() {
        columns.push(numbers("roller_x_mm", &|c| roller(c).x));
        columns.push(numbers("roller_y_mm", &|c| roller(c).y));
    } else {
        columns.push(numbers("face_mm", &|c| c.face.unwrap_or(0.0)));
    }
    let unit = if disc.follower().swings() {
        "rad"
    } else {
        "mm"
    };
    columns.extend([
        numbers(&format!("position_{unit}"), &|c| c.motion.position),
        numbers(&format!("velocity_{unit}_per_rad"), &|c| c.motion.velocity),
        numbers(&format!("acceleration_{unit}_per_rad2"), &|c| {
            c.motion.acceleration
        }),
        numbers(&format!("jerk_{unit}_per_rad3"), &|c| c.motion.jerk),
        numbers("pressure_angle_rad", &|c| c.pressure_angle),
    ]);
    let lost = |c: &Contact| cam.profile().is_undercut(c.input);
    let word = |c: &Contact| if lost(c) { "undercut" } else { "sound" };
    columns.push(Column::words(
        "state",
        contacts.iter().map(|c| word(c).to_owned()),
    ));
    columns
}
