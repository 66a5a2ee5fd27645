use glassbrick_residency::{Admitted, SlotId, WorkingSet, WorkingSetCounts};
use glassbrick_volume::BrickId;

use crate::{brick, bricks};

/// A set in which these bricks were admitted one after the other; none is held.
fn set_with(slots: u32, admitted: impl IntoIterator<Item = u32>) -> WorkingSet {
    let mut set = WorkingSet::new(slots);
    for x in admitted {
        set.admit(brick(x)).expect("a slot is free");
    }
    set.end_round();
    set
}

/// Whether bricks go in this order when others come.
fn assert_evicted(mut set: WorkingSet, order: impl IntoIterator<Item = u32>) {
    for (x, other) in order.into_iter().zip(1000..) {
        assert_eq!(set.admit(brick(other)).expect("one can go").evicted, Some(brick(x)));
    }
    assert_eq!(set.admit(brick(2000)), None, "all are held, or pinned");
}

#[test]
fn free_slots_are_given_from_the_lowest_on_and_before_any_eviction() {
    let mut set = set_with(4, [7, 8]);
    assert_eq!(set.residents().collect::<Vec<_>>(), [(SlotId(0), brick(7)), (SlotId(1), brick(8))]);
    assert_eq!(set.remove(brick(7)), Some(SlotId(0)));
    assert_eq!(set.admit(brick(9)), Some(Admitted { slot: SlotId(0), evicted: None }));
    assert_eq!(set.admit(brick(10)), Some(Admitted { slot: SlotId(2), evicted: None }));
    assert_eq!((set.resident(), set.peak()), (3, 3));
}

#[test]
fn the_least_recently_used_brick_goes_first() {
    let mut set = set_with(3, [0, 1, 2]);
    set.hold(brick(0));
    set.end_round();
    assert_evicted(set, [1, 2, 0]);
}

#[test]
fn bricks_drawn_in_this_frame_go_before_those_it_may_still_need() {
    let mut set = set_with(4, 0..4);
    set.begin_frame();
    set.set_drawn(brick(3));
    set.set_drawn(brick(1));
    assert_evicted(set, [1, 3, 0, 2]);
}

#[test]
fn a_brick_that_is_drawn_while_it_is_held_goes_first_once_it_is_not() {
    let mut set = set_with(2, [0, 1]);
    set.hold(brick(1));
    set.set_drawn(brick(1));
    set.end_round();
    assert_evicted(set, [1, 0]);
}

#[test]
fn a_drawn_brick_that_is_held_again_is_not_drawn() {
    let mut set = set_with(3, 0..3);
    set.set_drawn(brick(0));
    set.hold(brick(0));
    set.end_round();
    assert_evicted(set, [1, 2, 0]);
}

#[test]
fn in_the_next_frame_no_brick_is_drawn() {
    let mut set = set_with(3, 0..3);
    set.set_drawn(brick(2));
    set.begin_frame();
    assert_evicted(set, 0..3);
}

#[test]
fn held_bricks_stay_until_the_round_ends() {
    let mut set = set_with(2, [0, 1]);
    set.hold(brick(0));
    assert_eq!(set.admit(brick(2)).and_then(|admitted| admitted.evicted), Some(brick(1)));
    assert_eq!(set.admit(brick(3)), None);
    set.end_round();
    assert_evicted(set, [0, 2]);
}

#[test]
fn pinned_bricks_stay() {
    let mut set = set_with(4, 0..4);
    assert_eq!(set.set_pinned(&bricks([1, 0])), 2);
    assert_evicted(set.clone(), [2, 3]);
    assert_eq!(set.set_pinned(&bricks([0, 3])), 2);
    assert_evicted(set.clone(), [1, 2]);
    assert_eq!(set.set_pinned(&[]), 0);
    assert_evicted(set, 0..4);
}

#[test]
fn a_brick_that_was_pinned_before_it_came_stays() {
    let mut set = WorkingSet::new(2);
    set.set_pinned(&[brick(5)]);
    set.admit(brick(5));
    set.admit(brick(6));
    set.end_round();
    assert_evicted(set, [6]);
}

#[test]
fn at_most_half_the_slots_are_pinned_and_each_brick_counts_once() {
    let mut set = WorkingSet::new(5);
    assert_eq!(set.set_pinned(&bricks([4, 4, 3, 2, 1])), 2);
    assert_eq!(set.missing_pinned().collect::<Vec<_>>(), bricks([4, 3]));
    set.admit(brick(4));
    assert_eq!(set.missing_pinned().collect::<Vec<_>>(), bricks([3]));
    assert_eq!(WorkingSet::new(1).set_pinned(&[brick(0)]), 0);
}

#[test]
fn a_limit_drops_what_lies_beyond_and_the_pins_that_are_too_many() {
    let mut set = set_with(6, 0..6);
    set.set_pinned(&bricks([5, 0, 1]));
    assert_eq!(set.limit(2), bricks(2..6));
    assert_eq!((set.slots(), set.resident(), set.peak()), (2, 2, 6));
    assert_eq!(set.missing_pinned().collect::<Vec<_>>(), bricks([5]));
    assert_evicted(set.clone(), 0..2);
    assert_eq!(set.limit(100), Vec::<BrickId>::new());
    assert_eq!(set.slots(), 2);
    assert_eq!(set.limit(0), bricks(0..2));
    assert_eq!(set.admit(brick(0)), None);
}

#[test]
fn a_cleared_set_gives_its_slots_anew_and_still_wants_its_pins() {
    let mut set = set_with(3, 0..3);
    set.set_pinned(&[brick(2)]);
    set.hold(brick(1));
    set.clear();
    assert_eq!(set.resident(), 0);
    assert_eq!(set.missing_pinned().collect::<Vec<_>>(), [brick(2)]);
    assert_eq!(set.admit(brick(9)).map(|admitted| admitted.slot), Some(SlotId(0)));
    set.end_round();
    assert_eq!(set.admissible(), 3);
}

#[test]
fn hits_misses_and_evictions_are_counted_since_they_were_asked_for() {
    let mut set = set_with(2, [0, 1]);
    set.hold(brick(0));
    set.hold(brick(9));
    set.admit(brick(2));
    set.admit(brick(3));
    assert_eq!(set.take_counts(), WorkingSetCounts { hits: 1, misses: 3, evictions: 1 });
    assert_eq!(set.take_counts(), WorkingSetCounts::default());
}
