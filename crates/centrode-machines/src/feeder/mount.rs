use std::sync::Arc;

use centrode_geometry::{Outline, Recent, Solid, SolidError, Tolerance};

use super::{Feeder, FeederPart, GearsSpec};
use centrode_gear::IntermittentPair;
use centrode_kinematics::machine::{Joint, Linear, Link, LinkedMachine, Quantity};

/// Name of the intermittent gear, for its files and its link.
const DRIVER: &str = "gear-driver";
/// Name of the driven gear.
const DRIVEN: &str = "gear-driven";
/// Names of the cams next to the intermittent gear.
const CAMS: [&str; 2] = ["gear-entry-cam", "gear-exit-cam"];

/// Accuracy of the bodies in the machine, mm.
const FINE: f64 = 1e-3;

/// A gear or cam of the feeder as it is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct GearBody {
    /// Name of the body, for its files and its link.
    pub name: &'static str,
    /// Contour, mm.
    pub outline: Outline,
    /// Contour of the bore.
    pub bore: Option<Outline>,
    /// Holes for the pins that run on the cams.
    pub pins: Vec<Outline>,
}

impl GearBody {
    /// Names of all possible bodies: the intermittent gear, the driven gear, the entry cam, the exit cam.
    pub const NAMES: [&str; 4] = [DRIVER, DRIVEN, CAMS[0], CAMS[1]];

    /// The gears and cams of a pair, with arcs within a tolerance.
    #[must_use]
    pub fn all(gears: &IntermittentPair, tolerance: Tolerance) -> Vec<Self> {
        let pair = gears.pair();
        // The outlines are cut as short chords. Lines and arcs of the same accuracy replace them, because solids can have arcs,
        // too.
        let cut = |outline: &Outline| outline.polygon_arcs(gears.accuracy(), tolerance);
        let body = |name, outline: &Outline, bore: Option<Outline>| Self {
            name,
            outline: cut(outline),
            bore,
            pins: Vec::new(),
        };
        let mut driven = body(DRIVEN, gears.driven(), pair.driven().bore());
        for cam in gears.cams() {
            let pins = cam.pins.iter();
            let pins = pins.map(|&at| Outline::circle(at, cam.pin_radius));
            driven.pins.extend(pins);
        }
        let mut all = vec![body(DRIVER, gears.driver(), pair.driver().bore()), driven];
        let cams = CAMS.into_iter().zip(gears.cams());
        all.extend(cams.map(|(name, cam)| body(name, &cam.outline, pair.driver().bore())));
        all
    }

    /// Whether the body is a cam.
    #[must_use]
    pub fn is_cam(&self) -> bool {
        CAMS.contains(&self.name)
    }

    fn solid(&self, [bottom, top]: [f64; 2]) -> Result<Solid, SolidError> {
        let holes = self.bore.iter().chain(&self.pins).cloned().collect();
        Solid::new(self.outline.clone(), holes, bottom, top)
    }
}

impl Feeder {
    /// Heights of the lower faces of the gears, of the entry cam and of the exit cam, mm; `cams`: whether there are cams.
    #[must_use]
    pub fn gear_levels(&self, cams: bool) -> [f64; 3] {
        let (spec, plates) = (&self.design().gears, &self.design().plates);
        let next = spec.width + plates.gap;
        let behind = -(plates.thickness + plates.gap) - next;
        let middle = if cams { behind - next } else { behind };
        [middle, middle - next, behind]
    }

    /// Whether cams bring the driven gear to speed and to rest.
    #[must_use]
    pub fn has_cams(&self) -> bool {
        let spec = &self.design().gears;
        spec.entry > 0.0 && spec.drive().is_ok_and(|drive| drive.stops() > 0)
    }

    /// Bodies of the gears in the machine; `None` if the gears cannot be cut.
    ///
    /// Fitting arcs takes long; the result is cached by the gears' design.
    fn gear_bodies(&self) -> Option<Arc<Vec<GearBody>>> {
        static LAID: Recent<GearsSpec, Arc<Vec<GearBody>>> = Recent::new();
        let (gears, tolerance) = (self.gears().ok()?, Tolerance::new(FINE).ok()?);
        Some(LAID.get(&self.design().gears, || {
            Arc::new(GearBody::all(&gears, tolerance))
        }))
    }

    /// Adds the gears to the machine of [`Feeder::links`] as links with bodies, behind the rear frame plate, in this order: exit
    /// cam, gears, entry cam. Gears that cannot be cut are omitted: the six-bar moves without them.
    ///
    /// # Errors
    /// [`SolidError`] if a gear encloses no volume.
    pub fn mount_gears(&self, machine: &mut LinkedMachine) -> Result<(), SolidError> {
        let Some(bodies) = self.gear_bodies() else {
            return Ok(());
        };
        let (frame, crank) = (FeederPart::Frame.link(), FeederPart::Crank.link());
        let spec = &self.design().gears;
        let [middle, entry, exit] = self.gear_levels(bodies.len() > 2);
        let density = spec.body().density;
        let mut driver = frame;
        for body in bodies.iter() {
            let link = machine.link(Link::new(body.name));
            let (joint, bottom) = match body.name {
                DRIVER => {
                    driver = link;
                    let law = Linear {
                        start: 0.0,
                        slope: -1.0,
                    };
                    let joint = Joint::turning(frame, link, Arc::new(law));
                    (joint.at([-spec.center_distance(), 0.0, 0.0]), middle)
                }
                DRIVEN => (Joint::fixed(crank, link), middle),
                name if name == CAMS[0] => (Joint::fixed(driver, link), entry),
                _ => (Joint::fixed(driver, link), exit),
            };
            let joint = machine.joint(joint);
            if link == driver {
                let meaning =
                    "angle of the intermittent gear relative to the frame, counter-clockwise";
                let name = "gear_driver_joint_rad";
                machine.column(name, "rad", meaning, Quantity::joint(joint));
            }
            let solid = body.solid([bottom, bottom + spec.width])?;
            machine.links[link].mass = Some(solid.mass_properties(density));
            let shape = machine.solids(&format!("links/{}", body.name), "", vec![solid]);
            machine.links[link].shape = Some(shape);
        }
        Ok(())
    }
}
