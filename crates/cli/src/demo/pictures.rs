use glassbrick::{
    ControlPoint, Mode, NamedView, Phong, RenderRequest, RenderSettings, TransferFunction, preset,
};

/// A body stands upright.
const SIZE: [u32; 2] = [400, 800];

/// Half a voxel keeps surfaces free of the rings that samples leave on them.
const STEP_VOXELS: f64 = 0.5;

/// Values that the projection spreads over its greys, in Hounsfield units: from fat to hard bone.
const PROJECTED_HU: [f64; 2] = [-150.0, 1500.0];

/// One of the pictures that a demo draws.
#[derive(Clone, Copy, Debug)]
pub struct DemoPicture {
    pub file: &'static str,
    /// What it shows, in the words of the table.
    pub shows: &'static str,
    pub view: NamedView,
    look: Look,
}

#[derive(Clone, Copy, Debug)]
enum Look {
    Shaded { preset: &'static str },
    Unshaded { preset: &'static str },
    MaximumProjection,
}

/// What a demo draws.
pub fn pictures() -> [DemoPicture; 5] {
    let picture = |file, shows, view, look| DemoPicture { file, shows, view, look };
    [
        picture("bone.png", "bone, shaded", NamedView::Front, Look::Shaded { preset: "ct-bone" }),
        picture("skin.png", "skin, shaded", NamedView::Front, Look::Shaded { preset: "ct-skin" }),
        picture("haze.png", "haze, see-through", NamedView::Front, Look::Unshaded { preset: "haze" }),
        picture("mip.png", "maximum projection", NamedView::Front, Look::MaximumProjection),
        picture("left.png", "bone from the left", NamedView::Left, Look::Shaded { preset: "ct-bone" }),
    ]
}

impl DemoPicture {
    /// What is to be drawn of a volume whose values lie in `value_range`.
    pub fn request(&self, value_range: [f64; 2]) -> RenderRequest {
        let (transfer_function, mode, shading) = match self.look {
            Look::Shaded { preset } => (named(preset, value_range), Mode::Dvr, Some(Phong::default())),
            Look::Unshaded { preset } => (named(preset, value_range), Mode::Dvr, None),
            Look::MaximumProjection => (projected_greys(), Mode::Mip, None),
        };
        let settings = RenderSettings { mode, shading, ..RenderSettings::default() };
        RenderRequest {
            size: SIZE,
            step_voxels: STEP_VOXELS,
            settings,
            ..RenderRequest::new(transfer_function)
        }
    }
}

fn named(name: &str, value_range: [f64; 2]) -> TransferFunction {
    preset(name, value_range).expect("the demo names presets that there are")
}

/// White as opaque as the value is high, so that a projection's greys are its values.
fn projected_greys() -> TransferFunction {
    let [low, high] = PROJECTED_HU;
    let points = [(low, 0.0), (high, 1.0)];
    let point = |(value, opacity)| ControlPoint { value, color: [1.0; 3], opacity };
    TransferFunction { points: points.map(point).to_vec(), unit_mm: Some(1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_has_its_transfer_function_and_file() {
        let pictures = pictures();
        for picture in &pictures {
            assert!(!picture.request([-1024.0, 3071.0]).transfer_function.points.is_empty());
        }
        let mut files: Vec<_> = pictures.iter().map(|picture| picture.file).collect();
        files.dedup();
        assert_eq!(files.len(), pictures.len());
    }
}
