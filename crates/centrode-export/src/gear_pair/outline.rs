use centrode_formats::csv::Column;
use centrode_gear::Gear;
use centrode_geometry::Tolerance;

/// Points of the toothed contour in order, counter-clockwise, each with outward normal, curvature, the role of its segment and
/// the number of its tooth.
pub(super) fn columns(gear: &Gear, tolerance: Tolerance) -> Vec<Column> {
    let samples = gear.outline().samples(tolerance);
    let owner = |segment: usize| {
        gear.owners()
            .get(segment)
            .map_or_else(String::new, u32::to_string)
    };
    let role = |segment: usize| gear.roles().get(segment).map_or("", |role| role.name());
    vec![
        Column::numbers("x_mm", samples.iter().map(|s| s.point.x)),
        Column::numbers("y_mm", samples.iter().map(|s| s.point.y)),
        Column::numbers("normal_x", samples.iter().map(|s| s.normal.x)),
        Column::numbers("normal_y", samples.iter().map(|s| s.normal.y)),
        Column::numbers("curvature_per_mm", samples.iter().map(|s| s.curvature)),
        Column::words("role", samples.iter().map(|s| role(s.segment).to_owned())),
        Column::words("tooth", samples.iter().map(|s| owner(s.segment))),
    ]
}
