mod background;
mod block;
mod distribution;
mod hounsfield;
mod labels;
mod object;
mod points;
mod signed;
#[cfg(test)]
mod tests;
mod window;

use glassbrick_volume::{ControlPoint, Mode, TransferFunction, VolumeDesc};

use crate::Histogram;
use background::Background;
use distribution::Distribution;
use signed::Signed;

/// A transfer function for a first picture of a volume of which nothing is known but how often its values occur.
///
/// For direct volume rendering it shows the object, not what surrounds it: CT as bones in a veil of flesh, labels in
/// colours of their own, values about zero in blue and red, and everything else by how far it stands out from the
/// background, as opaque as suits its size. What has no background is shown as a solid block. For projections it is a
/// window, from black to white.
pub fn auto_transfer_function(histogram: &Histogram, desc: &VolumeDesc, mode: Mode) -> TransferFunction {
    let Some(distribution) = Distribution::of(histogram) else {
        return grey_box(histogram.range[0]);
    };
    let content = Content::of(&distribution);
    if mode != Mode::Dvr {
        return window::transfer_function(&content, &distribution, mode);
    }
    let mut function = content.transfer_function(&distribution, desc);
    hide_strays(&mut function, histogram);
    function
}

/// Whether a volume seems to be a CT in Hounsfield units, so that the CT presets show what they say.
pub fn has_hounsfield_units(histogram: &Histogram) -> bool {
    let content = Distribution::of(histogram).map(|distribution| Content::of(&distribution));
    content == Some(Content::Hounsfield { offset: 0.0 })
}

/// What a volume seems to hold.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Content {
    /// A CT whose values are Hounsfield units and this.
    Hounsfield { offset: f64 },
    /// Numbers that name things, or a mask.
    Labels,
    /// Values on both sides of zero.
    Signed(Signed),
    /// An object in what surrounds it.
    Object(Background),
    /// Something that fills the volume.
    Block,
}

impl Content {
    fn of(distribution: &Distribution) -> Self {
        if let Some(offset) = hounsfield::offset(distribution) {
            Self::Hounsfield { offset }
        } else if labels::are_labels(distribution) {
            Self::Labels
        } else if let Some(signed) = Signed::of(distribution) {
            Self::Signed(signed)
        } else if let Some(background) = Background::of(distribution) {
            Self::Object(background)
        } else {
            Self::Block
        }
    }

    fn transfer_function(&self, distribution: &Distribution, desc: &VolumeDesc) -> TransferFunction {
        match self {
            Self::Hounsfield { offset } => hounsfield::transfer_function(*offset, distribution, desc),
            Self::Labels => labels::transfer_function(distribution, desc),
            Self::Signed(signed) => signed.transfer_function(distribution, desc),
            Self::Object(background) => object::transfer_function(background, distribution, desc),
            Self::Block => block::transfer_function(distribution, desc),
        }
    }
}

/// A volume of one value, as a grey box: it is there, and nothing is in it.
fn grey_box(value: f64) -> TransferFunction {
    let value = if value.is_finite() { value } else { 0.0 };
    TransferFunction { points: vec![ControlPoint { value, color: [0.5; 3], opacity: 0.5 }], unit_mm: None }
}

/// Leaves out values absurdly far above all others, such as what memory holds that was never written.
fn hide_strays(function: &mut TransferFunction, histogram: &Histogram) {
    const ABSURD: f64 = 100.0;
    let [start, end] = histogram.span;
    if let [first, .., last] = function.points[..]
        && histogram.range[1] - end > ABSURD * (end - start)
    {
        let width = last.value - first.value;
        function.points.push(ControlPoint { value: last.value + 2.0 * width, ..last });
        function.points.push(ControlPoint { value: last.value + 2.1 * width, opacity: 0.0, ..last });
    }
}
