use centrode_geometry::COMPUTED;

/// Whether a figure is above its limit by more than rounding, both in the same unit.
///
/// A limit of 0 has no size to which rounding could be relative: every figure above 0 exceeds it.
pub(crate) fn exceeds(measured: f64, limit: f64) -> bool {
    measured - limit > COMPUTED * measured.abs().max(limit.abs()).min(f64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_figures_do_not_exceed_each_other() {
        for limit in [3.0, 1e-6, 7.0 / 3.0, 1e9, -2.0, f64::INFINITY] {
            assert!(!exceeds(limit, limit), "{limit}");
            assert!(!exceeds(limit * (1.0 + 4e-16), limit), "{limit}");
        }
        for (measured, limit) in [
            (3.0 * (1.0 + 1e-8), 3.0),
            (1e-300, 0.0),
            (f64::INFINITY, 200.0),
            (1.0, f64::NEG_INFINITY),
        ] {
            assert!(exceeds(measured, limit), "{measured} {limit}");
            assert!(!exceeds(limit, measured), "{limit} {measured}");
        }
    }
}
