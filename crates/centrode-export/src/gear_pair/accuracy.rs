//! Flank tolerances of the teeth, ISO 1328-1:2013.

use centrode_formats::sheet::number;
use centrode_gear::{GearPair, Member};
use centrode_kinematics::machine::Datum;
use std::f64::consts::PI;

/// Sizes that the tolerances of a gear depend on, mm.
#[derive(Clone, Copy, Debug)]
struct Gauge {
    /// Reference diameter.
    diameter: f64,
    module: f64,
    class: u32,
}

impl Gauge {
    /// Tolerance of the gear's class from that of class 5, um, rounded as the standard requires.
    fn of(self, fifth: f64) -> f64 {
        let exact = fifth * 2_f64.powf(0.5 * (f64::from(self.class) - 5.0));
        match exact {
            _ if exact > 10.0 => exact.round(),
            _ if exact >= 5.0 => (2.0 * exact).round() / 2.0,
            _ => (10.0 * exact).round() / 10.0,
        }
    }

    fn single_pitch(self) -> f64 {
        self.of(0.001 * self.diameter + 0.4 * self.module + 5.0)
    }

    /// Total cumulative pitch of class 5, um.
    fn cumulative(self) -> f64 {
        0.002 * self.diameter + 0.55 * self.diameter.sqrt() + 0.7 * self.module + 12.0
    }

    fn total_pitch(self) -> f64 {
        self.of(self.cumulative())
    }

    fn runout(self) -> f64 {
        self.of(0.9 * self.cumulative())
    }

    fn total_profile(self) -> f64 {
        let slope = 0.4 * self.module + 0.001 * self.diameter + 4.0;
        let form = 0.55 * self.module + 5.0;
        self.of(slope.hypot(form))
    }

    /// The gear with at least the smallest diameter of the standard, 5 teeth and 5 mm: below it the tolerances hardly decrease.
    fn at_least_five_teeth(self) -> Self {
        let minimum = (5.0 * self.module).max(5.0);
        Self {
            diameter: self.diameter.max(minimum),
            ..self
        }
    }

    /// Whether the standard's formulas hold for the gear with teeth of a face width, mm.
    fn is_stated(self, width: f64) -> bool {
        let teeth = self.diameter / self.module;
        (1..=11).contains(&self.class)
            && (5.0 - 1e-9..=1000.0).contains(&teeth)
            && (5.0..=15_000.0).contains(&self.diameter)
            && (0.5..=70.0).contains(&self.module)
            && (4.0..=1200.0).contains(&width)
    }
}

/// Sizes of the two equivalent circular gears: the osculating circle where the pitch curve bends most, and the circle as long as
/// the pitch curve. `None` if the class belongs to another system.
fn gauges(pair: &GearPair, member: Member) -> Option<[Gauge; 2]> {
    let (gear, module) = (pair.gear(member), pair.module());
    let class = class(pair, member).parse().ok()?;
    let bend = pair.rolling().curvature_ranges()[member as usize].maximum.1;
    let reference = pair.reference_diameter(member);
    // The pitch curve of a shifted gear is its operating circle; its tolerances refer to the curve on which it is generated.
    let diameters = [
        2.0 / bend * (PI * reference / gear.pitch_length()),
        reference,
    ];
    Some(diameters.map(|diameter| Gauge {
        diameter,
        module,
        class,
    }))
}

fn class(pair: &GearPair, member: Member) -> &str {
    pair.gear(member).body().accuracy_class()
}

/// Runout of the teeth of a gear to its bore, as measured over pins, mm; `None` beyond the range of the standard.
pub(crate) fn tooth_runout(pair: &GearPair, member: Member) -> Option<f64> {
    let [_, whole] = gauges(pair, member)?;
    let is_stated = whole.is_stated(pair.gear(member).body().width);
    is_stated.then(|| whole.runout() / 1000.0)
}

/// Class and values for the equivalent circular gears: single pitch and profile by the osculating circle of the pitch curve
/// where it bends most, total pitch and runout by the circle as long as the pitch curve.
pub(crate) fn flank_tolerances(pair: &GearPair, member: Member) -> Vec<Datum> {
    let (gear, class) = (pair.gear(member), class(pair, member));
    let Some([local, whole]) = gauges(pair, member) else {
        return vec![Datum::new("Accuracy class", "", class)];
    };
    let mut data = vec![Datum::new("Flank tolerance class, ISO 1328-1", "A", class)];
    let width = gear.body().width;
    let bent = local.diameter;
    let local = local.at_least_five_teeth();
    let mut say = |gauge: Gauge, bent: f64, name: &str, rows: &[(&str, &str, f64)]| {
        if !gauge.is_stated(width) {
            let size = number(gauge.diameter, 2);
            let words = format!("equivalent gear of d = {size} beyond ISO 1328-1");
            data.push(Datum::new(name, "", words));
            return;
        }
        let place = format!("equivalent gear of d = {}", number(gauge.diameter, 2));
        data.push(Datum::new(name, "", place));
        if bent < gauge.diameter {
            let words = format!(
                "bends as d = {}, below that standard's minimum",
                number(bent, 2)
            );
            data.push(Datum::new("", "", words));
        }
        let row = |(name, symbol, um): &(&str, &str, f64)| {
            Datum::new(name, symbol, number(um / 1000.0, 4))
        };
        data.extend(rows.iter().map(row));
    };
    say(
        local,
        bent,
        "Where the pitch curve bends most",
        &[
            ("Single pitch, either way", "fpT", local.single_pitch()),
            ("Total profile", "FαT", local.total_profile()),
        ],
    );
    let runout = match gear.body().bore > 0.0 {
        true => "Runout to A, of M over pins",
        false => "Runout of M over pins",
    };
    say(
        whole,
        whole.diameter,
        "All round, by the number of teeth",
        &[
            ("Total pitch", "FpT", whole.total_pitch()),
            (runout, "FrT", whole.runout()),
        ],
    );
    data
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_gear::design::GearPairDesign;
    use centrode_gear::pitch::{Circle, PitchSpec};

    #[test]
    fn tolerances_are_those_of_the_standard() {
        // Gear of 40 teeth of 3 mm, class 6: worked by hand from formulas 5 to 9 of ISO 1328-1:2013, sqrt(2) of class 5.
        let gauge = |class| Gauge {
            diameter: 120.0,
            module: 3.0,
            class,
        };
        let found = |gauge: Gauge| {
            [
                gauge.single_pitch(),
                gauge.total_pitch(),
                gauge.total_profile(),
                gauge.runout(),
            ]
        };
        // Class 5: 6.32, 20.365, hypot(5.32, 6.65) = 8.516, 18.328.
        assert_eq!(found(gauge(5)), [6.5, 20.0, 8.5, 18.0]);
        // Class 6: 8.94, 28.80, 12.04, 25.92.
        assert_eq!(found(gauge(6)), [9.0, 29.0, 12.0, 26.0]);
        // Class 1 is a quarter of class 5: 1.58, 5.09, 2.13, 4.58.
        assert_eq!(found(gauge(1)), [1.6, 5.0, 2.1, 4.6]);
        assert!(
            gauge(11).is_stated(10.0) && !gauge(12).is_stated(10.0) && !gauge(8).is_stated(3.0)
        );
    }

    #[test]
    fn a_shifted_gear_has_the_tolerances_of_its_reference_diameter() {
        // d = m z = 20 mm, where the operating circle is 22 mm. The single pitch by hand, formula 5 of ISO 1328-1:2013, class 11:
        // 8 (0.001 d + 0.4 m + 5) = 46.56 um, rounded to 47; both diameters round to it.
        let mut design = GearPairDesign::new(PitchSpec::Circle(Circle {
            module: Some(2.0),
            tooth_count: Some(10),
            ..Circle::default()
        }));
        for gear in [&mut design.driver, &mut design.driven] {
            gear.shift = Some(0.6);
            gear.accuracy = "11".into();
        }
        let pair = GearPair::resolve(&design).expect("a pair");
        assert!(pair.center_distance() > 21.5);
        for gauge in gauges(&pair, Member::Driver).expect("a class") {
            assert!((gauge.diameter - 20.0).abs() < 1e-9, "{gauge:?}");
            assert!((gauge.module - 2.0).abs() < 1e-12);
        }
        let rows = flank_tolerances(&pair, Member::Driver);
        assert_eq!(rows[1].value, "equivalent gear of d = 20");
        assert_eq!(rows[2].value, "0.047");
    }

    #[test]
    fn a_bend_of_less_than_five_teeth_is_told_by_the_least_gear_of_the_standard() {
        let gauge = |diameter| Gauge {
            diameter,
            module: 3.0,
            class: 8,
        };
        let minimum = gauge(4.8).at_least_five_teeth();
        assert!(!gauge(4.8).is_stated(10.0) && minimum.is_stated(10.0));
        assert_eq!(
            (minimum.diameter, gauge(90.0).at_least_five_teeth().diameter),
            (15.0, 90.0)
        );
        // What it is wider by is far below what the standard rounds to.
        assert_eq!(minimum.single_pitch(), gauge(4.8).single_pitch());
    }
}
