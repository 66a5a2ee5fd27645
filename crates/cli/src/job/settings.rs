//! The renderer's settings, and what of the flags does nothing.

use glassbrick::{GpuPass, Mode, Phong, RenderSettings, Skip};

use crate::args::{ModeChoice, PassChoice, RenderArgs, ShadingChoice, SkipChoice};

/// How frames are drawn.
pub fn render_settings(args: &RenderArgs) -> RenderSettings {
    RenderSettings {
        mode: mode(args.drawing.mode),
        shading: shading(args.drawing.shading),
        opacity_cutoff: args.drawing.opacity_cutoff,
        skip: match args.skip {
            SkipChoice::None => Skip::None,
            SkipChoice::Empty => Skip::Empty,
            SkipChoice::All => Skip::All,
        },
    }
}

/// What a ray makes of values.
pub fn mode(choice: ModeChoice) -> Mode {
    match choice {
        ModeChoice::Dvr => Mode::Dvr,
        ModeChoice::Mip => Mode::Mip,
        ModeChoice::Minip => Mode::Minip,
        ModeChoice::Mean => Mode::Mean,
    }
}

/// The light.
pub fn shading(choice: ShadingChoice) -> Option<Phong> {
    match choice {
        ShadingChoice::Off => None,
        ShadingChoice::Phong => Some(Phong::default()),
    }
}

/// How a GPU draws.
pub fn gpu_pass(args: &RenderArgs) -> GpuPass {
    match args.pass {
        Some(PassChoice::Slices) => GpuPass::Slices,
        Some(PassChoice::Raycast) | None => GpuPass::Raycast,
    }
}

/// Flags that were given and do nothing, a sentence each.
pub fn idle_flags(args: &RenderArgs, keeps_alpha: bool) -> Vec<String> {
    sentences([
        (
            args.drawing.shading != ShadingChoice::Off && args.drawing.mode != ModeChoice::Dvr,
            "--shading does nothing: it concerns mode dvr alone",
        ),
        (args.background.is_some() && keeps_alpha, "--background does nothing: EXR keeps its alpha"),
    ])
}

/// Flags that were given and do nothing where the CPU draws.
pub fn idle_flags_on_cpu(args: &RenderArgs) -> Vec<String> {
    sentences([
        (args.pass.is_some(), "--pass does nothing: it concerns GPUs, and the CPU draws by layers"),
        (
            args.drawing.gpu_memory.is_some(),
            "--gpu-memory does nothing: no GPU draws; the CPU's limit is --memory",
        ),
    ])
}

fn sentences(idle: [(bool, &str); 2]) -> Vec<String> {
    idle.into_iter().filter(|(is_idle, _)| *is_idle).map(|(_, what)| what.to_owned()).collect()
}
