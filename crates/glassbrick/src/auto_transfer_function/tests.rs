use glam::{DVec3, UVec3};
use glassbrick_volume::StoredType;

use super::*;

/// Voxels spread about a value: all of them, and those on the volume's faces.
struct Peak {
    value: f64,
    deviation: f64,
    voxels: f64,
    on_faces: f64,
}

fn peak(value: f64, deviation: f64, voxels: f64, on_faces: f64) -> Peak {
    Peak { value, deviation, voxels, on_faces }
}

/// A histogram of these, measured values that hardly ever repeat. Beyond three deviations there is nothing.
fn histogram(range: [f64; 2], bins: usize, peaks: &[Peak]) -> Histogram {
    let zeros = vec![0.0; bins];
    let mut histogram = Histogram {
        range,
        span: range,
        counts: zeros.clone(),
        face_counts: zeros.clone(),
        repeated_counts: zeros,
    };
    for peak in peaks {
        let density = |value: f64| {
            let deviations = (value - peak.value) / peak.deviation;
            if deviations.abs() < 3.0 { (-0.5 * deviations * deviations).exp() } else { 0.0 }
        };
        let mut part: Vec<f64> = (0..bins).map(|bin| density(histogram.value(bin))).collect();
        if part.iter().all(|&density| density == 0.0) {
            part[histogram.bin(peak.value)] = 1.0;
        }
        let all: f64 = part.iter().sum();
        for (bin, density) in part.iter().enumerate() {
            histogram.counts[bin] += peak.voxels * density / all;
            histogram.face_counts[bin] += peak.on_faces * density / all;
        }
    }
    histogram
}

/// The same of bytes.
fn bytes(peaks: &[Peak]) -> Histogram {
    Histogram { range: [0.0, 255.0], ..histogram([-0.5, 255.5], 256, peaks) }
}

fn desc() -> VolumeDesc {
    VolumeDesc::new(UVec3::splat(256), StoredType::I16)
}

/// The function, after a look at what holds for every first picture.
fn sound(histogram: &Histogram, desc: &VolumeDesc, mode: Mode) -> TransferFunction {
    let function = auto_transfer_function(histogram, desc, mode);
    assert!(!function.points.is_empty());
    assert!(function.points.is_sorted_by(|a, b| a.value < b.value), "{function:?}");
    for point in &function.points {
        assert!(point.value.is_finite() && (0.0..=1.0).contains(&point.opacity), "{function:?}");
        assert!(point.color.iter().all(|channel| (0.0..=1.0).contains(channel)), "{function:?}");
    }
    assert!(function.unit_mm.is_none_or(|unit| unit.is_normal() && unit > 0.0), "{function:?}");
    assert_eq!(function.warnings(), Vec::<String>::new());
    assert!(!function.bake(desc.smallest_spacing_mm()).bands().is_empty(), "something is shown");
    function
}

fn dvr(histogram: &Histogram) -> TransferFunction {
    for mode in Mode::ALL {
        sound(histogram, &desc(), mode);
    }
    sound(histogram, &desc(), Mode::Dvr)
}

/// Optical depth of so many millimetres of a value.
fn depth(function: &TransferFunction, value: f64, length_mm: f64) -> f64 {
    -(1.0 - function.at(value).1).ln() * length_mm / function.unit_mm.unwrap_or(1.0)
}

fn ct(offset: f64, range: [f64; 2], padding: Option<f64>) -> Histogram {
    let mut peaks = vec![
        peak(offset - 985.0, 20.0, 9e6, 3e5),
        peak(offset - 100.0, 25.0, 1e6, 1e3),
        peak(offset + 40.0, 25.0, 3e6, 5e3),
        peak(offset + 300.0, 150.0, 4e5, 1e3),
        peak(offset + 1200.0, 150.0, 2e5, 0.0),
    ];
    peaks.extend(padding.map(|value| peak(value, 0.1, 3e6, 2e5)));
    histogram(range, 4000, &peaks)
}

fn assert_shows_bone_in_a_veil(function: &TransferFunction, offset: f64) {
    let at = |hu: f64| function.at(hu + offset).1;
    for unseen in [-3024.0, -2000.0, -1000.0, -850.0, -400.0] {
        assert_eq!(at(unseen), 0.0, "{unseen} HU");
    }
    assert!((0.001..0.02).contains(&at(40.0)) && at(1200.0) > 0.7);
}

#[test]
fn ct_is_bone_in_a_veil_of_flesh_whatever_the_padding() {
    assert_shows_bone_in_a_veil(&dvr(&ct(0.0, [-1024.0, 3071.0], None)), 0.0);
    assert_shows_bone_in_a_veil(&dvr(&ct(0.0, [-2000.0, 3071.0], Some(-2000.0))), 0.0);
    assert_shows_bone_in_a_veil(&dvr(&ct(0.0, [-3024.0, 3071.0], Some(-3024.0))), 0.0);
}

#[test]
fn ct_without_sign_is_recognised() {
    assert_shows_bone_in_a_veil(&dvr(&ct(1024.0, [0.0, 4095.0], None)), 1024.0);
    assert_shows_bone_in_a_veil(&dvr(&ct(1000.0, [0.0, 4095.0], Some(0.0))), 1000.0);
}

#[test]
fn ct_cut_out_of_a_body_needs_no_air() {
    let peaks = [peak(50.0, 20.0, 1e6, 1e5), peak(-900.0, 20.0, 5e3, 5e2), peak(600.0, 150.0, 3e4, 3e3)];
    assert_shows_bone_in_a_veil(&dvr(&histogram([-1000.0, 1500.0], 2500, &peaks)), 0.0);
}

#[test]
fn a_small_body_is_as_opaque_as_a_large_one() {
    let histogram = ct(0.0, [-1024.0, 3071.0], None);
    let man = sound(&histogram, &desc(), Mode::Dvr);
    let mouse = VolumeDesc { spacing_mm: DVec3::splat(0.1), ..desc() };
    let mouse = sound(&histogram, &mouse, Mode::Dvr);
    assert!((depth(&man, 40.0, 100.0) / depth(&mouse, 40.0, 10.0) - 1.0).abs() < 1e-9);
}

/// A head in noise, and a few bright vessels and spikes that make the range.
fn mr(scale: f64) -> Histogram {
    let peaks = [
        peak(8.0, 4.0, 9e6, 3e5),
        peak(90.0, 20.0, 2e6, 4e3),
        peak(140.0, 20.0, 2e6, 4e3),
        peak(400.0, 50.0, 3e4, 0.0),
        peak(990.0, 3.0, 300.0, 0.0),
    ];
    let mut histogram = histogram([0.0, 1000.0], 1000, &peaks);
    histogram.range = histogram.range.map(|value| value * scale);
    histogram.span = histogram.range;
    histogram
}

#[test]
fn mr_is_a_head_without_a_cloud_of_noise() {
    let function = dvr(&mr(1.0));
    assert_eq!((function.at(8.0).1, function.at(18.0).1), (0.0, 0.0), "noise is clear");
    assert!(depth(&function, 90.0, 30.0) > 0.5, "tissue is seen");
    assert!(function.at(200.0).1 > 0.2 && function.points[4].value < 500.0, "outliers do not stretch it");
}

#[test]
fn the_scale_of_values_does_not_matter() {
    let shape = |function: &TransferFunction, scale: f64| -> Vec<(f64, f64)> {
        let rounded = |value: f64| (value * 1e6).round();
        function.points.iter().map(|point| (rounded(point.value / scale), rounded(point.opacity))).collect()
    };
    // Not with tissue at 1000: with air at 0 that is where a CT would have it.
    for scale in [1e-6, 1e-3, 40.0, 1e9] {
        assert_eq!(shape(&dvr(&mr(scale)), scale), shape(&dvr(&mr(1.0)), 1.0));
    }
}

#[test]
fn fluorescence_shows_what_is_sparse_and_bright_over_the_camera_s_offset() {
    let peaks = [peak(100.0, 3.0, 1e7, 3e5), peak(1200.0, 350.0, 8e4, 1e3), peak(3500.0, 300.0, 2e4, 0.0)];
    let function = dvr(&histogram([85.0, 4125.0], 4040, &peaks));
    assert_eq!(function.at(109.0).1, 0.0);
    assert!(function.at(1200.0).1 > 0.05 && function.at(3500.0).1 > 0.6);
}

#[test]
fn electron_microscopy_without_a_background_is_a_solid_block() {
    let peaks = [peak(150.0, 35.0, 9e6, 3e5), peak(70.0, 20.0, 1e6, 3e4)];
    let function = dvr(&bytes(&peaks));
    assert!([20.0, 70.0, 150.0, 250.0].into_iter().all(|value| function.at(value).1 > 0.5));
    assert!(function.at(70.0).0[0] < 0.5 && function.at(200.0).0[0] > 0.6, "in greys");
}

#[test]
fn a_dark_object_in_a_bright_background_is_shown() {
    let peaks = [peak(4000.0, 20.0, 9e6, 3e5), peak(2900.0, 60.0, 3e6, 4e3), peak(1500.0, 200.0, 3e5, 0.0)];
    let function = dvr(&histogram([-600.0, 4100.0], 4000, &peaks));
    assert_eq!((function.at(4000.0).1, function.at(3900.0).1), (0.0, 0.0));
    assert!(function.at(2900.0).1 > 0.05 && function.at(1500.0).1 > 0.5);
}

#[test]
fn values_saturated_at_255_are_shown() {
    let peaks = [peak(4.0, 1.5, 9e6, 3e5), peak(255.0, 0.1, 5e5, 5e3), peak(150.0, 60.0, 2e5, 3e3)];
    let function = dvr(&bytes(&peaks));
    assert!(function.at(10.0).1 == 0.0 && function.at(255.0).1 > 0.8);
}

#[test]
fn an_object_rarer_than_outliers_is_shown() {
    let peaks = [peak(0.0, 0.1, 1e7, 3e5), peak(200.0, 5.0, 500.0, 0.0)];
    let function = dvr(&bytes(&peaks));
    assert!(function.at(0.0).1 == 0.0 && function.at(200.0).1 > 0.5);
}

#[test]
fn labels_are_all_shown_and_each_in_its_colour() {
    let label = |label: u8| {
        peak(label.into(), 0.1, if label == 0 { 6e6 } else { 1e5 }, if label == 0 { 3e5 } else { 0.0 })
    };
    let mut histogram = histogram([-0.5, 29.5], 30, &(0..30).map(label).collect::<Vec<_>>());
    histogram.repeated_counts = histogram.counts.iter().map(|count| 0.9 * count).collect();
    let function = dvr(&histogram);
    assert_eq!(function.at(0.0).1, 0.0);
    assert!((1..30).all(|label| depth(&function, label.into(), 50.0) > 1.0));
    assert_ne!(function.at(1.0).0, function.at(2.0).0);
}

#[test]
fn masks_are_shown_either_way_round() {
    for (inside, outside) in [(1.0, 0.0), (0.0, 1.0)] {
        let peaks = [peak(outside, 0.1, 1e6, 1e5), peak(inside, 0.1, 1e5, 0.0)];
        let function = dvr(&histogram([-0.5, 1.5], 2, &peaks));
        assert!(function.at(outside).1 == 0.0 && function.at(inside).1 > 0.05);
    }
}

#[test]
fn values_about_zero_are_blue_below_and_red_above() {
    let peaks = [peak(0.0, 1e-4, 5e6, 2e5), peak(-3e-3, 6e-4, 1e6, 1e3), peak(2.5e-3, 5e-4, 1e6, 1e3)];
    let function = dvr(&histogram([-5e-3, 5e-3], 4096, &peaks));
    assert_eq!(function.at(0.0).1, 0.0);
    let ([low, high], least) = ([function.at(-4e-3), function.at(4e-3)], 0.1);
    assert!(low.1 > least && high.1 > least && low.0[2] > low.0[0] && high.0[0] > high.0[2]);
}

#[test]
fn noise_alone_is_a_block_and_one_value_a_box() {
    let noise = dvr(&histogram([50.0, 150.0], 4096, &[peak(100.0, 10.0, 1e6, 1e5)]));
    assert!(noise.at(100.0).1 > 0.5);
    for value in [0.0, 7.0, -1e30, f64::INFINITY] {
        let mut histogram = histogram([0.0, 1.0], 1, &[peak(0.5, 0.1, 1e3, 1e2)]);
        (histogram.range, histogram.span) = ([value; 2], [value; 2]);
        assert!(dvr(&histogram).points[0].opacity > 0.1);
    }
}

#[test]
fn what_was_never_written_is_not_shown() {
    let mut histogram = mr(1.0);
    histogram.range[1] = 1e38;
    let function = dvr(&histogram);
    assert!(function.at(1e6).1 == 0.0 && function.at(300.0).1 > 0.5);
}

#[test]
fn no_histogram_is_too_odd() {
    let all = [
        histogram([0.0, 1.0], 2, &[]),
        bytes(&[peak(0.0, 0.1, 1e6, 1e4)]),
        bytes(&[peak(255.0, 0.1, 1e6, 1e4)]),
        bytes(&[peak(100.0, 0.1, 1e6, 1e4)]),
        histogram([-1e38, 1e38], 4096, &[peak(0.0, 1e30, 1.0, 0.0)]),
        histogram([1e9, 1e9 + 1e-3], 4096, &[peak(1e9, 1e-4, 1e3, 1.0)]),
        histogram([-1e-30, 3e-30], 4096, &[peak(0.0, 1e-30, 1e3, 10.0)]),
        histogram([0.0, 255.0], 256, &[peak(255.0, 1.0, 1e3, 1e2), peak(0.0, 1.0, 1.0, 0.0)]),
        histogram([0.0, 65_535.0], 4096, &[peak(65_535.0, 0.1, 1.0, 0.0), peak(0.0, 0.1, 1e9, 1e7)]),
    ];
    let thin =
        VolumeDesc { extent: UVec3::new(4000, 3000, 1), spacing_mm: DVec3::new(1e-4, 1e-4, 10.0), ..desc() };
    for histogram in &all {
        dvr(histogram);
        for mode in Mode::ALL {
            sound(histogram, &thin, mode);
        }
    }
}

#[test]
fn projections_go_from_black_to_white_over_the_object_s_values() {
    let function = sound(&mr(1.0), &desc(), Mode::Mip);
    assert!(function.points.iter().all(|point| point.color == [1.0; 3]));
    assert!(function.at(5.0).1 < 0.01 && function.at(450.0).1 > 0.9);
    let minip = sound(&mr(1.0), &desc(), Mode::Minip);
    assert!(minip.at(0.0).1 > 0.0, "what surrounds the object is not quite black");
    let ct = sound(&ct(0.0, [-1024.0, 3071.0], None), &desc(), Mode::Mip);
    assert!(ct.at(-1000.0).1 == 0.0 && ct.at(40.0).1 < 0.1 && ct.at(1700.0).1 > 0.6);
}
