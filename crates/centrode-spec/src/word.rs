/// Defines the words of an enum's variants: a list of all variants, in order, and one with their words; the word of each variant;
/// the variant of a word.
#[macro_export]
macro_rules! words {
    ($kind:ident { $($variant:ident = $word:literal),+ $(,)? }) => {
        impl $kind {
            /// All of them, in order.
            pub const ALL: [Self; [$($word),+].len()] = [$(Self::$variant),+];

            /// All of them by their words.
            pub const NAMES: [(&'static str, Self); Self::ALL.len()] =
                [$(($word, Self::$variant)),+];

            /// Its word in files and calls.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }

            /// The variant with this word; `None` if there is none.
            #[must_use]
            pub fn named(word: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|one| one.name() == word)
            }
        }
    };
}
