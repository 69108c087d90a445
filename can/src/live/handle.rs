//! A thread that takes one turn after the other, and a handle on it for a screen.

use std::fmt;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};

use crate::car::Action;
use crate::status::Status;

/// Something that takes turns.
pub trait Runner {
    /// One cycle. It lasts until the cycle is over, and never much longer.
    fn turn(&mut self);

    /// What the operator does, before the next turn.
    fn act(&mut self, action: &Action);

    /// How everything stands after the last turn.
    fn status(&self) -> &Status;

    /// Whether no turn is to follow: a scenario has come to its end.
    fn is_over(&self) -> bool {
        false
    }
}

/// A runner in a thread of its own. It is stopped when the handle is dropped.
#[derive(Debug)]
pub struct Handle {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Shared {
    /// Shared, so that nobody waits for a copy to be made while the other has the lock.
    status: Mutex<Arc<Status>>,
    actions: Mutex<Vec<Action>>,
    stop: AtomicBool,
}

/// The thread of a runner ended by a panic, which is a mistake in this program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Panicked;

impl fmt::Display for Panicked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the thread on the bus ended by a mistake in this program; please report it")
    }
}

impl std::error::Error for Panicked {}

impl Handle {
    /// Lets a runner take its turns, until it is stopped. Fails if the system has no thread for it.
    ///
    /// # Errors
    ///
    /// Fails if the system has no thread for it.
    pub fn start(mut runner: impl Runner + Send + 'static) -> io::Result<Self> {
        let shared = Arc::new(Shared {
            status: Mutex::new(Arc::new(runner.status().clone())),
            actions: Mutex::default(),
            stop: AtomicBool::new(false),
        });
        let theirs = Arc::clone(&shared);
        let thread = thread::Builder::new().name("bus".to_owned()).spawn(move || {
            while !theirs.stop.load(Ordering::Acquire) && !runner.is_over() {
                for action in std::mem::take(&mut *lock(&theirs.actions)) {
                    runner.act(&action);
                }
                runner.turn();
                let status = Arc::new(runner.status().clone());
                // The one before is dropped when the lock is free again.
                let _before = std::mem::replace(&mut *lock(&theirs.status), status);
            }
        })?;
        Ok(Self { shared, thread: Some(thread) })
    }

    /// How everything stood after the last turn.
    pub fn status(&self) -> Arc<Status> {
        Arc::clone(&lock(&self.shared.status))
    }

    /// Lets the operator do something, before the next turn.
    pub fn act(&self, action: Action) {
        lock(&self.shared.actions).push(action);
    }

    /// Tells the runner to stop, after the turn that it is in: what that has to send is sent.
    pub fn stop(&self) {
        self.shared.stop.store(true, Ordering::Release);
    }

    /// Whether the runner still takes turns: until it is stopped or over, or ended by a mistake.
    pub fn is_running(&self) -> bool {
        self.thread.as_ref().is_some_and(|thread| !thread.is_finished())
    }

    /// Stops the runner, waits until it has, and tells how everything stood in the end.
    ///
    /// # Errors
    ///
    /// Fails if a panic ended the runner.
    pub fn join(mut self) -> Result<Arc<Status>, Panicked> {
        self.stop();
        if let Some(thread) = self.thread.take() {
            thread.join().map_err(|_| Panicked)?;
        }
        Ok(self.status())
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        self.stop();
        if let Some(thread) = self.thread.take() {
            // Who drops the handle does not ask how it ended.
            let _ = thread.join();
        }
    }
}

/// What a panic elsewhere left behind is still the last that is known.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
