use proptest::prelude::*;

use super::*;

fn brick(x: u32) -> BrickId {
    BrickId { level: 0, x, y: 0, z: 0 }
}

fn bricks(xs: impl IntoIterator<Item = u32>) -> Vec<BrickId> {
    xs.into_iter().map(brick).collect()
}

fn loaded(brick: BrickId) -> Loaded {
    Loaded { brick, voxels: Err("not read".into()) }
}

/// Begins and takes one brick.
fn next(queue: &mut LoadQueue) -> Option<Begun> {
    let begun = queue.begin()?;
    queue.finish(loaded(begun.brick));
    queue.take();
    Some(begun)
}

#[test]
fn loading_and_loaded_bricks_are_never_more_than_may_be_untaken() {
    let mut queue = LoadQueue::new(2);
    queue.request(Priority::NeededNow, &bricks(0..5));
    assert!(queue.begin().is_some() && queue.begin().is_some());
    assert_eq!(queue.begin(), None, "two are loading");
    queue.finish(loaded(brick(1)));
    assert_eq!(queue.begin(), None, "one is loading and one loaded");
    assert_eq!(queue.take().map(|loaded| loaded.brick), Some(brick(1)));
    assert_eq!(queue.begin().map(|begun| begun.brick), Some(brick(2)));
    assert!(LoadQueue::new(0).most_untaken > 0, "none would mean that nothing is ever loaded");
}

#[test]
fn a_brick_queued_twice_is_still_loaded_when_the_higher_request_is_withdrawn() {
    let mut queue = LoadQueue::new(1);
    queue.request(Priority::Boundary, &bricks([0, 1]));
    queue.request(Priority::NeededNow, &bricks([1]));
    queue.request(Priority::NeededNow, &[]);
    let order: Vec<BrickId> = std::iter::from_fn(|| next(&mut queue)).map(|begun| begun.brick).collect();
    assert_eq!(order, bricks([0, 1]));
    assert!(queue.is_idle());
}

#[test]
fn the_source_is_told_of_a_few_bricks_ahead_across_priorities() {
    let mut queue = LoadQueue::new(1);
    queue.request(Priority::NeededNow, &bricks([0, 1]));
    queue.request(Priority::Boundary, &bricks(10..40));
    let first = next(&mut queue).expect("some are queued");
    assert_eq!(first.brick, brick(0));
    assert_eq!(first.coming, bricks([1].into_iter().chain(10..10 + READ_AHEAD as u32 - 1)));
    let second = next(&mut queue).expect("some are queued");
    assert_eq!(second.coming, bricks([10 + READ_AHEAD as u32 - 1]), "each is told once");
}

#[derive(Clone, Debug)]
enum Deed {
    Request(Priority, Vec<u32>),
    Begin,
    Finish(usize),
    Take,
}

fn deed() -> impl Strategy<Value = Deed> {
    let priority =
        proptest::sample::select(vec![Priority::NeededNow, Priority::NextLayers, Priority::Boundary]);
    prop_oneof![
        (priority, proptest::collection::vec(0..12u32, 0..8)).prop_map(|(at, xs)| Deed::Request(at, xs)),
        Just(Deed::Begin),
        any::<usize>().prop_map(Deed::Finish),
        Just(Deed::Take),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_is_done_bricks_are_loaded_once_in_order_and_within_bounds(
        most_untaken in 1..5usize,
        deeds in proptest::collection::vec(deed(), 0..200),
    ) {
        let mut queue = LoadQueue::new(most_untaken);
        let mut queued: [Vec<BrickId>; 3] = Default::default();
        let (mut loading, mut finished) = (Vec::new(), VecDeque::new());
        for deed in deeds {
            match deed {
                Deed::Request(priority, xs) => {
                    queue.request(priority, &bricks(xs.clone()));
                    let is_new = |brick: &BrickId| !loading.contains(brick) && !finished.contains(brick);
                    queued[priority as usize] = bricks(xs).into_iter().filter(is_new).collect();
                }
                Deed::Begin => {
                    let first = queued.concat().first().copied();
                    let expected = first.filter(|_| loading.len() + finished.len() < most_untaken);
                    prop_assert_eq!(queue.begin().map(|begun| begun.brick), expected);
                    if let Some(brick) = expected {
                        queued.iter_mut().for_each(|queued| queued.retain(|&other| other != brick));
                        loading.push(brick);
                    }
                }
                Deed::Finish(which) => {
                    if !loading.is_empty() {
                        let brick = loading.swap_remove(which % loading.len());
                        queue.finish(loaded(brick));
                        finished.push_back(brick);
                    }
                }
                Deed::Take => {
                    prop_assert_eq!(queue.take().map(|loaded| loaded.brick), finished.pop_front());
                }
            }
            prop_assert_eq!(queue.is_idle(), queued.concat().is_empty() && loading.is_empty());
        }
    }
}
