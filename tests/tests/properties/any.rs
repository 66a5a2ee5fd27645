//! Volumes, brick layouts and cameras of every kind. What has many parts is made of a few numbers, so that a failure
//! shrinks to something that can be read.

use glam::{DMat3, DVec3, UVec2, UVec3};
use glassbrick_volume::{
    BrickGrid, BrickLayout, Camera, FrameRays, NamedView, Projection, Rescale, StoredType, VolumeDesc,
};
use proptest::prelude::*;
use proptest::sample::select;

/// Up to `most` voxels along each axis.
pub fn extent(most: u32) -> impl Strategy<Value = UVec3> {
    [1..=most, 1..=most, 1..=most].prop_map(UVec3::from_array)
}

/// Layouts that a source takes, small enough for small volumes to have seams.
pub fn layout() -> impl Strategy<Value = BrickLayout> {
    (4..=24u32, 2..=4u32).prop_map(|(core, halo)| BrickLayout { edge: core + 2 * halo, halo })
}

/// Slopes and intercepts with which whole numbers are followed exactly.
pub fn rescale() -> impl Strategy<Value = Rescale> {
    let slope = select(vec![1.0, -1.0, 0.5, -2.0, 8.0]);
    (slope, -1024..=1024).prop_map(|(slope, intercept)| Rescale { slope, intercept: f64::from(intercept) })
}

/// A volume anywhere in the world, its axes in any direction and not always orthogonal.
pub fn desc(most: u32) -> impl Strategy<Value = VolumeDesc> {
    let spacing = [0.4..2.5, 0.4..2.5, 0.4..2.5].prop_map(DVec3::from_array);
    let spacing_mm = prop_oneof![Just(DVec3::ONE), spacing];
    let origin_mm = prop_oneof![Just(DVec3::ZERO), point(300.0)];
    (extent(most), spacing_mm, origin_mm, direction()).prop_map(
        |(extent, spacing_mm, origin_mm, direction)| VolumeDesc {
            spacing_mm,
            origin_mm,
            direction,
            ..VolumeDesc::new(extent, StoredType::U8)
        },
    )
}

fn direction() -> impl Strategy<Value = DMat3> {
    let permuted = DMat3::from_cols(DVec3::Y, DVec3::NEG_Z, DVec3::X);
    let mirrored = DMat3::from_cols(DVec3::NEG_X, DVec3::Y, DVec3::Z);
    let rotated = || (unit_vector(), 0.0..3.0).prop_map(|(axis, angle)| DMat3::from_axis_angle(axis, angle));
    let sheared = (rotated(), -0.5..0.5, -0.5..0.5).prop_map(|(rotated, x, y)| {
        let lean = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(x, y, 1.0).normalize());
        rotated * lean
    });
    prop_oneof![
        3 => Just(DMat3::IDENTITY),
        1 => Just(permuted),
        1 => Just(mirrored),
        2 => rotated(),
        2 => sheared,
    ]
}

fn point(farthest: f64) -> impl Strategy<Value = DVec3> {
    let range = -farthest..farthest;
    [range.clone(), range.clone(), range].prop_map(DVec3::from_array)
}

fn unit_vector() -> impl Strategy<Value = DVec3> {
    point(1.0).prop_map(|vector| vector.try_normalize().unwrap_or(DVec3::X))
}

/// A volume, how it is cut, and how it is looked at.
#[derive(Clone, Debug)]
pub struct View {
    pub desc: VolumeDesc,
    pub layout: BrickLayout,
    pub camera: Camera,
    pub size: UVec2,
    pub step_voxels: f64,
}

impl View {
    pub fn grid(&self) -> BrickGrid {
        self.layout.grid(self.desc.extent)
    }

    pub fn rays(&self) -> FrameRays {
        FrameRays::new(&self.desc.level(0), &self.camera, self.size, self.step_voxels)
            .expect("a sound camera")
    }
}

/// Views from outside, from inside, from the very faces of bricks, along axes and across, in both projections.
pub fn view(most: u32) -> impl Strategy<Value = View> {
    let size = [1..=13u32, 1..=13u32].prop_map(UVec2::from_array);
    let step = prop_oneof![Just(1.0), 0.4..2.5];
    (desc(most), layout(), stand(), lens(), size, step).prop_map(
        |(desc, layout, stand, lens, size, step_voxels)| {
            let camera = lens.through(stand.camera(&desc, layout), &desc);
            View { desc, layout, camera, size, step_voxels }
        },
    )
}

/// Views along an axis of the volume, rows of pixels wide enough for sixteen rays and more.
pub fn wide_view(most: u32) -> impl Strategy<Value = View> {
    let size = [1..=70u32, 1..=5u32].prop_map(UVec2::from_array);
    let step = prop_oneof![Just(1.0), 0.4..2.5];
    let named = select(vec![NamedView::Front, NamedView::Back, NamedView::Top, NamedView::Bottom]);
    let along = (point(0.8), 0..3usize, any::<bool>()).prop_map(|(eye, axis, forward)| Stand::Anywhere {
        eye: eye + 0.5,
        look: Look::Along { axis, forward, tilt: DVec3::ZERO },
    });
    let stand = prop_oneof![named.prop_map(Stand::Named), along];
    let mirrored = DMat3::from_cols(DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z);
    let direction = select(vec![DMat3::IDENTITY, mirrored]);
    (desc(most), direction, layout(), stand, lens(), size, step).prop_map(
        |(desc, direction, layout, stand, lens, size, step_voxels)| {
            let desc = VolumeDesc { direction, ..desc };
            let camera = lens.through(stand.camera(&desc, layout), &desc);
            View { desc, layout, camera, size, step_voxels }
        },
    )
}

/// Where the viewer stands and looks.
#[derive(Clone, Debug)]
enum Stand {
    Named(NamedView),
    Around {
        azimuth_deg: f64,
        elevation_deg: f64,
    },
    /// At fractions of the volume, and a little around it.
    Anywhere {
        eye: DVec3,
        look: Look,
    },
    /// On faces of bricks, or off them by no more than rounding: `on` says on which axes.
    OnFaces {
        brick: DVec3,
        on: [bool; 3],
        off_by: f64,
        look: Look,
    },
}

#[derive(Clone, Debug)]
enum Look {
    Toward(DVec3),
    /// Along a voxel axis, or tilted from it by no more than rounding.
    Along {
        axis: usize,
        forward: bool,
        tilt: DVec3,
    },
}

fn stand() -> impl Strategy<Value = Stand> {
    use NamedView::{Back, Bottom, Front, Left, Right, Top};
    let named = select(vec![Front, Back, Left, Right, Top, Bottom]).prop_map(Stand::Named);
    let around = (0.0..360.0, -90.0..90.0)
        .prop_map(|(azimuth_deg, elevation_deg)| Stand::Around { azimuth_deg, elevation_deg });
    let anywhere = (point(0.8), look()).prop_map(|(eye, look)| Stand::Anywhere { eye: eye + 0.5, look });
    let off_by = select(vec![0.0, 1e-9, -1e-9, 1e-7, -1e-7, 1e-5, -1e-5]);
    let on_faces = (point(0.6), any::<[bool; 3]>(), off_by, look())
        .prop_map(|(brick, on, off_by, look)| Stand::OnFaces { brick: brick + 0.5, on, off_by, look });
    prop_oneof![1 => named, 2 => around, 2 => anywhere, 4 => on_faces]
}

fn look() -> impl Strategy<Value = Look> {
    let size = select(vec![0.0, 1e-8, 1e-7, 1e-6, 1e-4]);
    let along = (0..3usize, any::<bool>(), unit_vector(), size)
        .prop_map(|(axis, forward, tilt, size)| Look::Along { axis, forward, tilt: tilt * size });
    prop_oneof![unit_vector().prop_map(Look::Toward), along]
}

impl Stand {
    fn camera(&self, desc: &VolumeDesc, layout: BrickLayout) -> Camera {
        let (eye, look) = match self {
            Self::Named(view) => return Camera::framing(desc, *view),
            Self::Around { azimuth_deg, elevation_deg } => {
                return Camera::framing_around(desc, *azimuth_deg, *elevation_deg);
            }
            Self::Anywhere { eye, look } => (*eye * desc.extent.as_dvec3(), look),
            Self::OnFaces { brick, on, off_by, look } => {
                let core = f64::from(layout.core());
                let place = *brick * desc.extent.as_dvec3();
                let face = (place / core).round() * core - 0.5 + *off_by;
                (DVec3::select(glam::BVec3::from_array(*on), face, place), look)
            }
        };
        let toward = match look {
            Look::Toward(toward) => *toward,
            Look::Along { axis, forward, tilt } => {
                DVec3::AXES[*axis] * if *forward { 1.0 } else { -1.0 } + *tilt
            }
        };
        let world_from_voxel = desc.world_from_voxel();
        let forward = world_from_voxel.transform_vector3(toward).normalize();
        let eye_mm = world_from_voxel.transform_point3(eye);
        let up = DVec3::AXES[forward.abs().min_position()];
        Camera { eye_mm, target_mm: eye_mm + forward, up, ..Camera::framing(desc, NamedView::Front) }
    }
}

#[derive(Clone, Debug)]
enum Lens {
    Perspective {
        fov_y_deg: f64,
    },
    /// In radii of the volume.
    Orthographic {
        height: f64,
    },
}

fn lens() -> impl Strategy<Value = Lens> {
    let perspective =
        prop_oneof![Just(30.0), 2.0..140.0].prop_map(|fov_y_deg| Lens::Perspective { fov_y_deg });
    let orthographic = (0.2..4.0).prop_map(|height| Lens::Orthographic { height });
    prop_oneof![2 => perspective, 1 => orthographic]
}

impl Lens {
    fn through(&self, camera: Camera, desc: &VolumeDesc) -> Camera {
        let [low, high] = [desc.corners_mm()[0], desc.corners_mm()[7]];
        let projection = match *self {
            Self::Perspective { fov_y_deg } => Projection::Perspective { fov_y_deg },
            Self::Orthographic { height } => {
                Projection::Orthographic { height_mm: height * low.distance(high) / 2.0 }
            }
        };
        Camera { projection, ..camera }
    }
}
