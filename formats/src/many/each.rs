//! Work on many items, on all cores or on so many.
//!
//! Results come in the order of the recordings, however long each takes, and no more of them wait than there are cores for: memory is bounded by
//! the cores and not by the recordings.

use std::collections::BTreeMap;
use std::io;
use std::num::NonZeroUsize;
use std::sync::mpsc::{RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Condvar, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use rayon::iter::{ParallelBridge as _, ParallelIterator as _};

/// So many results for each core may wait for one before them.
const WAITING: usize = 8;
/// So often the caller hears that time passes, while nothing is done.
const TICK: Duration = Duration::from_millis(100);

/// What [`each`] has to tell.
#[derive(Debug, PartialEq, Eq)]
pub enum Step<R> {
    /// What came of the next item, in order.
    Done(R),
    /// Time passed: how far it is can be shown.
    Tick,
}

/// Does `work` on each item, on so many threads, or on one for each core, and tells `take` what came of each, in order of the items. `take` is
/// called by the thread that calls this. It answers whether to go on; what is in work by then is done, and nobody learns of it.
///
/// The threads are its own and end with it, so that a process that was forked has them as well.
///
/// ```
/// use adsdv_formats::{Step, each};
///
/// let mut squares = Vec::new();
/// each(None, vec![1, 2, 3], |number| number * number, |step| {
///     if let Step::Done(square) = step {
///         squares.push(square);
///     }
///     true
/// })?;
/// assert_eq!(squares, [1, 4, 9]);
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
///
/// Fails before it begins, if the system has no threads left.
pub fn each<T: Send, R: Send>(
    threads: Option<NonZeroUsize>,
    items: Vec<T>,
    work: impl Fn(T) -> R + Sync,
    mut take: impl FnMut(Step<R>) -> bool,
) -> io::Result<()> {
    // 0 is one for each core.
    let builder = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, NonZeroUsize::get));
    let pool = builder.build().map_err(io::Error::other)?;
    let cores = pool.current_num_threads();
    let gate = Gate::default();
    let (tell, hear) = sync_channel(cores);
    thread::scope(|scope| {
        let (gate, work) = (&gate, &work);
        // From a thread of its own: one of the pool that waited for results would not work.
        thread::Builder::new().spawn_scoped(scope, move || {
            let items = items.into_iter().enumerate().par_bridge();
            let one = |tell: &mut SyncSender<_>, (place, item)| {
                if gate.pass(place, cores * WAITING) {
                    // Nobody hears any more: the gate is about to close.
                    let _ = tell.send((place, work(item)));
                }
            };
            pool.install(|| items.for_each_with(tell, one));
        })?;
        // Also where `take` panics: a thread that waits at the gate would wait for ever.
        let _closing = Closing(gate);
        let (mut next, mut early) = (0, BTreeMap::new());
        loop {
            let go_on = match hear.recv_timeout(TICK) {
                Ok((place, result)) => {
                    early.insert(place, result);
                    let mut go_on = true;
                    while let Some(result) = early.remove(&next).filter(|_| go_on) {
                        next += 1;
                        go_on = take(Step::Done(result));
                    }
                    gate.open(next);
                    go_on
                }
                Err(RecvTimeoutError::Timeout) => take(Step::Tick),
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            };
            if !go_on {
                gate.close();
                // What is being sent finds nobody.
                drop(hear);
                return Ok(());
            }
        }
    })
}

/// Lets nothing begin that would have to wait for long.
#[derive(Default)]
struct Gate {
    /// How many results were taken; `None` once no more are.
    taken: Mutex<Taken>,
    moved: Condvar,
}

#[derive(Clone, Copy, Default)]
struct Taken {
    count: usize,
    closed: bool,
}

impl Gate {
    /// Waits until the item at this place is near enough to the one that is to be taken next. Whether it is to be done.
    fn pass(&self, place: usize, ahead: usize) -> bool {
        let taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        let far = |taken: &mut Taken| !taken.closed && place >= taken.count + ahead;
        !self.moved.wait_while(taken, far).unwrap_or_else(PoisonError::into_inner).closed
    }

    fn open(&self, count: usize) {
        self.taken.lock().unwrap_or_else(PoisonError::into_inner).count = count;
        self.moved.notify_all();
    }

    fn close(&self) {
        self.taken.lock().unwrap_or_else(PoisonError::into_inner).closed = true;
        self.moved.notify_all();
    }
}

/// Closes a gate when it is dropped.
struct Closing<'a>(&'a Gate);

impl Drop for Closing<'_> {
    fn drop(&mut self) {
        self.0.close();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn results_come_in_order_however_long_each_takes() {
        let mut taken = Vec::new();
        let work = |n: u64| {
            thread::sleep(Duration::from_millis(if n.is_multiple_of(7) { 20 } else { n % 3 }));
            n
        };
        for threads in [None, NonZeroUsize::new(1), NonZeroUsize::new(5)] {
            taken.clear();
            let take = |step| {
                if let Step::Done(n) = step {
                    taken.push(n);
                }
                true
            };
            each(threads, (0..100).collect(), work, take).expect("there are threads");
            assert_eq!(taken, (0..100).collect::<Vec<_>>());
        }
    }

    #[test]
    fn no_more_results_wait_than_the_cores_are_for() {
        let (begun, threads) = (AtomicUsize::new(0), 3);
        let limit = threads * (WAITING + 2);
        let work = |n: usize| {
            if n == 0 {
                thread::sleep(Duration::from_millis(200));
            }
            begun.fetch_add(1, Ordering::Relaxed);
        };
        let mut first = true;
        let take = |step| {
            if step == Step::Done(()) && std::mem::take(&mut first) {
                let begun = begun.load(Ordering::Relaxed);
                assert!(begun <= limit, "{begun}");
            }
            true
        };
        each(NonZeroUsize::new(threads), (0..10_000).collect(), work, take).expect("there are threads");
        assert_eq!(begun.into_inner(), 10_000);
    }

    #[test]
    fn what_is_not_wanted_any_more_is_not_begun() {
        let begun = AtomicUsize::new(0);
        let work = |_: u32| begun.fetch_add(1, Ordering::Relaxed);
        each(None, (0..100_000).collect(), work, |step| step == Step::Tick).expect("there are threads");
        assert!(begun.into_inner() < 1000);
    }

    #[test]
    fn of_nothing_nothing_comes() {
        let take = |step| step == Step::Tick || panic!("{step:?}");
        each(None, Vec::<u8>::new(), |n| n, take).expect("there are threads");
    }

    #[test]
    fn no_more_is_done_at_once_than_there_are_threads() {
        let (now, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let work = |_: u32| {
            most.fetch_max(now.fetch_add(1, Ordering::Relaxed) + 1, Ordering::Relaxed);
            thread::sleep(Duration::from_millis(5));
            now.fetch_sub(1, Ordering::Relaxed);
        };
        each(NonZeroUsize::new(3), (0..30).collect(), work, |_| true).expect("there are threads");
        assert_eq!(most.into_inner(), 3);
    }

    #[test]
    fn what_came_is_taken_by_the_thread_that_asked() {
        let here = thread::current().id();
        let take = |_| {
            assert_eq!(thread::current().id(), here);
            true
        };
        each(None, (0..10).collect(), |_: u32| thread::current().id() != here, take)
            .expect("there are threads");
    }

    #[test]
    fn what_it_panics_with_comes_through() {
        let each = || each(None, (0..10_000).collect(), |n: u32| n, |_| panic!("on purpose"));
        assert!(std::panic::catch_unwind(each).is_err());
    }
}
