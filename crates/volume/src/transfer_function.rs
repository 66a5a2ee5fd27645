/// A point of a transfer function: colour and opacity at a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    pub value: f64,
    /// sRGB-encoded red, green and blue, 0 to 1.
    pub color: [f64; 3],
    /// Opacity per unit length, 0 to 1.
    pub opacity: f64,
}

/// Colour and opacity as a function of value: linear between the points, constant outside them.
///
/// Points of equal value make a step, at which the later holds.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFunction {
    /// At least one, sorted by value.
    pub points: Vec<ControlPoint>,
    /// The length that opacities are of, in mm; the volume's smallest spacing where there is none.
    pub unit_mm: Option<f64>,
}
