//! Shafts of a composed machine as turned parts, and the remarks of the parts list about them.

use crate::machine::{BodyPoint, Hardware, Hold, Machine, MachineShaft, ShaftPart};
use centrode_geometry::COMPUTED;
use centrode_kinematics::machine::{
    Bar, JointKind, Keyway, LinkedMachine, Part, TurnedPiece, TurnedPieces,
};
use centrode_spec::digits::thousandths;

/// Length, in shaft diameters, by which a shaft goes on to its drive or to the part that holds it.
const FREE_END: f64 = 3.0;

impl Machine {
    /// The shafts as turned parts; shafts of copies are further pieces of those of the originals.
    #[must_use]
    pub fn turned_shafts(&self) -> Vec<TurnedPieces> {
        let mut found: Vec<(&str, TurnedPieces)> = Vec::new();
        for shaft in self.shafts() {
            let name = self.original(&shaft.name);
            let made = self.turned_shaft(shaft);
            match found.iter_mut().find(|(known, _)| *known == name) {
                Some((_, known)) => known.pieces.extend(made.pieces),
                None => found.push((name, made)),
            }
        }
        found.into_iter().map(|(_, made)| made).collect()
    }

    fn turned_shaft(&self, shaft: &MachineShaft) -> TurnedPieces {
        let (hub, spec) = (&shaft.hub, &self.design.plates);
        let tops = shaft.parts.iter().map(|part| part.span[1]);
        let top = tops.fold(f64::NEG_INFINITY, f64::max);
        let mut in_frame = shaft.parts.iter().filter(|part| part.is_plate);
        let in_frame = in_frame.find(|part| part.body == 0);
        let upper = in_frame.and_then(|part| self.top_part(part.at, hub.bore, top));
        let on_it = shaft.parts.iter().chain(&upper);
        let on_it = on_it.filter(|part| part.hold.is_fixed() || part.hold == Hold::Turning);
        let on_it: Vec<&ShaftPart> = on_it.collect();
        let low = on_it
            .iter()
            .map(|part| part.span[0])
            .fold(f64::INFINITY, f64::min);
        let high = on_it
            .iter()
            .map(|part| part.span[1])
            .fold(f64::NEG_INFINITY, f64::max);
        let [deepest, highest] = self.extent_from(0);
        let (body, at) = (shaft.body, shaft.at);
        let own = BodyPoint { body, at };
        let beyond = |wall: f64, is_above: bool, is_last: bool| match is_last {
            true => f64::INFINITY,
            false => self.room_at(own, hub.bore, wall, is_above, &|_, _| true),
        };
        let (is_lowest, is_highest) = (low <= deepest + COMPUTED, high >= highest - COMPUTED);
        let end = match shaft.is_driven && is_lowest {
            true => FREE_END * hub.bore,
            false => 0.0,
        };
        let turning = on_it.iter().any(|part| part.hold == Hold::Turning);
        let class = if turning {
            &spec.pin_fit
        } else {
            &hub.shaft_fit
        };
        let above = beyond(high, true, is_highest);
        let mut bar = Bar::new(hub.seat(""), [low - end, high])
            .of_class(class)
            .ring(low, false, beyond(low, false, is_lowest))
            .ring(high, true, above);
        let spans: Vec<[f64; 2]> = on_it.iter().map(|part| part.span).collect();
        let spacers = self.spacers(own, hub.bore, &spans);
        let general = &self.design.drawing.general_tolerance;
        bar = bar.through(&spans).spaced(spacers).within(above, general);
        let mut seats = Vec::new();
        if end > 0.0 {
            seats.push([low - end, low]);
        }
        for part in on_it.iter().filter(|part| part.hold.is_fixed()) {
            let mut span = part.span;
            if let Hold::Keyed(key) = part.hold {
                let half = 0.5 * key.length.max(span[1] - span[0]);
                let middle = 0.5 * (span[0] + span[1]);
                span = [middle - half, middle + half];
                bar = match key.has_square_ends {
                    true => bar.keyed_square(hub.keyway, span),
                    false => bar.keyed(hub.keyway, span),
                };
                bar = bar.key(Some(key), part.span);
                if let Some([past, beyond]) = bar.last_keyway() {
                    seats.extend([[past, span[0]], [span[1], beyond]]);
                }
            }
            seats.push(span);
        }
        if *class != hub.shaft_fit {
            let turning = on_it.iter().filter(|part| part.hold == Hold::Turning);
            let turning: Vec<[f64; 2]> = turning.map(|part| part.span).collect();
            for seat in joined(seats, &turning) {
                bar = bar.seat(seat, &hub.shaft_fit);
            }
        }
        let title = format!("Shaft of {}", self.original(&shaft.name));
        let name = format!("shaft-{}", self.original(&shaft.name));
        let mut made = bar.turned(&name, &title, hub.shaft_stock(), general);
        made.part.notes.extend(notes(&on_it, end > 0.0));
        made.role = match (shaft.body, end > 0.0) {
            (0, _) => "fixed in the frame".into(),
            (_, true) => "driven at its free end".into(),
            (_, false) => String::new(),
        };
        let owner = &self.bodies[shaft.body].name;
        let given = self.design.bodies.get(owner).map(|body| body.given_mass());
        made.pieces = vec![TurnedPiece {
            turn: [0.0, 0.0, hub.keyway.map_or(0.0, |_| hub.keyway_angle)],
            is_counted: given.is_some_and(|given| given.mass.is_some()),
            ..bar.piece(owner, shaft.at)
        }];
        made
    }

    /// Remark of the parts list on a gear or cam without a shaft, or with another bore or keyway than its shaft; else `None`.
    pub(in crate::machine) fn hold_remark(&self, name: &str) -> Option<&'static str> {
        let mut parts = self.shafts().iter().flat_map(|shaft| &shaft.parts);
        let own = parts.find(|part| !part.is_plate && part.name == name);
        match own.map(|part| part.hold) {
            None if self.design.hardware() == Hardware::None => None,
            None => Some("no bore, or not on an axis: not joined"),
            Some(Hold::Loose) => Some("bore or keyway differs from shaft"),
            Some(_) => None,
        }
    }

    /// Lists the drives that turn bodies from outside, and the joints that fix bodies to others if no shaft joins them.
    pub(super) fn list_drives(&self, machine: &mut LinkedMachine) {
        for (index, body) in self.bodies.iter().enumerate().skip(1) {
            let Some(mount) = &body.mount else { continue };
            let name = self.original(&body.name);
            let carrier = self.original(&self.bodies[mount.carrier].name);
            let mut on_shafts = self.shafts().iter().flat_map(|shaft| &shaft.parts);
            let is_joined =
                on_shafts.any(|part| part.is_plate && part.body == index && part.hold.is_fixed());
            let is_fixed = mount.kind == JointKind::Fixed && !is_joined && self.has_plate(index);
            let (what, remark) = match self.is_driven(index) {
                true => ("Drive", format!("turns it on {carrier}")),
                false if is_fixed => ("Joint", format!("fixes it to {carrier}")),
                false => continue,
            };
            machine.part(Part::given(
                &format!("{what} of {name}"),
                vec![index],
                remark,
            ));
        }
    }

    /// Lists the brackets of gears or cams through which the shaft of another body passes. They come from the customer.
    pub(in crate::machine) fn list_brackets(&self, machine: &mut LinkedMachine) {
        let parts = self
            .shafts()
            .iter()
            .flat_map(|shaft| shaft.parts.iter().map(move |part| (shaft, part)));
        for (shaft, part) in parts.filter(|(_, part)| part.hold == Hold::Bracket) {
            let original = self.original(&part.name);
            let (name, body) = (
                format!("Bracket of {original}"),
                &self.bodies[part.body].name,
            );
            let link = machine.link_named(body);
            let gears = self.gears.iter();
            let gears = gears.map(|gear| (&gear.name, gear.gear().body(), gear.mount));
            let cams = self.cams.iter();
            let cams = cams.map(|cam| (&cam.name, cam.part.body(), cam.mount));
            let found = gears.chain(cams).find(|(name, ..)| **name == part.name);
            let Some((_, hub, mount)) = found else {
                continue;
            };
            let angle = thousandths((mount + hub.keyway_angle).to_degrees());
            if let Some(known) = machine.parts.iter_mut().find(|part| part.name == name) {
                known.links.extend(link);
                if hub.keyway.is_some() {
                    known.remark += &format!(", copy at {angle}°");
                }
                continue;
            }
            let inside = thousandths(shaft.hub.bore);
            let bore = thousandths(hub.bore);
            let kept = match hub.keyway.map(Keyway::of_shaft) {
                Some(key) => {
                    let on = self.original(body);
                    let [width, depth] = [key.width, key.depth].map(thousandths);
                    format!("keyway {width} x {depth} at {angle}° from the x axis of {on}")
                }
                None => "locked in rotation".into(),
            };
            let (on, class) = (self.original(body), &hub.shaft_fit);
            let remark = format!(
                "holds it on {on}: Ø{bore} {class} in its bore, clear of Ø{inside} inside, {kept}"
            );
            machine.part(Part::given(&name, link.into_iter().collect(), remark));
        }
    }

    /// Lowest and highest face of the plates of the bodies from `first` on, and of all gears and cams, mm.
    pub(super) fn extent_from(&self, first: usize) -> [f64; 2] {
        let plates = (first..self.bodies.len()).filter(|&body| self.is_on_axes(body));
        let plates = plates.map(|body| {
            let bottom = self.bottom(body);
            [bottom, bottom + self.thickness(body)]
        });
        let from = |bottom: f64, width: f64| [bottom, bottom + width];
        let gears = self.gears.iter();
        let gears = gears.map(|gear| from(self.gear_bottom(gear), gear.gear().body().width));
        let cams = self.cams.iter();
        let cams = cams.map(|cam| from(self.cam_bottom(cam), cam.part.body().width));
        let all = plates.chain(gears).chain(cams);
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| {
            [low.min(a), high.max(b)]
        })
    }
}

/// Joins the seats on a shaft between which nothing turns, and extends them to the ends of the shaft if nothing turns there.
/// Seats that overlap a turning part are dropped.
fn joined(mut seats: Vec<[f64; 2]>, turning: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let is_free = |from: f64, to: f64| {
        let within = |part: &[f64; 2]| part[0] < to - COMPUTED && part[1] > from + COMPUTED;
        !turning.iter().any(within)
    };
    let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
    seats.retain(|seat| seat[0] < seat[1] && is_free(seat[0], seat[1]));
    seats.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut all: Vec<[f64; 2]> = Vec::new();
    for seat in seats {
        match all.last_mut().filter(|last| is_free(last[1], seat[0])) {
            Some(last) => last[1] = last[1].max(seat[1]),
            None => all.push(seat),
        }
    }
    let first = all.first_mut().filter(|first| is_free(low, first[0]));
    if let Some(first) = first {
        first[0] = low;
    }
    let last = all.last_mut().filter(|last| is_free(last[1], high));
    if let Some(last) = last {
        last[1] = high;
    }
    all
}

/// Notes of a shaft's sheet: on its free end, and on keyways that are in line.
fn notes(on_it: &[&ShaftPart], is_driven: bool) -> Vec<String> {
    let mut notes = Vec::new();
    if is_driven {
        notes.push("Driven at its free end, to be cut to length.".to_owned());
    }
    let keyed = on_it
        .iter()
        .filter(|part| matches!(part.hold, Hold::Keyed(_)));
    let keyed: Vec<&str> = keyed.map(|part| &*part.name).collect();
    if keyed.len() > 1 {
        let what = keyed.join(", ");
        notes.push(format!("Keyways on one line set the angles of {what}."));
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::joined;

    #[test]
    fn seats_are_one_where_nothing_turns_between_them() {
        let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        let turning = [[12.0, 18.0]];
        // The end of a keyway with room, and one that reaches below what turns.
        let seats = vec![
            [20.0, 26.0],
            [0.0, 10.0],
            [26.0, 27.5],
            [17.0, 20.0],
            [28.0, 34.0],
        ];
        assert_eq!(joined(seats, &turning), [[low, 10.0], [20.0, high]]);
        // What turns at an end keeps it.
        assert_eq!(joined(vec![[0.0, 10.0]], &[[11.0, 20.0]]), [[low, 10.0]]);
        assert_eq!(joined(vec![[0.0, 10.0]], &[[-9.0, 0.0]]), [[0.0, high]]);
        assert_eq!(joined(vec![[0.0, 10.0], [11.0, 20.0]], &[]), [[low, high]]);
        assert_eq!(joined(Vec::new(), &[]), [[0.0; 2]; 0]);
    }
}
