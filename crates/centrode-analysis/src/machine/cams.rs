use std::f64::consts::{FRAC_PI_4, FRAC_PI_6};

use centrode_kinematics::machine::Spacer;
use centrode_machines::machine::{Machine, MachineCam};

use crate::cam::CheckedCam;
use crate::{Finding, Report, Severity, Table, Unit};

/// Maximum pressure angles of a sliding and a swinging follower during the rise, rad. VDI 2142 part 2.
const PRESSURE_ANGLES: [f64; 2] = [FRAC_PI_6, FRAC_PI_4];

/// Names and headings of the tables of the motion of followers that slide and of those that swing.
const MOTIONS: [(&str, &str); 2] = [
    (
        "cam-slide-motion",
        "Maximum motion of the follower of cam, mm per radian of the cam",
    ),
    (
        "cam-swing-motion",
        "Maximum motion of the follower of cam, rad per radian of the cam",
    ),
];

/// Reports the maximum motion of the follower, the maximum pressure angles and the radii of every cam, and its findings.
pub(super) fn cams(composed: &Machine, report: &mut Report) {
    let (mut angles, mut radii) = (Vec::new(), Vec::new());
    let mut motions = [Vec::new(), Vec::new()];
    for cam in composed.cams() {
        let disc = cam.disc();
        let limits = disc.limits();
        let [rise, fall] = [limits.rise_pressure_angle, limits.return_pressure_angle];
        let input = |angle: f64| cam.inputs(angle, composed.period()).first().copied();
        angles.push((cam.name.clone(), vec![rise.value, fall.value]));
        let (minimum, maximum) = cam.part.radii();
        let [convex, concave] = [limits.minimum_radius.value, limits.largest_wheel.value];
        radii.push((cam.name.clone(), vec![minimum, maximum, convex, concave]));
        thin_roller(composed, cam, report);
        let swings = disc.follower().swings();
        let peaks = disc.peaks();
        let peaks = [peaks.lift, peaks.velocity, peaks.acceleration, peaks.jerk];
        let row = peaks.map(|peak| peak.value).to_vec();
        motions[usize::from(swings)].push((cam.name.clone(), row));
        let checked = CheckedCam {
            part: &cam.name,
            pressure_angle: PRESSURE_ANGLES[usize::from(swings)],
            undercut: format!(
                "cam {} is undercut: {} cannot follow its motion there",
                cam.name,
                cam.followers.join(", ")
            ),
            pushes: [
                format!("the pressure angle of cam {} reaches", cam.name),
                "while it lifts its follower".into(),
            ],
            remedies: [
                "a longer span_deg, a larger base_radius, or a smaller roller",
                "a longer span_deg or a larger base_radius",
            ],
            input: &input,
        };
        checked.report(&limits, report);
    }
    for (rows, (name, heading)) in motions.into_iter().zip(MOTIONS) {
        let columns = ["position", "velocity", "acceleration", "jerk"];
        let table = Table::new(name, heading, Unit::Number);
        report.table(table.columns(columns).rows(rows));
    }
    report.table(
        Table::new(
            "cam-pressure-angles",
            "Maximum pressure angle of cam",
            Unit::Angle,
        )
        .columns(["rise", "return"])
        .rows(angles),
    );
    report.table(
        Table::new(
            "cam-radii",
            "Radius of cam, and minimum radii of curvature",
            Unit::Millimetre,
        )
        .columns(["minimum", "maximum", "convex", "concave"])
        .rows(radii),
    );
}

/// Reports a roller whose wall is too thin for the pins of the design: it gets no part and no pin.
fn thin_roller(composed: &Machine, cam: &MachineCam, report: &mut Report) {
    let pin = composed.plates().pin_diameter;
    let radius = cam.disc().follower().roller_radius().unwrap_or(0.0);
    let is_made = Spacer::roller(radius, pin, cam.part.body().width).is_some();
    if radius == 0.0 || pin == 0.0 || is_made {
        return;
    }
    let (wall, minimum) = (radius - 0.5 * pin, Spacer::ROLLER_WALL * pin);
    let message = format!(
        "the roller on cam {}, Ø{:.3} mm, has a wall of {wall:.3} mm on a pin of Ø{pin:.3} mm, but needs at least {minimum:.3} mm: neither roller nor pin is made",
        cam.name,
        2.0 * radius
    );
    Finding::new("thin-roller", Severity::Warning, message)
        .measured(wall, minimum, Unit::Millimetre)
        .remedy("a larger roller_radius, or a smaller pin_diameter")
        .on(cam.name.clone())
        .add_to(report);
}
