use glassbrick_residency::{Load, Round, SlotId, WorkingSet, next_round};

use crate::{brick, bricks};

#[test]
fn a_round_takes_what_the_slots_hold_and_the_next_one_goes_on() {
    let mut set = WorkingSet::new(2);
    let plan = bricks(0..3);
    let load = |x, slot, evicted: Option<u32>| Load {
        brick: brick(x),
        slot: SlotId(slot),
        evicted: evicted.map(brick),
    };
    let first = next_round(&mut set, &plan, usize::MAX);
    assert_eq!(first, Round { taken: 2, loads: vec![load(0, 0, None), load(1, 1, None)] });
    let second = next_round(&mut set, &plan[2..], usize::MAX);
    assert_eq!(second, Round { taken: 1, loads: vec![load(2, 0, Some(0))] });
    assert_eq!(next_round(&mut set, &[], usize::MAX), Round::default());
}

#[test]
fn a_round_keeps_its_own_bricks_though_their_turn_to_go_has_come() {
    let mut set = WorkingSet::new(3);
    next_round(&mut set, &bricks(0..3), usize::MAX);
    let round = next_round(&mut set, &bricks([7, 0, 1]), usize::MAX);
    assert_eq!(round.taken, 3);
    assert_eq!(round.loads, [Load { brick: brick(7), slot: SlotId(2), evicted: Some(brick(2)) }]);
}

#[test]
fn a_round_loads_no_more_than_allowed_but_takes_resident_bricks_beside() {
    let mut set = WorkingSet::new(8);
    next_round(&mut set, &bricks([1, 3]), usize::MAX);
    let round = next_round(&mut set, &bricks(0..8), 2);
    assert_eq!(round.taken, 4, "0 and 2 are loaded, 1 and 3 are there");
    let round = next_round(&mut set, &bricks(4..8), 0);
    assert_eq!(round.taken, 1, "one is always taken");
}

#[test]
fn with_one_slot_a_plan_is_drawn_brick_by_brick() {
    let mut set = WorkingSet::new(1);
    set.set_pinned(&bricks(0..9));
    for x in (0..9).rev() {
        let round = next_round(&mut set, &bricks((0..=x).rev()), usize::MAX);
        assert_eq!((round.taken, round.loads.len()), (1, 1));
    }
}

#[test]
fn pinned_bricks_of_the_plan_take_no_slot_from_others() {
    let mut set = WorkingSet::new(4);
    next_round(&mut set, &bricks(0..4), usize::MAX);
    set.set_pinned(&bricks([0, 1]));
    assert_eq!(next_round(&mut set, &bricks([10, 11, 12]), usize::MAX).taken, 2);
    assert_eq!(next_round(&mut set, &bricks([12, 13, 0, 1, 14]), usize::MAX).taken, 4);
}

#[test]
fn a_second_frame_finds_what_the_first_one_left() {
    let plan = bricks(0..10);
    let mut set = WorkingSet::new(6);
    let mut loads = |most_loads| {
        set.begin_frame();
        let (mut wanted, mut loads) = (&plan[..], 0);
        while !wanted.is_empty() {
            let round = next_round(&mut set, wanted, most_loads);
            wanted[..round.taken].iter().for_each(|&brick| set.set_drawn(brick));
            wanted = &wanted[round.taken..];
            loads += round.loads.len();
        }
        loads
    };
    assert_eq!(loads(1), 10);
    assert_eq!(loads(1), 5, "in small rounds, drawn bricks make way and the rest stays");
}
