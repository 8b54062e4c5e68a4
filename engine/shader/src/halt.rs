//! Why a run ended without a value.

/// What stopped a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// More steps than one call may take.
    Steps,
    /// More steps than all calls together may take.
    AllSteps,
    /// Functions that call each other too deep.
    Depth,
    /// More numbers held at once than there is room for.
    Room,
    /// An index past the end.
    PastTheEnd {
        /// The index.
        index: u32,
        /// How many there are.
        len: usize,
    },
    /// The end of a function without a value.
    NoValue,
    /// Something that validation should have refused.
    Unexpected(&'static str),
}
