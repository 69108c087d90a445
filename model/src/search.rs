//! A search for all that can be reached, by many at once.
//!
//! Who reaches a state is a set of members, a bit each, and a state is looked at again for those alone that had not been there.
//! A batch of states is looked at, and then all that comes next is looked up at once: a table of millions of states is
//! in no cache, and the memory answers several questions in the time of one.

use std::collections::{HashMap, VecDeque};
use std::hash::Hash;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

use ahash::RandomState;

/// How many members there are at most: a bit for each.
pub const MEMBERS: usize = u64::BITS as usize;

/// How many states are looked at before what comes next is looked up.
const BATCH: usize = 1024;

/// A state, and those who have come to it.
pub(crate) type Visit<S> = (S, u64);

/// What a search has come to; members count each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Searched {
    /// How many different states were reached.
    pub(crate) states: u64,
    /// How many times one was reached.
    pub(crate) reached: u64,
    /// Whether each of them was looked at.
    pub(crate) complete: bool,
}

/// Searches from these states with this many threads. `look` gets a state, and who comes to it for the first time, and names what
/// comes next.
pub(crate) fn search<S: Hash + Send>(
    begin: impl IntoIterator<Item = Visit<S>>,
    threads: usize,
    look: impl Fn(&S, u64, &mut Arrivals<S>) + Sync,
) -> Searched {
    let search = Search {
        visited: Visited::default(),
        queue: Mutex::new(Queue { batches: VecDeque::new(), working: 0 }),
        changed: Condvar::new(),
        looked_at: AtomicU64::new(0),
        reached: AtomicU64::new(0),
        threads: threads.max(1),
        look,
    };
    let mut arrivals = Arrivals::default();
    for (state, members) in begin {
        arrivals.add(state, members);
    }
    let first = search.take_in(&mut arrivals);
    search.queue(&mut search.lock(), first);
    if search.threads == 1 {
        search.work();
    } else {
        thread::scope(|scope| {
            for _ in 0..search.threads {
                scope.spawn(|| search.work());
            }
        });
    }
    let states = search.visited.states();
    Searched {
        states,
        reached: search.reached.into_inner(),
        complete: search.looked_at.into_inner() == states,
    }
}

struct Search<S, L> {
    visited: Visited,
    queue: Mutex<Queue<S>>,
    /// There is more to do, or nothing more to come.
    changed: Condvar,
    looked_at: AtomicU64,
    reached: AtomicU64,
    threads: usize,
    look: L,
}

struct Queue<S> {
    /// What is to be looked at; what was found first is the first.
    batches: VecDeque<Vec<Visit<S>>>,
    /// How many threads look at a batch, from which more may come.
    working: usize,
}

impl<S: Hash, L: Fn(&S, u64, &mut Arrivals<S>)> Search<S, L> {
    /// Until nothing is left to look at.
    fn work(&self) {
        let mut arrivals = Arrivals::default();
        let mut queue = self.lock();
        loop {
            if let Some(batch) = queue.batches.pop_front() {
                queue.working += 1;
                drop(queue);
                let working = Working { queue: &self.queue, changed: &self.changed };
                for (state, members) in &batch {
                    (self.look)(state, *members, &mut arrivals);
                }
                self.looked_at.fetch_add(count(&batch), Ordering::Relaxed);
                let next = self.take_in(&mut arrivals);
                queue = self.lock();
                self.queue(&mut queue, next);
                drop(queue);
                drop(working);
                queue = self.lock();
            } else if queue.working == 0 {
                return;
            } else {
                queue = self.changed.wait(queue).unwrap_or_else(PoisonError::into_inner);
            }
        }
    }

    fn take_in(&self, arrivals: &mut Arrivals<S>) -> Vec<Visit<S>> {
        self.reached.fetch_add(count(&arrivals.visits), Ordering::Relaxed);
        self.visited.take_in(arrivals)
    }

    /// Puts visits at the end, in batches: where threads have nothing to do, in smaller ones.
    fn queue(&self, queue: &mut Queue<S>, mut visits: Vec<Visit<S>>) {
        /// Fewer are not worth being handed over.
        const FEW: usize = 16;
        if visits.is_empty() {
            return;
        }
        let share = if queue.batches.is_empty() { visits.len().div_ceil(self.threads) } else { BATCH };
        let share = share.clamp(FEW, BATCH);
        while visits.len() > share {
            let rest = visits.split_off(share);
            queue.batches.push_back(visits);
            visits = rest;
        }
        queue.batches.push_back(visits);
    }

    fn lock(&self) -> MutexGuard<'_, Queue<S>> {
        locked(&self.queue)
    }
}

/// What a panic elsewhere left behind is whole: batches and members are only ever added.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A thread that looks at a batch; no more once this goes, also where a look panics, for the others wait for it.
struct Working<'a, S> {
    queue: &'a Mutex<Queue<S>>,
    changed: &'a Condvar,
}

impl<S> Drop for Working<'_, S> {
    fn drop(&mut self) {
        locked(self.queue).working -= 1;
        self.changed.notify_all();
    }
}

fn count<S>(visits: &[Visit<S>]) -> u64 {
    visits.iter().map(|(_, members)| u64::from(members.count_ones())).sum()
}

/// Members that have come to states, which have not been looked up yet.
pub(crate) struct Arrivals<S> {
    visits: Vec<Visit<S>>,
    /// By the shard that knows them, their hashes and their places among the visits.
    by_shard: Vec<Vec<(u64, usize)>>,
    hasher: RandomState,
}

impl<S> Default for Arrivals<S> {
    fn default() -> Self {
        // The same in every run, and in every thread.
        let hasher = RandomState::with_seeds(1, 2, 3, 4);
        Self { visits: Vec::new(), by_shard: vec![Vec::new(); SHARDS], hasher }
    }
}

impl<S: Hash> Arrivals<S> {
    /// These members come to a state.
    pub(crate) fn add(&mut self, state: S, members: u64) {
        let hash = self.hasher.hash_one(&state);
        let shard = usize::try_from(hash % SHARDS as u64).unwrap_or_default();
        if let Some(shard) = self.by_shard.get_mut(shard) {
            shard.push((hash, self.visits.len()));
            self.visits.push((state, members));
        }
    }
}

/// So many that threads seldom wait for one another.
const SHARDS: usize = 64;

/// Which members have come to which state. States are told apart by their hashes alone, as stateright does.
struct Visited {
    shards: Vec<Mutex<HashMap<u64, u64, RandomState>>>,
}

impl Default for Visited {
    fn default() -> Self {
        Self { shards: (0..SHARDS).map(|_| Mutex::default()).collect() }
    }
}

impl Visited {
    /// Takes in who has arrived, and has the visits of those that had not been there.
    fn take_in<S>(&self, arrivals: &mut Arrivals<S>) -> Vec<Visit<S>> {
        let Arrivals { visits, by_shard, .. } = arrivals;
        for (shard, arrived) in self.shards.iter().zip(by_shard).filter(|(_, arrived)| !arrived.is_empty()) {
            let mut shard = locked(shard);
            // One after the other, and little else between two questions: the memory answers several at once.
            for (hash, place) in arrived.drain(..) {
                let Some((_, members)) = visits.get_mut(place) else { continue };
                let before = shard.entry(hash).or_insert(0);
                let new = *members & !*before;
                *before |= new;
                *members = new;
            }
        }
        visits.drain(..).filter(|(_, new)| *new != 0).collect()
    }

    /// In how many states members have been.
    fn states(&self) -> u64 {
        let of_shard = |shard: &Mutex<HashMap<u64, u64, RandomState>>| {
            locked(shard).values().map(|members| u64::from(members.count_ones())).sum::<u64>()
        };
        self.shards.iter().map(of_shard).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers below a limit, of which each leads to its double and to one more, for the members that may.
    fn doubling(threads: usize, limit: u64, may: impl Fn(u64) -> u64 + Sync) -> Searched {
        search([(1_u64, 0b11)], threads, |&number, members, arrivals| {
            for next in [2 * number, 2 * number + 1].into_iter().filter(|next| *next < limit) {
                let members = members & may(next);
                if members != 0 {
                    arrivals.add(next, members);
                }
            }
        })
    }

    #[test]
    fn each_state_is_reached_by_whom_it_can_be_with_any_number_of_threads() {
        let all = |states, reached| Searched { states, reached, complete: true };
        for threads in [0, 1, 2, 7] {
            assert_eq!(doubling(threads, 100_000, |_| 0b11), all(2 * 99_999, 2 * 99_999));
            // One of the two goes to even numbers alone: the powers of two.
            let found = doubling(threads, 1024, |number| if number % 2 == 0 { 0b11 } else { 0b10 });
            assert_eq!(found, all(1023 + 10, 1023 + 10));
        }
    }

    /// A ring, into which the second member comes later: it goes round again, and the first does not.
    #[test]
    fn who_comes_later_goes_on_alone() {
        let looks = Mutex::new(Vec::new());
        let found = search([(0_u64, 0b01), (100, 0b10)], 1, |&place, members, arrivals| {
            locked(&looks).push((place, members));
            arrivals.add(if place == 100 { 2 } else { (place + 1) % 4 }, members);
        });
        assert_eq!(found, Searched { states: 4 + 5, reached: 2 + 4 + 5, complete: true });
        let mut looks = locked(&looks).clone();
        looks.sort_unstable();
        assert_eq!(looks, [(0, 1), (0, 2), (1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (3, 2), (100, 2)]);
    }

    #[test]
    #[should_panic(expected = "a scoped thread panicked")]
    fn a_look_that_panics_ends_the_search() {
        search([(1_u64, 1)], 2, |&number, members, arrivals| {
            assert!(number < 500, "so far and no further");
            for next in [2 * number, 2 * number + 1] {
                arrivals.add(next, members);
            }
        });
    }
}
