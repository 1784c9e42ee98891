use super::{ROWS, columns};
use crate::plate::{Exactness, Plate};
use centrode_formats::sheet::Table;
use centrode_gear::cam::Cam;

/// A cam as a plate, with the file of its profile; `quantity` is the number of such cams in the machine.
pub(crate) fn plate(cam: &Cam, name: &str, title: &str, quantity: usize) -> Plate {
    let (body, disc) = (cam.body(), cam.disc());
    let base = format!("Base radius {:.4} mm", disc.base_radius());
    let follower = match disc.follower().roller_radius() {
        Some(radius) => format!("{base}, roller Ø{:.3}.", 2.0 * radius),
        None => format!("{base}, flat face."),
    };
    let outline = cam.profile().outline().clone();
    Plate {
        quantity,
        notes: vec![format!("Exact profile: {name}.step."), follower],
        tables: vec![Table::of_file(
            "Profile points",
            &format!("{name}.csv"),
            &columns(cam, ROWS),
        )],
        exactness: Some(Exactness::Profile),
        ..Plate::of_body(name, title, outline, cam.bore(), body)
    }
}
