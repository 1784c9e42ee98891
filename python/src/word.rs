//! Words of design files and calls, and what each represents.

use crate::error::{Answer, Raised};
use centrode::family::Depth;
use centrode_export::Layers;
use centrode_formats::Purpose;
use centrode_formats::dxf::{Curves, Version};
use centrode_gear::cam::design::Turn;
use centrode_gear::design::{Addendum, Fit, Phase, TipShortening};
use centrode_gear::pitch::{Interpolation, Plane};
use centrode_groove::Scheme;
use centrode_kinematics::linkage::Branch;
use centrode_machines::three_arm::design::Direction;
use centrode_spec::{Projection, SheetSize};
use centrode_synthesis::optimise::Strategy;
use centrode_synthesis::reverse::{Aim, SplitKind};

/// Maker of a value from a number, where one may replace a word, and the sentence for anything else.
pub(crate) type OrNumber<T> = Option<(fn(f64) -> T, &'static str)>;

/// One of a few, each known by a word.
pub(crate) trait Word: Copy + PartialEq + 'static {
    /// All of them, by their words.
    const WORDS: &'static [(&'static str, Self)];

    /// Whether a number may replace a word.
    const NUMBER: OrNumber<Self> = None;

    /// The one of a word given at a key.
    fn of(key: &str, word: &str) -> Answer<Self> {
        let mut all = Self::WORDS.iter();
        let found = all.find(|(name, _)| *name == word);
        found.map(|(_, one)| *one).ok_or_else(|| {
            let known: Vec<&str> = Self::WORDS.iter().map(|(name, _)| *name).collect();
            Raised::word(key, word, &known)
        })
    }

    /// Its word.
    fn word(self) -> &'static str {
        let mut all = Self::WORDS.iter();
        all.find(|(_, one)| *one == self)
            .map_or("", |(name, _)| name)
    }
}

impl Word for Addendum {
    const WORDS: &'static [(&'static str, Self)] =
        &[("full", Self::Full), ("fitted", Self::Fitted)];
}

impl Word for Fit {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("addendum", Self::Addendum),
        ("thickness_split", Self::ThicknessSplit),
        ("pressure_angle", Self::PressureAngle),
        ("phase", Self::Phase),
    ];
}

impl Word for Phase {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("auto", Self::Auto),
        ("tooth", Self::Tooth),
        ("space", Self::Space),
        ("congruent", Self::Congruent),
    ];
    const NUMBER: OrNumber<Self> =
        Some((Self::Pitches, "phase must be a word or a number of pitches"));
}

impl Word for TipShortening {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("keep-clearance", Self::KeepClearance),
        ("none", Self::None),
    ];
    const NUMBER: OrNumber<Self> = Some((Self::By, "tip_shortening must be a word or a number"));
}

impl Word for Plane {
    const WORDS: &'static [(&'static str, Self)] =
        &[("polar", Self::Polar), ("cartesian", Self::Cartesian)];
}

impl Word for Interpolation {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("cubic", Self::Cubic),
        ("quintic", Self::Quintic),
        ("trigonometric", Self::Trigonometric),
    ];
}

impl Word for Turn {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("counter-clockwise", Self::CounterClockwise),
        ("clockwise", Self::Clockwise),
    ];
}

impl Word for Direction {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("clockwise", Self::Clockwise),
        ("counter-clockwise", Self::CounterClockwise),
    ];
}

impl Word for Branch {
    const WORDS: &'static [(&'static str, Self)] =
        &[("upper", Self::Upper), ("lower", Self::Lower)];
}

impl Word for Scheme {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("shaft", Self::Shaft),
        ("elliptic-gear", Self::EllipticGear),
        ("both", Self::Both),
    ];
}

/// Types that know their own words.
macro_rules! own_words {
    ($($kind:ty),*) => {
        $(impl Word for $kind {
            const WORDS: &'static [(&'static str, Self)] = &Self::NAMES;
        })*
    };
}

own_words!(
    Aim, Curves, Depth, Layers, Projection, Purpose, SheetSize, SplitKind, Strategy
);

impl Word for Version {
    const WORDS: &'static [(&'static str, Self)] = &[("R2010", Self::R2010), ("R12", Self::R12)];
}
