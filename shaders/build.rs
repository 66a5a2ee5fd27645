//! Composes each pass with the shared functions that it imports, in every variant that is used, and validates it:
//! a shader that is wrong does not build.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga_oil::compose::{ComposableModuleDescriptor, Composer, NagaModuleDescriptor, ShaderDefValue};

/// Shared modules, each after those that it imports.
const SHARED: [&str; 12] = [
    "frame",
    "rays",
    "cells",
    "bricks",
    "transfer_function",
    "atlas",
    "light",
    "gathered",
    "search",
    "samples",
    "sliced_brick",
    "full_screen",
];

const FILTER: [&[&str]; 2] = [&[], &["FILTERS"]];
const TEXTURES: [&[&str]; 2] = [&[], &["MANY_TEXTURES"]];
const PIXELS: [&[&str]; 4] = [&["DVR"], &["DVR", "SHADED"], &["EXTREMUM"], &["MEAN"]];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=shared");
    println!("cargo::rerun-if-changed=passes");
    let mut table =
        String::from("/// Every variant: its pass, what is defined in it in order, and its WGSL.\n");
    writeln!(table, "const VARIANTS: &[(&str, &[&str], &str)] = &[")?;
    for (pass, choices) in passes() {
        for defined in combinations(&choices) {
            let wgsl = compose(pass, &defined)?;
            writeln!(table, "    ({pass:?}, &{defined:?}, {wgsl:?}),")?;
        }
    }
    writeln!(table, "];")?;
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::write(out.join("variants.rs"), table)?;
    Ok(())
}

/// Each pass and what is chosen for it, one of each list.
fn passes() -> Vec<(&'static str, Vec<&'static [&'static [&'static str]]>)> {
    vec![
        ("raycast", vec![&PIXELS, &FILTER, &TEXTURES]),
        ("slices", vec![&PIXELS, &FILTER]),
        ("boxes", vec![&[&[], &["EXTREMUM"]]]),
        ("visible", vec![]),
        ("under", vec![]),
        ("erase", vec![]),
        ("opaque", vec![]),
        ("filter_probe", vec![]),
    ]
}

/// Every way to take one of each list.
fn combinations<'a>(choices: &[&'a [&'a [&'a str]]]) -> Vec<Vec<&'a str>> {
    choices.iter().fold(vec![Vec::new()], |chosen, choice| {
        let one_more = |before: &Vec<&'a str>| {
            choice.iter().map(|more| [before.as_slice(), more].concat()).collect::<Vec<_>>()
        };
        chosen.iter().flat_map(one_more).collect()
    })
}

/// The WGSL of a pass with all that it imports.
fn compose(pass: &str, defined: &[&str]) -> Result<String, Box<dyn Error>> {
    let shader_defs = || defined.iter().map(|&name| (name.to_owned(), ShaderDefValue::Bool(true))).collect();
    let mut composer = Composer::default();
    for shared in SHARED {
        let path = format!("shared/{shared}.wgsl");
        let source = fs::read_to_string(&path)?;
        let module = ComposableModuleDescriptor {
            source: &source,
            file_path: &path,
            shader_defs: shader_defs(),
            ..Default::default()
        };
        composer
            .add_composable_module(module)
            .map(|_| ())
            .map_err(|error| error.emit_to_string(&composer))?;
    }
    let path = format!("passes/{pass}.wgsl");
    let source = fs::read_to_string(Path::new(&path))?;
    let descriptor = NagaModuleDescriptor {
        source: &source,
        file_path: &path,
        shader_defs: shader_defs(),
        ..Default::default()
    };
    let module = composer.make_naga_module(descriptor).map_err(|error| error.emit_to_string(&composer))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::default());
    let info = validator.validate(&module).map_err(|error| format!("{path} {defined:?}: {error:?}"))?;
    Ok(naga::back::wgsl::write_string(&module, &info, naga::back::wgsl::WriterFlags::empty())?)
}
