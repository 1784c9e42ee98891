use centrode_analysis::Contact;
use centrode_export::picture::Curve;

/// Curves of the contact of the finished gears along the cycle.
pub(super) fn contact_curves(contact: &Contact) -> Vec<Curve> {
    let curve = |chart, name, unit, value: &[f64]| {
        Curve::new([chart, name, unit], &contact.input, value.to_vec())
    };
    let degrees = contact.backlash.iter().map(|angle| angle.to_degrees());
    let degrees: Vec<f64> = degrees.collect();
    let count: Vec<f64> = contact.contacts.iter().map(|&n| f64::from(n)).collect();
    let (forward, reverse) = (
        &contact.transmission_error,
        &contact.reverse_transmission_error,
    );
    vec![
        Curve {
            count: true,
            ..curve("Tooth pairs in contact", "", "", &count)
        },
        curve("Backlash of the driven gear", "", "°", &degrees),
        curve("Clearance", "tip to root", "mm", &contact.clearance),
        curve(
            "Clearance",
            "tip to fillet",
            "mm",
            &contact.fillet_clearance,
        ),
        curve("Transmission error", "forward", "rad", forward),
        curve("Transmission error", "reverse", "rad", reverse),
        curve(
            "Sliding speed per driver speed",
            "",
            "mm/rad",
            &contact.sliding,
        ),
    ]
}
