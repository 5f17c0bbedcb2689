//! How a long job tells of its progress, without knowing who listens.

/// Listener to the progress of a job, called from any thread.
pub trait Progress: Sync {
    /// A stage of `total` steps begins.
    fn begin(&self, stage: &str, total: usize);
    /// `done` steps of the stage are finished.
    fn advance_to(&self, done: usize);
    /// The stage is over.
    fn end(&self);
    /// Something the user should know that is not an error.
    fn note(&self, message: &str);
}

/// Listens to nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn begin(&self, _: &str, _: usize) {}
    fn advance_to(&self, _: usize) {}
    fn end(&self) {}
    fn note(&self, _: &str) {}
}
