use std::f64::consts::{PI, TAU};

use centrode_gear::GearPair;
use centrode_geometry::{Point, Vector};
use centrode_machines::three_arm::ThreeArm;
use nalgebra::Rotation2;

use crate::gear_pair::{Flanks, PITCH_SAMPLES, ROUNDING, paths, track};
use crate::picture::Contacts;

/// A mesh of the first chain: of its intermediate gear with the sun, or with the planet.
#[derive(Clone, Copy, Eq, PartialEq)]
enum Mesh {
    Sun,
    Planet,
}

impl Mesh {
    fn words(self, chain: u32) -> String {
        match self {
            Self::Sun => format!("sun and intermediate gear {}", chain + 1),
            Self::Planet => format!("intermediate gear {0} and planet {0}", chain + 1),
        }
    }

    /// Carrier turn at a polar angle at which sun or planet, drivers of the pair, meet the intermediate gear, rad.
    fn input(self, mechanism: &ThreeArm, polar: f64) -> f64 {
        let (train, rolling) = (mechanism.train(), mechanism.rolling());
        let psi = match self {
            Self::Sun => polar,
            Self::Planet => {
                let met = rolling.driven_angle(polar) + train.bend() + PI;
                rolling.driver_jet(met).position
            }
        };
        train.direction().sign() * psi
    }

    /// Polar angle at a carrier turn.
    fn polar(self, mechanism: &ThreeArm, input: f64) -> f64 {
        let train = mechanism.train();
        match self {
            Self::Sun => train.direction().sign() * input,
            Self::Planet => {
                let jet = train.at(input);
                jet.carrier.position + train.bend() + PI - jet.planet.position
            }
        }
    }

    /// Converts a position from the axes of the pair to the machine's axes, at a carrier turn.
    fn place(self, mechanism: &ThreeArm, input: f64, at: Point) -> Point {
        let train = mechanism.train();
        let way = train.carrier_start() + train.direction().sign() * input;
        match self {
            Self::Sun => Rotation2::new(way) * at,
            Self::Planet => {
                let leg = |angle: f64| Rotation2::new(angle) * Vector::x();
                let legs = leg(way) + leg(way + train.bend());
                let axis = legs * mechanism.center_distance();
                Rotation2::new(way + train.bend() + PI) * at + axis
            }
        }
    }

    /// Flanks of sun or planet that touch while the sun, seen from the carrier, drives.
    fn flanks(self, mechanism: &ThreeArm) -> Flanks {
        let is_clockwise = mechanism.train().direction().sign() > 0.0;
        match (self, is_clockwise) {
            (Self::Sun, true) | (Self::Planet, false) => Flanks::Leading,
            (Self::Sun, false) | (Self::Planet, true) => Flanks::Trailing,
        }
    }
}

/// Positions at which the flanks of sun, intermediate gears and planets touch, while the carrier drives and the sun is fixed;
/// without teeth only the pitch points.
#[must_use]
pub fn contacts(mechanism: &ThreeArm, teeth: Option<&GearPair>) -> Vec<Contacts> {
    let meshes = [Mesh::Sun, Mesh::Planet];
    let touching = meshes.map(|mesh| touching(mechanism, teeth, mesh));
    // Rounding must stay invisible: it depends on the module, or without teeth on 2 % of the centre distance.
    let size = teeth.map_or(0.02 * mechanism.center_distance(), |pair| pair.module());
    // A rounded input moves the whole mesh about the sun.
    let length = ROUNDING * size;
    let units = [0.5 * length / mechanism.center_distance(), length];
    let chains = 0..mechanism.arms();
    let all = chains.flat_map(|chain| {
        meshes
            .iter()
            .zip(&touching)
            .map(move |(&mesh, paths)| (chain, mesh, paths))
    });
    all.map(|(chain, mesh, paths)| {
        let later = TAU * f64::from(chain) / f64::from(mechanism.arms());
        let shifted = |path: &Vec<(f64, Point)>| {
            let start = path[0].0 + later;
            let shift = start.rem_euclid(TAU) - path[0].0;
            track(path.iter().map(|&(input, at)| (input + shift, at)), units)
        };
        let pitch_points = (0..=PITCH_SAMPLES).map(|i| {
            let input = TAU * f64::from(i) / f64::from(PITCH_SAMPLES);
            let own = mechanism.own_input(input, chain);
            let radius = mechanism.rolling().radius(mesh.polar(mechanism, own));
            (input, mesh.place(mechanism, own, Point::new(radius, 0.0)))
        });
        Contacts {
            mesh: mesh.words(chain),
            pitch_point: track(pitch_points, units),
            paths: paths.iter().map(shifted).collect(),
        }
    })
    .collect()
}

/// Paths of contact of a mesh of the first chain: inputs, ascending, and positions in the machine's axes.
fn touching(mechanism: &ThreeArm, teeth: Option<&GearPair>, mesh: Mesh) -> Vec<Vec<(f64, Point)>> {
    let Some(pair) = teeth else {
        return Vec::new();
    };
    let seen = |path: Vec<(f64, Point)>| {
        let samples = path.into_iter().map(|(polar, at)| {
            let input = mesh.input(mechanism, polar);
            (input, mesh.place(mechanism, input, at))
        });
        let mut samples: Vec<(f64, Point)> = samples.collect();
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        samples
    };
    let paths = paths(pair, mesh.flanks(mechanism)).into_iter();
    paths.map(seen).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_gear::Member;
    use centrode_geometry::Tolerance;
    use centrode_machines::three_arm::ThreeArmLink;
    use centrode_machines::three_arm::design::{Direction, ThreeArmDesign};
    use centrode_spec::DesignSpec as _;

    /// Distance of a position of the machine's axes from the outline of a gear.
    fn off(
        mechanism: &ThreeArm,
        polygon: &[Point],
        link: ThreeArmLink,
        input: f64,
        at: Point,
    ) -> f64 {
        let motion = mechanism.link(link, input);
        let own = Rotation2::new(-motion.angle.position) * (at - motion.origin.position);
        let own = Point::from(own);
        let next = polygon.iter().cycle().skip(1);
        let apart = polygon.iter().zip(next).map(|(a, b)| {
            let t = ((own - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            (own - (a + (b - a) * t)).norm()
        });
        apart.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn flanks_touch_where_the_outlines_of_both_gears_are() {
        for direction in [Direction::Clockwise, Direction::CounterClockwise] {
            let mut design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("sound");
            design.direction = direction;
            let mechanism = ThreeArm::resolve(&design).expect("a mechanism");
            let pair = mechanism.pair().expect("teeth");
            let fine = Tolerance::new(1e-4).expect("positive");
            let outlines =
                [Member::Driver, Member::Driven].map(|m| pair.gear(m).outline().flatten(fine));
            let found = contacts(&mechanism, Some(&pair));
            assert_eq!(found.len() as u32, 2 * mechanism.arms());
            let backlash = pair.teeth().backlash;
            for (i, mesh) in found.iter().enumerate() {
                let chain = i as u32 / 2;
                let own = match i % 2 {
                    0 => ThreeArmLink::Sun,
                    _ => ThreeArmLink::Planet(chain),
                };
                assert!(mesh.paths.len() > 10);
                for path in &mesh.paths {
                    for (&input, &at) in path.input.iter().zip(&path.at).skip(1).step_by(3) {
                        let at = Point::from(at);
                        let near = off(&mechanism, &outlines[0], own, input, at);
                        assert!(
                            near < 2e-3 * pair.module(),
                            "{} at {input}: {near}",
                            mesh.mesh
                        );
                        let mate = ThreeArmLink::Intermediate(chain);
                        let near = off(&mechanism, &outlines[1], mate, input, at);
                        let most = backlash + 2e-3 * pair.module();
                        assert!(near < most, "{} at {input}: {near}", mesh.mesh);
                    }
                }
            }
            // Without teeth the pitch points are where they were.
            for (mesh, bare) in found.iter().zip(contacts(&mechanism, None)) {
                assert!(bare.paths.is_empty());
                for (a, b) in mesh.pitch_point.at.iter().zip(&bare.pitch_point.at) {
                    assert!((Point::from(*a) - Point::from(*b)).norm() < 1e-3);
                }
            }
        }
    }
}
