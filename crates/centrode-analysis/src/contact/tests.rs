pub(crate) mod closed_forms;

use centrode_gear::GearPair;
use centrode_gear::design::{Addendum, GearPairDesign};
use centrode_machines::three_arm::ThreeArm;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::DesignSpec as _;

use super::{
    Contact, Meshing, ProofError, ProofStretch,
    contour::{Pose, PoseTolerance},
    cycle::at_angle,
    prove,
    seat::CandidatePair,
};

/// Many teeth on a circle off its centre by half its radius.
fn many(teeth: u32) -> GearPair {
    let text = format!(
        "family = \"gear-pair\"\n[pitch]\nkind = \"eccentric-circle\"\nradius = {teeth}\neccentricity = 0.5\ntooth_count = {teeth}\n[teeth]\nbacklash = 0.05\n"
    );
    let design = GearPairDesign::from_toml(&text).expect("a design");
    GearPair::resolve(&design).expect("a pair")
}

#[test]
fn cached_pairs_of_parts_are_those_near_in_every_pose() {
    let pair = many(300);
    let cached = Meshing::new(&pair);
    let mut anew = Meshing::new(&pair);
    anew.pose_tolerance = PoseTolerance::none();
    let pairs = |meshing: &Meshing<'_>, pose: &Pose| -> Vec<(usize, usize)> {
        let found = meshing.candidates(pose);
        let part = |pair: &CandidatePair| {
            let driver = &found.driver[pair.driver].stretch;
            (driver.whole.part, pair.driven)
        };
        found.pairs.iter().map(part).collect()
    };
    // Small steps, sometimes with the driven gear off its law, and one large step.
    for i in 0..400 {
        let phi = 0.7 + 0.0021 * f64::from(i) + if i > 200 { 1.3 } else { 0.0 };
        let psi = pair.driven_angle(phi) + [0.0, 3e-4, -5e-3][i as usize % 3];
        let pose = Pose::new(phi, psi, pair.center_distance());
        let found = pairs(&cached, &pose);
        assert!(!found.is_empty());
        assert_eq!(found, pairs(&anew, &pose), "{phi}");
    }
}

#[test]
fn a_long_cycle_has_the_same_figures_on_any_number_of_cores() {
    let pair = many(300);
    let on = |cores: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(cores).build();
        pool.expect("threads")
            .install(|| Contact::sampled(&pair, 4))
    };
    let one = on(1);
    assert_eq!(one.input.len(), 1202);
    assert_eq!(one, on(2));
    assert_eq!(one, on(3));
}

fn design(name: &str) -> GearPair {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/designs");
    let text = std::fs::read_to_string(format!("{folder}/{name}.toml")).expect("readable");
    let design = GearPairDesign::from_toml(&text).expect("a design");
    GearPair::resolve(&design).expect("a pair")
}

#[test]
fn clearances_at_the_law_are_those_at_the_seats() {
    for name in ["elliptic-pair-2018", "law-pair", "quintic-pair"] {
        let pair = design(name);
        let (mut with, mut without) = (Meshing::new(&pair), Meshing::new(&pair));
        for i in 0..60 {
            let point = at_angle(&pair, 0.1 + 0.1037 * f64::from(i));
            let sample = with.sample(&point);
            let at_law = without
                .clearances_at_law(&point)
                .expect("nothing penetrates");
            for (one, other) in [
                (at_law.root, sample.clearance),
                (at_law.fillet, sample.fillet_clearance),
            ] {
                assert!(
                    one == other || (one - other).abs() < 1e-9,
                    "{name}: {one} {other}"
                );
            }
        }
    }
}

/// The backlash comes from seating the contours as polygons.
#[test]
fn edges_that_touch_bound_the_backlash_of_trimmed_teeth() {
    let pair = design("transplanter-pair-2021");
    let polygons = [
        (3.876, 0.001_897),
        (3.880, 0.001_910),
        (3.888, 0.001_939),
        (3.900, 0.002_001),
    ];
    let contact = Contact::analyse_at(&pair, &polygons.map(|(input, _)| input));
    for (i, (input, backlash)) in polygons.into_iter().enumerate() {
        assert!(
            (contact.backlash[i] - backlash).abs() < 1e-6,
            "{} at {input}",
            contact.backlash[i]
        );
        assert!(contact.transmission_error[i].abs() < 6e-5, "at {input}");
        assert!(contact.penetration[i] == 0.0, "at {input}");
    }
}

#[test]
fn the_error_at_an_edge_is_measured_from_the_designed_flank() {
    let pair = design("transplanter-pair-2021");
    let phi = 3.5343;
    let contact = Contact::analyse_at(&pair, &[phi]);
    let pitch = pair.pitch_point(phi);
    let lever = pitch.driven_radius * pitch.pressure_angle.cos();
    let designed = pair.driven_angle(phi) - 0.5 * pair.backlash() / lever;
    let error = contact.driven_angle[0] - designed;
    // The lever holds to the first order of the backlash.
    assert!((contact.transmission_error[0] - error).abs() < 2e-6);
    assert!((error - 1.18e-3).abs() < 2e-6, "{error:e}");
}

/// Turning the driven gear by half the backlash takes at both inputs the contact past the end of a flank.
#[test]
fn flanks_thinned_for_backlash_have_no_error_at_their_ends() {
    let contact = Contact::analyse_at(&design("quintic-pair"), &[0.0, 4.476_110_580_575_04]);
    let errors = contact.transmission_error.iter();
    for error in errors.chain(&contact.reverse_transmission_error) {
        assert!(error.abs() < 1e-12, "{error:e}");
    }
}

#[test]
fn the_seats_of_a_certificate_are_those_of_the_samples() {
    let pair = design("law-pair");
    let proof = prove(&pair).expect("a certificate");
    let middles: Vec<f64> = proof
        .stretches
        .iter()
        .map(|s| 0.5 * (s.from + s.to))
        .collect();
    let contact = Contact::analyse_at(&pair, &middles);
    // In the middle the odd terms of a series are zero, and the even ones change their sign.
    let middle = |series: &[f64]| -> f64 {
        let even = series.iter().step_by(2).enumerate();
        even.map(|(k, c)| if k % 2 == 0 { *c } else { -c }).sum()
    };
    for (i, stretch) in proof.stretches.iter().enumerate() {
        let sampled = [contact.driven_angle[i], contact.reverse_driven_angle[i]];
        for (seat, angle) in stretch.seats.iter().zip(sampled) {
            let off = contact.law[i] + middle(seat) - angle;
            assert!(off.abs() < proof.half_width, "{off:e} at {}", middles[i]);
        }
    }
}

#[test]
fn a_certificate_follows_the_contact_over_the_ends_of_trimmed_flanks() {
    let pair = design("quintic-pair");
    assert_eq!(pair.teeth().addendum, Addendum::Fitted);
    let proof = prove(&pair).expect("a certificate");
    let ends = proof.stretches.windows(2);
    assert!(ends.into_iter().all(|two| two[0].to == two[1].from));
    // Here a tooth lies within the backlash.
    let found = prove(&design("transplanter-pair-2021"));
    let angle = |error: &ProofError| match error {
        ProofError::Step { phi, .. } => *phi,
        _ => f64::NAN,
    };
    let at = found.as_ref().err().map(angle);
    assert!(at.is_some_and(|phi| (3.42..3.44).contains(&phi)), "{at:?}");
}

/// The angle comes from turning one outline against the other as polygons.
#[test]
fn a_tooth_that_comes_into_the_backlash_makes_a_seat_jump() {
    let pair = design("transplanter-pair-2021");
    let jumps = Contact::analyse(&pair).seat_jumps(&pair);
    let first = jumps.first().expect("a jump");
    assert!((first.input - 3.43).abs() < 1e-4, "{first:?}");
    assert!((first.turn - 1.1e-3).abs() < 1e-5, "{first:?}");
    assert!(!first.is_reverse && first.teeth == (22, 21), "{first:?}");
    // Just before it the driven gear is at the old seat, just after it at the new one.
    let neighbours = [first.input - 1e-6, first.input + 1e-6];
    let contact = Contact::analyse_at(&pair, &neighbours);
    let off = |k: usize| contact.driven_angle[k] - contact.law[k];
    assert!(((off(1) - off(0)).abs() - first.turn).abs() < 1e-5);
    for sound in ["law-pair", "quintic-pair"] {
        let pair = design(sound);
        assert!(
            Contact::analyse(&pair).seat_jumps(&pair).is_empty(),
            "{sound}"
        );
    }
}

#[test]
fn interfering_gears_are_analysed_at_few_samples() {
    // Roots too shallow for the tips by a quarter of the module.
    let text = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\nmodule = 2\neccentricity = 0.2\ntooth_count = 41\n[tool]\nkind = \"rack\"\ndedendum_coefficient = 0.75\ntip_radius_coefficient = 0.1\n";
    let jammed = GearPairDesign::from_toml(text).expect("a design");
    let jammed = GearPair::resolve(&jammed).expect("a pair");
    let contact = Contact::analyse(&jammed);
    assert!(contact.interferes(&jammed));
    assert!(contact.input.len() <= 4 * 41 + 2, "{}", contact.input.len());
    assert!(contact.seat_jumps(&jammed).is_empty());
    let deepest = contact.penetration.iter().copied().fold(0.0, f64::max);
    let found = contact.extremes(&jammed).penetration;
    assert!(deepest > 0.1 && found.value.to_bits() == deepest.to_bits());
    for runs in ["law-pair", "transplanter-pair-2021"] {
        let pair = design(runs);
        assert!(!Contact::analyse(&pair).interferes(&pair), "{runs}");
    }
}

/// Their tips pass the root fillets, which are as large as that allows.
#[test]
fn fitted_teeth_of_circles_at_a_small_pressure_angle_carry_the_motion() {
    let kinds = ["kind = \"rack\"", "kind = \"shaper\"\ntooth_count = 24"];
    for (z, kind) in [14, 16, 20, 21, 36, 40, 44, 60]
        .map(|z| kinds.map(|kind| (z, kind)))
        .concat()
    {
        for backlash in [0.0, 0.1] {
            let text = format!(
                "family = \"gear-pair\"\n[pitch]\nkind = \"polar\"\nmodule = 2\nexpression = \"1\"\ntooth_count = {z}\n[tool]\n{kind}\npressure_angle_deg = 14.5\n[teeth]\naddendum = \"fitted\"\nbacklash = {backlash}\n"
            );
            let design = GearPairDesign::from_toml(&text).expect("a design");
            let pair = GearPair::resolve(&design).expect("a pair");
            let found = Contact::analyse(&pair).extremes(&pair);
            let error = found.transmission_error.value;
            assert!(error < 1e-9, "z {z}, {kind}, {backlash}: {error:e}");
            let deepest = found.penetration.value.max(-found.fillet_clearance.value);
            assert!(deepest < 1e-6, "z {z}, {kind}, {backlash}: {deepest:e}");
        }
    }
}

#[test]
fn gears_that_run_on_edges_are_analysed_at_few_samples() {
    // Pitch curves that oscillate once per tooth and 24 times per tooth.
    for (radius, off) in [
        ("1+0.02*cos(40*phi)", 1e-3),
        ("1+0.00001*cos(963*phi)", 4e-4),
    ] {
        let text = format!(
            "family = \"gear-pair\"\n[pitch]\nkind = \"polar\"\nmodule = 2\nexpression = \"{radius}\"\ntooth_count = 40\n[teeth]\naddendum = \"fitted\"\nbacklash = 0.05\n"
        );
        let design = GearPairDesign::from_toml(&text).expect("a design");
        let pair = GearPair::resolve(&design).expect("a pair");
        let contact = Contact::analyse(&pair);
        assert!(
            contact.runs_on_edges(&pair) && !contact.is_followed(&pair),
            "{radius}"
        );
        assert!(contact.input.len() <= 40 + 2, "{}", contact.input.len());
        assert!(contact.seat_jumps(&pair).is_empty());
        let errors = contact.transmission_error.iter().map(|e| e.abs());
        let largest = errors.fold(0.0, f64::max);
        let found = contact.extremes(&pair).transmission_error;
        assert!(largest > off, "{radius}: {largest}");
        assert_eq!(found.value.to_bits(), largest.to_bits(), "{radius}");
        let findings = crate::gear_pair::check(&pair).findings;
        let lost = findings.iter().find(|f| f.rule == "contact-lost");
        let message = &lost.expect("a finding").message;
        assert!(message.contains("the driven gear is at least"), "{message}");
    }
    // Contact on an edge over a few degrees of the cycle does not prevent the search between samples.
    let pair = design("transplanter-pair-2021");
    assert!(!Contact::analyse(&pair).runs_on_edges(&pair));
}

#[test]
fn a_corner_next_to_a_sharp_bend_has_its_foot_there() {
    // A flank of this mechanism's sun has a curvature of 4.8/mm where it meets its fillet.
    let text = include_str!("../../../../tests/designs/three-arm-all-goals.toml");
    let design = ThreeArmDesign::from_toml(text).expect("a design");
    let arms = ThreeArm::resolve(&design).expect("a mechanism");
    let proof = prove(&arms.pair().expect("gears")).expect("a certificate");
    let along = |s: &&ProofStretch| s.from > 2.4133 && s.to < 2.4142;
    let near = |s: &ProofStretch| s.meetings.iter().any(|m| m.pieces[0] == 150);
    let mut all = proof.stretches.iter().filter(along).peekable();
    assert!(all.peek().is_some() && all.all(near));
}

#[test]
fn gears_without_room_have_no_certificate_and_the_error_says_where() {
    // Five deep lobes are too much for fifty teeth.
    let text = r#"
        family = "gear-pair"
        pitch = { kind = "polar", expression = "(1 + 0.45*cos(5*phi))/(2 + 0.45*cos(5*phi))", module = 1, tooth_count = 50 }
    "#;
    let design = GearPairDesign::from_toml(text).expect("a design");
    let pair = GearPair::resolve(&design).expect("a pair");
    let Err(ProofError::NoRoom { phi, overlap }) = prove(&pair) else {
        panic!("no room");
    };
    // There the backlash is negative by the missing room.
    let contact = Contact::analyse_at(&pair, &[phi]);
    assert!(
        (contact.backlash[0] + overlap).abs() < 1e-9 && overlap > 1e-6,
        "{phi} {overlap}"
    );
}

/// Polygons of these gears, turned by the law, have no area in common anywhere.
#[test]
fn sides_of_neighbouring_teeth_that_face_each_other_do_not_penetrate() {
    let text = r#"
        family = "gear-pair"
        pitch = { kind = "ratio", expression = "1 + 0.334*cos(2*phi)", module = 1, tooth_count = 16 }
        teeth = { addendum = "fitted" }
    "#;
    let design = GearPairDesign::from_toml(text).expect("a design");
    let pair = GearPair::resolve(&design).expect("a pair");
    let extremes = Contact::analyse(&pair).extremes(&pair);
    for clearance in [extremes.clearance, extremes.fillet_clearance] {
        assert!(clearance.value > -1e-8, "{clearance:?}");
    }
}

/// Flanks of this driver end next to a cusp, where their curvature is 25,000/mm.
#[test]
fn a_contact_near_a_cusp_is_found_from_any_previous_sample() {
    let text = r#"
        family = "gear-pair"
        pitch = { kind = "ellipse", eccentricity = 0.6758549005856598, module = 0.5, tooth_count = 31 }
        tool = { kind = "rack", tip_radius_coefficient = 0.25 }
        teeth = { phase = 0.49867478413033606, backlash = 0.037552126566842425, thickness_split = 0.48019125770153837 }
    "#;
    let design = GearPairDesign::from_toml(text).expect("a design");
    let pair = GearPair::resolve(&design).expect("a pair");
    let inputs: Vec<f64> = (0..54).map(|i| 0.05605 + 1e-3 * f64::from(i)).collect();
    let along = Contact::analyse_at(&pair, &inputs);
    for (k, &input) in inputs.iter().enumerate() {
        let alone = Contact::analyse_at(&pair, &[input]);
        let [one, other] = [along.sliding[k], alone.sliding[0]];
        assert!(
            (one - other).abs() < 1e-9 * one,
            "{one} and {other} at {input}"
        );
        // The teeth that have just met at the seat, at 0.051, slide the fastest.
        assert!(one > 1.8 + 40.0 * (0.11 - input), "{one} at {input}");
    }
}

/// A pair by its pitch curve and teeth, as written.
fn pair_of(text: &str) -> GearPair {
    let design = GearPairDesign::from_toml(&format!("family = \"gear-pair\"\n{text}"));
    GearPair::resolve(&design.expect("a design")).expect("a pair")
}

#[test]
fn figures_of_one_period_or_half_of_it_are_those_of_the_cycle() {
    // One curve by its kind, with known symmetry, and by a formula without.
    let kinds = [
        "kind = \"limacon\"\nmean_radius = 30\namplitude = 2.5\nlobes = 3\n",
        "kind = \"polar\"\nexpression = \"30 + 2.5*cos(3*phi)\"\n",
    ];
    for teeth in [
        "phase = 0.0\nbacklash = 0.06\n",
        "phase = 0.5\nthickness_split = 0.46\n",
        "phase = 0.2\nbacklash = 0.03\n",
        "addendum = \"fitted\"\nbacklash = 0.05\n",
    ] {
        let both = kinds.map(|kind| {
            pair_of(&format!(
                "[pitch]\n{kind}tooth_count = 30\n[teeth]\n{teeth}"
            ))
        });
        let [known, unknown] = &both;
        assert_eq!((known.period(), unknown.period()), (10, 30));
        assert_eq!(known.is_mirrored(), !teeth.contains("0.2"));
        let [one, two] = both.each_ref().map(|pair| {
            let contact = Contact::sampled(pair, 8);
            assert!(contact.input.is_sorted());
            contact
        });
        let there = Contact::analyse_at(unknown, &one.input);
        let off = |a: &[f64], b: &[f64]| {
            let both = a.iter().zip(b);
            both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        for (a, b) in [
            (&one.driven_angle, &there.driven_angle),
            (&one.reverse_driven_angle, &there.reverse_driven_angle),
            (&one.backlash, &there.backlash),
            (&one.normal_backlash, &there.normal_backlash),
            (&one.transmission_error, &there.transmission_error),
            (&one.sliding, &there.sliding),
        ] {
            assert!(off(a, b) < 1e-8, "{teeth}: {}", off(a, b));
        }
        assert_eq!(one.contacts, there.contacts);
        let [one, two] = [one.extremes(known), two.extremes(unknown)];
        for (a, b) in [
            (one.sliding, two.sliding),
            (one.backlash[0], two.backlash[0]),
            (one.backlash[1], two.backlash[1]),
            (one.normal_backlash[0], two.normal_backlash[0]),
            (one.clearance, two.clearance),
            (one.fillet_clearance, two.fillet_clearance),
            (one.contacts[0], two.contacts[0]),
            (one.contacts[1], two.contacts[1]),
        ] {
            let is_same = a.value == b.value || (a.value - b.value).abs() < 1e-8;
            assert!(is_same, "{teeth}: {a:?} {b:?}");
        }
        assert!((one.contact_ratio - two.contact_ratio).abs() < 1e-8);
    }
}

#[test]
fn the_mean_of_contacts_of_a_circle_is_the_contact_ratio_of_the_standard() {
    // ISO 21771: the length of the path of contact over the base pitch.
    for (z1, z2, module, backlash) in [
        (23.0, 23.0, 2.0, 0.0),
        (40.0, 60.0, 1.5, 0.0),
        // The driven gear is turned to its seat, and the path of contact stays.
        (23.0, 23.0, 2.0, 0.05),
        (40.0, 60.0, 1.5, 0.3),
    ] {
        let (driver, ratio) = (z1 as u32, if z1 == z2 { "[1, 1]" } else { "[3, 2]" });
        let pair = pair_of(&format!(
            "mean_ratio = {ratio}\n[pitch]\nkind = \"circle\"\nmodule = {module}\ntooth_count = {driver}\n\
             [teeth]\nbacklash = {backlash}\n"
        ));
        let (sin, cos) = 20.0_f64.to_radians().sin_cos();
        let path = |z: f64| {
            let (tip, base) = (0.5 * module * z + module, 0.5 * module * z * cos);
            (tip * tip - base * base).sqrt() - 0.5 * module * z * sin
        };
        let ratio = (path(z1) + path(z2)) / (std::f64::consts::PI * module * cos);
        let found = Contact::analyse(&pair).extremes(&pair);
        assert!(
            (found.contact_ratio - ratio).abs() < 1e-9,
            "{} {ratio}",
            found.contact_ratio
        );
        assert_eq!(found.contacts.map(|e| e.value), [1.0, 2.0]);
    }
}

#[test]
fn contact_lost_between_two_samples_is_found_with_backlash() {
    // The path of contact is shorter than a base pitch: over the missing share edges drive.
    let (addendum, module, teeth) = (0.5667, 2.0, 24.0);
    let pair = pair_of(&format!(
        "[pitch]\nkind = \"circle\"\nmodule = {module}\ntooth_count = {teeth}\n\
         [tool]\nkind = \"rack\"\naddendum_coefficient = {addendum}\n[teeth]\nphase = \"tooth\"\nbacklash = 0.4\n"
    ));
    let (sin, cos) = 20.0_f64.to_radians().sin_cos();
    let radius: f64 = 0.5 * module * teeth;
    let path =
        ((radius + addendum * module).powi(2) - (radius * cos).powi(2)).sqrt() - radius * sin;
    let ratio = 2.0 * path / (std::f64::consts::PI * module * cos);
    let found = Contact::analyse(&pair).extremes(&pair);
    assert!(
        (found.lost - (1.0 - ratio)).abs() < 1e-6,
        "{} {ratio}",
        found.lost
    );
    let inputs: Vec<f64> = (0..4000)
        .map(|k| pair.cycle() / teeth * f64::from(k) / 4000.0)
        .collect();
    let seen = Contact::analyse_at(&pair, &inputs).transmission_error;
    let largest = seen
        .iter()
        .fold(0.0_f64, |most, error| most.max(error.abs()));
    assert!(largest > 5e-6, "{largest}");
    assert!(found.transmission_error.value >= largest * (1.0 - 1e-9));
    assert!(found.transmission_error.value < largest * 1.01);
}

#[test]
fn backlash_is_no_turn_where_the_normal_of_the_law_passes_the_axis() {
    let pair = pair_of(
        "[pitch]\nkind = \"polar\"\nexpression = \"1 + 0.1*cos(40*phi)\"\nmodule = 2\ntooth_count = 40\n\
         [teeth]\naddendum = \"fitted\"\nbacklash = 0.05\n",
    );
    let contact = Contact::sampled(&pair, 48);
    let errors = contact
        .transmission_error
        .iter()
        .chain(&contact.reverse_transmission_error);
    let angles = contact
        .driven_angle
        .iter()
        .chain(&contact.reverse_driven_angle);
    let laws = contact.law.iter().chain(&contact.law);
    for ((error, angle), law) in errors.zip(angles).zip(laws) {
        let most = 4.0 * pair.module() / pair.center_distance();
        assert!((angle - law - error).abs() <= most, "{error}");
    }
}

#[test]
fn an_edge_does_not_touch_before_its_flank() {
    // The path of an edge only touches the mate's flank, where the contact begins: the tip next to it must not count as in front of it.
    for pair in [design("elliptic-pair-2018"), many(30)] {
        let pitch = pair.cycle() / 30.0;
        let inputs: Vec<f64> = (0..60_000)
            .map(|k| 1.0 + 2.0 * pitch * f64::from(k) / 60_000.0)
            .collect();
        let found = Contact::analyse_at(&pair, &inputs);
        let errors = found
            .transmission_error
            .iter()
            .chain(&found.reverse_transmission_error);
        let most = errors.fold(0.0_f64, |most, e| most.max(e.abs()));
        assert!(most < 1e-12, "{most:e}");
    }
}
