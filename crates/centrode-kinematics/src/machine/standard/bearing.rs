use centrode_geometry::{Outline, Point, Solid};

/// Deep-groove ball bearing of one row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bearing {
    /// Bore, mm.
    pub bore: f64,
    /// Outer diameter, mm.
    pub outer: f64,
    /// Width, mm.
    pub width: f64,
    /// Designation: "6000", "61800".
    pub designation: &'static str,
}

/// Designation, bore, outer diameter, width, mm.
///
/// Source: ISO 15:2017, dimension series 18, 10 and 02; designations of DIN 625-1, series 618, 60 and 62.
#[rustfmt::skip]
const BEARINGS: [(&str, [f64; 3]); 32] = [
    ("61800", [10.0, 19.0, 5.0]),
    ("61801", [12.0, 21.0, 5.0]), ("61802", [15.0, 24.0, 5.0]), ("61803", [17.0, 26.0, 5.0]),
    ("61804", [20.0, 32.0, 7.0]), ("61805", [25.0, 37.0, 7.0]), ("61806", [30.0, 42.0, 7.0]),
    ("606", [6.0, 17.0, 6.0]), ("607", [7.0, 19.0, 6.0]), ("608", [8.0, 22.0, 7.0]),
    ("609", [9.0, 24.0, 7.0]), ("6000", [10.0, 26.0, 8.0]), ("6001", [12.0, 28.0, 8.0]),
    ("6002", [15.0, 32.0, 9.0]), ("6003", [17.0, 35.0, 10.0]), ("6004", [20.0, 42.0, 12.0]),
    ("6005", [25.0, 47.0, 12.0]), ("6006", [30.0, 55.0, 13.0]), ("6007", [35.0, 62.0, 14.0]),
    ("6008", [40.0, 68.0, 15.0]),
    ("625", [5.0, 16.0, 5.0]), ("626", [6.0, 19.0, 6.0]), ("627", [7.0, 22.0, 7.0]),
    ("6200", [10.0, 30.0, 9.0]), ("6201", [12.0, 32.0, 10.0]), ("6202", [15.0, 35.0, 11.0]),
    ("6203", [17.0, 40.0, 12.0]), ("6204", [20.0, 47.0, 14.0]), ("6205", [25.0, 52.0, 15.0]),
    ("6206", [30.0, 62.0, 16.0]), ("6207", [35.0, 72.0, 17.0]), ("6208", [40.0, 80.0, 18.0]),
];

impl Bearing {
    /// The largest bearing of a bore that is no wider than `room`, mm; `None` if there is none.
    #[must_use]
    pub fn for_bore(bore: f64, room: f64) -> Option<Self> {
        Self::every(bore)
            .filter(|bearing| bearing.width <= room)
            .max_by(|a, b| a.outer.total_cmp(&b.outer))
    }

    /// The narrowest bearing of a bore, mm.
    #[must_use]
    pub fn narrowest(bore: f64) -> Option<Self> {
        Self::every(bore).min_by(|a, b| a.width.total_cmp(&b.width))
    }

    fn every(bore: f64) -> impl Iterator<Item = Self> {
        let own = BEARINGS
            .into_iter()
            .filter(move |(_, sizes)| sizes[0] == bore);
        own.map(|(designation, [bore, outer, width])| Self {
            bore,
            outer,
            width,
            designation,
        })
    }

    /// Name by which it is bought: "Deep groove ball bearing ISO 15 - 61800 - 10 x 19 x 5".
    #[must_use]
    pub fn name(self) -> String {
        let Self {
            bore,
            outer,
            width,
            designation,
        } = self;
        format!("Deep groove ball bearing ISO 15 - {designation} - {bore} x {outer} x {width}")
    }

    /// Its body, from z = 0 upwards: one ring that fills the space of both rings and the balls.
    #[must_use]
    pub fn solid(self) -> Option<Solid> {
        let circle = |diameter: f64| Outline::circle(Point::origin(), 0.5 * diameter);
        Solid::new(circle(self.outer), vec![circle(self.bore)], 0.0, self.width).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bearing_is_the_largest_that_the_room_takes() {
        let name = |bore: f64, room: f64| Bearing::for_bore(bore, room).map(|b| b.designation);
        assert_eq!(name(10.0, 6.0), Some("61800"));
        assert_eq!(name(10.0, 8.0), Some("6000"));
        assert_eq!(name(10.0, 20.0), Some("6200"));
        assert_eq!((name(10.0, 4.9), name(16.0, 20.0)), (None, None));
        assert_eq!(Bearing::narrowest(12.0).map(|b| b.width), Some(5.0));
        let bearing = Bearing::for_bore(10.0, 6.0).expect("a bearing");
        assert_eq!(
            bearing.name(),
            "Deep groove ball bearing ISO 15 - 61800 - 10 x 19 x 5"
        );
        let ring = std::f64::consts::PI * (9.5_f64.powi(2) - 25.0) * 5.0;
        assert!((bearing.solid().expect("a body").volume() - ring).abs() < 1e-9);
    }

    /// Series, from thin to thick: dimension series 18, 10 and 02.
    const SERIES: [&str; 3] = ["618", "60", "62"];

    /// The height of a ring's section grows with the diameter series 8, 0 and 2 of one bore, and no bearing of a thicker section is
    /// narrower; of one series widths keep to a share of the section that ISO 15 lets grow thinner with the bore.
    #[test]
    fn dimensions_follow_the_dimension_series_of_iso_15() {
        let series = |name: &str| SERIES.into_iter().position(|series| is_of(name, series));
        for (name, [bore, outer, width]) in BEARINGS {
            let own = series(name).expect(name);
            for (other, [same, wider, thicker]) in BEARINGS {
                if same == bore && series(other) > Some(own) {
                    assert!(wider > outer && thicker >= width, "{name} {other}");
                }
            }
            // Width series 1 and 0: between half and one and a quarter of the section's height.
            let share = width / (0.5 * (outer - bore));
            assert!((0.85..=1.25).contains(&share), "{name}: {share}");
        }
        // Names without a bore code have the bore as their last digit.
        for (name, [bore, ..]) in BEARINGS.iter().filter(|(name, _)| name.len() == 3) {
            assert_eq!(name[2..].parse(), Ok(*bore), "{name}");
        }
        // Bore codes below four.
        for (code, bore) in ["00", "01", "02", "03"]
            .into_iter()
            .zip([10.0, 12.0, 15.0, 17.0])
        {
            let all = BEARINGS
                .iter()
                .filter(|(name, _)| name.len() > 3 && name.ends_with(code));
            let bores: Vec<f64> = all.map(|(_, sizes)| sizes[0]).collect();
            assert_eq!(bores, [bore; 3], "{code}");
        }
    }

    fn is_of(name: &str, series: &str) -> bool {
        name.strip_prefix(series).is_some_and(|rest| rest.len() < 3)
    }

    #[test]
    fn bearings_of_a_series_grow_with_their_bores_and_bores_follow_the_designation() {
        for series in SERIES {
            let own: Vec<[f64; 3]> = BEARINGS
                .into_iter()
                .filter(|(name, _)| is_of(name, series))
                .map(|(_, sizes)| sizes)
                .collect();
            assert!(
                own.windows(2).all(|w| (0..3).all(|i| w[0][i] <= w[1][i])),
                "{series}"
            );
        }
        for (name, [bore, outer, width]) in BEARINGS {
            assert!(width < outer - bore && bore < outer, "{name}");
            // Bore codes from 04 on are a fifth of the bore.
            let code = name
                .get(name.len() - 2..)
                .and_then(|code| code.parse::<f64>().ok());
            if let Some(code) =
                code.filter(|code| name.len() > 3 && *code >= 4.0 && !name.contains('/'))
            {
                assert_eq!(5.0 * code, bore, "{name}");
            }
        }
    }
}
