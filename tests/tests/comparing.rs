//! Pictures are compared as the agreement table says.

use glassbrick_tests::tolerance::{CPU, compare};

#[test]
fn one_pixel_in_10_000_may_be_far_off_and_no_second() {
    let reference = vec![[0.25; 4]; 10_000];
    let mut frame = vec![[0.25; 4]; 10_000];
    frame[17][2] = 0.75;
    frame[18] = [0.25 + 1.0 / 1024.0; 4];
    let difference = compare(&frame, &reference);
    assert_eq!(difference.largest_all_but_0_01_percent, 1.0 / 1024.0);
    assert_eq!(difference.mean, (0.5 + 1.0 / 1024.0) / 10_000.0);
    assert!(!difference.is_within(CPU), "the mean is too large: {difference}");
    frame[19][3] = 0.0;
    assert_eq!(compare(&frame, &reference).largest_all_but_0_01_percent, 0.25);
}

#[test]
fn in_a_small_picture_every_pixel_counts() {
    let mut frame = [[0.0; 4]; 9_999];
    frame[0][0] = 0.5;
    assert_eq!(compare(&frame, &[[0.0; 4]; 9_999]).largest_all_but_0_01_percent, 0.5);
}

#[test]
fn a_pixel_that_is_not_a_number_is_infinitely_far_off() {
    for channel in [f32::NAN, f32::INFINITY] {
        let difference = compare(&[[0.0, channel, 0.0, 0.0]], &[[0.0; 4]]);
        assert_eq!(
            (difference.largest_all_but_0_01_percent, difference.mean),
            (f64::INFINITY, f64::INFINITY)
        );
    }
}
