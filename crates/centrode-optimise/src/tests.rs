use std::ops::ControlFlow;

use super::{Ended, Evaluation, Method, Problem, Search, SearchError, Settings, minimise};

/// A curved valley, its bottom at (1, 1, ...), off the middle of the box.
struct Rosenbrock(usize);

impl Problem for Rosenbrock {
    fn bounds(&self) -> Vec<(f64, f64)> {
        vec![(-2.0, 3.0); self.0]
    }

    fn evaluate(&self, x: &[f64]) -> Evaluation {
        let pairs = x.windows(2);
        let terms = pairs.map(|p| 100.0 * (p[1] - p[0] * p[0]).powi(2) + (1.0 - p[0]).powi(2));
        Evaluation {
            objective: terms.sum(),
            constraints: Vec::new(),
        }
    }
}

/// The minimum x² + 2 y above x y = 3/2, inside a box cut by a line.
struct AboveAHyperbola;

impl Problem for AboveAHyperbola {
    fn bounds(&self) -> Vec<(f64, f64)> {
        vec![(0.5, 2.0), (0.5, 2.0)]
    }

    fn evaluate(&self, x: &[f64]) -> Evaluation {
        Evaluation {
            objective: x[0] * x[0] + 2.0 * x[1],
            constraints: vec![1.5 - x[0] * x[1], x[0] + x[1] - 3.5],
        }
    }

    fn is_costly(&self) -> bool {
        false
    }
}

fn on(_: &super::Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn settings(method: Method, evaluations: u64) -> Settings {
    Settings {
        method,
        evaluations,
        ..Settings::default()
    }
}

#[test]
fn a_curved_valley_is_followed_to_its_bottom() {
    for (method, n, evaluations, minimum) in [
        (Method::DifferentialEvolution, 5, 40_000, 1e-10),
        (Method::CmaEs, 10, 40_000, 1e-12),
        (Method::Genetic, 2, 20_000, 1e-3),
    ] {
        let (search, _) = minimise(&Rosenbrock(n), settings(method, evaluations), &mut on)
            .expect("a good problem");
        let best = search.best().evaluation.objective;
        assert!(best < minimum, "{method:?}: {best:e}");
    }
}

/// On the edge x y = 3/2 the objective x² + 3/x is smallest at x³ = 3/2.
#[test]
fn constraints_are_held() {
    let x = 1.5_f64.cbrt();
    let minimum = x * x + 3.0 / x;
    for (_, method) in Method::NAMES {
        let (search, _) =
            minimise(&AboveAHyperbola, settings(method, 20_000), &mut on).expect("a good problem");
        let best = search.best();
        assert!(best.evaluation.feasible());
        let off = best.evaluation.objective - minimum;
        assert!((-1e-12..1e-3).contains(&off), "{method:?}: {off:e}");
    }
}

#[test]
fn a_search_cut_in_two_is_the_search_in_one() {
    for (_, method) in Method::NAMES {
        let problem = Rosenbrock(4);
        let (whole, ended) =
            minimise(&problem, settings(method, 5000), &mut on).expect("a good problem");
        assert_eq!(ended, Ended::Evaluations);
        let mut stop = |p: &super::Progress| {
            if p.generation >= 7 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let (part, ended) =
            minimise(&problem, settings(method, 5000), &mut stop).expect("a good problem");
        assert_eq!((ended, part.history().len()), (Ended::Stopped, 7));
        let text = serde_json::to_string(&part).expect("plain numbers");
        let mut part: Search = serde_json::from_str(&text).expect("what was written");
        part.run(&problem, &mut on);
        assert_eq!(part.best(), whole.best(), "{method:?}");
        assert_eq!(part.history(), whole.history());
        let other = Settings {
            seed: 2,
            ..settings(method, 5000)
        };
        let (other, _) = minimise(&problem, other, &mut on).expect("a good problem");
        assert_ne!(other.best(), whole.best());
    }
}

#[test]
fn one_core_finds_what_many_find() {
    let pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
    };
    let run = || {
        let found = minimise(&Rosenbrock(6), settings(Method::CmaEs, 3000), &mut on);
        found.expect("a good problem").0
    };
    assert_eq!(pool(1).install(run), pool(4).install(run));
}

#[test]
fn nothing_to_search_is_refused() {
    struct Bounds(Vec<(f64, f64)>);
    impl Problem for Bounds {
        fn bounds(&self) -> Vec<(f64, f64)> {
            self.0.clone()
        }
        fn evaluate(&self, _: &[f64]) -> Evaluation {
            Evaluation::default()
        }
    }
    let new = |bounds, population| {
        let settings = Settings {
            population,
            ..Settings::default()
        };
        Search::new(&Bounds(bounds), settings).expect_err("refused")
    };
    assert_eq!(new(Vec::new(), None), SearchError::NoVariable);
    assert!(matches!(
        new(vec![(0.0, 1.0), (2.0, f64::NAN)], None),
        SearchError::Bounds { index: 1, .. }
    ));
    assert!(matches!(
        new(vec![(0.0, 1.0)], Some(3)),
        SearchError::Population { count: 3, .. }
    ));
    let none = Settings {
        evaluations: 0,
        ..Settings::default()
    };
    let refused = Search::new(&Bounds(vec![(0.0, 1.0)]), none).expect_err("refused");
    assert_eq!(refused, SearchError::NoEvaluation);
}

/// A value that is not a number is never the best.
#[test]
fn not_a_number_comes_last() {
    let of = |objective, constraint| Evaluation {
        objective,
        constraints: vec![constraint],
    };
    assert!(of(1.0, 0.0).order(&of(f64::NAN, -1.0)).is_lt());
    assert!(of(9.0, -1.0).order(&of(1.0, 0.1)).is_lt());
    assert!(of(f64::NAN, 0.5).order(&of(0.0, f64::NAN)).is_lt());
    assert!(!of(0.0, f64::NAN).feasible());
}
