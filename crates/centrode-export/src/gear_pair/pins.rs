use centrode_formats::csv::Column;
use centrode_gear::{GearPair, Member, OverPins, Pin};

/// Measuring pins, one row per tooth space: position of the pin, and the measures over it. Cells of a space that cannot be
/// measured are empty, and the column `remark` states why.
///
/// If the design gives deviations of tooth thickness, columns with the limits of the measures follow.
pub(super) fn columns(
    pair: &GearPair,
    member: Member,
    limits: Option<&[OverPins; 2]>,
) -> Vec<Column> {
    let over = pair.gear(member).over_pins(pair.pin_diameter(member));
    let cells = |figure: &dyn Fn(&Pin) -> f64| -> Vec<String> {
        let each = over.pins.iter();
        each.map(|pin| {
            pin.as_ref()
                .map_or_else(|_| String::new(), |p| figure(p).to_string())
        })
        .collect()
    };
    let across: Vec<Option<(usize, f64)>> = (0..over.pins.len()).map(|k| over.across(k)).collect();
    let spaces = 0..over.pins.len();
    let mut columns = vec![
        Column::words("space", spaces.clone().map(|k| k.to_string())),
        Column::numbers("pin_diameter_mm", spaces.map(|_| over.diameter)),
        Column::words("pin_x_mm", cells(&|p| p.center.x)),
        Column::words("pin_y_mm", cells(&|p| p.center.y)),
        Column::words("pin_radius_mm", cells(&|p| p.center.coords.norm())),
        Column::words("pin_angle_deg", cells(&|p| angle_deg(p))),
        Column::words("axis_to_far_side_mm", cells(&|p| p.radial)),
        Column::words(
            "opposite_space",
            across
                .iter()
                .map(|a| a.map_or_else(String::new, |(j, _)| j.to_string())),
        ),
        Column::words(
            "over_two_pins_mm",
            across
                .iter()
                .map(|a| a.map_or_else(String::new, |(_, m)| m.to_string())),
        ),
        Column::words(
            "remark",
            over.pins.iter().map(|pin| match pin {
                Ok(_) => String::new(),
                Err(fault) => fault.to_string().replace([',', '"'], ";"),
            }),
        ),
    ];
    for (over, end) in limits.into_iter().flatten().zip(["maximum", "minimum"]) {
        let cell = |value: Option<f64>| value.map_or_else(String::new, |mm| mm.to_string());
        let radial = |pin: &Result<Pin, _>| cell(pin.as_ref().ok().map(|pin| pin.radial));
        let both = |(k, across): (usize, &Option<(usize, f64)>)| {
            cell(across.and_then(|(j, _)| over.over(k, j)))
        };
        columns.extend([
            Column::words(
                &format!("axis_to_far_side_{end}_mm"),
                over.pins.iter().map(radial),
            ),
            Column::words(
                &format!("over_two_pins_{end}_mm"),
                across.iter().enumerate().map(both),
            ),
        ]);
    }
    columns
}

/// Polar angle of a pin's center, 0 to 360 deg.
fn angle_deg(pin: &Pin) -> f64 {
    pin.center
        .y
        .atan2(pin.center.x)
        .to_degrees()
        .rem_euclid(360.0)
}
