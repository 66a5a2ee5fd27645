//! `glassbrick verify`: checks every brick and table of a store.

use anyhow::{Result, bail};
use glassbrick::verify;

use crate::args::VerifyArgs;
use crate::figures::count;
use crate::progress::Progress;
use crate::terminal;

/// Checks the store; prints what is damaged, or that nothing is.
///
/// # Errors
/// When something is damaged, or the store cannot be checked.
pub fn run(args: &VerifyArgs) -> Result<()> {
    let progress = Progress::start("checking");
    let threads = args.threads.map(|threads| threads as usize);
    let verified = verify(&args.store, threads, |done, total| progress.pieces(done, total))?;
    drop(progress);
    let store = terminal::one_line(&args.store.to_string_lossy());
    if verified.damage.is_empty() {
        let (bricks, levels) = (count(verified.bricks), verified.levels);
        return terminal::print(&format!(
            "{store}: all {bricks} bricks of {levels} levels and their tables are sound"
        ));
    }
    let lines: Vec<String> = verified.damage.iter().map(|line| terminal::one_line(line)).collect();
    terminal::print(&lines.join("\n"))?;
    let found = match verified.damage.len() {
        1 => "1 part is damaged; it is named above".to_owned(),
        parts => format!("{} parts are damaged; they are named above", count(parts as u64)),
    };
    bail!("{store}: {found}; make the store again from its volume");
}
