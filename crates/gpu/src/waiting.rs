/// How a frame waits for bricks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waiting {
    /// Until the picture is complete.
    Complete,
    /// Not at all: what is resident is drawn, and what is missing is asked for.
    Never,
}
