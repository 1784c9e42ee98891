use centrode_gear::design::Addendum;

/// Remedy for a finding about the teeth of a pair with the given addendum.
pub(super) fn remedy_of_teeth(rule: &str, addendum: Addendum) -> Option<&'static str> {
    match (rule, addendum) {
        ("cut-through" | "undercut" | "short-tooth", Addendum::Fitted) => {
            Some("more teeth of a smaller module, or a pitch curve of gentler curvature")
        }
        _ => remedy(rule),
    }
}

/// Whether a rule is about the teeth or their mesh: for circular gears its remedy is searched by trial.
pub(super) fn is_of_teeth(rule: &str) -> bool {
    let of_teeth = [
        "cut-through",
        "undercut",
        "short-tooth",
        "pointed",
        "thin-tip",
        "no-flank",
    ];
    let of_mesh = [
        "disengaged",
        "contact-lost",
        "seat-jump",
        "interference",
        "tip-interference",
    ];
    of_teeth.contains(&rule) || of_mesh.contains(&rule)
}

/// Usual remedy for a finding of a rule.
pub(crate) fn remedy(rule: &str) -> Option<&'static str> {
    Some(match rule {
        "cut-through" | "undercut" | "short-tooth" => {
            "more teeth of a smaller module, or teeth.addendum = \"fitted\""
        }
        "pointed" | "thin-tip" => {
            "a smaller addendum or pressure angle, or a smaller profile shift"
        }
        "no-flank" | "disengaged" | "contact-lost" | "seat-jump" => {
            "a pitch curve of gentler curvature, or more teeth of a smaller module"
        }
        "interference" => "more backlash, or a smaller module",
        "negative-backlash" => "more backlash, or a smaller upper deviation of tooth thickness",
        "zero-backlash" => {
            "teeth.backlash of 0.02 to 0.05 modules, plus the oversize of the manufacturing process"
        }
        "tip-interference" => "more tip clearance, or a smaller module",
        "pitch-curve-corner" => "samples that round the corner over a pitch or more",
        "pressure-angle" => {
            "a pitch curve whose radius changes more slowly, or a smaller tool pressure angle"
        }
        "uncut-corner" | "kerf-too-wide" => {
            "a narrower cut, a larger module, or a larger tool.tip_radius_coefficient"
        }
        "pitch-curve-swings" => "a smoother law, or fewer points or more digits",
        "pitch-curves-overlap" => "a law whose ratio varies less, or has fewer waves per turn",
        "shaper-radius" => "a shaper cutter with fewer teeth, or a less concave pitch curve",
        _ => return None,
    })
}
