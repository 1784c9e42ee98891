/// Usual remedy against a finding of a rule.
pub(crate) fn remedy(rule: &str) -> Option<&'static str> {
    Some(match rule {
        "severed" | "undercut" | "short-tooth" => {
            "more teeth of a smaller module, or teeth.addendum = \"fitted\""
        }
        "pointed" | "thin-tip" => {
            "a smaller addendum or pressure angle, or a smaller profile shift"
        }
        "no-flank" | "disengaged" | "contact-lost" => {
            "a pitch curve of gentler curvature, or more teeth of a smaller module"
        }
        "interference" => "more tip clearance or backlash, or a smaller module",
        "pressure-angle" => {
            "a pitch curve whose radius changes more slowly, or a smaller tool pressure angle"
        }
        "shaper-radius" => "a shaper of fewer teeth, or a pitch curve less concave",
        _ => return None,
    })
}
