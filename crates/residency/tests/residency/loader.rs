use std::sync::{Arc, mpsc};
use std::thread;
use std::time::Duration;

use glassbrick_residency::{Loader, Priority};
use glassbrick_volume::{BrickId, Voxels};

use crate::fake_source::{DAMAGED, FakeSource, PANICS};
use crate::{brick, bricks};

/// Fails where `test` hangs.
fn in_time<T: Send + 'static>(test: impl FnOnce() -> T + Send + 'static) -> T {
    let (send, receive) = mpsc::channel();
    let running = thread::spawn(move || send.send(test()));
    match receive.recv_timeout(Duration::from_secs(60)) {
        Err(mpsc::RecvTimeoutError::Timeout) => panic!("it hangs"),
        Err(mpsc::RecvTimeoutError::Disconnected) => match running.join() {
            Err(panic) => std::panic::resume_unwind(panic),
            Ok(_) => unreachable!("it sends before it ends"),
        },
        Ok(value) => value,
    }
}

fn loader(source: &Arc<FakeSource>, threads: usize, most_untaken: usize) -> Loader {
    Loader::new(Arc::<FakeSource>::clone(source), threads, most_untaken).expect("the system has threads")
}

/// All bricks that come, in the order in which they do.
fn all(loader: &Loader) -> Vec<BrickId> {
    std::iter::from_fn(|| loader.wait()).map(|loaded| loaded.brick).collect()
}

#[test]
fn bricks_come_by_priority_and_then_in_the_order_in_which_they_were_asked_for() {
    in_time(|| {
        let source = FakeSource::closed();
        let loader = loader(&source, 1, 2);
        loader.request(Priority::Boundary, &bricks([0]));
        source.wait_until_begun(1);
        loader.request(Priority::Boundary, &bricks([1, 2]));
        loader.request(Priority::NextLayers, &bricks([4, 3]));
        loader.request(Priority::NeededNow, &bricks([6, 5]));
        source.let_through();
        assert_eq!(all(&loader), bricks([0, 6, 5, 4, 3, 1, 2]));
    });
}

#[test]
fn a_brick_that_is_queued_under_way_or_untaken_is_not_loaded_twice() {
    in_time(|| {
        let source = FakeSource::closed();
        let loader = loader(&source, 1, 2);
        let ask_again = || {
            loader.request(Priority::NeededNow, &bricks([0, 1, 1]));
            loader.request(Priority::NextLayers, &bricks([1, 0]));
            loader.request(Priority::Boundary, &bricks([2, 1]));
        };
        ask_again();
        source.wait_until_begun(1);
        ask_again();
        source.let_through();
        source.wait_until_begun(2);
        ask_again();
        assert_eq!(all(&loader), bricks([0, 1, 2]));
        assert_eq!(source.begun(), bricks([0, 1, 2]));
        loader.request(Priority::NeededNow, &bricks([1]));
        assert_eq!(all(&loader), bricks([1]), "once it is taken it may be asked for again");
    });
}

#[test]
fn a_request_takes_the_place_of_the_one_before_at_its_priority() {
    in_time(|| {
        let source = FakeSource::closed();
        let loader = loader(&source, 1, 2);
        loader.request(Priority::NeededNow, &bricks([0, 1, 2]));
        loader.request(Priority::Boundary, &bricks([2, 3]));
        source.wait_until_begun(1);
        loader.request(Priority::NeededNow, &bricks([4]));
        source.let_through();
        assert_eq!(all(&loader), bricks([0, 4, 2, 3]));
    });
}

#[test]
fn no_more_bricks_are_read_than_may_be_untaken() {
    in_time(|| {
        let source = FakeSource::open();
        let loader = loader(&source, 4, 3);
        loader.request(Priority::NeededNow, &bricks(0..50));
        source.wait_until_begun(3);
        thread::sleep(Duration::from_millis(50));
        assert_eq!(source.begun().len(), 3);
        assert!(loader.take().is_some());
        source.wait_until_begun(4);
        thread::sleep(Duration::from_millis(50));
        assert_eq!(source.begun().len(), 4);
        assert_eq!(all(&loader).len(), 49);
    });
}

#[test]
fn all_threads_load_at_once() {
    in_time(|| {
        let source = FakeSource::closed();
        let loader = loader(&source, 4, 8);
        loader.request(Priority::NeededNow, &bricks(0..9));
        source.wait_until_begun(4);
        source.let_through();
        let mut came = all(&loader);
        came.sort();
        assert_eq!(came, bricks(0..9));
    });
}

#[test]
fn taking_does_not_wait_and_waiting_for_nothing_ends() {
    in_time(|| {
        let source = FakeSource::closed();
        let loader = loader(&source, 1, 1);
        assert!(loader.take().is_none() && loader.wait().is_none());
        loader.request(Priority::NeededNow, &bricks([0]));
        source.wait_until_begun(1);
        assert!(loader.take().is_none());
        source.let_through();
        let loaded = loader.wait().expect("it is under way");
        assert_eq!(loaded.brick, brick(0));
        assert!(matches!(&loaded.voxels.unwrap().voxels, Voxels::U16(voxels) if voxels[0] == 0));
        assert!(loader.take().is_none() && loader.wait().is_none());
    });
}

#[test]
fn a_brick_that_cannot_be_read_gives_an_error_and_those_after_it_come() {
    in_time(|| {
        let source = FakeSource::open();
        let loader = loader(&source, 2, 4);
        loader.request(Priority::NeededNow, &bricks([DAMAGED, PANICS, 1, PANICS + 1]));
        let loaded: Vec<_> = std::iter::from_fn(|| loader.wait()).collect();
        assert_eq!(loaded.len(), 4);
        for loaded in loaded {
            let text = loaded.voxels.err().map(|error| error.to_string());
            let expected = match loaded.brick.x {
                DAMAGED => Some("brick 1000,0,0 of level 0 is damaged"),
                PANICS => Some(
                    "brick 2000,0,0 of level 0: its reader broke off: the reader is at its end; report this as a fault",
                ),
                _ => None,
            };
            assert_eq!(text.as_deref(), expected);
        }
    });
}

#[test]
fn a_reader_that_panics_again_and_again_hangs_nobody() {
    in_time(|| {
        let source = FakeSource::open();
        let loader = loader(&source, 2, 2);
        for _ in 0..10 {
            loader.request(Priority::NeededNow, &bricks([PANICS]));
            assert!(loader.wait().expect("it was asked for").voxels.is_err());
        }
    });
}

#[test]
fn dropping_the_loader_ends_its_threads_and_reads_no_more() {
    in_time(|| {
        let source = FakeSource::closed();
        let loader = loader(&source, 2, 8);
        loader.request(Priority::NeededNow, &bricks(0..100));
        source.wait_until_begun(2);
        let dropping = thread::spawn(move || drop(loader));
        thread::sleep(Duration::from_millis(50));
        source.let_through();
        dropping.join().unwrap();
        assert_eq!(source.begun().len(), 2);
        assert_eq!(Arc::strong_count(&source), 1, "no thread is left");
    });
}

#[test]
fn dropping_a_loader_that_has_nothing_to_do_or_nowhere_to_put_it_does_not_hang() {
    in_time(|| {
        let source = FakeSource::open();
        drop(loader(&source, 3, 2));
        let full = loader(&source, 3, 2);
        full.request(Priority::Boundary, &bricks(0..10));
        source.wait_until_begun(2);
        drop(full);
        assert_eq!(Arc::strong_count(&source), 1);
    });
}

#[test]
fn queued_bricks_are_hinted_at_once_each_and_none_that_is_not_wanted() {
    in_time(|| {
        let source = FakeSource::closed();
        let loader = loader(&source, 1, 4);
        loader.request(Priority::NeededNow, &bricks(0..200));
        source.wait_until_begun(1);
        let first = source.told();
        assert!(first.len() > 1 && first.len() < 100, "some ahead, and not all: {}", first.len());
        source.let_through();
        assert_eq!(all(&loader).len(), 200);
        assert_eq!(source.told(), bricks(1..200));
    });
}
