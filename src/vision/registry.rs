//! Parts of the front end that can be exchanged by name: one line of a table a part.

/// Makes a type of names for the parts behind a trait, from a table of them: the name in code, the word of settings and of
/// the command line, the part itself, and what it is. The first one is the default.
macro_rules! registry {
    (
        $(#[$about:meta])*
        $kind:ident of $part:ident:
        $($name:ident $word:literal = $value:expr, $what:literal;)+
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        pub enum $kind {
            $(#[doc = $what] #[serde(rename = $word)] $name,)+
        }

        impl $kind {
            /// All there are, the default first.
            pub const ALL: &'static [Self] = &[$(Self::$name),+];

            /// Its word in settings and on the command line.
            pub fn word(self) -> &'static str {
                match self { $(Self::$name => $word),+ }
            }

            /// What it is, in a sentence.
            pub fn about(self) -> &'static str {
                match self { $(Self::$name => $what),+ }
            }

            /// What does the work.
            pub fn part(self) -> &'static dyn $part {
                match self { $(Self::$name => &$value),+ }
            }
        }

        impl Default for $kind {
            fn default() -> Self {
                Self::ALL[0]
            }
        }
    };
}

pub(super) use registry;
