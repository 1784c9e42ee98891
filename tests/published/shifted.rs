//! Circular gears with profile shift against the involute formulas of ISO 21771.

use std::f64::consts::{FRAC_PI_2, PI};

use centrode_analysis::Contact;
use centrode_gear::design::{GearPairDesign, Rack, Shaper, ToolSpec};
use centrode_gear::{BaseTangentFault, Gear, GearPair, GearPairError, Member, Role, ToolKind};
use centrode_geometry::{Vector, bracketed_minimum};
use centrode_spec::DesignSpec as _;

/// Dedendum and tip radius of the rack, in modules; its addendum is 1.
const DEDENDUM: f64 = 1.25;
const TIP_RADIUS: f64 = 0.2;

fn involute(angle: f64) -> f64 {
    angle.tan() - angle
}

/// Angle of an involute function, by Newton's method.
fn involute_angle(value: f64) -> f64 {
    let mut angle = (3.0 * value).cbrt();
    for _ in 0..60 {
        angle -= (involute(angle) - value) / angle.tan().powi(2);
    }
    angle
}

/// A pair of circular gears as the formulas know it.
#[derive(Clone, Copy, Debug)]
struct Case {
    module: f64,
    z: [u32; 2],
    x: [f64; 2],
    alpha: f64,
    backlash: f64,
    /// Tip shortening coefficient; `None` keeps the clearance.
    k: Option<f64>,
}

impl Case {
    fn operating_angle(&self) -> f64 {
        let teeth = f64::from(self.z[0] + self.z[1]);
        let sum = self.x[0] + self.x[1];
        involute_angle(involute(self.alpha) + 2.0 * self.alpha.tan() * sum / teeth)
    }

    fn center_distance(&self) -> f64 {
        let reference = 0.5 * self.module * f64::from(self.z[0] + self.z[1]);
        reference * self.alpha.cos() / self.operating_angle().cos()
    }

    fn tip_shortening(&self) -> f64 {
        let teeth = f64::from(self.z[0] + self.z[1]);
        self.k.unwrap_or_else(|| {
            self.center_distance() / self.module - 0.5 * teeth - self.x[0] - self.x[1]
        })
    }

    fn reference(&self, i: usize) -> f64 {
        0.5 * self.module * f64::from(self.z[i])
    }

    fn base(&self, i: usize) -> f64 {
        self.reference(i) * self.alpha.cos()
    }

    fn tip(&self, i: usize) -> f64 {
        self.reference(i) + self.module * (1.0 + self.x[i] + self.tip_shortening())
    }

    /// Half of the angle of a tooth at a radius, backlash taken off.
    fn half_tooth(&self, i: usize, radius: f64) -> f64 {
        let thick = FRAC_PI_2 + 2.0 * self.x[i] * self.alpha.tan();
        let thinning = self.backlash / (2.0 * self.alpha.cos()) / (2.0 * self.reference(i));
        thick / f64::from(self.z[i]) - thinning + involute(self.alpha)
            - involute((self.base(i) / radius).acos())
    }

    /// Width of the top land along the tip circle.
    fn tip_land(&self, i: usize) -> f64 {
        2.0 * self.tip(i) * self.half_tooth(i, self.tip(i))
    }

    /// Depth of the straight side of the rack, in modules.
    fn straight(&self) -> f64 {
        DEDENDUM - TIP_RADIUS * (1.0 - self.alpha.sin())
    }

    /// Shift below which the rack undercuts the gear.
    fn undercut_limit(&self, i: usize) -> f64 {
        self.straight() - 0.5 * f64::from(self.z[i]) * self.alpha.sin().powi(2)
    }

    /// Length of the path of contact over the base pitch, if neither gear is undercut.
    fn contact_ratio(&self) -> f64 {
        let whole = self.center_distance() * self.operating_angle().sin();
        let along = |i: usize| (self.tip(i).powi(2) - self.base(i).powi(2)).sqrt();
        // The involute begins where the straight side of the rack ends.
        let start = |i: usize| {
            let depth = self.module * (self.straight() - self.x[i]);
            self.reference(i) * self.alpha.sin() - depth / self.alpha.sin()
        };
        let reach = |i: usize| along(i).min(whole - start(1 - i));
        (reach(0) + reach(1) - whole) / (PI * self.module * self.alpha.cos())
    }

    fn design(&self) -> GearPairDesign {
        let divisor = (1..=self.z[0])
            .rev()
            .find(|d| self.z.iter().all(|z| z % d == 0))
            .unwrap_or(1);
        let [z1, z2] = self.z;
        let k = self
            .k
            .map_or("\"keep-clearance\"".into(), |k| k.to_string());
        GearPairDesign::from_toml(&format!(
            "family = \"gear-pair\"\nmean_ratio = [{}, {}]\n[pitch]\nkind = \"circle\"\nmodule = {}\ntooth_count = {z1}\n\
             [tool]\nkind = \"rack\"\npressure_angle_deg = {}\ntip_radius_coefficient = {TIP_RADIUS}\n\
             [teeth]\nbacklash = {}\ntip_shortening = {k}\n[driver]\nshift = {}\n[driven]\nshift = {}\n",
            z2 / divisor,
            z1 / divisor,
            self.module,
            self.alpha.to_degrees(),
            self.backlash,
            self.x[0],
            self.x[1],
        ))
        .expect("a design")
    }

    fn pair(&self) -> GearPair {
        GearPair::resolve(&self.design()).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }
}

const MEMBERS: [Member; 2] = [Member::Driver, Member::Driven];

/// Width of the first top land along the tip circle, by the corners of the contour.
fn tip_land(gear: &Gear) -> f64 {
    let parts = gear
        .outline()
        .segments()
        .iter()
        .zip(gear.roles())
        .zip(gear.owners());
    let ends: Vec<_> = parts
        .filter(|((_, role), owner)| **role == Role::Tip && **owner == 1)
        .flat_map(|((segment, _), _)| [segment.start(), segment.end()])
        .collect();
    let (first, last) = (ends[0].coords, ends[ends.len() - 1].coords);
    first.perp(&last).atan2(first.dot(&last)) * gear.radii().1
}

fn contact_ratio(pair: &GearPair) -> f64 {
    Contact::analyse(pair).extremes(pair).contact_ratio
}

fn near(found: f64, expected: f64, within: f64, case: &Case) {
    let off = (found - expected).abs();
    assert!(off <= within, "{found} is not {expected}: {case:?}");
}

/// Worked example: m 3, z 12/24, x 0.6/0.36.
const EXAMPLE: Case = Case {
    module: 3.0,
    z: [12, 24],
    x: [0.6, 0.36],
    alpha: 20.0 * PI / 180.0,
    backlash: 0.0,
    k: None,
};

#[test]
fn shifted_gears_have_the_sizes_of_the_standard() {
    for (k, shortening, tips, ratio) in [
        (None, -0.12671, [44.840, 79.400], 1.202),
        (Some(0.0), 0.0, [45.600, 80.160], 1.348),
    ] {
        let case = Case { k, ..EXAMPLE };
        let pair = case.pair();
        near(pair.pressure_angle().to_degrees(), 26.0886, 5e-5, &case);
        near(pair.center_distance(), 56.499_87, 5e-6, &case);
        near(pair.tip_shortening(), shortening, 5e-6, &case);
        near(contact_ratio(&pair), ratio, 5e-4, &case);
        for (i, member) in MEMBERS.into_iter().enumerate() {
            let gear = pair.gear(member);
            let (root, tip) = gear.radii();
            near(2.0 * tip, tips[i], 6e-4, &case);
            near(2.0 * root, [32.1, 66.66][i], 1e-9, &case);
            near(gear.pitch_length() / PI, [37.667, 75.333][i], 5e-4, &case);
            near(
                pair.reference_diameter(member),
                [36.0, 72.0][i],
                1e-12,
                &case,
            );
            let base = gear.pitch_length() / PI * pair.pressure_angle().cos();
            near(base, [33.8289, 67.6579][i], 6e-5, &case);
            // Heights are those of the contour, from the operating circle.
            let pitch = gear.pitch_length() / (2.0 * PI);
            near(pitch + pair.tip_height(member), tip, 1e-9, &case);
            near(pitch - pair.root_depth(member), root, 1e-9, &case);
        }
    }
}

#[test]
fn equal_gears_with_equal_shifts_are_one_part() {
    let case = Case {
        z: [20, 20],
        x: [0.3, 0.3],
        ..EXAMPLE
    };
    let pair = case.pair();
    assert!(pair.congruent());
    near(contact_ratio(&pair), case.contact_ratio(), 1e-9, &case);
    let [driver, driven] = MEMBERS.map(|member| pair.gear(member).outline());
    near(driver.area(), driven.area(), 1e-9, &case);
    let unlike = Case {
        x: [0.3, 0.2],
        ..case
    };
    assert!(!unlike.pair().congruent());
}

#[test]
fn a_missing_shift_follows_from_the_centre_distance() {
    let mut design = EXAMPLE.design();
    design.center_distance = Some(56.5);
    design.driven.shift = None;
    let pair = GearPair::resolve(&design).expect("a pair");
    // a = 56.5 has alpha_w 26.0888 deg and a sum of 0.960056.
    near(pair.shift(Member::Driven), 0.360_056, 5e-7, &EXAMPLE);
    near(pair.center_distance(), 56.5, 1e-12, &EXAMPLE);
    (design.driver.shift, design.driven.shift) = (None, Some(0.36));
    let pair = GearPair::resolve(&design).expect("a pair");
    near(pair.shift(Member::Driver), 0.600_056, 5e-7, &EXAMPLE);
    // Both given: the distance is checked.
    design.driver.shift = Some(0.5);
    let refused = GearPair::resolve(&design);
    assert!(
        matches!(refused, Err(GearPairError::ShiftedDistance { .. })),
        "{refused:?}"
    );
    // Between the base circles there is no pair.
    design.driver.shift = None;
    design.center_distance = Some(50.0);
    let refused = GearPair::resolve(&design);
    assert!(
        matches!(refused, Err(GearPairError::BaseCircles { .. })),
        "{refused:?}"
    );
}

#[test]
fn shifts_that_no_pair_can_have_are_refused_with_the_reason() {
    let read = |text: &str| {
        let text = format!("family = \"gear-pair\"\n{text}");
        GearPair::resolve(&GearPairDesign::from_toml(&text).expect("a design"))
    };
    let shifts = "[driver]\nshift = 0.3\n[driven]\nshift = 0.2\n";
    let ellipse = "[pitch]\nkind = \"ellipse\"\neccentricity = 0.2\nmodule = 2\ntooth_count = 23\n";
    let error = read(&format!("{ellipse}{shifts}")).expect_err("no pair");
    assert_eq!(error.key(), "driven.shift");
    let stated = error.to_string();
    assert!(
        stated.contains("is 0.5") && stated.contains("driven.shift = -0.3"),
        "{stated}"
    );
    let circle = "[pitch]\nkind = \"circle\"\nmodule = 2\ntooth_count = 20\n";
    let fitted = read(&format!("{circle}{shifts}[teeth]\naddendum = \"fitted\"\n"));
    assert!(
        matches!(fitted, Err(GearPairError::FittedShift { .. })),
        "{fitted:?}"
    );
    let small = "[driver]\nshift = -0.5\n[driven]\nshift = -0.4\n";
    let error = read(&format!("{circle}{small}")).expect_err("no pair");
    // -inv(20 deg) 40 / (2 tan(20 deg)) = -0.818958...
    let minimum = -involute(EXAMPLE.alpha) * 20.0 / EXAMPLE.alpha.tan();
    let GearPairError::ShiftsTooSmall { minimum: found, .. } = error else {
        panic!("{error}");
    };
    near(found, minimum, 1e-12, &EXAMPLE);
}

#[test]
fn each_gear_has_the_heights_and_the_fillets_of_its_own_tool() {
    let mut design = EXAMPLE.design();
    (design.driver.addendum, design.driver.dedendum) = (Some(1.1), Some(1.2));
    design.driven.addendum = Some(0.9);
    design.driven.tool = Some(ToolSpec::Shaper(Shaper {
        tooth_count: 20,
        dedendum_coefficient: 1.3,
        tip_radius_coefficient: 0.1,
        ..Shaper::default()
    }));
    let pair = GearPair::resolve(&design).expect("a pair");
    let k = EXAMPLE.tip_shortening();
    let heights = [[1.1, 1.2], [0.9, 1.3]];
    let mut path = -EXAMPLE.center_distance() * EXAMPLE.operating_angle().sin();
    for (i, member) in MEMBERS.into_iter().enumerate() {
        let (x, reference) = (EXAMPLE.x[i], EXAMPLE.reference(i));
        let [addendum, dedendum] = heights[i].map(|height| EXAMPLE.module * height);
        let [tip, root] = [
            addendum + EXAMPLE.module * (x + k),
            EXAMPLE.module * x - dedendum,
        ];
        let (low, high) = pair.gear(member).radii();
        near(high, reference + tip, 1e-9, &EXAMPLE);
        near(low, reference + root, 1e-9, &EXAMPLE);
        path += (high.powi(2) - EXAMPLE.base(i).powi(2)).sqrt();
        let tool = pair.teeth().tool(member);
        assert_eq!(tool.kind == ToolKind::Rack, i == 0);
    }
    let base_pitch = PI * EXAMPLE.module * EXAMPLE.alpha.cos();
    near(contact_ratio(&pair), path / base_pitch, 1e-9, &EXAMPLE);
    // Flanks are those of the rack: the same spaces, measured over pins.
    let plain = EXAMPLE.pair();
    let radial = |pair: &GearPair| {
        let pins = pair.driven().over_pins(5.0).pins;
        pins[0].as_ref().expect("a measure").radial
    };
    near(radial(&pair), radial(&plain), 1e-9, &EXAMPLE);
    // Another pressure angle is refused.
    design.driven.tool = Some(ToolSpec::Rack(Rack {
        pressure_angle: 0.4,
        ..Rack::default()
    }));
    let error = GearPair::resolve(&design).expect_err("no pair");
    assert_eq!(error.key(), "driven.tool.pressure_angle_deg");
}

#[test]
fn fitted_teeth_of_two_tools_run_without_interference() {
    let text = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\neccentricity = 0.45\nmodule = 2\ntooth_count = 26\n\
                [teeth]\naddendum = \"fitted\"\n[driver]\naddendum = 1.1\ndedendum = 1.1\n\
                [driven]\naddendum = 0.8\ndedendum = 1.4\ntool = { kind = \"rack\", tip_radius_coefficient = 0.2 }\n";
    let pair =
        GearPair::resolve(&GearPairDesign::from_toml(text).expect("a design")).expect("a pair");
    let found = Contact::analyse(&pair).extremes(&pair);
    assert!(found.penetration.value < 1e-6, "{found:?}");
    assert!(
        found.clearance.value > -1e-6 && found.fillet_clearance.value > -1e-6,
        "{found:?}"
    );
    for (gear, most) in [(pair.driver(), 2.2), (pair.driven(), 1.6)] {
        let heights = gear
            .teeth()
            .iter()
            .flat_map(|t| [t.leading.tip_height, t.trailing.tip_height]);
        let highest = heights.fold(0.0, f64::max);
        assert!(
            (most - 0.3..=most + 1e-9).contains(&highest),
            "{highest} of {most}"
        );
    }
}

/// Numbers between 0 and 1, the same in every run.
fn random(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

/// Circular gears without undercut and with tips of some width.
fn random_case(state: &mut u64) -> Case {
    loop {
        let mut next = |low: f64, high: f64| low + (high - low) * random(state);
        let mut case = Case {
            module: next(0.5, 5.0),
            z: [next(9.0, 41.0) as u32, next(9.0, 41.0) as u32],
            x: [0.0; 2],
            alpha: next(18.0, 25.0).to_radians(),
            backlash: 0.0,
            k: None,
        };
        for i in 0..2 {
            case.x[i] = next(case.undercut_limit(i).max(-0.5) + 0.01, 0.8);
        }
        case.backlash = case.module * next(-0.05, 0.1).max(0.0);
        case.k = match next(0.0, 3.0) as u32 {
            0 => None,
            1 => Some(0.0),
            _ => Some(next(-0.2, 0.05)),
        };
        let lands = [0, 1].map(|i| case.tip_land(i));
        if lands.iter().all(|land| *land >= 0.1 * case.module) && case.contact_ratio() >= 1.02 {
            return case;
        }
    }
}

#[test]
fn two_hundred_random_circular_pairs_are_those_of_the_involute_formulas() {
    let mut state = 58;
    let mut measured = 0;
    for _ in 0..200 {
        let case = random_case(&mut state);
        let pair = case.pair();
        near(
            pair.center_distance(),
            case.center_distance(),
            1e-11 * pair.center_distance(),
            &case,
        );
        near(contact_ratio(&pair), case.contact_ratio(), 1e-9, &case);
        let limit = |i: usize| {
            let sharp = 0.5 * f64::from(case.z[i]) * case.alpha.sin().powi(2);
            match case.straight() - case.x[i] {
                depth if depth > 0.0 => sharp / depth,
                _ => f64::INFINITY,
            }
        };
        let largest = pair.limits().largest_module / case.module;
        near(largest, limit(0).min(limit(1)), 1e-9 * largest, &case);
        for (i, member) in MEMBERS.into_iter().enumerate() {
            let gear = pair.gear(member);
            assert!(
                gear.teeth()
                    .iter()
                    .all(|t| t.leading.undercut == 0.0 && t.trailing.undercut == 0.0)
            );
            near(tip_land(gear), case.tip_land(i), 1e-9 * case.module, &case);
            // A pin between two teeth: its centre is on the middle of the space.
            let diameter = pair.pin_diameter(member);
            let half_space = PI / f64::from(case.z[i]) - case.half_tooth(i, case.reference(i));
            let at = involute(case.alpha) + 0.5 * diameter / case.base(i) - half_space;
            let radial = case.base(i) / involute_angle(at).cos() + 0.5 * diameter;
            let pins = gear.over_pins(diameter);
            if let Ok(pin) = &pins.pins[0] {
                measured += 1;
                near(pin.radial, radial, 1e-9 * case.module, &case);
            }
        }
    }
    // A few pins of the usual size would touch beyond the flanks.
    assert!(measured > 350, "{measured}");
}

#[test]
fn undercut_begins_at_the_shift_of_the_formula() {
    for z in [8, 12, 16, 20, 30] {
        let mut case = Case {
            z: [z, 40],
            ..EXAMPLE
        };
        for (by, is_undercut) in [(-1e-4, true), (1e-6, false)] {
            case.x = [case.undercut_limit(0) + by, 0.3];
            let side = case.pair().driver().teeth()[0].leading;
            assert_eq!(side.undercut > 0.0, is_undercut, "{z} {by}: {side:?}");
        }
    }
}

/// Distance of two parallel lines that touch opposite flanks over some teeth, and the radii between which the flanks are, by the
/// contour alone.
fn span(gear: &Gear, teeth: u32) -> (f64, [f64; 2]) {
    let of = |role: Role, tooth: u32| {
        let parts = gear.outline().segments().iter().zip(gear.roles());
        let own = parts.zip(gear.owners());
        own.filter(move |((_, own), owner)| **own == role && **owner == tooth)
            .map(|((segment, _), _)| segment)
    };
    let middle = |tooth: u32| {
        let ends = of(Role::Tip, tooth).flat_map(|tip| [tip.start(), tip.end()]);
        let sum = ends.fold(Vector::zeros(), |sum, end| sum + end.coords);
        sum.normalize()
    };
    let bisector = (middle(0) + middle(teeth - 1)).normalize();
    let mut normal = Vector::new(-bisector.y, bisector.x);
    if normal.dot(&middle(teeth - 1)) < 0.0 {
        normal = -normal;
    }
    let farthest = |tooth: u32, along: Vector| {
        let quarters = of(Role::Flank, tooth).flat_map(|segment| {
            let height = move |u: f64| -segment.at(u).point.coords.dot(&along);
            (0..8).map(move |i| {
                let low = -1.0 + 0.25 * f64::from(i);
                -bracketed_minimum(height, low, low + 0.25).1
            })
        });
        quarters.fold(f64::NEG_INFINITY, f64::max)
    };
    let ends = of(Role::Flank, 0).flat_map(|flank| [flank.start(), flank.end()]);
    let radii = ends
        .map(|end| end.coords.norm())
        .fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], radius| {
            [low.min(radius), high.max(radius)]
        });
    (farthest(teeth - 1, normal) + farthest(0, -normal), radii)
}

#[test]
fn base_tangents_of_a_hundred_random_gears_are_those_of_the_contour() {
    let (mut state, mut gears) = (85, 0);
    while gears < 100 {
        let case = random_case(&mut state);
        let pair = case.pair();
        for (i, member) in MEMBERS.into_iter().enumerate() {
            let gear = pair.gear(member);
            let found = match pair.base_tangent(member) {
                Ok(found) => found,
                Err(fault) => {
                    // Few short teeth: each k has a contact outside the flanks.
                    assert_eq!(fault, BaseTangentFault::NoCount);
                    for k in 1..4 {
                        let (length, [low, high]) = span(gear, k);
                        let contact = case.base(i).hypot(0.5 * length);
                        let within = 1e-6 * case.module;
                        assert!(
                            contact < low + within || contact > high - within,
                            "{k}: {case:?}"
                        );
                    }
                    continue;
                }
            };
            gears += 1;
            let k = f64::from(found.teeth);
            let arcs = PI * (k - 0.5) + f64::from(case.z[i]) * involute(case.alpha);
            let shifted = arcs + 2.0 * case.x[i] * case.alpha.tan();
            let formula = case.module * case.alpha.cos() * shifted - 0.5 * case.backlash;
            near(found.length, formula, 1e-12 * formula, &case);
            let (length, [low, high]) = span(gear, found.teeth);
            near(found.length, length, 1e-9 * case.module, &case);
            let contact = case.base(i).hypot(0.5 * length);
            assert!(
                (low..=high).contains(&contact),
                "{low} {contact} {high}: {case:?}"
            );
        }
    }
}

#[test]
fn a_base_tangent_is_the_published_one() {
    // m 2, z 20, no shift: 15.321 mm over 3 teeth, contacts at a diameter of 40.59 mm (machinecalcs.com, span measurement).
    let case = Case {
        module: 2.0,
        z: [20, 20],
        x: [0.0; 2],
        ..EXAMPLE
    };
    let found = case.pair().base_tangent(Member::Driver).expect("a length");
    assert_eq!(found.teeth, 3);
    near(found.length, 15.321, 5e-4, &case);
    let contacts = 2.0 * case.base(0).hypot(0.5 * found.length);
    near(contacts, 40.59, 5e-3, &case);
    // m 3, z 24, x 0.4: contacts at the shifted circle need 3.79 teeth.
    let case = Case {
        z: [24, 24],
        x: [0.4, -0.4],
        ..EXAMPLE
    };
    let found = case.pair().base_tangent(Member::Driver).expect("a length");
    assert_eq!(found.teeth, 4);
    near(found.length, 32.8266, 5e-5, &case);
    let ellipse = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\neccentricity = 0.2\nmodule = 2\ntooth_count = 23\n";
    let design = GearPairDesign::from_toml(ellipse).expect("a design");
    let pair = GearPair::resolve(&design).expect("a pair");
    assert_eq!(
        pair.base_tangent(Member::Driver),
        Err(BaseTangentFault::NotCircular)
    );
}
