use std::mem::offset_of;

use naga::{Expression, Literal, Module, TypeInner};

use super::*;

fn parse(pass: Pass) -> Module {
    naga::front::wgsl::parse_str(wgsl(pass)).expect("the build validated it")
}

/// The members of a struct in WGSL, which the build may have given a longer name: offsets, and the size.
fn reflected(module: &Module, name: &str) -> (Vec<(String, u32)>, u32) {
    let is_it = |found: &str| found == name || found.starts_with(&format!("{name}X_naga_oil"));
    let members = module.types.iter().find_map(|(_, kind)| match &kind.inner {
        TypeInner::Struct { members, span } if kind.name.as_deref().is_some_and(is_it) => {
            let name = |member: &naga::StructMember| member.name.clone().expect("members have names");
            Some((members.iter().map(|member| (name(member), member.offset)).collect(), *span))
        }
        _ => None,
    });
    members.unwrap_or_else(|| panic!("the WGSL has no struct {name}"))
}

macro_rules! lies_as_in_wgsl {
    ($module:expr, $kind:ident { $($field:ident),* $(,)? }) => {{
        let (members, span) = reflected($module, stringify!($kind));
        let ours = vec![$((stringify!($field).to_owned(), offset_of!($kind, $field) as u32)),*];
        assert_eq!(members, ours, stringify!($kind));
        assert_eq!(span as usize, size_of::<$kind>(), stringify!($kind));
    }};
}

#[test]
fn structs_lie_in_memory_as_the_shaders_read_them() {
    let raycast = &parse(Pass::Raycast { pixels: Pixels::Dvr, filters: false, many_textures: false });
    lies_as_in_wgsl!(
        raycast,
        Frame {
            tile_origin,
            tile_size,
            sample_count,
            cores_per_voxel,
            core,
            halo,
            grid_counts,
            flags,
            volume_low,
            opacity_cutoff,
            volume_high,
            sign,
            atlas_from_texel,
            first_stored,
            stored_from_texel,
            stored_bias,
            entries_per_stored,
            phong,
            normal_from_gradient,
            step_mm,
            cell_bytes,
            box_depth,
            rank_from_stored,
            cell_edge,
            cell_words,
            rays,
        }
    );
    lies_as_in_wgsl!(raycast, RayFan { start_high, start_low, step_high, step_low });
    lies_as_in_wgsl!(raycast, RayState { gathered, next, surface, samples, padding });
    let slices = &parse(Pass::Slices { pixels: Pixels::Extremum, filters: true });
    lies_as_in_wgsl!(
        slices,
        SlicedBrick { corners, owned_low, last_slice, owned_high, best, texel_from_voxel, first_slice }
    );
    let visible = &parse(Pass::Visible);
    lies_as_in_wgsl!(visible, QueryRange { first, count });
    lies_as_in_wgsl!(visible, DrawArgs { vertex_count, instance_count, first_vertex, first_instance });
}

#[test]
fn a_slab_has_as_many_slices_in_both_languages() {
    let slices = parse(Pass::Slices { pixels: Pixels::Mean, filters: true });
    let is_it = |name: &Option<String>| name.as_deref().is_some_and(|name| name.starts_with("SLAB_SLICES"));
    let (_, constant) =
        slices.constants.iter().find(|(_, constant)| is_it(&constant.name)).expect("it is there");
    let value = &slices.global_expressions[constant.init];
    assert!(
        matches!(value, Expression::Literal(Literal::F32(slices)) if *slices == SLAB_SLICES as f32),
        "{value:?}"
    );
}

#[test]
fn every_variant_that_can_be_asked_for_is_there() {
    let booleans = [false, true];
    for pixels in [Pixels::Dvr, Pixels::DvrShaded, Pixels::Extremum, Pixels::Mean] {
        for filters in booleans {
            for many_textures in booleans {
                parse(Pass::Raycast { pixels, filters, many_textures });
            }
            parse(Pass::Slices { pixels, filters });
        }
    }
    for ranked in booleans {
        parse(Pass::Boxes { ranked });
    }
    for pass in [Pass::Visible, Pass::Under, Pass::Erase, Pass::Opaque, Pass::FilterProbe] {
        parse(pass);
    }
}
