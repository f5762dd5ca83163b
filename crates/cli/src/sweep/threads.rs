//! Runs on the processors of this machine. Each is a simulation of its own, so that results do not depend on how many run at a time.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use anyhow::Result;

use super::{Common, Series};

/// Runs the missing runs in threads, and passes each finished one to `take`.
///
/// # Errors
/// Errors of `take`.
pub fn run(
    common: &Common,
    jobs: Option<NonZeroUsize>,
    missing: &[usize],
    take: &mut impl FnMut(usize, Result<Series, String>) -> Result<()>,
) -> Result<()> {
    let jobs = match jobs {
        Some(jobs) => jobs,
        None => thread::available_parallelism()?,
    };
    let next = AtomicUsize::new(0);
    thread::scope(|scope| {
        // No more results wait than a few for every thread.
        let (sender, receiver) = mpsc::sync_channel(4 * jobs.get());
        for _ in 0..jobs.get().min(missing.len()) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                while let Some(&run) = missing.get(next.fetch_add(1, Ordering::Relaxed)) {
                    // Nobody listens where results cannot be written.
                    if sender.send((run, common.run(run))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        for (run, found) in receiver {
            take(run, found)?;
        }
        Ok(())
    })
}
