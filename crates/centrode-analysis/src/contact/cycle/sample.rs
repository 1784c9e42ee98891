//! Figures of one sample, and of the samples that are its copies.

use centrode_gear::PitchContact;
use centrode_geometry::checkpoint;

use super::{
    Contact,
    backlash_position::{BacklashPosition, lever},
    clearances::Clearances,
};
use crate::contact::contour::Pose;
use crate::contact::seat::{FacingFlanks, Meshing, Proximity, ProximityKind, SEATED, SeatedPose};

/// Deviation from the designed backlash within which flanks face each other as designed, modules. Ten times less fails
/// by rounding of the outline, ten times more accepts edges next to a flank.
const DESIGNED_GAP: f64 = 1e-6;

/// Newton step of the driven angle below which the angle is exact, rad: about its rounding. A smaller step may never be
/// reached.
const SETTLED: f64 = 1e-12;

/// Figures of one sample.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Sample {
    /// Driver angle, rad.
    pub(super) input: f64,
    /// Driven angle of the law, rad.
    pub(super) law: f64,
    /// With the driver pushing forward, and pushing back.
    pub(super) loaded: [LoadedFigures; 2],
    /// Angular backlash, rad.
    pub(super) backlash: f64,
    /// Depth of penetration, mm.
    pub(super) penetration: f64,
    /// Clearance of tips from roots, mm.
    pub(in crate::contact) clearance: f64,
    /// Clearance of tips from fillets, mm.
    pub(in crate::contact) fillet_clearance: f64,
}

/// Figures with the driver pushing in one direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoadedFigures {
    /// Driven angle, rad; infinite if nothing holds the gear.
    pub(super) angle: f64,
    /// Transmission error, rad.
    pub(super) error: f64,
    /// Pairs of teeth in contact.
    pub(super) contacts: u32,
    /// Maximum sliding speed per driver speed, mm/rad.
    pub(super) sliding: f64,
    /// Distance of the driven axis from the line of action of the law, mm.
    pub(super) lever: f64,
    /// Whether flanks face each other as designed.
    pub(super) on_flanks: bool,
}

impl LoadedFigures {
    /// Figures of gears out of mesh.
    pub(super) fn out_of_mesh(lever: f64) -> Self {
        Self {
            angle: f64::INFINITY,
            error: f64::INFINITY,
            contacts: 0,
            sliding: 0.0,
            lever,
            on_flanks: false,
        }
    }

    /// The figures of the pair's mirror image, where the driver pushes in the other direction.
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

    /// The figures after a rotation of driver and driven gear, rad.
    pub(super) fn after(&self, driver: f64, driven: f64) -> Self {
        let loaded = |load: LoadedFigures| LoadedFigures {
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

impl Meshing<'_> {
    /// Analyses the gears at a contact of the pitch curves.
    pub(in crate::contact) fn sample(&mut self, point: &PitchContact) -> Sample {
        checkpoint();
        let (phi, law) = (point.input, point.driven_angle);
        let a = self.pair.center_distance();
        let pose = Pose::new(phi, law, a);
        let mut candidates = self.candidates(&pose);
        let proximities = self.proximities(&mut candidates, &pose);
        let seats = self.seats(&candidates, phi, law);
        let levers = [1.0, -1.0].map(|sign| lever(self.pair, point, sign));
        let [Some(forward), Some(back)] = &seats else {
            // No tooth reaches the other gear.
            return Sample {
                input: phi,
                law,
                loaded: levers.map(LoadedFigures::out_of_mesh),
                backlash: f64::INFINITY,
                penetration: 0.0,
                clearance: f64::INFINITY,
                fillet_clearance: f64::INFINITY,
            };
        };
        let half = 0.5 * self.pair.backlash();
        let loaded = |seat: &SeatedPose, sign: f64, lever: f64| LoadedFigures {
            on_flanks: self
                .designed(&proximities, sign)
                .any(|p| p.points.is_on_both()),
            angle: seat.angle,
            error: seat.angle - self.ideal(&proximities, point, sign * half),
            contacts: seat.contacts,
            sliding: self.sliding(&proximities, point, sign, seat),
            lever,
        };
        let loaded = [
            loaded(forward, 1.0, levers[0]),
            loaded(back, -1.0, levers[1]),
        ];
        let backlash = back.angle - forward.angle;
        // Without room the driven gear penetrates on both sides by half of the missing room.
        let penetration = (-backlash * 0.5 * forward.lever.min(back.lever)).max(0.0);
        // If the gears penetrate at the law's angle although there is room, clearances are those in the middle of the backlash.
        let off = (law - back.angle).max(forward.angle - law);
        let (proximities, core_penetration) = if backlash > 0.0 && off * a > SEATED * self.module {
            let pose = Pose::new(phi, 0.5 * (forward.angle + back.angle), a);
            let mut candidates = self.candidates(&pose);
            let proximities = self.proximities(&mut candidates, &pose);
            (proximities, candidates.core_penetration)
        } else {
            (proximities, candidates.core_penetration)
        };
        let clearances = Clearances::new(&proximities, core_penetration);
        Sample {
            input: phi,
            law,
            loaded,
            backlash,
            penetration,
            clearance: clearances.root,
            fillet_clearance: clearances.fillet,
        }
    }

    /// Flanks that face each other as designed at the law's angle, with half the designed backlash between them, with the driver pushing
    /// on (`sign` above zero) or back.
    fn designed<'p>(
        &self,
        proximities: &'p [Proximity],
        sign: f64,
    ) -> impl Iterator<Item = &'p Proximity> {
        let (half, near) = (0.5 * self.pair.backlash(), DESIGNED_GAP * self.module);
        proximities.iter().filter(move |p| {
            p.kind == ProximityKind::Flanks
                && p.corner.is_none()
                && sign * p.points.lever > 0.0
                && (half - p.points.gap).abs() < near
        })
    }

    /// Driven angle at which flanks with exactly the designed backlash touch, rad; `half` is half of it, negative if the driver pushes
    /// back.
    ///
    /// At the law's angle flanks thinned for backlash are parallel and half the backlash apart. The driven gear is turned until they
    /// touch. If no flanks face each other as designed, the rotation follows from the law's normal.
    fn ideal(&self, proximities: &[Proximity], point: &PitchContact, half: f64) -> f64 {
        let (phi, law) = (point.input, point.driven_angle);
        if half == 0.0 {
            return law;
        }
        let off = |p: &Proximity| (half.abs() - p.points.gap).abs();
        let mut facing: Vec<&Proximity> = self.designed(proximities, half).collect();
        facing.sort_by(|p, q| off(p).total_cmp(&off(q)));
        let touching = facing.into_iter().find_map(|proximity| {
            let wrong = (half.abs() - proximity.points.gap) / proximity.points.lever;
            let mut parts = proximity.parts;
            let (mut angle, mut points) = (law, proximity.points);
            for _ in 0..8 {
                let step = points.gap / points.lever;
                angle -= step;
                if step.abs() < SETTLED {
                    return Some(angle - wrong);
                }
                let pose = Pose::new(phi, angle, self.pair.center_distance());
                FacingFlanks { parts, points } = self.along_flanks(parts, points.at, &pose)?;
            }
            None
        });
        touching.unwrap_or_else(|| BacklashPosition::Pushed(half.signum()).angle(self.pair, point))
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
