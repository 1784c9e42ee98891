//! Rules that a number of the file can break, and the checks of them.

use thiserror::Error;

use crate::digits::stated;
use crate::is_control;

/// A value of a description that breaks a rule.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{key} {rule}")]
pub struct SpecError {
    /// Key of the value, with the tables around it: `teeth.backlash`.
    pub key: String,
    /// The rule it breaks.
    pub rule: Rule,
}

/// Rule that a value breaks, with the value.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Rule {
    /// NaN or infinite.
    #[error("must be a finite number, not {0}")]
    NotFinite(f64),
    /// Zero or less where a size is needed.
    #[error("must be greater than 0, not {}", stated(*.0))]
    NotPositive(f64),
    /// Less than zero.
    #[error("must not be negative, but is {}", stated(*.0))]
    Negative(f64),
    /// Outside a range.
    #[error("must be {}{unit}, not {}{unit}", range(*minimum, *maximum), stated(*value))]
    OutOfRange {
        /// Value given.
        value: f64,
        /// Minimum value allowed.
        minimum: f64,
        /// Maximum value allowed.
        maximum: f64,
        /// Unit with a leading space, or empty.
        unit: &'static str,
    },
    /// A range whose ends are not in order.
    #[error("must be a range from low to high, not {} to {}", stated(*.0), stated(*.1))]
    NotInOrder(f64, f64),
    /// Two keys that exclude each other.
    #[error("cannot be given together with {0}")]
    Excludes(&'static str),
    /// None of several keys is given, but one is required.
    #[error("is missing: give one of {0}")]
    NeedsOneOf(&'static str),
    /// Two goals for one figure that no figure can meet together.
    #[error("contradicts {other}: {figure} cannot be at least {} and at most {}", stated(*minimum), stated(*maximum))]
    Contradicts {
        /// Key of the other goal.
        other: String,
        /// Figure of both goals, in words.
        figure: String,
        /// Minimum that one goal requires.
        minimum: f64,
        /// Maximum that the other goal requires.
        maximum: f64,
    },
    /// Strokes of another kind than the follower makes.
    #[error("needs {0} in every segment, for this follower")]
    Stroke(&'static str),
    /// A number that must not occur twice.
    #[error("is {} again, as in an earlier entry", stated(*.0))]
    Twice(f64),
    /// A key that must be given.
    #[error("is needed {0}")]
    Needed(&'static str),
    /// A key that has no meaning in this design.
    #[error("has no meaning {0}")]
    Unused(&'static str),
    /// A size for which there is no screw.
    #[error("must be 0 or the size of a screw, 1.6, 2, 2.5, 3, 4, 5, 6, 8, 10 or 12 mm, not {}", stated(*.0))]
    NoScrew(f64),
    /// A name of a design that cannot name a file.
    #[error("must be 1 to 64 letters, digits, '-' or '_', not {0:?}")]
    Name(String),
    /// A name of a part of a design that not every output can hold.
    #[error("must be 1 to 64 letters a to z, digits, '-' or '_', not {0:?}")]
    PartName(String),
    /// Words that do not fit one line of a drawing.
    #[error(
        "must be one line of at most {most} characters, not {count} with {controls} control characters (including U+FFFE and U+FFFF)"
    )]
    Line {
        /// Characters given.
        count: usize,
        /// Control characters among them, U+FFFE and U+FFFF: line ends, tabs and the like.
        controls: usize,
        /// Maximum number of characters allowed.
        most: usize,
    },
    /// Words that are no tolerance class.
    #[error(
        "must be empty or a tolerance class of ISO 286 for a {of}, such as {like:?}, not {word:?}"
    )]
    NoClass {
        /// Word given.
        word: String,
        /// Side of the fit: hole or shaft.
        of: &'static str,
        /// A class of that side.
        like: &'static str,
    },
    /// A mean ratio with a common factor.
    #[error("must be in lowest terms: write {1:?} for {0:?}")]
    LowestTerms([u32; 2], [u32; 2]),
    /// Two different tooth counts for one gear.
    #[error("is {0}, but the pitch curve has tooth_count {1}: give only one of them")]
    ToothCountTwice(u32, u32),
    /// A driven gear without a whole number of teeth.
    #[error("is {0}, but with mean_ratio {1:?} the driven gear then has no whole number of teeth: it must be a multiple of {n2}", n2 = .1[1])]
    DrivenTeeth(u32, [u32; 2]),
    /// A keyway wider than the bore.
    #[error("is {0} mm, but the bore is only {1} mm across")]
    KeywayWidth(f64, f64),
    /// Something that needs a bore, without one.
    #[error("needs a bore")]
    NoBore,
    /// Two tools of a pair with unlike pressure angles.
    #[error(
        "is {} deg, but tool.pressure_angle_deg is {} deg: mating flanks touch on one line of action, so both tools must have the same angle",
        stated(*.own),
        stated(*.tool)
    )]
    PressureAngles {
        /// Pressure angle of the gear's own tool, degrees.
        own: f64,
        /// Pressure angle of the tool of the pair, degrees.
        tool: f64,
    },
    /// A tip rounding that does not fit the tool's tooth.
    #[error(
        "is {value}, but with this pressure angle and addendum, the tip of the tool has room for at most {maximum:.6}"
    )]
    TipRadius {
        /// Value given.
        value: f64,
        /// Maximum that fits.
        maximum: f64,
    },
}

/// A range in words; if it has no upper end, by its minimum.
fn range(minimum: f64, maximum: f64) -> String {
    if maximum <= minimum {
        stated(minimum)
    } else if maximum.is_finite() {
        format!("{} to {}", stated(minimum), stated(maximum))
    } else {
        format!("at least {}", stated(minimum))
    }
}

impl SpecError {
    /// Error with its key seen from outside the table `table`.
    #[must_use]
    pub fn inside(mut self, table: &str) -> Self {
        self.key = format!("{table}.{}", self.key);
        self
    }
}

/// The error that the value of a key breaks a rule.
///
/// # Errors
/// Always: [`SpecError`] with the key and the rule.
pub fn broken<T>(key: &str, rule: Rule) -> Result<T, SpecError> {
    Err(SpecError {
        key: key.into(),
        rule,
    })
}

/// Checks that a value is a number, not NaN and not infinite.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn finite(key: &str, value: f64) -> Result<(), SpecError> {
    if value.is_finite() {
        Ok(())
    } else {
        broken(key, Rule::NotFinite(value))
    }
}

/// Checks a size: greater than 0, at most 1e12.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn positive(key: &str, value: f64) -> Result<(), SpecError> {
    finite(key, value)?;
    if value > 0.0 {
        not_too_great(key, value)
    } else {
        broken(key, Rule::NotPositive(value))
    }
}

/// Checks a size that may be 0, at most 1e12.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn not_negative(key: &str, value: f64) -> Result<(), SpecError> {
    finite(key, value)?;
    if value >= 0.0 {
        not_too_great(key, value)
    } else {
        broken(key, Rule::Negative(value))
    }
}

/// Checks that a size is at most 1e12, more than any part has: values computed from it are then finite.
fn not_too_great(key: &str, value: f64) -> Result<(), SpecError> {
    const MAXIMUM: f64 = 1e12;
    in_range(key, value, [0.0, MAXIMUM], "")
}

/// Checks the name of a design, which names files: letters of any script.
///
/// # Errors
/// [`SpecError`] at the key `name`.
pub fn design_name(name: &str) -> Result<(), SpecError> {
    if is_name(name, char::is_alphanumeric) {
        return Ok(());
    }
    broken("name", Rule::Name(name.chars().take(80).collect()))
}

/// Checks the name of a part of a design, which formulas and simulators read too: letters a to z.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn part_name(key: &str, name: &str) -> Result<(), SpecError> {
    if is_name(name, |c| c.is_ascii_alphanumeric()) {
        return Ok(());
    }
    broken(key, Rule::PartName(name.chars().take(80).collect()))
}

fn is_name(name: &str, is_letter: impl Fn(char) -> bool) -> bool {
    let safe = |c: char| is_letter(c) || c == '-' || c == '_';
    (1..=64).contains(&name.chars().count()) && name.chars().all(safe)
}

/// Checks words for a drawing: one line of limited length.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn single_line(key: &str, words: &str) -> Result<(), SpecError> {
    const MOST: usize = 80;
    let count = words.chars().count();
    let controls = words.chars().filter(|&c| is_control(c)).count();
    if count <= MOST && controls == 0 {
        return Ok(());
    }
    let rule = Rule::Line {
        count,
        controls,
        most: MOST,
    };
    broken(key, rule)
}

/// Whether a number is zero and need not be written.
#[must_use]
pub fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// Whether two numbers differ by rounding at most: a few units in the twelfth digit.
pub(crate) fn same(one: f64, other: f64) -> bool {
    (one - other).abs() <= 1e-12 * one.abs().max(other.abs())
}

/// Checks a count against its minimum and maximum.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn count_in_range(key: &str, value: u32, minimum: u32, maximum: u32) -> Result<(), SpecError> {
    in_range(key, value.into(), [minimum.into(), maximum.into()], "")
}

/// Checks a value against its minimum and maximum, in a unit with a leading space, or empty.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn in_range(
    key: &str,
    value: f64,
    [minimum, maximum]: [f64; 2],
    unit: &'static str,
) -> Result<(), SpecError> {
    finite(key, value)?;
    if (minimum..=maximum).contains(&value) {
        return Ok(());
    }
    let rule = Rule::OutOfRange {
        value,
        minimum,
        maximum,
        unit,
    };
    broken(key, rule)
}
