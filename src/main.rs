//! The command line: one file a subcommand in `cli/`; everything else is the library.

mod cli;

use std::process::ExitCode;

/// Mesa's drivers print an error where `XDG_RUNTIME_DIR` is not set, though nothing here needs it.
fn give_mesa_a_runtime_folder() {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: this is the first statement of the program; no other thread exists yet.
        unsafe { std::env::set_var("XDG_RUNTIME_DIR", std::env::temp_dir()) };
    }
}

fn main() -> ExitCode {
    give_mesa_a_runtime_folder();
    cli::run()
}
