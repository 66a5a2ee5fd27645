/// Pixels along a side of a picture, at most.
const MOST_PIXELS: u32 = 32_768;

/// Reads `N` finite numbers with commas between, such as `1,-2.5,0`.
pub fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let read = |word: &str| word.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let list: Option<Vec<f64>> = text.split(',').map(read).collect();
    list.and_then(|list| <[f64; N]>::try_from(list).ok())
        .ok_or_else(|| format!("{N} numbers with commas between are wanted, such as {}", example(N)))
}

fn example(count: usize) -> &'static str {
    if count == 2 { "1,-1024" } else { "1,-2.5,0" }
}

/// Reads a finite number.
pub fn number(text: &str) -> Result<f64, String> {
    numbers(text).map(|[number]: [f64; 1]| number).map_err(|_| "a number is wanted".to_owned())
}

/// Reads three positive lengths.
pub fn spacing(text: &str) -> Result<[f64; 3], String> {
    numbers(text)
        .ok()
        .filter(|spacing: &[f64; 3]| spacing.iter().all(|&mm| mm > 0.0))
        .ok_or_else(|| "three positive lengths in mm are wanted, such as 0.7,0.7,1.25".to_owned())
}

/// Reads a slope, which is not zero, and an intercept.
pub fn rescale(text: &str) -> Result<[f64; 2], String> {
    numbers(text)
        .ok()
        .filter(|[slope, _]: &[f64; 2]| *slope != 0.0)
        .ok_or_else(|| "a slope that is not zero and an intercept are wanted, such as 1,-1024".to_owned())
}

/// Reads a finite number above zero.
pub fn positive(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|number: &f64| number.is_finite() && *number > 0.0)
        .ok_or_else(|| "a number above 0 is wanted".to_owned())
}

/// Reads a number from 0 to 1.
pub fn fraction(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|number| (0.0..=1.0).contains(number))
        .ok_or_else(|| "a number from 0 to 1 is wanted".to_owned())
}

/// Reads a share from 0 up: a number such as 0.1, or in percent.
pub fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = text.strip_suffix('%').map_or((text, 1.0), |percent| (percent.trim_end(), 100.0));
    number
        .parse()
        .ok()
        .filter(|number: &f64| number.is_finite() && *number >= 0.0)
        .map(|number| number / unit)
        .ok_or_else(|| "a share is wanted, such as 0.1 or 10%".to_owned())
}

/// Reads a number above 0, up to 1.
pub fn opacity_cutoff(text: &str) -> Result<f64, String> {
    fraction(text)
        .ok()
        .filter(|cutoff| *cutoff > 0.0)
        .ok_or_else(|| "a number above 0 and up to 1 is wanted, where 1 never stops a ray".to_owned())
}

/// Reads `WxH` in pixels.
pub fn picture_size(text: &str) -> Result<[u32; 2], String> {
    whole_numbers(text).filter(|size| size.iter().all(|&pixels| pixels <= MOST_PIXELS)).ok_or_else(|| {
        format!("width x height in pixels are wanted, 1 to {MOST_PIXELS} each, such as 640x480")
    })
}

/// Reads `NXxNYxNZ` in voxels.
pub fn extent(text: &str) -> Result<[u32; 3], String> {
    whole_numbers(text)
        .ok_or_else(|| "three numbers of voxels above 0 are wanted, such as 512x304x1730".to_owned())
}

/// `N` whole numbers above zero with an x between.
fn whole_numbers<const N: usize>(text: &str) -> Option<[u32; N]> {
    let list: Option<Vec<u32>> =
        text.split(['x', 'X']).map(|word| word.parse().ok().filter(|&number| number > 0)).collect();
    list?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_take_negative_numbers_and_spaces() {
        assert_eq!(numbers::<3>("-10,0,5"), Ok([-10.0, 0.0, 5.0]));
        assert_eq!(numbers::<2>(" 0.5, -1e3"), Ok([0.5, -1000.0]));
    }

    #[test]
    fn lists_of_another_length_or_of_words_are_refused() {
        for text in ["", "1", "1,2", "1,2,3,4", "1,2,", "a,b,c", "1;2;3", "1,2,nan", "inf,0,0", "1e999,0,0"] {
            assert!(numbers::<3>(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_and_extents_are_whole_and_above_zero() {
        assert_eq!(picture_size("640x480"), Ok([640, 480]));
        assert_eq!(extent("512x304x1730"), Ok([512, 304, 1730]));
        for text in
            ["", "640", "640x", "640x480x2", "0x480", "-1x2", "1.5x2", "640*480", "32769x1", "9999999999x1"]
        {
            assert!(picture_size(text).is_err(), "{text}");
        }
        assert!(extent("1x2").is_err());
    }

    #[test]
    fn bounds_are_kept() {
        assert_eq!((fraction("0"), fraction("1")), (Ok(0.0), Ok(1.0)));
        assert!(fraction("1.01").is_err() && fraction("-0.1").is_err() && fraction("nan").is_err());
        assert_eq!((share("0.1"), share("10%"), share("5 %")), (Ok(0.1), Ok(0.1), Ok(0.05)));
        assert!(share("-1%").is_err() && share("%").is_err() && share("nan").is_err());
        assert!(opacity_cutoff("0").is_err() && opacity_cutoff("1").is_ok());
        assert!(positive("0").is_err() && positive("inf").is_err() && positive("2").is_ok());
        assert!(rescale("0,1").is_err() && rescale("-1,0").is_ok());
        assert!(spacing("1,1,0").is_err() && spacing("1,-1,1").is_err());
    }
}
