use centrode_geometry::Point;

use super::{DRAWN, drawn, points};
use crate::reverse::{AxisFault, PathDesign, PathError, RequiredPath, RequiredPoints, TwoBar};

fn refused(list: &[[f64; 2]]) -> PathError {
    RequiredPath::through(&points(list)).expect_err("no path")
}

#[test]
fn the_spline_passes_its_points_with_two_continuous_derivatives() {
    let path = drawn();
    assert_eq!(path.period(), 13.0);
    for (i, &[x, y]) in DRAWN.iter().enumerate() {
        let (before, here) = (path.at((i as f64).next_down()), path.at(i as f64));
        assert!((here.point - Point::new(x, y)).norm() < 1e-12);
        for (a, b) in [(before.first, here.first), (before.second, here.second)] {
            assert!((a - b).norm() < 1e-10);
        }
    }
    let again = points(&DRAWN).into_iter().chain([Point::origin()]);
    let closed = RequiredPath::through(&again.collect::<Vec<_>>()).expect("closed by its first");
    assert_eq!(closed.at(3.7), path.at(3.7));
}

#[test]
fn bad_points_are_refused_with_their_numbers() {
    let mut list = DRAWN;
    list[4][1] = f64::NAN;
    assert!(matches!(
        refused(&list),
        PathError::NotFinite { number: 5, .. }
    ));
    list[4][1] = 1e300;
    assert!(matches!(
        refused(&list),
        PathError::TooFar { number: 5, .. }
    ));
    list[4] = list[3];
    assert!(matches!(
        refused(&list),
        PathError::Twice {
            first: 4,
            second: 5,
            ..
        }
    ));
    assert!(matches!(
        refused(&DRAWN[..3]),
        PathError::TooFew { count: 3, .. }
    ));
    assert!(matches!(refused(&[]), PathError::TooFew { count: 0, .. }));
    let many = vec![[0.0, 0.0]; 60_000];
    let many: Vec<[f64; 2]> = many
        .iter()
        .enumerate()
        .map(|(i, _)| [i as f64, 0.0])
        .collect();
    assert!(matches!(refused(&many), PathError::TooMany { .. }));
    let half: Vec<[f64; 2]> = (0..20)
        .map(|i| (f64::from(i) * 0.15).sin_cos())
        .map(|(y, x)| [x, y])
        .collect();
    let error = refused(&half);
    assert!(matches!(error, PathError::Open { .. }), "{error}");
}

#[test]
fn a_file_is_read_line_by_line() {
    let mut text = String::from("x,y,direction_deg\r\n# by hand\r\n\r\n");
    for [x, y] in DRAWN {
        text += &format!("{x}, {y},\r\n");
    }
    let path = RequiredPath::from_csv(text.as_bytes()).expect("a path");
    assert_eq!(path.at(2.3), drawn().at(2.3));
    for (separator, end) in [(";", "\n"), ("\t", "\r\n"), (";", "\r")] {
        let line = |[x, y]: &[f64; 2]| format!("{x}{separator}{y}{end}").replace('.', ",");
        let text: String = DRAWN.iter().map(line).collect();
        let path = RequiredPath::from_csv(text.as_bytes()).expect("a path");
        assert_eq!(path.at(2.3), drawn().at(2.3), "{separator:?} {end:?}");
    }
    let fault = |text: &[u8]| RequiredPath::from_csv(text).expect_err("no path");
    assert!(matches!(
        fault(b"x,y\n0,0\n1,a\n"),
        PathError::NotNumber { line: 3, found } if found == "a"
    ));
    assert!(matches!(
        fault(b"0,0\n1\n"),
        PathError::Columns {
            line: 2,
            count: 1,
            required: "x and y in mm"
        }
    ));
    assert!(matches!(
        fault(b"0,0\n\xff"),
        PathError::NotText { line: 2 }
    ));
    assert!(matches!(
        fault(b"0,0\n1,inf\n2,0\n3,3\n"),
        PathError::NotFinite { number: 2, .. }
    ));
    let large = vec![b' '; RequiredPath::LARGEST + 1];
    assert!(matches!(fault(&large), PathError::TooLarge { .. }));
    assert!(matches!(fault(b""), PathError::TooFew { count: 0, .. }));
}

#[test]
fn headings_name_the_columns_in_any_order() {
    let expected: Vec<Point> = points(&[[1.0, 2.0], [3.5, 4.0]]);
    for text in [
        "1,2\n3.5,4\n",
        "1,2,\n3.5,4,,\n",
        "x,y\n1,2\n3.5,4\n",
        "y,x\n2,1\n4,3.5\n",
        "Y, X\n2,1\n4,3.5\n",
        "\"y\",\"x\"\n2,1\n4,3.5\n",
        "y_mm;x_mm\n2;1\n4;3,5\n",
        "y\tx\n2\t1\n4\t3,5\n",
        "tolerance,y,x\n0,2,1\n0,4,3.5\n",
        "direction_deg,x,tolerance,y\n,1,0,2\n,3.5,0,4\n",
        "x,,y\n1,,2\n3.5,,4\n",
        "# by hand\n\ny,x,\n2,1\n4,3.5,\n",
        "\u{feff}y,x\r\n2,1\r\n4,3.5\r\n",
    ] {
        let read = RequiredPoints::from_csv(text.as_bytes());
        assert_eq!(read.expect(text).points, expected, "{text}");
    }
    let read = RequiredPoints::from_csv(b"direction_deg,y,tolerance,x\n,2,0.5,1\n90,4,0.25,3.5\n");
    let read = read.expect("points");
    assert_eq!(read.points, expected);
    assert_eq!(read.tolerances, Some(vec![0.5, 0.25]));
    assert_eq!(read.directions.len(), 1);
    assert_eq!(read.directions[0].point, 2);
    let quarter = std::f64::consts::FRAC_PI_2;
    assert!((read.directions[0].direction - quarter).abs() < 1e-15);
}

#[test]
fn columns_without_a_known_heading_are_refused() {
    for (text, words) in [
        (
            "x,y,z\n1,2,3\n",
            "line 1: unknown column \"z\"; known columns are x, y, tolerance, direction_deg, direction_tolerance_deg",
        ),
        ("x,y,speed\n1,2,\n", "line 1: unknown column \"speed\""),
        (
            "x,y,tolerence\n1,2,0\n",
            "line 1: unknown column \"tolerence\"",
        ),
        (
            "# a\n\nx,y,direction\n1,2,0\n",
            "line 3: unknown column \"direction\"",
        ),
        ("my path\n1,2\n", "line 1: unknown column \"my path\""),
        ("0,a\n1,2\n", "line 1: unknown column \"0\""),
        ("x,x\n1,2\n", "line 1: column x is given twice"),
        ("x,x_mm,y\n1,2,3\n", "line 1: column x is given twice"),
        ("x,tolerance\n1,2\n", "line 1: column y is missing"),
        ("y\n1\n", "line 1: column x is missing"),
        (
            "1,2\n3,4,5\n",
            "line 2 has 3 values; it must contain x and y in mm",
        ),
        (
            "1,2,0\n3,4,0\n",
            "line 1 has 3 values; it must contain x and y in mm",
        ),
        ("x,y\n1,2,7\n", "line 2 has 3 values"),
        ("x,,y\n1,7,2\n", "line 2 has 3 values"),
        ("y,x\n1\n", "line 2 has 1 values"),
    ] {
        let error = RequiredPoints::from_csv(text.as_bytes()).expect_err(text);
        assert!(error.to_string().starts_with(words), "{text}: {error}");
    }
    let long = format!("x,y,{}\n1,2,3\n", "z".repeat(10_000));
    let error = RequiredPoints::from_csv(long.as_bytes()).expect_err("a long word");
    assert!(error.to_string().len() < 200, "{error}");
}

#[test]
fn messages_of_paths_have_few_digits() {
    let far = 1e300_f64;
    let near = 1e-300_f64;
    for (text, words) in [
        (
            format!("0,0\n{far:?},inf\n"),
            "point 2 of the path is (1e300, inf)",
        ),
        (
            format!("0,0\nnan,-{far}\n"),
            "point 2 of the path is (NaN, -1e300)",
        ),
        (
            format!("0,0\n{far},0\n"),
            "point 2 of the path is (1e300, 0) mm",
        ),
        (
            format!("0,0\n-2e9,{near}\n"),
            "point 2 of the path is (-2000000000, 1e-300) mm",
        ),
        (
            format!("1,1\n{near},{near}\n{near},{near}\n1,0\n"),
            "points 2 and 3 of the path are both (1e-300, 1e-300) mm",
        ),
        (
            format!("x,y,tolerance\n0,0,-{far}\n"),
            "line 2: the tolerance of a point must be zero or more, in mm, not -1e300",
        ),
        (
            format!("x,y,tolerance\n0,0,-{near}\n"),
            "line 2: the tolerance of a point must be zero or more, in mm, not -1e-300",
        ),
        (
            format!("x,y,tolerance\n0,0,{}\n", "9".repeat(400)),
            "line 2: the tolerance of a point must be zero or more, in mm, not inf",
        ),
    ] {
        let read = RequiredPoints::from_csv(text.as_bytes());
        let error = read.and_then(|read| RequiredPath::through(&read.points));
        let error = error.expect_err("a bad path").to_string();
        assert!(error.starts_with(words) && error.len() < 160, "{error}");
    }
    for axis in [[far, 0.0], [0.0, -far], [2e9, near], [f64::NAN, far]] {
        let error = TwoBar::new(&drawn(), axis.into(), None).expect_err("a bad axis");
        assert!(error.to_string().len() < 160, "{error}");
    }
}

#[test]
fn axes_are_within_a_thousand_times_the_size_of_the_path() {
    // An ellipse of 200 by 120 mm.
    let circle = |k: i32| (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos();
    let list: Vec<Point> = (0..24)
        .map(circle)
        .map(|(y, x)| Point::new(100.0 * x, 60.0 * y))
        .collect();
    let path = RequiredPath::through(&list).expect("a path");
    let room = 1000.0 * 200.0_f64.hypot(120.0);
    for (share, is_far) in [
        (0.01, false),
        (0.5, false),
        (0.9, false),
        (0.999, false),
        (1.001, true),
        (2.0, true),
        (10.0, true),
        (1e3, true),
    ] {
        let at = 100.0 + share * room;
        for axis in [[at, 0.0], [-at, 0.0], [0.6 * at, -0.8 * at]] {
            let fault = TwoBar::new(&path, axis.into(), None).err();
            let found = matches!(fault, Some(AxisFault::TooFar { .. }));
            assert_eq!(found, is_far, "{share} {axis:?} {fault:?}");
        }
        let design = |corners| PathDesign {
            axis_box: Some(corners),
            ..PathDesign::default()
        };
        for corners in [
            [[0.0, 0.0], [at, 50.0]],
            [[50.0, 10.0], [-at, 0.0]],
            [[-at, -60.0], [at, 60.0]],
        ] {
            let refused = design(corners).check_axes(&list).err();
            assert_eq!(refused.is_some(), is_far, "{share} {corners:?}");
            let message = refused.map(|error| error.to_string()).unwrap_or_default();
            assert!(
                !is_far || message.starts_with("axis_box must be -"),
                "{message}"
            );
        }
    }
    for corner in [1e9, -1e9, 2e9, 1e300, f64::INFINITY, f64::NAN] {
        let design = PathDesign {
            axis_box: Some([[0.0, 0.0], [corner, corner]]),
            ..PathDesign::default()
        };
        let error = design.check_axes(&list).expect_err("a far box").to_string();
        assert!(
            error.starts_with("axis_box must be ") && error.len() < 100,
            "{error}"
        );
    }
}

#[test]
fn a_path_that_crosses_itself_is_found() {
    drawn().check_simple().expect("simple");
    let eight: Vec<[f64; 2]> = (0..24)
        .map(|i| f64::from(i) * std::f64::consts::TAU / 24.0)
        .map(|t| [50.0 * t.sin(), 30.0 * (2.0 * t).sin()])
        .collect();
    let path = RequiredPath::through(&points(&eight)).expect("a path");
    let PathError::Crossing { x, y } = path.check_simple().expect_err("a figure eight") else {
        panic!("another fault");
    };
    assert!(x.hypot(y) < 1e-9, "{x} {y}");
}
