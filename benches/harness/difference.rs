use crate::Difference;

/// Of the pixels, this share may be further apart than [`Difference::largest`] says: those at edges and thresholds.
const LEFT_OUT: f64 = 1e-4;

/// How far two pictures of one size are apart.
pub fn difference(a: &[[f32; 4]], b: &[[f32; 4]]) -> Difference {
    let apart = |(a, b): (&[f32; 4], &[f32; 4])| {
        let channels = a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs()));
        channels.fold(0.0, f64::max)
    };
    let mut pixels: Vec<f64> = a.iter().zip(b).map(apart).collect();
    pixels.sort_unstable_by(f64::total_cmp);
    let channels = a.as_flattened().iter().zip(b.as_flattened());
    let sum: f64 = channels.map(|(a, b)| f64::from((a - b).abs())).sum();
    let left_out = (LEFT_OUT * pixels.len() as f64) as usize;
    Difference {
        largest: pixels.len().checked_sub(left_out + 1).map_or(0.0, |place| pixels[place]),
        maximum: pixels.last().copied().unwrap_or(0.0),
        mean: if a.is_empty() { 0.0 } else { sum / (4 * a.len()) as f64 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_pixel_in_ten_thousand_is_the_maximum_alone() {
        let (a, mut b) = (vec![[0.5; 4]; 10_000], vec![[0.5; 4]; 10_000]);
        assert_eq!(difference(&a, &b), Difference { largest: 0.0, maximum: 0.0, mean: 0.0 });
        b[7] = [0.5, 0.0, 0.5, 0.5];
        let one = difference(&a, &b);
        assert_eq!((one.largest, one.maximum), (0.0, 0.5));
        assert!((one.mean - 0.5 / 40_000.0).abs() < 1e-12);
        b[8] = [0.25, 0.5, 0.5, 0.5];
        assert_eq!(difference(&a, &b).largest, 0.25);
    }
}
