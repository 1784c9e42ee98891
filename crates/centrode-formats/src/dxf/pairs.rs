//! Pairs of group code and value, which make up a file of both versions, and the additions of the newer one to each entry.

use super::Version;
use centrode_geometry::Point;

/// Group codes with their values. The newer version gives every entry a handle, its owner's handle and the
/// names of its classes; in R12 nothing is written for them.
pub(super) struct Pairs {
    version: Version,
    text: String,
    next: u32,
}

/// Number by which entries of the newer version refer to one another; 0 refers to none.
#[derive(Clone, Copy)]
pub(super) struct Handle(u32);

impl Handle {
    /// Owner of entries that no entry owns.
    pub(super) const NONE: Self = Self(0);
}

impl Pairs {
    pub(super) fn new(version: Version) -> Self {
        Self {
            version,
            text: String::new(),
            next: 1,
        }
    }

    pub(super) fn is_newer(&self) -> bool {
        self.version == Version::R2010
    }

    /// The next free handle.
    pub(super) fn seed(&self) -> Handle {
        Handle(self.next)
    }

    /// The text of these pairs and of others after them.
    pub(super) fn followed_by(mut self, others: &Self) -> Vec<u8> {
        self.text.push_str(&others.text);
        self.text.into_bytes()
    }

    pub(super) fn word(&mut self, code: u16, value: &str) -> &mut Self {
        self.text.push_str(&format!("{code:>3}\r\n{value}\r\n"));
        self
    }

    /// One line of text: line ends become spaces, and a caret, which otherwise begins a code, is put before a
    /// space. R12 knows no letters beyond ASCII: others are written by their number.
    pub(super) fn line(&mut self, code: u16, value: &str) -> &mut Self {
        let newer = self.is_newer();
        let letter = |c: char| match c {
            c if c.is_control() => " ".to_owned(),
            '^' => "^ ".to_owned(),
            c if newer || c.is_ascii() => c.to_string(),
            c => format!("\\U+{:04X}", u32::from(c)),
        };
        self.word(code, &value.chars().map(letter).collect::<String>())
    }

    pub(super) fn whole(&mut self, code: u16, value: u32) -> &mut Self {
        self.word(code, &format!("{value:>6}"))
    }

    /// Writes a number to twelve decimals.
    pub(super) fn number(&mut self, code: u16, value: f64) -> &mut Self {
        let text = format!("{:.12}", value + 0.0);
        let short = text.trim_end_matches('0');
        let dot = if short.ends_with('.') { "0" } else { "" };
        self.word(code, &format!("{short}{dot}"))
    }

    /// Writes x at `code`, y ten after it.
    pub(super) fn flat(&mut self, code: u16, point: &Point) -> &mut Self {
        self.number(code, point.x).number(code + 10, point.y)
    }

    /// Writes x at `code`, y and z ten and twenty after it.
    pub(super) fn point(&mut self, code: u16, point: &Point) -> &mut Self {
        self.flat(code, point).number(code + 20, 0.0)
    }

    pub(super) fn section(&mut self, name: &str) -> &mut Self {
        self.word(0, "SECTION").word(2, name)
    }

    pub(super) fn handle(&mut self, code: u16, handle: Handle) -> &mut Self {
        self.word(code, &format!("{:X}", handle.0))
    }

    /// Class whose values follow; an entry of R12 has none.
    pub(super) fn class(&mut self, name: &str) -> &mut Self {
        if self.is_newer() {
            self.word(100, name);
        }
        self
    }

    /// Begins an entry: its kind, handle and owner.
    pub(super) fn entry(&mut self, kind: &str, owner: Handle) -> Handle {
        self.word(0, kind).identity(5, owner)
    }

    /// Writes handle (at `code`) and owner of the current entry; nothing in R12.
    pub(super) fn identity(&mut self, code: u16, owner: Handle) -> Handle {
        if !self.is_newer() {
            return Handle::NONE;
        }
        let handle = Handle(self.next);
        self.next += 1;
        self.handle(code, handle).handle(330, owner);
        handle
    }
}
