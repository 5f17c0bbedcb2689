//! Progress on a terminal as a bar, elsewhere as plain lines, or nothing.

use indicatif::{ProgressBar, ProgressStyle};
use opnav::pipeline::Progress;
use std::io::{IsTerminal, Write};
use std::sync::Mutex;

/// Listener of the pipelines that prints to standard error.
pub struct Terminal {
    quiet: bool,
    stage: Mutex<Option<Stage>>,
}

struct Stage {
    name: String,
    total: usize,
    printed_tenths: usize,
    bar: Option<ProgressBar>,
}

impl Terminal {
    /// A listener that prints nothing if `quiet`.
    pub fn new(quiet: bool) -> Self {
        Terminal { quiet, stage: Mutex::new(None) }
    }

    /// Prints a line of result to standard output, unless quiet.
    pub fn say(&self, line: &str) {
        if !self.quiet {
            // A reader that has seen enough, such as `head`, is no error.
            let _ = writeln!(std::io::stdout(), "{line}");
        }
    }

    fn with_stage(&self, act: impl FnOnce(&mut Option<Stage>)) {
        if !self.quiet {
            act(&mut self.stage.lock().unwrap_or_else(|poisoned| poisoned.into_inner()));
        }
    }
}

impl Progress for Terminal {
    fn begin(&self, name: &str, total: usize) {
        self.with_stage(|stage| {
            let bar = std::io::stderr().is_terminal().then(|| {
                let style =
                    ProgressStyle::with_template("{prefix:>12} [{bar:40}] {pos}/{len} {elapsed_precise} left {eta}")
                        .unwrap_or_else(|_| ProgressStyle::default_bar());
                ProgressBar::new(total as u64).with_style(style).with_prefix(name.to_string())
            });
            *stage = Some(Stage { name: name.to_string(), total, printed_tenths: 0, bar });
        });
    }

    fn advance_to(&self, done: usize) {
        self.with_stage(|stage| {
            let Some(stage) = stage else { return };
            if let Some(bar) = &stage.bar {
                bar.set_position(done as u64);
                return;
            }
            let tenths = 10 * done / stage.total.max(1);
            if tenths > stage.printed_tenths {
                stage.printed_tenths = tenths;
                eprintln!("{}: {done}/{}", stage.name, stage.total);
            }
        });
    }

    fn end(&self) {
        self.with_stage(|stage| {
            if let Some(bar) = stage.take().and_then(|s| s.bar) {
                bar.finish();
            }
        });
    }

    fn note(&self, message: &str) {
        if !self.quiet {
            eprintln!("{message}");
        }
    }
}
