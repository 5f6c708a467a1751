//! Where words and instructions are.

/// An offset from the base of a frame, or with [`ABSOLUTE`] from the first word of a run.
pub type Slot = u32;
/// Marks an operand that belongs to no frame: an input or a constant. Nothing is written there.
pub const ABSOLUTE: Slot = 1 << 31;
/// An index into [`crate::Program::ops`].
pub type Addr = u32;
