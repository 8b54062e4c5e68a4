//! What can go wrong, each in one line with the next step.

use std::fmt;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// The graphics processor was asked for and there is none that wgpu can use.
    NoAdapter(String),
    /// The graphics processor refused the program or the work.
    Gpu(String),
    /// A formula of the fingerprint does not fit the scene.
    Formula {
        /// `right` or `wrong`.
        which: &'static str,
        /// What is wrong with it, and where.
        error: formula::Error,
    },
    /// The scene has a value that no scene can have.
    Scene(String),
    /// The size asked for is zero or larger than [`crate::MAX_SIZE`].
    Size(u32),
    /// The picture cannot be written where it should be.
    Write(String),
    /// The plot has nothing to draw, or no room to draw it.
    Plot(String),
    /// The caller asked to stop.
    Cancelled,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAdapter(why) => write!(
                f,
                "no graphics adapter ({why}): install a Vulkan driver (Debian: apt-get install mesa-vulkan-drivers) or use the CPU (--backend cpu)"
            ),
            Self::Gpu(why) => write!(
                f,
                "the graphics adapter gave up: {why}; use the CPU (--backend cpu)"
            ),
            Self::Formula { which, error } => {
                write!(f, "the {which} formula cannot be drawn: {error}")
            }
            Self::Scene(why) => write!(f, "the scene cannot be drawn: {why}"),
            Self::Size(size) => {
                write!(
                    f,
                    "a panel of {size} pixels cannot be drawn: choose 16 to {}",
                    crate::MAX_SIZE
                )
            }
            Self::Write(why) => write!(f, "the picture cannot be written: {why}"),
            Self::Plot(why) => write!(f, "the plot cannot be drawn: {why}"),
            Self::Cancelled => write!(f, "drawing was cancelled"),
        }
    }
}

impl std::error::Error for Error {}
