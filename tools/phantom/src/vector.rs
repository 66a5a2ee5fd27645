//! Points and directions in body millimetres, as plain arrays.

/// A point or a direction: x to the patient's left, y posterior, z superior.
pub type Vec3 = [f32; 3];

pub fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn scale(a: Vec3, s: f32) -> Vec3 {
    [a[0] * s, a[1] * s, a[2] * s]
}

pub fn lerp(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    add(a, scale(sub(b, a), t))
}

pub fn dot(a: Vec3, b: Vec3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn length(a: Vec3) -> f32 {
    dot(a, a).sqrt()
}

/// The direction of `a`, or +z where it has none.
pub fn normalize(a: Vec3) -> Vec3 {
    let length = length(a);
    if length > 1e-6 { scale(a, 1.0 / length) } else { [0.0, 0.0, 1.0] }
}

/// The mirror image in the body's midplane.
pub fn mirror(a: Vec3) -> Vec3 {
    [-a[0], a[1], a[2]]
}

/// An orthonormal frame whose first axis is `axis`; the second lies as much along y as it can.
pub fn frame_along(axis: Vec3) -> [Vec3; 3] {
    let first = normalize(axis);
    let side = cross([0.0, 1.0, 0.0], first);
    let third = if length(side) > 1e-3 { normalize(side) } else { [0.0, 0.0, 1.0] };
    [first, cross(first, third), third]
}
