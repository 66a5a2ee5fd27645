//! Frames in order along the normal, and the time steps of a volume that has several frames at one position.

use std::collections::HashMap;

use super::byte_stream::Parsed;
use super::candidate::{Slice, same_grid};
use super::frame_info::Orientation;
use super::image::Image;
use super::step_attribute::{KeyValue, key_names};

/// More stacks than any real file has.
const MAX_STACKS: usize = 64;

/// One time step: its frames in order, and what sets it apart.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub slices: Vec<Slice>,
    pub label: String,
}

/// The time steps that a candidate holds, in order; several stacks of one file follow each other.
pub(super) fn steps(images: &[Image], slices: Vec<Slice>, notes: &mut Vec<String>) -> Parsed<Vec<Step>> {
    let mut stacks: Vec<Vec<Slice>> = Vec::new();
    for slice in slices {
        let fits = |stack: &Vec<Slice>| same_grid(slice.info(images), stack[0].info(images));
        match stacks.iter().position(fits) {
            Some(stack) => stacks[stack].push(slice),
            None if stacks.len() == MAX_STACKS => {
                return Err(format!(
                    "its frames lie in more than {MAX_STACKS} directions and make no volume"
                ));
            }
            None => stacks.push(vec![slice]),
        }
    }
    let several = stacks.len() > 1;
    let mut steps = Vec::new();
    for (index, stack) in stacks.into_iter().enumerate() {
        for mut step in stack_steps(images, stack, notes) {
            if several {
                step.label = format!("stack {} {}", index + 1, step.label).trim_end().to_owned();
            }
            steps.push(step);
        }
    }
    Ok(steps)
}

fn stack_steps(images: &[Image], slices: Vec<Slice>, notes: &mut Vec<String>) -> Vec<Step> {
    let mut positions = by_position(images, slices);
    let doubles = drop_copies(images, &mut positions);
    if doubles > 0 {
        notes.push(format!("files that are copies of others and left out: {doubles}"));
    }
    let most = positions.iter().map(Vec::len).max().unwrap_or(0);
    let shared = positions.iter().filter(|here| here.len() > 1).count();
    if most > 1 && shared * 2 < positions.len() {
        notes.push(format!(
            "at {shared} of {} positions lie several slices, of which the first is read",
            positions.len()
        ));
        positions.iter_mut().for_each(|here| here.truncate(1));
    } else if most > 1 {
        return match splitting_key(images, &positions, most) {
            Some((name, values)) => split_by_key(images, &positions, name, &values),
            None => split_by_rank(&positions, most),
        };
    }
    vec![Step { slices: positions.concat(), label: String::new() }]
}

/// The frames in order along the normal, those of one position together; each a position of its own, as they
/// are numbered, where nothing says how they lie.
fn by_position(images: &[Image], mut slices: Vec<Slice>) -> Vec<Vec<Slice>> {
    let distances = distances_mm(images, &slices);
    slices.sort_by(|one, other| rank(images, *one, *other));
    let Some(distances) = distances else {
        return slices.into_iter().map(|slice| vec![slice]).collect();
    };
    let mut placed: Vec<(f64, Slice)> = slices.into_iter().map(|slice| (distances(slice), slice)).collect();
    placed.sort_by(|one, other| one.0.total_cmp(&other.0));
    let [x, y] = placed[0].1.info(images).pixel_spacing_mm;
    let tolerance_mm = (0.02 * x.min(y)).min(0.01);
    let mut positions: Vec<Vec<Slice>> = Vec::new();
    let mut last = f64::NEG_INFINITY;
    for (distance, slice) in placed {
        match positions.last_mut() {
            Some(here) if distance - last <= tolerance_mm => here.push(slice),
            _ => positions.push(vec![slice]),
        }
        last = distance;
    }
    for here in &mut positions {
        here.sort_by(|one, other| rank(images, *one, *other));
    }
    positions
}

/// How far along the normal a frame lies: by its position, or its location. Nothing where that says nothing.
fn distances_mm<'a>(images: &'a [Image], slices: &[Slice]) -> Option<impl Fn(Slice) -> f64 + 'a> {
    let first = slices.first()?.info(images);
    let normal = first.orientation.unwrap_or(Orientation::AXIAL).normal();
    let located = slices.iter().all(|slice| slice.info(images).location_mm.is_some());
    let differ = slices.iter().any(|slice| slice.info(images).location_mm != first.location_mm);
    let positioned = first.position_mm.is_some();
    (positioned || (located && differ)).then_some(move |slice: Slice| {
        let info = slice.info(images);
        match info.position_mm {
            Some(position) if positioned => position.dot(normal),
            _ => info.location_mm.unwrap_or_default(),
        }
    })
}

/// The order of frames that lie at one position, or have none: as they are numbered, then by the name of
/// their file.
fn rank(images: &[Image], one: Slice, other: Slice) -> std::cmp::Ordering {
    let number = |slice: Slice| slice.info(images).instance_number.unwrap_or(f64::INFINITY);
    let place = |slice: Slice| (&images[slice.image].path, slice.frame);
    number(one).total_cmp(&number(other)).then_with(|| place(one).cmp(&place(other)))
}

/// Leaves out files that are the same image as another at their position; says how many.
fn drop_copies(images: &[Image], positions: &mut [Vec<Slice>]) -> usize {
    let mut dropped = 0;
    for here in positions {
        let mut image_of: HashMap<&str, usize> = HashMap::new();
        here.retain(|slice| {
            let uid = images[slice.image].sop_instance_uid.as_str();
            let original = *image_of.entry(uid).or_insert(slice.image) == slice.image || uid.is_empty();
            dropped += usize::from(!original);
            original
        });
    }
    dropped
}

/// The attribute whose values tell apart the frames of every position, as many values as there are steps.
fn splitting_key<'a>(
    images: &'a [Image],
    positions: &[Vec<Slice>],
    most: usize,
) -> Option<(&'static str, Vec<&'a KeyValue>)> {
    key_names().find_map(|name| {
        let mut all: Vec<&KeyValue> = Vec::new();
        for here in positions {
            let mut own = here.iter().map(|slice| key(images, *slice, name)).collect::<Option<Vec<_>>>()?;
            own.sort_by(|one, other| one.order(other));
            if own.windows(2).any(|pair| pair[0] == pair[1]) {
                return None;
            }
            all.append(&mut own);
        }
        all.sort_by(|one, other| one.order(other));
        all.dedup();
        (all.len() == most).then_some((name, all))
    })
}

fn key<'a>(images: &'a [Image], slice: Slice, name: &str) -> Option<&'a KeyValue> {
    slice.info(images).keys.iter().find(|(key, _)| *key == name).map(|(_, value)| value)
}

fn split_by_key(images: &[Image], positions: &[Vec<Slice>], name: &str, values: &[&KeyValue]) -> Vec<Step> {
    let label = |value: &&KeyValue| Step { slices: Vec::new(), label: format!("{name} {value}") };
    let mut steps: Vec<Step> = values.iter().map(label).collect();
    for slice in positions.iter().flatten() {
        let value = key(images, *slice, name);
        let step = value.and_then(|value| values.binary_search_by(|other| other.order(value)).ok());
        if let Some(step) = step {
            steps[step].slices.push(*slice);
        }
    }
    steps
}

fn split_by_rank(positions: &[Vec<Slice>], most: usize) -> Vec<Step> {
    let step = |rank: usize| {
        let slices = positions.iter().filter_map(|here| here.get(rank).copied()).collect();
        Step { slices, label: "in the order of their numbers".to_owned() }
    };
    (0..most).map(step).collect()
}
