use glassbrick_shaders::{DrawArgs, SLAB_SLICES, SlicedBrick};
use glassbrick_volume::{PixelRect, PlannedBrick};

/// Queries of a set, at most.
pub const MOST_QUERIES: usize = 4096;

/// Queries whose results are resolved together begin at multiples of this: results are 8 bytes, and their place in a
/// buffer is a multiple of 256.
const QUERY_ALIGNMENT: usize = 32;

/// Corners of the two triangles that are drawn of a slab of slices.
pub const SLAB_CORNERS: u32 = 6;

/// A brick, or a part of one, that is drawn or asked about.
#[derive(Clone, Copy)]
pub struct RoundBrick {
    pub planned: PlannedBrick,
    pub sliced: SlicedBrick,
    pub slices: u32,
    pub texture: u32,
}

impl RoundBrick {
    /// Slabs in which its slices are drawn.
    pub fn slabs(&self) -> u32 {
        self.slices.div_ceil(SLAB_SLICES)
    }
}

/// Bricks whose visibility is found at one time: those of a layer.
pub struct Group {
    /// Places in the round's bricks.
    pub first: usize,
    pub count: usize,
    /// Number of the first one's query and draw.
    pub first_query: usize,
    /// The pixels of the picture that they can meet.
    pub rect: PixelRect,
}

/// How many bricks, group by group of these sizes and drawn in so many parts each, one round takes; as many queries again
/// are left to ask about others.
pub fn most_bricks(groups: impl IntoIterator<Item = usize>, parts: usize) -> usize {
    let (mut queries, mut bricks) = (0usize, 0);
    for group in groups {
        let room = (MOST_QUERIES / 2).saturating_sub(queries) / parts;
        bricks += group.min(room);
        if group >= room {
            break;
        }
        queries = (queries + group * parts).next_multiple_of(QUERY_ALIGNMENT);
    }
    bricks
}

/// One submission as data: what is drawn group by group, and what is asked about at its end.
#[derive(Default)]
pub struct SliceRound {
    pub bricks: Vec<RoundBrick>,
    pub groups: Vec<Group>,
    queries: usize,
}

impl SliceRound {
    /// Adds bricks that no ray meets two of, or parts of them, each brick's farthest first.
    pub fn add(&mut self, bricks: impl IntoIterator<Item = RoundBrick>) {
        let first = self.bricks.len();
        self.bricks.extend(bricks);
        let count = self.bricks.len() - first;
        if count > 0 {
            let rect =
                self.bricks[first..].iter().map(|brick| brick.planned.footprint).reduce(PixelRect::union);
            let rect = rect.expect("there is a brick");
            self.groups.push(Group { first, count, first_query: self.queries, rect });
            self.queries = (self.queries + count).next_multiple_of(QUERY_ALIGNMENT);
        }
    }

    /// Numbers of queries, with the gaps between groups.
    pub fn queries(&self) -> usize {
        self.queries
    }

    /// The query of each brick.
    pub fn query_numbers(&self) -> impl Iterator<Item = usize> {
        self.groups.iter().flat_map(|group| group.first_query..group.first_query + group.count)
    }

    /// The draws of all bricks by query number, as if each were visible.
    pub fn draws(&self) -> Vec<DrawArgs> {
        let draw = |instance_count| DrawArgs {
            vertex_count: SLAB_CORNERS,
            instance_count,
            first_vertex: 0,
            first_instance: 0,
        };
        let mut draws = vec![draw(0); self.queries];
        for (query, brick) in self.query_numbers().zip(&self.bricks) {
            draws[query] = draw(brick.slabs());
        }
        draws
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    fn brick(index: u32) -> RoundBrick {
        let footprint = PixelRect { min: [0, 0], max: [1, 1] };
        let planned = PlannedBrick { index, footprint };
        RoundBrick { planned, sliced: SlicedBrick::zeroed(), slices: index, texture: 0 }
    }

    #[test]
    fn groups_begin_where_their_results_can_be_resolved() {
        let mut round = SliceRound::default();
        round.add((1..4).map(brick));
        round.add([]);
        round.add((4..40).map(brick));
        assert_eq!(round.groups.len(), 2);
        assert_eq!(round.queries(), 32 + 64);
        let draws = round.draws();
        for (query, brick) in round.query_numbers().zip(&round.bricks) {
            assert_eq!(draws[query].instance_count, brick.slabs());
        }
        assert_eq!(draws[3].instance_count, 0, "gaps draw nothing");
    }

    #[test]
    fn a_round_leaves_half_the_queries_to_ask_about_others() {
        assert_eq!(most_bricks([3, 36, 5], 1), 44);
        assert_eq!(most_bricks([MOST_QUERIES], 8), MOST_QUERIES / 16);
        assert_eq!(most_bricks([MOST_QUERIES], 1), MOST_QUERIES / 2);
        assert_eq!(most_bricks(vec![1; MOST_QUERIES], 1), MOST_QUERIES / 2 / QUERY_ALIGNMENT);
        assert_eq!(most_bricks([], 1), 0);
    }
}
