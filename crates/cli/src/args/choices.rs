use clap::ValueEnum;

/// What a ray makes of the values that it meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ModeChoice {
    /// Direct volume rendering: emission and absorption
    Dvr,
    /// The largest value
    Mip,
    /// The smallest value
    Minip,
    /// The arithmetic mean
    Mean,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShadingChoice {
    Off,
    /// Light from the eye on surfaces
    Phong,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BackendChoice {
    /// What this machine draws best on
    Auto,
    Cpu,
    Gpu,
}

/// What a benchmark draws with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ExecutorChoice {
    /// GPU slices without visibility tests: every brick in the frustum
    Hw,
    /// A plain ray caster on the CPU, without bricks
    Sw,
    /// GPU slices with occlusion queries
    Slices,
    /// GPU rays
    Raycast,
    /// The CPU renderer
    Cpu,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PassChoice {
    Slices,
    Raycast,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SkipChoice {
    /// Every brick in the frustum is drawn, and the opacity cutoff ignored
    None,
    /// Empty bricks are skipped, and rays stop at the opacity cutoff
    Empty,
    /// Hidden bricks are skipped too
    All,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CodecChoice {
    None,
    Lz4,
    Zstd,
}

/// The side of the patient that faces the viewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewChoice {
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum EndianChoice {
    Little,
    Big,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DemoSize {
    /// 256x152x865 voxels, 67 MB
    Small,
    /// 512x304x1730 voxels, 538 MB
    VisibleHuman,
}
