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
    let mut sections = body.journal(radius, true);
    let below: f64 = sections.iter().map(|section| section.length).sum();
    let slot = body.keyway.map(|key| TurnedSlot {
        width: key.width,
        foot: 0.5 * body.journal_diameter - key.depth,
        rounded: body.keyway_rounding() > 0.0,
    });
    let journal = Turned::new(thick[0] - below, sections, slot).ok()?;
    journal.close(builder, [TurnedEnd::Flat, near]);
    sections = body.journal(radius, false);
    sections.reverse();
    for section in &mut sections {
        section.radii.reverse();
    }
    let journal = Turned::new(thick[1], sections, None).ok()?;
    journal.close(builder, [far, TurnedEnd::Flat]);
    Some(())
}

impl ShaftBody {
    /// Sections of a journal from its tip to the thick part of a radius, the near one with its keyway.
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
        sections
    }
}
