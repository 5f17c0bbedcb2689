//! Threads that finish what one thread draws, with a short queue between them.

use crate::pipeline::error::PipelineError;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// What the threads did.
pub(super) struct Finished<T> {
    /// Results, in no particular order.
    pub results: Vec<T>,
    /// Time that the threads worked, all together.
    pub busy: Duration,
}

/// Hands `draw` a function that passes a job on to the threads, waiting while `threads` jobs are queued already, and
/// returns what `finish` made of each job. After a failure the function says `false`: it is time to stop.
///
/// # Errors
/// The first failure of `finish`, else that of `draw`.
pub(super) fn draw_and_finish<Job: Send, T: Send>(
    threads: usize,
    finish: impl Fn(Job) -> Result<T, PipelineError> + Sync,
    draw: impl FnOnce(&dyn Fn(Job) -> bool) -> Result<(), PipelineError>,
) -> Result<Finished<T>, PipelineError> {
    let (sender, receiver) = sync_channel::<Job>(threads);
    let (receiver, failed) = (Mutex::new(receiver), AtomicBool::new(false));
    let (outcomes, drawn) = std::thread::scope(|scope| {
        let work = || finish_until_closed(&receiver, &failed, &finish);
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let drawn = draw(&|job| pass_on(&sender, &failed, job));
        drop(sender);
        let join = |worker: std::thread::ScopedJoinHandle<_>| worker.join().expect("a writing thread does not panic");
        (workers.into_iter().map(join).collect::<Vec<_>>(), drawn)
    });
    let mut finished = Finished { results: Vec::new(), busy: Duration::ZERO };
    for outcome in outcomes {
        let (results, busy) = outcome?;
        finished.results.extend(results);
        finished.busy += busy;
    }
    drawn.map(|()| finished)
}

fn pass_on<Job>(sender: &SyncSender<Job>, failed: &AtomicBool, job: Job) -> bool {
    !failed.load(Ordering::Relaxed) && sender.send(job).is_ok()
}

/// One thread's work. After any thread's failure the queue is emptied without doing it, so that nobody waits.
fn finish_until_closed<Job, T>(
    receiver: &Mutex<Receiver<Job>>,
    failed: &AtomicBool,
    finish: &impl Fn(Job) -> Result<T, PipelineError>,
) -> Result<(Vec<T>, Duration), PipelineError> {
    let (mut results, mut busy, mut failure) = (Vec::new(), Duration::ZERO, None);
    loop {
        let next = receiver.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok(job) = next else { break };
        if failed.load(Ordering::Relaxed) {
            continue;
        }
        let start = Instant::now();
        match finish(job) {
            Ok(result) => results.push(result),
            Err(error) => {
                failed.store(true, Ordering::Relaxed);
                failure = Some(error);
            }
        }
        busy += start.elapsed();
    }
    failure.map_or(Ok((results, busy)), Err)
}
