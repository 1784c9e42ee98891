use std::cell::RefCell;

use centrode_gear::{GearPair, PitchContact};
use centrode_geometry::{Point, Vector, checkpoint};

use super::{
    body::GearOutline,
    hit::Hit,
    places::{Candidates, Kind, Place, gaps},
    sample::{Loaded, Sample},
    seat::Seat,
    stretch::{Divided, Stretch},
    touch::{self, Pose, Stand, Touch},
    tree::Run,
    turning::{Limits, Turning},
    window::{Allowance, Window},
};

/// Greatest distance, in modules, of places that are examined.
const NEAR: f64 = 0.3;

/// Deviation, in modules, from the designed backlash within which flanks face each other as designed.
const DESIGNED: f64 = 1e-6;

/// Turn of the driven gear, rad, below which a seat is exact.
const SETTLED: f64 = 1e-12;

/// Play or penetration, in modules, beyond which the gears are taken not to hold each other, or to have no room.
const FARTHEST: f64 = 2.0;

/// Greatest depth, in modules, of penetrations that are examined: more than the height of a tooth.
const DEEPEST: f64 = 4.0;

/// Depth, in modules, from which gears are taken to penetrate each other's bodies, not to touch.
const SHALLOW: f64 = 1e-3;

/// Greatest distance, in modules, of flanks that are examined unless nothing nearer is found.
const CLOSE: f64 = 0.05;

/// Gap, in modules, within which two seated flanks are in contact.
const SEATED: f64 = 1e-6;

/// Lever, in modules, of the normal about the driven axis below which a contact holds nothing.
const IDLE: f64 = 1e-3;

/// Pair under analysis, pose by pose.
#[derive(Debug)]
pub(crate) struct Meshing<'a> {
    pub(super) pair: &'a GearPair,
    pub(super) driver: GearOutline<'a>,
    pub(super) driven: GearOutline<'a>,
    /// Parts of the driven gear.
    pub(super) stretches: Vec<Divided>,
    pub(super) module: f64,
    /// Whether all teeth are as the tool would make them.
    whole: bool,
    pub(super) near: f64,
    /// Search distance between flanks, which touch or nearly do, mm.
    pub(super) close: f64,
    /// Parameters at which parts faced each other at the sample before.
    pub(super) memory: Vec<(usize, usize, (f64, f64))>,
    /// Parts that are near each other in poses like the last.
    pub(super) window: RefCell<Window>,
    pub(super) allowance: Allowance,
}

impl<'a> Meshing<'a> {
    pub(super) fn new(pair: &'a GearPair) -> Self {
        let near = NEAR * pair.module() + 2.0 * pair.backlash();
        let [driver, driven] = GearOutline::pair(pair.driver(), pair.driven(), near);
        let parts = driven.parts.iter().enumerate();
        Self {
            pair,
            stretches: parts
                .map(|(j, part)| Divided::new(Stretch::from_part(j, part, |p| *p, |v| *v)))
                .collect(),
            window: RefCell::default(),
            allowance: Allowance::new(pair, near),
            driver,
            driven,
            module: pair.module(),
            whole: super::is_whole(pair),
            near,
            close: CLOSE * pair.module() + 2.0 * pair.backlash(),
            memory: Vec::new(),
        }
    }

    /// Forgets the sample before.
    pub(super) fn begin(&mut self) {
        self.memory.clear();
    }

    /// Analyses the pose in which the pitch curves touch at a point.
    pub(super) fn sample(&mut self, point: &PitchContact) -> Sample {
        checkpoint();
        let (phi, law) = (point.input, point.driven_angle);
        let a = self.pair.center_distance();
        let pose = Pose::new(phi, law, a);
        let mut candidates = self.candidates(&pose);
        let places = self.places(&mut candidates, &pose);
        let seats = self.seats(&candidates, phi, law);
        let levers = [1.0, -1.0].map(|sign| touch::lever(self.pair, point, sign));
        let [Some(forward), Some(back)] = &seats else {
            // Nothing near enough to drive: the mesh has come apart.
            return Sample {
                input: phi,
                law,
                loaded: levers.map(Loaded::apart),
                backlash: f64::INFINITY,
                penetration: 0.0,
                clearance: f64::INFINITY,
                fillet_clearance: f64::INFINITY,
            };
        };
        let half = 0.5 * self.pair.backlash();
        let loaded = |seat: &Seat, sign: f64, lever: f64| Loaded {
            on_flanks: self.designed(&places, sign).any(|p| p.touch.is_on_both()),
            angle: seat.angle,
            error: seat.angle - self.ideal(&places, point, sign * half),
            contacts: seat.contacts,
            sliding: self.sliding(&places, point, sign, seat),
            lever,
        };
        let loaded = [
            loaded(forward, 1.0, levers[0]),
            loaded(back, -1.0, levers[1]),
        ];
        let backlash = back.angle - forward.angle;
        // Wedged between two sides: half of the missing room.
        let penetration = (-backlash * 0.5 * forward.lever.min(back.lever)).max(0.0);
        // Where the gears penetrate at the law's angle though there is room for them, they are put in its middle.
        let off = (law - back.angle).max(forward.angle - law);
        let (places, clash) = if backlash > 0.0 && off * a > SEATED * self.module {
            let pose = Pose::new(phi, 0.5 * (forward.angle + back.angle), a);
            let mut candidates = self.candidates(&pose);
            (self.places(&mut candidates, &pose), candidates.clash)
        } else {
            (places, candidates.clash)
        };
        let [clearance, fillet_clearance] = gaps(&places, clash);
        Sample {
            input: phi,
            law,
            loaded,
            backlash,
            penetration,
            clearance,
            fillet_clearance,
        }
    }

    /// Seats of the driven gear pushed on and back, searched for ever farther from the law's angle; none where the mesh has
    /// come apart.
    pub(super) fn seats(
        &mut self,
        candidates: &Candidates,
        phi: f64,
        law: f64,
    ) -> [Option<Seat>; 2] {
        let pose = Pose::new(phi, law, self.pair.center_distance());
        let limits = (self.near, self.close);
        let mut seats = [1.0, -1.0].map(|sign| self.seat(candidates, phi, law, sign));
        // Nothing so near: search farther.
        while seats.iter().any(Option::is_none) && self.close < FARTHEST * self.module {
            self.close *= 3.0;
            self.near = self.near.max(self.close);
            let candidates = self.candidates(&pose);
            seats = [1.0, -1.0].map(|sign| self.seat(&candidates, phi, law, sign));
        }
        // Teeth cut short or undercut may penetrate so deep that no sides that face each other are near.
        let free = |seats: &[Option<Seat>; 2]| match seats {
            [Some(forward), Some(back)] => forward.angle <= back.angle,
            _ => false,
        };
        while !self.whole
            && free(&seats)
            && seats.iter().flatten().any(|s| self.lie_deep(phi, s.angle))
            && self.near < DEEPEST * self.module
        {
            self.near *= 2.0;
            let candidates = self.candidates(&pose);
            seats = [1.0, -1.0].map(|sign| self.seat(&candidates, phi, law, sign));
        }
        (self.near, self.close) = limits;
        seats
    }

    /// Places at the law's angle at which flanks face each other with half the designed backlash, where the driver pushes on
    /// (`sign` above zero) or back.
    pub(super) fn designed<'p>(
        &self,
        places: &'p [Place],
        sign: f64,
    ) -> impl Iterator<Item = &'p Place> {
        let (half, near) = (0.5 * self.pair.backlash(), DESIGNED * self.module);
        places.iter().filter(move |p| {
            p.kind == Kind::Flanks
                && p.corner.is_none()
                && sign * p.touch.lever > 0.0
                && (half - p.touch.gap).abs() < near
        })
    }

    /// Angle of the driven gear if the flanks had the designed backlash exactly.
    ///
    /// At the law's own angle flanks thinned for backlash are parallel and half the backlash apart; the driven gear is turned
    /// until they touch. Where no flanks face each other as designed the lever is that of the law's own normal.
    fn ideal(&self, places: &[Place], point: &PitchContact, half: f64) -> f64 {
        let (phi, law) = (point.input, point.driven_angle);
        if half == 0.0 {
            return law;
        }
        let off = |p: &Place| (half.abs() - p.touch.gap).abs();
        let mut facing: Vec<&Place> = self.designed(places, half).collect();
        facing.sort_by(|p, q| off(p).total_cmp(&off(q)));
        let touching = facing.into_iter().find_map(|place| {
            let wrong = (half.abs() - place.touch.gap) / place.touch.lever;
            let mut parts = place.parts;
            let (mut angle, mut touch) = (law, place.touch);
            for _ in 0..8 {
                let step = touch.gap / touch.lever;
                angle -= step;
                if step.abs() < SETTLED {
                    return Some(angle - wrong);
                }
                let pose = Pose::new(phi, angle, self.pair.center_distance());
                (parts, touch) = self.along_flanks(parts, touch.at, &pose)?;
            }
            None
        });
        touching.unwrap_or_else(|| Stand::Seat(half.signum()).angle(self.pair, point))
    }

    /// Points where two flanks face each other, sought from where they did: on these parts, on their neighbours of the
    /// same flanks, or beyond the ends of the flanks.
    pub(super) fn along_flanks(
        &self,
        (i, j): (usize, usize),
        at: (f64, f64),
        pose: &Pose,
    ) -> Option<((usize, usize), Touch)> {
        let facing = |i: usize, j: usize, at: (f64, f64)| {
            let touch = touch::parts(&self.driver.parts[i], &self.driven.parts[j], pose, at);
            Some(((i, j), touch.or_else(|| self.facing_sharply((i, j), pose))?))
        };
        facing(i, j, at).or_else(|| {
            let near = [self.driver.along_flank(i), self.driven.along_flank(j)];
            let [first, second] = &near;
            let pairs = first
                .iter()
                .flat_map(|&i| second.iter().map(move |&j| (i, j)));
            let mut neighbours = pairs.filter(|&pair| pair != (i, j));
            neighbours
                .find_map(|(i, j)| facing(i, j, (0.0, 0.0)))
                .or_else(|| {
                    let (a, b) = (&self.driver.parts[i], &self.driven.parts[j]);
                    Some(((i, j), touch::continued(a, b, pose, at)?))
                })
        })
    }

    /// Turns the driven gear back (`sign` 1) or on (-1) until it rests on the driver.
    fn seat(&self, candidates: &Candidates, phi: f64, law: f64, sign: f64) -> Option<Seat> {
        let a = self.pair.center_distance();
        let seated = SEATED * self.module;
        let (mut angle, mut pose) = (law, Pose::new(phi, law, a));
        let mut hits = self.first_hits(candidates, &pose, sign);
        // Out of one penetration the gear may come into the next. Where there is no room it passes the other seat, by
        // the missing room. Every step is more than a seated gap, so the search ends.
        let farthest = FARTHEST * self.module / a;
        while (angle - law).abs() < farthest {
            checkpoint();
            let first = hits.first()?;
            if sign * first.turn * first.lever < seated {
                break;
            }
            let turned = angle + first.turn;
            // Of an angle of many turns a small step may be lost in rounding.
            if turned == angle {
                break;
            }
            (angle, pose) = (turned, Pose::new(phi, turned, a));
            hits = self.first_hits(&self.candidates(&pose), &pose, sign);
        }
        let first = *hits.first()?;
        hits.retain(|h| sign * (first.turn - h.turn) * h.lever <= seated);
        let teeth = |h: &Hit| {
            let (i, j) = h.parts;
            (self.driver.parts[i].owner, self.driven.parts[j].owner)
        };
        // The first meeting of each pair of teeth is its contact.
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        hits.retain(|h| {
            let new = !pairs.contains(&teeth(h));
            if new {
                pairs.push(teeth(h));
            }
            new
        });
        Some(Seat {
            angle: angle + first.turn,
            lever: first.lever,
            contacts: pairs.len() as u32,
            touches: hits.iter().map(|h| h.touch(&pose)).collect(),
            start: angle,
            hits,
        })
    }

    /// Whether the gears penetrate each other by more than a shallow amount.
    fn lie_deep(&self, phi: f64, angle: f64) -> bool {
        let pose = Pose::new(phi, angle, self.pair.center_distance());
        let (driver, driven) = (&self.driver, &self.driven);
        let deep = SHALLOW * self.module;
        let on_driver = |run: &Run| {
            let center = pose.back(&run.center).coords;
            driven.is_near(&center, run.radius + deep)
        };
        let on_driven = |run: &Run| {
            let center = pose.place(&run.center).coords;
            driver.is_near(&center, run.radius + deep)
        };
        driver.tree.any(&on_driver, &mut |i| {
            driver.inner(i, deep).is_some_and(|p| {
                let back = pose.back(&p);
                driven.is_near(&back.coords, 0.0) && driven.contains(back)
            })
        }) || driven.tree.any(&on_driven, &mut |j| {
            driven.inner(j, deep).is_some_and(|p| {
                let placed = pose.place(&p);
                driver.is_near(&placed.coords, 0.0) && driver.contains(placed)
            })
        })
    }

    /// Contacts that hold the driven gear when it is turned from a pose, the first of them first.
    fn first_hits(&self, candidates: &Candidates, pose: &Pose, sign: f64) -> Vec<Hit> {
        let (driver, driven) = (&self.driver, &self.driven);
        let penetrates = |a: &Vector, b: &Vector| {
            driven.contains(Point::from(*a)) || driver.contains(pose.place(&Point::from(*b)))
        };
        let limits = Limits {
            window: self.close / self.pair.center_distance(),
            deep: self.near,
            seated: SEATED * self.module,
            idle: IDLE * self.module,
            facing: &self.memory,
            penetrates: &penetrates,
        };
        let mut turning = Turning::new(&self.driver, &self.driven, *pose, sign, &limits);
        for &(k, j) in &candidates.pairs {
            checkpoint();
            turning.look(&candidates.posed[k].0, &self.stretches[j]);
        }
        turning.finish()
    }
}
