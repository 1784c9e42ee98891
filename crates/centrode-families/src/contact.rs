use centrode_analysis::Contact;
use centrode_export::picture::Curve;

/// Findings of running finished gears together, along the cycle.
pub(super) fn contact_curves(contact: &Contact) -> Vec<Curve> {
    let curve = |chart, name, unit, value| Curve::new([chart, name, unit], &contact.input, value);
    let degrees = |list: &[f64]| list.iter().map(|v| v.to_degrees()).collect::<Vec<_>>();
    vec![
        Curve {
            count: true,
            ..curve(
                "Contacts at once",
                "",
                "",
                contact.contacts.iter().map(|&n| f64::from(n)).collect(),
            )
        },
        curve(
            "Backlash of the driven gear",
            "",
            "°",
            degrees(&contact.backlash),
        ),
        curve("Clearance", "tip to root", "mm", contact.clearance.clone()),
        curve(
            "Clearance",
            "tip to fillet",
            "mm",
            contact.fillet_clearance.clone(),
        ),
        curve(
            "Transmission error",
            "forward",
            "rad",
            contact.transmission_error.clone(),
        ),
        curve(
            "Transmission error",
            "reverse",
            "rad",
            contact.reverse_transmission_error.clone(),
        ),
        curve(
            "Sliding a rad of the driver",
            "",
            "mm",
            contact.sliding.clone(),
        ),
    ]
}
