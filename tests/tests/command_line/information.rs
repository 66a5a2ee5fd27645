use serde_json::json;

use super::Scratch;

#[test]
fn info_tells_what_a_volume_is() {
    let scratch = Scratch::new();
    let told = scratch.run("info {}/ball.nrrd --json").json();
    let volume = &told["volume"];
    assert_eq!(volume["extent"], json!([70, 64, 40]));
    assert_eq!(volume["spacing"], json!([0.5, 0.5, 1.0]));
    assert_eq!(volume["origin"], json!([-17.0, -16.0, -20.0]));
    assert_eq!(volume["direction"], json!([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]));
    assert_eq!(volume["dtype"], "u8");
    assert_eq!(volume["bytes"], 70 * 64 * 40);
    assert_eq!(volume["range"], json!([0.0, 200.0]));
    assert_eq!((&volume["slope"], &volume["intercept"]), (&json!(1.0), &json!(0.0)));
    assert_eq!(volume["nan"], 0);
    assert_eq!(told["format"], "NRRD");
    assert_eq!(told["levels"], 1);
    assert_eq!(told["bricks"]["total"], 4);
    assert_eq!(told["bricks"]["grid"], json!([2, 2, 1]));
    assert_eq!(told["bricks"]["layout"], json!({"edge": 64, "halo": 2}));
    assert!(told["notes"].as_array().expect("a list").is_empty());
}

#[test]
fn info_tells_what_a_transfer_function_needs() {
    let scratch = Scratch::new();
    let bricks = &scratch.run("info {}/ball.nrrd --json --brick 24 --tf {}/tf.json").json()["bricks"];
    let [total, empty, visible] =
        ["total", "empty", "filtered_visible"].map(|name| bricks[name].as_u64().expect("a count"));
    assert_eq!(total, 4 * 4 * 2);
    assert_eq!(empty + visible, total);
    // The ball touches x 34 to 54, y 10 to 30, z 12 to 32; cores are 20 wide.
    assert_eq!(visible, 2 * 2 * 2);
    assert_eq!(bricks["bytes_needed"], visible * 24 * 24 * 24);
}

#[test]
fn info_reads_well() {
    let scratch = Scratch::new();
    let told = scratch.run("info {}/ball.nrrd --tf {}/tf.json").stdout;
    for words in ["ball.nrrd", "NRRD", "70 × 64 × 40 voxels", "0.5 × 0.5 × 1 mm", "u8", "0 to 200", "179,200"]
    {
        assert!(told.contains(words), "{words} is not in: {told}");
    }
}

#[test]
fn a_raw_file_is_what_the_flags_say() {
    let scratch = Scratch::new();
    let voxels: Vec<u8> = (0..60i16).flat_map(|voxel| (voxel - 10).to_be_bytes()).collect();
    std::fs::write(scratch.path("a.raw"), [&[9; 7], voxels.as_slice()].concat()).expect("a scratch file");
    let told = scratch
        .run(
            "info {}/a.raw --json --extent 3x4x5 --dtype i16 --endian big --offset 7 --spacing 0.5,1,2.5 \
             --rescale -2,-1024",
        )
        .json();
    let volume = &told["volume"];
    assert_eq!(volume["extent"], json!([3, 4, 5]));
    assert_eq!(volume["spacing"], json!([0.5, 1.0, 2.5]));
    assert_eq!(volume["range"], json!([-2.0 * 49.0 - 1024.0, 20.0 - 1024.0]));
    assert_eq!((&volume["slope"], &volume["intercept"]), (&json!(-2.0), &json!(-1024.0)));
}

#[test]
fn help_and_version_go_to_stdout() {
    let scratch = Scratch::new();
    assert!(scratch.run("--version").stdout.starts_with("glassbrick "));
    for line in ["--help", "render --help", "info --help", "demo --help"] {
        assert!(scratch.run(line).stdout.contains("Usage:"), "{line}");
    }
}
