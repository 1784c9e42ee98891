//! Figures of one pose, and of the poses that are its images.

use super::Contact;

/// Figures of one pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Driver angle, rad.
    pub(super) input: f64,
    /// Driven angle the pitch curves ask for, rad.
    pub(super) law: f64,
    /// With the driver pushing on, and pushing back.
    pub(super) loaded: [Loaded; 2],
    pub(super) backlash: f64,
    pub(super) penetration: f64,
    pub(super) clearance: f64,
    pub(super) fillet_clearance: f64,
}

/// Figures of a pose under load.
#[derive(Clone, Copy, Debug)]
pub(super) struct Loaded {
    /// Driven angle, rad; infinite where nothing holds the gear.
    pub(super) angle: f64,
    /// Transmission error, rad.
    pub(super) error: f64,
    /// Pairs of teeth in contact.
    pub(super) contacts: u32,
    /// Greatest sliding speed per driver speed, mm/rad.
    pub(super) sliding: f64,
    /// Distance of the driven axis from the line of action by the law, mm.
    pub(super) lever: f64,
    /// Whether flanks that face each other as designed are there to carry the load.
    pub(super) on_flanks: bool,
}

impl Loaded {
    /// Nothing holds the gear.
    pub(super) fn apart(lever: f64) -> Self {
        Self {
            angle: f64::INFINITY,
            error: f64::INFINITY,
            contacts: 0,
            sliding: 0.0,
            lever,
            on_flanks: false,
        }
    }

    /// The load the other way, of the pair's mirror image.
    fn mirrored(&self) -> Self {
        let negative = |angle: f64| if angle.is_finite() { -angle } else { angle };
        Self {
            angle: negative(self.angle),
            error: negative(self.error),
            ..*self
        }
    }
}

impl Sample {
    /// Figures of the pair's mirror image, at the opposite angles.
    pub(super) fn mirrored(&self) -> Self {
        let [on, back] = &self.loaded;
        Self {
            input: -self.input,
            law: -self.law,
            loaded: [back.mirrored(), on.mirrored()],
            ..*self
        }
    }

    /// The figures of a pose after the driver has turned on by one angle and the driven gear by another.
    pub(super) fn after(&self, driver: f64, driven: f64) -> Self {
        let loaded = |load: Loaded| Loaded {
            angle: load.angle + driven,
            ..load
        };
        Self {
            input: self.input + driver,
            law: self.law + driven,
            loaded: self.loaded.map(loaded),
            ..*self
        }
    }
}

impl FromIterator<Sample> for Contact {
    fn from_iter<T: IntoIterator<Item = Sample>>(samples: T) -> Self {
        let samples = samples.into_iter();
        let mut out = Self::with_capacity(samples.size_hint().0);
        for sample in samples {
            let [on, back] = sample.loaded;
            out.input.push(sample.input);
            out.law.push(sample.law);
            out.driven_angle.push(on.angle);
            out.reverse_driven_angle.push(back.angle);
            out.transmission_error.push(on.error);
            out.reverse_transmission_error.push(back.error);
            out.backlash.push(sample.backlash);
            out.normal_backlash.push(sample.backlash * on.lever);
            out.contacts.push(on.contacts);
            out.reverse_contacts.push(back.contacts);
            out.on_flanks.push(on.on_flanks);
            out.reverse_on_flanks.push(back.on_flanks);
            out.penetration.push(sample.penetration);
            out.clearance.push(sample.clearance);
            out.fillet_clearance.push(sample.fillet_clearance);
            out.sliding.push(on.sliding);
        }
        out
    }
}

impl Contact {
    fn with_capacity(count: usize) -> Self {
        let list = || Vec::with_capacity(count);
        Self {
            input: list(),
            law: list(),
            driven_angle: list(),
            reverse_driven_angle: list(),
            transmission_error: list(),
            reverse_transmission_error: list(),
            backlash: list(),
            normal_backlash: list(),
            contacts: Vec::with_capacity(count),
            reverse_contacts: Vec::with_capacity(count),
            on_flanks: Vec::with_capacity(count),
            reverse_on_flanks: Vec::with_capacity(count),
            penetration: list(),
            clearance: list(),
            fillet_clearance: list(),
            sliding: list(),
        }
    }
}
