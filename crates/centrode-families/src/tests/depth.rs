//! Depths of a check: each deeper report is the shallower one, and more.

use std::collections::BTreeMap;

use centrode_analysis::Report;

use super::*;

/// Pairs of several kinds of pitch curve, each with a change of its teeth that a depth treats on its own.
const PAIRS: [(&str, &str); 7] = [
    ("kind = \"ellipse\"\neccentricity = 0.3", ""),
    (
        "kind = \"polar\"\nexpression = \"1 + 0.2*cos(phi)\"",
        "[teeth]\naddendum = \"fitted\"",
    ),
    (
        "kind = \"limacon\"\nmean_radius = 40\namplitude = 9",
        "[cut]\nkerf = 0.3",
    ),
    (
        "kind = \"circle\"",
        "[driver]\nshift = 0.3\n[driven]\nshift = 0.4",
    ),
    (
        "kind = \"ellipse\"\neccentricity = 0.5",
        "[teeth]\nfit = [\"phase\"]\naddendum = \"fitted\"",
    ),
    (
        "kind = \"lobed-ellipse\"\nlobes = 2\neccentricity = 0.3",
        "[housing]\ngap = 0.1",
    ),
    (
        "kind = \"eccentric-circle\"\neccentricity = 0.4",
        "[driver]\nbore = 12",
    ),
];

fn pairs() -> Vec<String> {
    PAIRS
        .iter()
        .map(|(pitch, more)| {
            let size = if pitch.contains("limacon") {
                "tooth_count = 31"
            } else {
                "module = 2\ntooth_count = 30"
            };
            format!("family = \"gear-pair\"\n[pitch]\n{pitch}\n{size}\n{more}\n")
        })
        .collect()
}

/// Figures of a report by the bits of their values.
fn bits(report: &Report) -> BTreeMap<String, u64> {
    let goals = report
        .goals
        .iter()
        .filter_map(|goal| Some((goal.name.to_string(), goal.value?)));
    let figures = report
        .values
        .iter()
        .map(|(name, value)| ((*name).to_owned(), *value));
    goals
        .chain(figures)
        .map(|(name, value)| (name, value.to_bits()))
        .collect()
}

#[test]
fn deeper_reports_have_the_figures_of_shallower_ones_to_the_last_bit() {
    for text in pairs()
        .iter()
        .chain([&FAMILIES.template("three-arm").expect("a family").to_owned()])
    {
        let file = FAMILIES
            .read(text.as_bytes())
            .unwrap_or_else(|e| panic!("{text}: {e}"));
        let mechanism = file.mechanism().unwrap_or_else(|e| panic!("{text}: {e}"));
        let mut before: Option<(BTreeMap<String, u64>, Vec<&str>)> = None;
        for depth in Depth::ALL {
            let report = mechanism.report(depth);
            let alone = file
                .family()
                .report(file.design(), depth)
                .expect("a report");
            assert_eq!(bits(&alone), bits(&report), "{text}");
            assert_eq!(alone.findings, report.findings, "{text}");
            let figures = bits(&report);
            let rules: Vec<&str> = report.findings.iter().map(|f| f.rule).collect();
            if let Some((fewer, of)) = before {
                assert!(
                    fewer
                        .iter()
                        .all(|(name, value)| figures.get(name) == Some(value)),
                    "{text}"
                );
                assert!(
                    of.iter().all(|rule| rules.contains(rule)),
                    "{text}: {of:?} {rules:?}"
                );
                assert!(fewer.len() <= figures.len());
            }
            before = Some((figures, rules));
        }
    }
}

#[test]
fn a_pair_is_deeper_by_its_teeth_and_then_by_its_mesh() {
    for text in pairs() {
        let file = FAMILIES.read(text.as_bytes()).expect("a design");
        let of = |depth| {
            bits(
                &file
                    .family()
                    .report(file.design(), depth)
                    .expect("a report"),
            )
        };
        let [motion, made, whole] = Depth::ALL.map(of);
        let first = |name: &str| {
            [&motion, &made, &whole]
                .iter()
                .position(|figures| figures.contains_key(name))
        };
        assert_eq!(first("center_distance"), Some(0), "{text}");
        assert_eq!(first("pressure_angle_max"), Some(0), "{text}");
        assert_eq!(first("driver_tip_width_min"), Some(1), "{text}");
        assert_eq!(first("transmission_error_max"), Some(2), "{text}");
    }
}

#[test]
fn pitch_curves_whose_teeth_cannot_be_cut_have_a_motion() {
    // The axis of the driver is outside its teeth.
    let text = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\neccentricity = 0.3\nmodule = 2\ntooth_count = 30\n[driver]\nbore = 50\n";
    let file = FAMILIES.read(text.as_bytes()).expect("a design");
    let of = |depth| {
        file.family()
            .report(file.design(), depth)
            .map_err(|error| error.message())
    };
    assert!(of(Depth::Motion).is_ok());
    let reasons = [
        of(Depth::Made),
        of(Depth::Whole),
        file.mechanism()
            .map(|_| Report::default())
            .map_err(|e| e.message()),
    ];
    for reason in reasons {
        assert!(reason.expect_err("no room").contains("bore"));
    }
}
