//! Turned parts, their rings, keys, bearings and spacers as bodies of the links that they are mounted on.

use std::f64::consts::FRAC_PI_2;

use centrode_geometry::{MassProperties, Solid};
use nalgebra::Point3;

use super::{
    Blank, Form, Link, LinkedMachine, Mounted, Part, Shape, SpacerKind, Supply, TurnedPiece,
    TurnedPieces,
};

/// Density of rings, keys and bearings: steel, kg/m^3.
const STEEL: f64 = 7850.0;

/// A ring, key, bearing or spacer on a turned part.
#[derive(Clone, Debug)]
pub struct Fastener<'a> {
    /// Name in the parts list.
    pub name: String,
    material: &'a str,
    density: f64,
    /// Name of its files if it is made, not bought.
    pub file: Option<String>,
    solid: Option<Solid>,
    /// Its origin in the part's frame, mm, and its turn there.
    pub at: [f64; 3],
    turn: [f64; 3],
}

impl TurnedPieces {
    /// The rings, keys, bearings and spacers on each piece: each ring in the middle of its groove, each key on the floor of the
    /// keyway.
    pub fn fasteners(&self) -> Vec<Fastener<'_>> {
        let part = &self.part;
        let mut low = 0.0;
        let mut all = Vec::new();
        for step in &part.steps {
            if let Some(ring) = step.ring {
                all.push(Fastener {
                    name: ring.name(),
                    material: "spring steel",
                    density: STEEL,
                    file: None,
                    solid: ring.solid(),
                    at: [0.0, 0.0, low + 0.5 * (step.length - ring.thickness)],
                    turn: [0.0; 3],
                });
            }
            low += step.length;
        }
        all.extend(self.keys.iter().map(|seated| Fastener {
            name: seated.key.name(),
            material: "steel",
            density: STEEL,
            file: None,
            solid: seated.key.solid(),
            at: [part.key_foot(), 0.0, seated.at],
            // Its length along the axis, its height away from it.
            turn: [FRAC_PI_2, 0.0, FRAC_PI_2],
        }));
        all.extend(self.bearings.iter().map(|(bearing, at)| Fastener {
            name: bearing.name(),
            material: "bearing steel",
            density: STEEL,
            file: None,
            solid: bearing.solid(),
            at: [0.0, 0.0, *at],
            turn: [0.0; 3],
        }));
        // Sleeves and rollers have the material of the shaft or pin that they are on.
        all.extend(self.spacers.iter().map(|(spacer, at)| {
            let (material, density) = match spacer.kind {
                SpacerKind::Shim => ("steel", STEEL),
                SpacerKind::Sleeve | SpacerKind::Roller => (&*part.material, part.density),
            };
            Fastener {
                name: spacer.name(),
                material,
                density,
                file: spacer.file(),
                solid: spacer.solid(),
                at: [0.0, 0.0, *at],
                turn: [0.0; 3],
            }
        }));
        all
    }
}

impl Part {
    /// Name as one word, as in file names: "circlip-din-471-10x1".
    #[must_use]
    pub fn word(&self) -> String {
        let word = self.name.to_lowercase().replace(" - ", "-");
        word.replace(" x ", "x").replace([' ', '/'], "-")
    }
}

impl Link {
    fn mount(&mut self, body: Mounted, own: Option<MassProperties>) {
        let carried = own.map(|own| own.placed(&body.place()));
        let all: Vec<MassProperties> = self.mass.into_iter().chain(carried).collect();
        self.mass = MassProperties::combined(&all).or(self.mass);
        self.mounted.push(body);
    }
}

impl LinkedMachine {
    /// Mounts the pieces of a turned part on their links and lists it, under a remark, with the rings, keys and bearings that are
    /// bought and the sleeves that are made for it. Its item number points to its rim.
    pub fn add_turned(&mut self, all: &TurnedPieces, remark: String) {
        let part = &all.part;
        let named = |piece: &TurnedPiece| self.link_named(&piece.link).unwrap_or(0);
        let links: Vec<usize> = all.pieces.iter().map(named).collect();
        let rim = all.axis.map(|[x, y]| [x - 0.5 * part.diameter(), y]);
        let place = rim.and_then(|rim| self.place_on(&self.links.first()?.name, rim));
        let own = part.mass_properties();
        let listed = Part {
            name: part.title.clone(),
            links: links.clone(),
            material: part.material.clone(),
            mass: own.map(|own| own.mass),
            remark,
            ..Part::default()
        };
        let listed = match &all.standard {
            Some(name) => Part {
                name: name.clone(),
                supply: Supply::Bought,
                ..listed
            },
            None => Part {
                blank: Some(Blank::Round {
                    diameter: part.diameter(),
                    length: part.length(),
                }),
                file: part.name.clone(),
                place,
                ..listed
            },
        };
        let is_body = own.is_some();
        if is_body {
            let shape = self.shape(Shape {
                name: format!("turned/{}", part.name),
                part: listed.file.clone(),
                form: Form::Turned(part.clone()),
            });
            for piece in &all.pieces {
                self.mount(shape, piece, [0.0; 3], [0.0; 3], own);
            }
        }
        self.part(listed);
        for fastener in all.fasteners() {
            let solid = fastener.solid.filter(|_| is_body);
            let own = solid.as_ref();
            let own = own.map(|solid| solid.mass_properties(fastener.density));
            let bought = Part {
                material: fastener.material.into(),
                mass: own.map(|own| own.mass),
                ..Part::bought(fastener.name, links.clone())
            };
            let blank = solid.as_ref();
            let blank = blank.and_then(|solid| Blank::plate(solid.outline(), solid.top()));
            let listed = match fastener.file {
                Some(file) => Part {
                    supply: Supply::Made,
                    blank,
                    file,
                    ..bought
                },
                None => bought,
            };
            if let Some(solid) = solid {
                let name = format!("{}/{}", listed.supply.name(), listed.word());
                let shape = self.solids(&name, &listed.file, vec![solid]);
                for piece in &all.pieces {
                    self.mount(shape, piece, fastener.at, fastener.turn, own);
                }
            }
            self.part(listed);
        }
    }

    /// Mounts a body on the link of a piece, at a position on the piece.
    fn mount(
        &mut self,
        shape: usize,
        piece: &TurnedPiece,
        at: [f64; 3],
        turn: [f64; 3],
        own: Option<MassProperties>,
    ) {
        let link = self.link_named(&piece.link);
        let Some(link) = link.and_then(|link| self.links.get_mut(link)) else {
            return;
        };
        let [upon, within] = [(piece.at, piece.turn), (at, turn)]
            .map(|(at, turn)| Mounted { shape, at, turn }.place());
        // Without a turn of the body, the angles of the piece are used unchanged, free of rounding.
        let turn = match turn == [0.0; 3] {
            true => piece.turn,
            false => {
                let (roll, pitch, yaw) = (upon.rotation * within.rotation).euler_angles();
                [roll, pitch, yaw]
            }
        };
        let at = (upon * Point3::from(at)).coords.into();
        let body = Mounted { shape, at, turn };
        link.mount(body, own.filter(|_| !piece.is_counted));
    }

    /// Mounts a body on a link and adds its mass to that of the link.
    pub fn mount_body(&mut self, link: usize, body: Mounted, own: Option<MassProperties>) {
        if let Some(link) = self.links.get_mut(link) {
            link.mount(body, own);
        }
    }
}
