use glam::UVec3;
use glassbrick_residency::{MISSING, NOT_PLANNED, PageTable, SlotId, WorkingSet, next_round};
use glassbrick_volume::{BrickGrid, BrickId, BrickLayout};

use crate::{brick, bricks};

/// A row of six bricks.
fn grid() -> BrickGrid {
    BrickLayout { edge: 8, halo: 2 }.grid(UVec3::new(24, 4, 4))
}

#[test]
fn entries_tell_what_is_planned_and_where_it_is() {
    let mut set = WorkingSet::new(8);
    next_round(&mut set, &bricks([5, 4, 1]), usize::MAX);
    let table = PageTable::new(0, grid(), [1, 2, 5], &set);
    assert_eq!(table.entries(), [NOT_PLANNED + 1, 2, MISSING, NOT_PLANNED + 1, NOT_PLANNED + 1, 0]);
}

#[test]
fn a_round_is_followed_and_only_what_it_changed_is_dirty() {
    let mut set = WorkingSet::new(2);
    let mut table = PageTable::new(0, grid(), 0..6, &set);
    assert_eq!(table.take_dirty(), Some(0..6));
    assert_eq!(table.take_dirty(), None);
    table.follow(&next_round(&mut set, &bricks([1, 3]), usize::MAX).loads);
    assert_eq!(table.entries(), [MISSING, 0, MISSING, 1, MISSING, MISSING]);
    assert_eq!(table.take_dirty(), Some(1..4));
    table.follow(&next_round(&mut set, &[brick(2)], usize::MAX).loads);
    assert_eq!(table.entries(), [MISSING, MISSING, 0, 1, MISSING, MISSING]);
    assert_eq!(table.take_dirty(), Some(1..3));
    table.set_resident(brick(3), SlotId(1));
    assert_eq!(table.take_dirty(), None, "it was there");
}

#[test]
fn bricks_that_are_not_planned_or_of_another_level_or_grid_change_nothing() {
    let mut table = PageTable::new(1, grid(), [0], &WorkingSet::new(2));
    table.take_dirty();
    for stranger in [
        BrickId { level: 1, x: 1, y: 0, z: 0 },
        brick(0),
        BrickId { level: 1, x: 6, y: 0, z: 0 },
        BrickId { level: 1, x: 0, y: 0, z: u32::MAX },
    ] {
        table.set_resident(stranger, SlotId(0));
        table.set_missing(stranger);
    }
    assert_eq!(table.take_dirty(), None);
    assert_eq!(table.entries()[..3], [MISSING, NOT_PLANNED + 1, NOT_PLANNED + 2]);
}

#[test]
fn another_plan_changes_only_what_differs() {
    let mut set = WorkingSet::new(2);
    set.admit(brick(3));
    let mut table = PageTable::new(0, grid(), [0, 1, 5], &set);
    table.take_dirty();
    table.plan([0, 3, 5], &set);
    assert_eq!(table.entries(), [MISSING, NOT_PLANNED + 1, NOT_PLANNED + 1, 0, NOT_PLANNED + 1, MISSING]);
    assert_eq!(table.take_dirty(), Some(1..4));
    table.plan([0, 3, 5], &set);
    assert_eq!(table.take_dirty(), None);
}

#[test]
fn a_brick_that_is_left_out_is_leapt_over() {
    let mut table = PageTable::new(0, grid(), 0..6, &WorkingSet::new(2));
    table.leave_out(brick(2));
    assert_eq!(table.entries()[1..4], [MISSING, NOT_PLANNED + 1, MISSING]);
}
