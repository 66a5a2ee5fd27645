//! GPUs by the command: what it reports, and what it refuses in one line.

use std::fs;

use glassbrick::{BrickLayout, Gpu, GpuPass, Renderer};
use glassbrick_tests::drawing::request;
use glassbrick_tests::gpu::{ADAPTER_VARIABLE, gpu};
use serde_json::{Value, json};

use super::{PASSES, needed_bytes, on, texture_bytes, volume};
use crate::binary::{NO_DRIVERS, glassbrick, glassbrick_with};
use crate::store::damage::{EDGE, prepared, scene};
use crate::store::{assert_one_line, failed};

/// No adapter has this name.
const NONE_SUCH: &str = "nonesuch";

const RENDER: &str = "render {}/v.zarr --tf {}/tf.json --level 0 --size 24x18 --threads 2 --backend gpu \
                      -o {}/a.exr --report {}/r.json";

#[test]
fn the_command_draws_by_either_pass_and_reports_it() {
    let Some(gpu) = gpu() else { return };
    let scratch = prepared();
    for pass in PASSES {
        let line = scratch.line(&format!("{RENDER} --gpu-memory 128MiB --pass {}", pass.name()));
        glassbrick(&line, &[]).succeeded();
        let report = fs::read(scratch.path("r.json")).expect("it was written");
        let report: Value = serde_json::from_slice(&report).expect("JSON");
        assert_eq!(report["backend"], json!("gpu"));
        assert_eq!(report["pass"], json!(pass.name()));
        assert_eq!(report["adapter"], json!(gpu.adapter()));
        assert_eq!(report["complete"], json!(true));
        assert_eq!(report["residency"]["budget_bytes"], json!(128 << 20));
        assert_eq!(report["samples"].is_u64(), pass == GpuPass::Raycast, "{}", report["samples"]);
        assert_eq!(report["samples"].is_null(), pass == GpuPass::Slices, "{}", report["samples"]);
        assert!(report["residency"]["uploads"].as_u64() >= report["bricks"]["rendered"].as_u64());
        assert!(report["bricks"]["rendered"].as_u64() > Some(0));
    }
}

#[test]
fn too_little_memory_is_refused_and_what_is_needed_is_enough() {
    let Some(gpu) = gpu() else { return };
    for edge in [EDGE, 64, 300] {
        let volume = volume(&scene(), BrickLayout { edge, halo: 2 });
        let needed = texture_bytes(gpu, &volume);
        let draws = |gpu_memory_bytes| {
            let request = on(gpu, GpuPass::Raycast, request(&scene()));
            Renderer::new(&volume, glassbrick::RenderRequest { gpu_memory_bytes, ..request })
        };
        for too_few in [0, 1, needed - 1] {
            let refused = draws(too_few).err().expect("it is too little").to_string();
            assert_one_line(&refused);
            assert!(
                refused.contains("--gpu-memory") && refused.contains(&format!(" {too_few} ")),
                "{refused}"
            );
            assert_eq!(needed_bytes(&refused), needed, "{refused}");
        }
        assert!(draws(needed).is_ok(), "{needed} bytes are enough");
    }
    let scratch = prepared();
    let before = scratch.names();
    let refused = failed(&scratch.glassbrick(&format!("{RENDER} --gpu-memory 1000")));
    assert!(refused.contains("--gpu-memory") && needed_bytes(&refused) > 1 << 20, "{refused}");
    assert_eq!(scratch.names(), before, "nothing is written");
}

/// By the command, whatever is chosen: who names an adapter wants that one.
#[test]
fn an_adapter_that_is_not_there_is_refused_and_those_that_are_there_are_named() {
    let Some(gpu) = gpu() else { return };
    let own_name = gpu.adapter().split(", ").next().expect("a name");
    let refused = Gpu::open(Some(NONE_SUCH)).expect_err("there is none").to_string();
    assert_one_line(&refused);
    assert!(refused.contains(NONE_SUCH) && refused.contains(own_name), "{refused}");

    let scratch = prepared();
    let before = scratch.names();
    for line in [RENDER.to_owned(), RENDER.replace("--backend gpu", "--backend auto")] {
        let outcome = glassbrick_with(&[(ADAPTER_VARIABLE, NONE_SUCH)], &scratch.line(&line), &[]);
        let refused = failed(&outcome);
        assert!(refused.contains(NONE_SUCH) && refused.contains(own_name), "{refused}");
        assert_eq!(scratch.names(), before, "nothing is written");
    }
    let on_cpu = scratch.line(&RENDER.replace("--backend gpu", "--backend cpu"));
    glassbrick_with(&[(ADAPTER_VARIABLE, NONE_SUCH)], &on_cpu, &[]).succeeded();
}

#[test]
#[cfg(target_os = "linux")]
fn without_any_driver_a_gpu_is_refused_and_auto_is_the_cpu() {
    let scratch = prepared();
    let before = scratch.names();
    let variables: Vec<(&str, &str)> = [(ADAPTER_VARIABLE, "")].into_iter().chain(NO_DRIVERS).collect();
    let refused = failed(&glassbrick_with(&variables, &scratch.line(RENDER), &[]));
    assert!(refused.contains("no GPU") && refused.contains("--backend cpu"), "{refused}");
    assert_eq!(scratch.names(), before, "nothing is written");

    let auto = scratch.line(&RENDER.replace("--backend gpu", "--backend auto"));
    glassbrick_with(&variables, &auto, &[]).succeeded();
    let report = fs::read(scratch.path("r.json")).expect("it was written");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    assert_eq!(report["backend"], json!("cpu"));
}
