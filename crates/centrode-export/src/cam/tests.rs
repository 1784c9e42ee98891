use super::{FORMATS, drawing, files, mesh, solid};
use crate::{ExportError, Options};
use centrode_formats::csv::Values;
use centrode_formats::drawing::EntityShape;
use centrode_formats::{Format, dxf};
use centrode_gear::cam::Cam;
use centrode_gear::cam::design::{
    CamSpec, Dwell, Follower, MotionSpec, SegmentSpec, SwingingRoller, TranslatingFlat, Travel,
    Turn,
};
use centrode_gear::cam::law::LawSpec;
use centrode_geometry::{Point, Tolerance};
use centrode_kinematics::machine::Keyway;

fn motion(stroke: f64, swings: bool) -> MotionSpec {
    let travel = |degrees: f64| Travel {
        span: degrees.to_radians(),
        lift: (!swings).then_some(stroke),
        swing: swings.then_some(stroke),
        law: LawSpec::ModifiedSine,
    };
    MotionSpec {
        start: 0.5,
        segments: vec![
            SegmentSpec::Rise(travel(150.0)),
            SegmentSpec::Dwell(Dwell {
                span: 90.0_f64.to_radians(),
            }),
            SegmentSpec::Return(travel(120.0)),
        ],
    }
}

fn swinging() -> Cam {
    let follower = Follower::SwingingRoller(SwingingRoller {
        roller_radius: 6.0,
        center_distance: 60.0,
        arm_length: 48.0,
        lifts: Turn::Clockwise,
    });
    let mut spec = CamSpec::new(26.0, follower, motion(0.25, true));
    spec.name = "fork-cam".into();
    spec.body.bore = 12.0;
    spec.body.keyway = Some(Keyway {
        width: 4.0,
        depth: 1.8,
    });
    Cam::resolve(&spec).expect("sound")
}

fn flat() -> Cam {
    let follower = Follower::TranslatingFlat(TranslatingFlat {});
    Cam::resolve(&CamSpec::new(40.0, follower, motion(6.0, false))).expect("sound")
}

fn tolerance() -> Tolerance {
    Tolerance::new(1e-3).expect("positive")
}

#[test]
fn a_cam_has_a_file_of_every_format_of_parts_the_same_each_time() {
    for cam in [swinging(), flat()] {
        for curves in [dxf::Curves::Arcs, dxf::Curves::Splines] {
            let mut options = Options::new(tolerance());
            options.dxf_curves = curves;
            let bundle = files(&cam, &FORMATS, &options).expect("written");
            let again = files(&cam, &FORMATS, &options).expect("written");
            let names: Vec<&str> = bundle.files().map(|(name, _)| name).collect();
            assert_eq!(names.len(), 8);
            assert!(names.iter().all(|name| name.starts_with(cam.name())));
            assert!(bundle.files().eq(again.files()));
        }
    }
    let refused = files(&flat(), &[Format::Urdf], &Options::new(tolerance()));
    assert!(matches!(refused, Err(ExportError::NoModel(Format::Urdf))));
}

#[test]
fn the_mesh_is_closed_and_has_the_solids_volume() {
    for cam in [swinging(), flat()] {
        let (solid, mesh) = (
            solid(&cam).expect("solid"),
            mesh(&cam, tolerance()).expect("apart"),
        );
        assert!(mesh.is_watertight());
        assert!((mesh.volume() / solid.volume() - 1.0).abs() < 1e-4);
    }
}

#[test]
fn the_drawing_holds_profile_path_base_circle_and_bore() {
    for (cam, expected) in [
        (
            swinging(),
            vec!["PROFILE", "HOLE", "PITCH_CURVE", "BASE_CIRCLE"],
        ),
        (flat(), vec!["PROFILE", "BASE_CIRCLE"]),
    ] {
        let drawing = drawing(&cam, tolerance()).expect("drawn");
        let contours: Vec<&str> = drawing
            .entities
            .iter()
            .filter(|entity| matches!(entity.shape, EntityShape::Contour(_)))
            .map(|entity| entity.layer.as_str())
            .collect();
        assert_eq!(contours, expected);
        assert!(
            drawing
                .entities
                .iter()
                .all(|e| drawing.layer_of(e).is_some())
        );
    }
}

#[test]
fn the_table_tells_where_the_profile_is() {
    let cam = swinging();
    let columns = super::columns(&cam, 90);
    let column = |heading: &str| -> &Vec<f64> {
        let found = columns.iter().find(|c| c.heading == heading);
        match &found.expect(heading).values {
            Values::Numbers(numbers) => numbers,
            Values::Words(_) => panic!("numbers"),
        }
    };
    let (x, y, radius) = (column("x_mm"), column("y_mm"), column("radius_mm"));
    let (nx, ny) = (column("normal_x"), column("normal_y"));
    let (rx, ry) = (column("roller_x_mm"), column("roller_y_mm"));
    let polar = column("polar_angle_rad");
    for i in 0..90 {
        let step = Point::new(x[i], y[i]) - Point::new(rx[i], ry[i]);
        assert!((step.norm() - 6.0).abs() < 1e-12);
        assert!((nx[i] * 6.0 + step.x).abs() < 1e-12 && (ny[i] * 6.0 + step.y).abs() < 1e-12);
        assert!((radius[i] * polar[i].cos() - x[i]).abs() < 1e-12);
    }
    assert!(
        column("position_rad")
            .iter()
            .all(|&p| (-1e-15..=0.25 + 1e-15).contains(&p))
    );
    for heading in [
        "jerk_rad_per_rad3",
        "pressure_angle_rad",
        "curvature_per_mm",
    ] {
        assert_eq!(column(heading).len(), 90);
    }
}
