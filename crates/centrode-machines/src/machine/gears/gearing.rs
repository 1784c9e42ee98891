use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{COMPUTED, Outline, Point, Solid, SolidError, Vector};
use nalgebra::Isometry2;

use crate::machine::body::points::{LocalPoint, Reference};
use crate::machine::gears::mesh::{Angle, MeshedBody, RollingMesh};
use crate::machine::resolve::{Builder, blame};
use crate::machine::{
    BodyPoint, GearRole, Machine, MachineBodySpec, MachineDesign, MachineError, MachineMeshSpec,
    Mount,
};
use centrode_gear::design::GearPairDesign;
use centrode_gear::pitch::gcd;
use centrode_gear::{Gear, GearPair, Member, Role};
use centrode_kinematics::machine::{Line, LineRole, Surface};

/// Inputs per turn at which a loop of meshes is checked.
const SAMPLES: u32 = 720;
/// Distance of two axes, as a share of the centre distance, below which they count as one.
const SAME: f64 = 1e-12;

/// A gear of a composed machine.
#[derive(Clone, Debug)]
pub struct MachineGear {
    /// Name.
    pub name: String,
    /// Name of its body.
    pub(in crate::machine) body_name: String,
    /// Its pair.
    pub pair: Arc<GearPair>,
    /// Whether it is the driver or the driven gear of its pair.
    pub member: Member,
    /// Position of its axis in the body's axes, mm.
    pub at: Point,
    /// Angle of its own axes against the body's, rad.
    pub mount: f64,
}

impl MachineGear {
    /// The gear.
    #[must_use]
    pub fn gear(&self) -> &Gear {
        self.pair.gear(self.member)
    }

    /// Name of its body.
    #[must_use]
    pub fn body_name(&self) -> &str {
        &self.body_name
    }

    /// Name of the gear's surface in the machine.
    #[must_use]
    pub fn surface_name(&self) -> String {
        format!("{}-teeth", self.name)
    }

    /// Pose of the gear's axes in those of its body.
    fn place(&self) -> Isometry2<f64> {
        Isometry2::new(self.at.coords, self.mount)
    }

    /// The gear in its body's axes; `bottom` is the height of its lower face, mm.
    pub(in crate::machine) fn solid(&self, bottom: f64) -> Result<Solid, SolidError> {
        let (gear, place) = (self.gear(), self.place());
        let bore = gear.bore().map(|bore| bore.transformed(&place));
        let top = bottom + gear.body().width;
        Solid::from_counter_clockwise(
            gear.outline().transformed(&place),
            bore.into_iter().collect(),
            bottom,
            top,
        )
    }

    /// Surface of the teeth: flanks and tips can touch other gears, fillets cannot.
    pub(in crate::machine) fn surface(&self, solid: &Solid) -> Surface {
        let touches = |(role, owner): (&Role, &u32)| {
            matches!(role, Role::Flank | Role::Tip).then_some(*owner)
        };
        let segments = self.gear().roles().iter().zip(self.gear().owners());
        Surface {
            teeth: segments.map(touches).collect(),
            ..Surface::of_solid(self.surface_name(), solid)
        }
    }

    /// Outline, bore and pitch curve of the gear in its body's axes.
    pub(in crate::machine) fn lines(&self) -> Vec<Line> {
        let (gear, place) = (self.gear(), self.place());
        let line = |role, outline: &Outline| Line::contour(role, &outline.transformed(&place));
        let mut lines = vec![line(LineRole::Body, gear.outline())];
        lines.extend(gear.bore().map(|bore| line(LineRole::Hole, &bore)));
        lines.push(line(LineRole::Pitch, gear.pitch_curve()));
        lines
    }
}

impl Machine {
    /// Height of a gear's lower face along the shafts, mm: pairs lie one below the other, behind the frame.
    pub(in crate::machine) fn gear_bottom(&self, gear: &MachineGear) -> f64 {
        let own = gear.pair.name();
        self.pairs_bottom(|name| name <= own)
    }

    /// Height of the lower face of the last pair, mm.
    pub(in crate::machine) fn gears_bottom(&self) -> f64 {
        self.pairs_bottom(|_| true)
    }

    fn pairs_bottom(&self, counts: impl Fn(&str) -> bool) -> f64 {
        let plates = &self.design.plates;
        let width = |pair: &GearPairDesign| pair.driver.width.max(pair.driven.width) + plates.gap;
        let upto = self.design.pairs.iter();
        let upto = upto.take_while(|(name, _)| counts(name));
        let depth: f64 = upto.map(|(_, pair)| width(pair)).sum();
        -(plates.thickness + plates.gap) - depth
    }
}

/// Indices of two gears in mesh, the driver of their pair first, and index of the body that they move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::machine) struct Meshing {
    pub(in crate::machine) gears: [usize; 2],
    pub(in crate::machine) moved: usize,
}

/// The gears of a design, each on a point of its body.
pub(in crate::machine) fn gears_of(
    design: &MachineDesign,
    points: &crate::machine::body::points::BodyPoints,
) -> Result<Vec<MachineGear>, MachineError> {
    let mut pairs = std::collections::BTreeMap::new();
    for (name, pair) in &design.pairs {
        let named = GearPairDesign {
            name: name.clone(),
            ..pair.clone()
        };
        let made = GearPair::cached(&named).map_err(|error| MachineError::Pair {
            key: format!("pairs.{name}.{}", error.key_in(&named)),
            error: Box::new(error),
        })?;
        pairs.insert(name, made);
    }
    let gear = |(name, spec): (&String, &crate::machine::MachineGearSpec)| {
        if points.contains_key(name) {
            return Err(MachineError::refused(
                format!("gears.{name}"),
                format!("there is also a body named {name}: their files would have the same name"),
            ));
        }
        let key = format!("gears.{name}.on");
        let on = Reference::to_body(&spec.on);
        let at = on.find(&key, points)?;
        let pair = pairs.get(&spec.pair).ok_or_else(|| {
            MachineError::unknown(
                format!("gears.{name}.pair"),
                "pair",
                spec.pair.clone(),
                design.pairs.keys().cloned(),
            )
        })?;
        Ok(MachineGear {
            name: name.clone(),
            body_name: on.body,
            pair: Arc::clone(pair),
            member: match spec.role {
                GearRole::Driver => Member::Driver,
                GearRole::Driven => Member::Driven,
            },
            at,
            mount: spec.mount,
        })
    };
    design.gears.iter().map(gear).collect()
}

impl Builder<'_> {
    /// Index of a gear by its name.
    pub(in crate::machine) fn gear(&self, key: &str, name: &str) -> Result<usize, MachineError> {
        let found = self.gears.iter().position(|gear| gear.name == name);
        found.ok_or_else(|| {
            MachineError::unknown(
                key,
                "gear",
                name,
                self.gears.iter().map(|gear| gear.name.clone()),
            )
        })
    }

    /// Indices of the two gears of a mesh, which must be the two gears of one pair.
    fn both(&self, key: &str, names: [&str; 2]) -> Result<[usize; 2], MachineError> {
        let [one, other] = [self.gear(key, names[0])?, self.gear(key, names[1])?];
        let [a, b] = [&self.gears[one], &self.gears[other]];
        if a.pair.name() != b.pair.name() || a.member == b.member {
            let words = |gear: &MachineGear| {
                format!(
                    "{} is the {} of {}",
                    gear.name,
                    gear.member.name(),
                    gear.pair.name()
                )
            };
            return Err(MachineError::refused(
                key,
                format!(
                    "{} and {}: only the driver and the driven gear of one pair can mesh",
                    words(a),
                    words(b)
                ),
            ));
        }
        Ok([one, other])
    }

    /// Angle of a gear as a function of the input.
    fn gear_angle(&self, gear: usize) -> Angle {
        let gear = &self.gears[gear];
        let body = self.body_named(&gear.body_name);
        self.angle(body.unwrap_or(0)).plus(gear.mount)
    }

    /// Adds a body that a mesh moves on its carrier.
    pub(in crate::machine) fn add_meshed(
        &mut self,
        name: &str,
        body: &MachineBodySpec,
        mesh: &MachineMeshSpec,
    ) -> Result<(), MachineError> {
        let key = format!("bodies.{name}.mesh");
        // The motions of dyads built before are needed.
        self.follow()?;
        let on = body.on.as_deref().unwrap_or_default();
        let base = self.place(&format!("bodies.{name}.on"), on)?;
        let [own, with] = self.both(&key, [&mesh.gear, &mesh.with])?;
        let gear = &self.gears[own];
        let wrong = |why: String| MachineError::refused(key.clone(), why);
        if gear.body_name != name || gear.at != Point::origin() || base.at != Point::origin() {
            return Err(wrong(format!(
                "gear {} must be at the origin of body {name}, and bodies.{name}.on must name a body without a point: the mesh determines its position",
                gear.name
            )));
        }
        let pair = Arc::clone(&gear.pair);
        let other = &self.gears[with];
        let axis = self.body_named(&other.body_name).and_then(|body| {
            let size = SAME * pair.center_distance();
            self.axis_on(base.body, BodyPoint { body, at: other.at }, size)
        });
        let axis = axis.ok_or_else(|| {
            wrong(format!(
                "the axis of gear {} must be fixed on body {on}, but moves relative to it",
                other.name
            ))
        })?;
        let (sin, cos) = mesh.direction.sin_cos();
        let at = axis + Vector::new(cos, sin) * pair.center_distance();
        let is_driven = gear.member == Member::Driven;
        let on_carrier = self.angle(base.body);
        let mesh = RollingMesh {
            rolling: pair.shared_rolling(),
            lambda: on_carrier.plus(if is_driven {
                mesh.direction
            } else {
                mesh.direction + PI
            }),
        };
        let moved = MeshedBody {
            mesh,
            is_driven,
            other: self.gear_angle(with),
            carrier: on_carrier.plus(gear.mount),
        };
        let (law, turns) = moved.law(self.linkage.period());
        if (turns - turns.round()).abs() > COMPUTED {
            return Err(wrong(format!(
                "turns body {name} by {} turns relative to {on} in the period of {} turns of the input. This must be a whole number: set input.turns",
                (turns * 1e9).round() / 1e9,
                self.design.input.turns
            )));
        }
        let of_carrier = self
            .points
            .entry(self.bodies[base.body].name.clone())
            .or_default();
        of_carrier
            .entry(format!("axis-of-{name}"))
            .or_insert(LocalPoint { at, own: false });
        let joint = self.linkage.point(self.bodies[base.body].link, at);
        let joint = joint.map_err(blame(&key))?;
        let link = self.linkage.turning(joint, law.clone());
        let moved = self.push(
            name,
            link.map_err(blame(&key))?,
            Mount::turning(base.body, at, law),
        );
        self.meshes.push(Meshing {
            gears: if is_driven { [with, own] } else { [own, with] },
            moved,
        });
        Ok(())
    }

    /// Checks the meshes of the table `meshes` over the cycle: distance of the axes, and teeth in tooth spaces.
    pub(in crate::machine) fn check_loops(&self) -> Result<(), MachineError> {
        for (name, spec) in &self.design.meshes {
            let key = format!("meshes.{name}");
            let both = self.both(&key, [&spec.gears[0], &spec.gears[1]])?;
            let [driver, driven] = match self.gears[both[0]].member {
                Member::Driver => both,
                Member::Driven => [both[1], both[0]],
            };
            let (mismatch, input) = self.mismatch(&key, [driver, driven])?;
            if mismatch > COMPUTED {
                let [one, other] = [driver, driven].map(|gear| self.gears[gear].name.clone());
                return Err(MachineError::refused(
                    key,
                    format!(
                        "the loop of meshes does not close: the other meshes hold gears {one} and {other} {:.6} deg off their mesh at an input of {:.4} deg",
                        mismatch.to_degrees(),
                        input.to_degrees()
                    ),
                ));
            }
        }
        Ok(())
    }

    /// Maximum angle by which a driven gear deviates from its mesh, rad, and the input there.
    fn mismatch(
        &self,
        key: &str,
        [driver, driven]: [usize; 2],
    ) -> Result<(f64, f64), MachineError> {
        let pair = &self.gears[driver].pair;
        let axis = |gear: usize, input: f64| {
            let gear = &self.gears[gear];
            let body = self.body_named(&gear.body_name)?;
            Some(self.linkage.place(self.bodies[body].link, gear.at, input))
        };
        let [one, other] = [self.gear_angle(driver), self.gear_angle(driven)];
        let rolling = pair.shared_rolling();
        // Number of repeating parts of each gear in a cycle of the pair. The driven gear repeats after `driver_parts / common`
        // of the driver's parts.
        let (n1, n2) = pair.mean_ratio();
        let [driver_parts, driven_parts] =
            [(n1, Member::Driver), (n2, Member::Driven)].map(|(n, m)| n * pair.repeats(m));
        let common = gcd(driver_parts, driven_parts);
        let [driver_part, driven_part] =
            [Member::Driver, Member::Driven].map(|m| TAU / f64::from(pair.repeats(m)));
        let count = SAMPLES * self.design.input.turns;
        let mut worst = (0.0, 0.0);
        for i in 0..count {
            let input = self.linkage.period() * f64::from(i) / f64::from(count);
            let (Some(from), Some(to)) = (axis(driver, input), axis(driven, input)) else {
                continue;
            };
            let way = to - from;
            let (apart, distance) = (way.norm(), pair.center_distance());
            if (apart - distance).abs() > COMPUTED * distance {
                return Err(MachineError::refused(
                    key,
                    format!(
                        "the axes of gears {} and {} are {apart:.6} mm apart at an input of {:.4} deg, not the pair's {distance:.6} mm",
                        self.gears[driver].name,
                        self.gears[driven].name,
                        input.to_degrees()
                    ),
                ));
            }
            let mesh = RollingMesh {
                rolling: Arc::clone(&rolling),
                lambda: Angle::default().plus(way.y.atan2(way.x)),
            };
            // The gears may also mesh shifted by whole parts: the smallest deviation counts.
            let off = (0..driver_parts / common).map(|part| {
                let mut at = one.at(input);
                at.position -= driver_part * f64::from(part);
                let off = other.at(input).position - mesh.driven(&at, input).position;
                (off - driven_part * (off / driven_part).round()).abs()
            });
            let off = off.fold(f64::INFINITY, f64::min);
            if off > worst.0 {
                worst = (off, input);
            }
        }
        Ok(worst)
    }
}
