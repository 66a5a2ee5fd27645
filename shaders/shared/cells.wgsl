#define_import_path glassbrick::cells
#import glassbrick::frame::frame
#import glassbrick::rays::Ray

// Cells of 8x8x8 voxels of the bricks in the slots. DVR: a byte, how far the cell is from one that shows something, in
// cells along the farthest axis. Projections: two bytes, the rank of its best value in 65535ths, rounded up.
@group(0) @binding(8) var<storage, read> cells: array<u32>;

// Voxels along an axis of a cell.
const CELL_EDGE: f32 = 8.0;
// Boxes are left this early, in voxels, so that rounding never leaps over a sample behind them.
const EARLY: f32 = 1e-3;
// And as much of a position, which is rounded the coarser the larger it is.
const EARLY_OF_POSITION: f32 = 3e-7;

// What is known of a cell of a slot's brick.
fn cell_answer(slot: u32, cell: vec3u) -> u32 {
    let place = (cell.z * frame.cell_edge + cell.y) * frame.cell_edge + cell.x;
    let byte = place * frame.cell_bytes;
    let bits = 8u * frame.cell_bytes;
    return extractBits(cells[slot * frame.cell_words + byte / 4u], byte % 4u * 8u, bits);
}

// The first sample after `number` that may lie outside the box [low, high). `at` is where sample `number` is, from the
// same origin.
fn behind_box(ray: Ray, at: vec3f, number: u32, low: vec3f, high: vec3f) -> u32 {
    let early = EARLY + abs(at) * EARLY_OF_POSITION;
    let bound = select(low + early, high - early, ray.step > vec3f(0.0));
    let apart = select(vec3f(1e6), (bound - at) / ray.step, ray.step != vec3f(0.0));
    return number + u32(max(ceil(min(apart.x, min(apart.y, apart.z))), 1.0));
}
