use centrode_spec::digits::digits;

/// Reason why a linkage cannot be built or posed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkageError {
    /// A length that is not above zero.
    #[error("{name} is {value} mm; it must be finite and above zero")]
    Length {
        /// Name of the length.
        name: &'static str,
        /// Length as given, mm.
        value: f64,
    },
    /// A number that is not finite.
    #[error("{name} is {value}; it must be finite")]
    NotFinite {
        /// Name of the number.
        name: &'static str,
        /// Number as given.
        value: f64,
    },
    /// A joint or link of another linkage.
    #[error("{what} {index} does not exist in this linkage, which has {count}")]
    Unknown {
        /// Kind of item: `joint` or `link`.
        what: &'static str,
        /// Its number.
        index: usize,
        /// Number of such items in this linkage.
        count: usize,
    },
    /// A second crank.
    #[error("the linkage already has a crank: it can have only one")]
    SecondCrank,
    /// A dyad cannot close.
    #[error("dyad {dyad} cannot close {}", not_closing(*input, *missing))]
    DoesNotClose {
        /// Its number, from 0 in the order of building.
        dyad: usize,
        /// The input, rad.
        input: f64,
        /// Distance that is missing for it to close, mm: 0 at the limit of the crank; infinite for two parallel guides.
        missing: f64,
    },
    /// A dyad only just closes, and velocities have no finite value.
    #[error(
        "dyad {dyad} is stretched or folded flat at the input {input} rad: velocities are not finite there"
    )]
    Flat {
        /// Its number, from 0 in the order of building.
        dyad: usize,
        /// The input, rad.
        input: f64,
    },
    /// The angle of a link jumps: a guided link's block passes its pivot.
    #[error("the direction of link {link} is not defined near the input {input} rad")]
    NoDirection {
        /// The link's number.
        link: usize,
        /// The input, rad.
        input: f64,
    },
}

/// Where a dyad cannot close, in words.
fn not_closing(input: f64, missing: f64) -> String {
    let input = digits(input, 6);
    match missing {
        0.0 => format!("past the input {input} rad, where its links lie in one line"),
        m if m.is_infinite() => format!("at the input {input} rad: its guides are parallel"),
        m => format!("at the input {input} rad: {} mm are missing", digits(m, 6)),
    }
}
