use centrode_geometry::Point;

use super::{DRAWN, drawn, points};
use crate::reverse::{PathError, WantedPath};

fn refused(list: &[[f64; 2]]) -> PathError {
    WantedPath::through(&points(list)).expect_err("no path")
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
    let closed = WantedPath::through(&again.collect::<Vec<_>>()).expect("closed by its first");
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
    let path = WantedPath::from_csv(text.as_bytes()).expect("a path");
    assert_eq!(path.at(2.3), drawn().at(2.3));
    for (separator, end) in [(";", "\n"), ("\t", "\r\n"), (";", "\r")] {
        let line = |[x, y]: &[f64; 2]| format!("{x}{separator}{y}{end}").replace('.', ",");
        let text: String = DRAWN.iter().map(line).collect();
        let path = WantedPath::from_csv(text.as_bytes()).expect("a path");
        assert_eq!(path.at(2.3), drawn().at(2.3), "{separator:?} {end:?}");
    }
    let fault = |text: &[u8]| WantedPath::from_csv(text).expect_err("no path");
    assert!(matches!(
        fault(b"x,y\n0,0\n1,a\n"),
        PathError::NotNumber { line: 3, found } if found == "a"
    ));
    assert!(matches!(
        fault(b"0,0\n1\n"),
        PathError::Columns {
            line: 2,
            count: 1,
            wanted: "x and y in mm"
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
    let large = vec![b' '; WantedPath::LARGEST + 1];
    assert!(matches!(fault(&large), PathError::TooLarge { .. }));
    assert!(matches!(fault(b""), PathError::TooFew { count: 0, .. }));
}

#[test]
fn a_path_that_crosses_itself_is_found() {
    drawn().check_simple().expect("simple");
    let eight: Vec<[f64; 2]> = (0..24)
        .map(|i| f64::from(i) * std::f64::consts::TAU / 24.0)
        .map(|t| [50.0 * t.sin(), 30.0 * (2.0 * t).sin()])
        .collect();
    let path = WantedPath::through(&points(&eight)).expect("a path");
    let PathError::Crossing { x, y } = path.check_simple().expect_err("a figure eight") else {
        panic!("another fault");
    };
    assert!(x.hypot(y) < 1e-9, "{x} {y}");
}
