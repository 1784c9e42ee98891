//! Chamfers, shoulders, journals and keyway of the exact boundary.

use centrode_geometry::{ShellBuilder, Turned, TurnedEnd, TurnedSection, TurnedSlot};

use super::ShaftBody;

/// Closes both ends beyond the thick part, whose rims have vertices at the angles `lines`; `None` where body and journals make
/// no solid.
pub(super) fn close(
    builder: &mut ShellBuilder,
    body: &ShaftBody,
    radius: f64,
    thick: [f64; 2],
    lines: &[f64],
) -> Option<()> {
    let [near, far] = thick.map(|height| TurnedEnd::Joined {
        height,
        radius,
        angles: lines,
    });
    let [below, above] = [true, false].map(|near| body.journal(radius, near));
    let journal = Turned::new(thick[0] - length(&below), below, body.slot()).ok()?;
    journal.add_faces(builder, [TurnedEnd::Flat, near]);
    let journal = Turned::new(thick[1], above, None).ok()?;
    journal.add_faces(builder, [far, TurnedEnd::Flat]);
    Some(())
}

/// The shaft before its groove is cut, with its keyway; `None` where body and journals make no solid.
pub(super) fn blank(body: &ShaftBody, radius: f64, thick: [f64; 2]) -> Option<Turned> {
    let mut sections = body.journal(radius, true);
    let bottom = thick[0] - length(&sections);
    sections.push(TurnedSection::cylinder(thick[1] - thick[0], radius));
    sections.extend(body.journal(radius, false));
    Turned::new(bottom, sections, body.slot()).ok()
}

fn length(sections: &[TurnedSection]) -> f64 {
    sections.iter().map(|section| section.length).sum()
}

impl ShaftBody {
    fn slot(&self) -> Option<TurnedSlot> {
        self.keyway.map(|key| TurnedSlot {
            width: key.width,
            floor: 0.5 * self.journal_diameter - key.depth,
            rounded: self.keyway_rounding() > 0.0,
        })
    }

    /// Sections of a journal next to the thick part of a radius, upwards: the near one, with its keyway, is below.
    fn journal(&self, radius: f64, near: bool) -> Vec<TurnedSection> {
        let (journal, c) = (0.5 * self.journal_diameter, self.chamfer);
        let cone = |from: f64| TurnedSection {
            length: c,
            radii: [from - c, from],
            slotted: false,
        };
        let plain = TurnedSection::cylinder;
        let mut sections = match self.keyway.filter(|_| near) {
            Some(_) => vec![
                cone(journal).slotted(),
                plain(self.keyway_length - c, journal).slotted(),
                plain(self.journal_length - self.keyway_length, journal),
            ],
            None => vec![cone(journal), plain(self.journal_length - c, journal)],
        };
        sections.push(cone(radius));
        // Without chamfers there are no cones.
        sections.retain(|section| section.length > 0.0);
        if !near {
            sections.reverse();
            for section in &mut sections {
                section.radii.reverse();
            }
        }
        sections
    }
}
