use std::borrow::Cow;

use centrode_gear::{Member, PlannedPair};

use super::remedy::{is_of_teeth, remedy};
use crate::{Finding, Report, Severity, Unit};

/// Rules about the pitch curve that noise of its samples breaks, in addition to those of the teeth.
const OF_CURVE: [&str; 5] = [
    "pitch-curves-overlap",
    "pitch-curve-corner",
    "pitch-curve-swings",
    "pressure-angle",
    "shaper-radius",
];

/// The corners of the law that the samples of the pitch curve follow, as findings.
pub(super) fn corners(pair: &PlannedPair) -> impl Iterator<Item = Finding> {
    pair.rolling().sampled().corners.iter().map(|corner| {
        let unit = Unit::Angle;
        let message = format!(
            "the samples of the pitch curve have a corner of {} at {}: the curve through them rounds it off",
            unit.with_unit(corner.turn.abs()),
            unit.with_unit(corner.angle)
        );
        Finding::new("pitch-curve-corner", Severity::Warning, message)
            .measured(corner.turn.abs(), 0.0, unit)
            .remedy(remedy("pitch-curve-corner"))
            .on(Member::Driver.name())
            .at(corner.angle)
    })
}

/// The scaling of the samples of the pitch curve to the mean ratio, as a finding.
pub(super) fn scaled_mean(pair: &PlannedPair) -> Option<Finding> {
    let scaling = pair.rolling().sampled().scaling?;
    let (driver, driven) = scaling.ratio;
    let [mean, factor] = [scaling.mean, scaling.factor].map(|value| Unit::Number.show(value));
    let message = format!(
        "the samples give {mean} driven turns per driver turn: they are multiplied by {factor} for the mean ratio {driver}:{driven}"
    );
    let required = f64::from(driven) / f64::from(driver);
    Some(
        Finding::new("scaled-mean", Severity::Note, message)
            .measured(scaling.mean, required, Unit::Number)
            .on(Member::Driver.name()),
    )
}

/// Replaces the findings that noise of the samples causes by one about the noise, with the severity of the worst of them.
pub(super) fn noise(pair: &PlannedPair, report: &mut Report) {
    let Some(noise) = pair.rolling().sampled().noise else {
        return;
    };
    let is_caused =
        |finding: &Finding| is_of_teeth(finding.rule) || OF_CURVE.contains(&finding.rule);
    let caused = report.findings.iter().filter(|finding| is_caused(finding));
    let worst = caused.map(|finding| finding.severity).max();
    report.findings.retain(|finding| !is_caused(finding));
    let message = format!(
        "the samples scatter by {:.2e} (rms, in their unit): noise gives the pitch curve {:.1} times the curvature of a circle, so that its teeth are not those of the law",
        noise.deviation, noise.curvature
    );
    let harmonics = noise.harmonics;
    let mut finding = Finding::new(
        "noisy-law",
        worst.unwrap_or(Severity::Warning).max(Severity::Warning),
        message,
    )
    .measured(noise.curvature, noise.limit, Unit::Number)
    .on(Member::Driver.name());
    finding.remedy = Some(Cow::Owned(format!(
        "smooth = {{ harmonics = {harmonics} }} for the pitch curve"
    )));
    finding.add_to(report);
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use centrode_gear::GearPair;
    use centrode_gear::design::GearPairDesign;
    use centrode_gear::pitch::{PitchSpec, Ratio, Smooth};

    use super::*;
    use crate::gear_pair::check;

    /// Report of a pair whose ratio has samples times a factor, with noise up to a share of them.
    fn report(factor: f64, noise: f64, smooth: Option<u32>) -> Report {
        let mut state = 1_u64;
        let mut scatter = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            2.0 * (state >> 11) as f64 / (1_u64 << 53) as f64 - 1.0
        };
        let law = |k: u32| 1.0 + 0.2 * (TAU * f64::from(k) / 360.0).cos();
        let ratio = (0..360).map(|k| factor * law(k) * (1.0 + noise * scatter()));
        let design = GearPairDesign::new(PitchSpec::Ratio(Ratio {
            ratio: ratio.collect(),
            module: Some(2.0),
            tooth_count: Some(30),
            smooth: smooth.map(|harmonics| Smooth {
                harmonics: Some(harmonics),
                tolerance: None,
            }),
            ..Ratio::default()
        }));
        check(&GearPair::resolve(&design).expect("a pair"))
    }

    fn rules(report: &Report) -> Vec<&str> {
        report.findings.iter().map(|finding| finding.rule).collect()
    }

    #[test]
    fn noisy_samples_are_one_finding_whose_remedy_removes_it() {
        for noise in [3e-4, 1e-3] {
            let noisy = report(1.0, noise, None);
            let [finding, rest @ ..] = noisy.findings.as_slice() else {
                panic!("no finding");
            };
            assert_eq!(finding.rule, "noisy-law");
            // The mean of the noise is not zero.
            assert!(rest.iter().all(|f| f.rule == "scaled-mean"), "{rest:?}");
            let remedy = finding.remedy.as_deref().expect("a remedy");
            let harmonics = remedy.split(|c: char| !c.is_ascii_digit());
            let harmonics = harmonics.filter_map(|word| word.parse().ok()).next();
            let cured = report(1.0, noise, harmonics);
            assert_eq!(rules(&cured), ["scaled-mean"], "{noise}: {remedy}");
        }
    }

    #[test]
    fn samples_with_another_mean_are_scaled_with_a_note() {
        assert_eq!(rules(&report(1.0, 0.0, None)), [""; 0]);
        let scaled = report(1.0034, 0.0, None);
        let [finding] = scaled.findings.as_slice() else {
            panic!("{:?}", scaled.findings);
        };
        assert_eq!(
            (finding.rule, finding.severity),
            ("scaled-mean", Severity::Note)
        );
        assert!(finding.message.contains("1.003400"), "{}", finding.message);
        assert!(finding.message.contains("0.996612"), "{}", finding.message);
        assert!(finding.message.contains("1:1"), "{}", finding.message);
    }
}
