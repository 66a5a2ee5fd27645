use std::mem::MaybeUninit;

use glassbrick_volume::Frame;
use rayon::prelude::*;

/// A frame whose rows of pixels and depths are made by the threads that draw them: so many `together` are handed out as one
/// transparent slice, with the number of the first. Where one thread makes all rows first, the others wait for it, a twentieth
/// of the time of a frame of few milliseconds.
pub fn draw_rows<E: Send>(
    [width, height]: [u32; 2],
    together: usize,
    draw: impl Fn(usize, &mut [[f32; 4]], &mut [f32]) -> Result<(), E> + Sync,
) -> Result<Frame, E> {
    let fill = |colors: &mut [MaybeUninit<[f32; 4]>], depths: &mut [MaybeUninit<f32>]| {
        let colors = colors.par_chunks_mut(together * width as usize);
        let depths = depths.par_chunks_mut(together * width as usize);
        // One by one: some rows take long, and others no time.
        colors.zip(depths).enumerate().with_max_len(1).try_for_each(|(place, (colors, depths))| {
            draw(place * together, filled(colors, [0.0; 4]), filled(depths, f32::INFINITY))
        })
    };
    // SAFETY: rows have no pixel left over, and every one of them is filled.
    unsafe { frame(width, height, fill) }
}

/// The same where what is drawn are columns of the picture, so many `together` one behind the other: `width` and `height` are those of
/// the picture on its side, so that it has `width` rows.
pub fn draw_columns<E: Send>(
    [width, height]: [u32; 2],
    together: usize,
    draw: impl Fn(usize, &mut [[f32; 4]], &mut [f32]) -> Result<(), E> + Sync,
) -> Result<Frame, E> {
    let (rows, columns) = (width as usize, height as usize);
    let fill = |colors: &mut [MaybeUninit<[f32; 4]>], depths: &mut [MaybeUninit<f32>]| {
        let bands = bands(colors, columns, together).into_par_iter().zip(bands(depths, columns, together));
        bands.enumerate().with_max_len(1).try_for_each(|(place, (colors, depths))| {
            let drawn = rows * colors[0].len();
            let (mut drawn_colors, mut drawn_depths) = (vec![[0.0; 4]; drawn], vec![f32::INFINITY; drawn]);
            draw(place * together, &mut drawn_colors, &mut drawn_depths)?;
            put(&drawn_colors, colors);
            put(&drawn_depths, depths);
            Ok(())
        })
    };
    // SAFETY: bands have no pixel left over, and every one of them is put there.
    unsafe { frame(height, width, fill) }
}

/// A frame whose pixels and depths `fill` writes.
///
/// # Safety
/// It writes all of them, unless it fails.
unsafe fn frame<E>(
    width: u32,
    height: u32,
    fill: impl FnOnce(&mut [MaybeUninit<[f32; 4]>], &mut [MaybeUninit<f32>]) -> Result<(), E>,
) -> Result<Frame, E> {
    let pixels = width as usize * height as usize;
    let (mut rgba, mut depth_mm) = (Vec::with_capacity(pixels), Vec::with_capacity(pixels));
    fill(&mut rgba.spare_capacity_mut()[..pixels], &mut depth_mm.spare_capacity_mut()[..pixels])?;
    // SAFETY: the caller's promise.
    unsafe {
        rgba.set_len(pixels);
        depth_mm.set_len(pixels);
    }
    Ok(Frame { width, height, rgba, depth_mm })
}

/// Cuts rows of `columns` into bands of so many columns `together`: each is its part of every row.
fn bands<T>(items: &mut [T], columns: usize, together: usize) -> Vec<Vec<&mut [T]>> {
    let mut bands: Vec<Vec<&mut [T]>> = (0..columns.div_ceil(together)).map(|_| Vec::new()).collect();
    for row in items.chunks_exact_mut(columns) {
        for (band, part) in bands.iter_mut().zip(row.chunks_mut(together)) {
            band.push(part);
        }
    }
    bands
}

/// Puts columns, one behind the other, into the rows of a band.
fn put<T: Copy>(columns: &[T], band: Vec<&mut [MaybeUninit<T>]>) {
    let height = band.len();
    for (row, items) in band.into_iter().enumerate() {
        for (column, item) in items.iter_mut().enumerate() {
            item.write(columns[column * height + row]);
        }
    }
}

fn filled<T: Copy>(items: &mut [MaybeUninit<T>], item: T) -> &mut [T] {
    for place in &mut *items {
        place.write(item);
    }
    // SAFETY: each was written.
    unsafe { items.assume_init_mut() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_transparent_but_for_what_is_drawn() {
        let frame = draw_rows([3, 2], 1, |row, rgba, depth_mm| {
            (rgba[row], depth_mm[row]) = ([1.0; 4], 7.0);
            Ok::<(), ()>(())
        });
        let frame = frame.expect("no row fails");
        let (clear, drawn) = ([0.0; 4], [1.0; 4]);
        assert_eq!(frame.rgba, [drawn, clear, clear, clear, drawn, clear]);
        let far = f32::INFINITY;
        assert_eq!(frame.depth_mm, [7.0, far, far, far, 7.0, far]);
    }

    #[test]
    fn rows_that_are_drawn_together_lie_one_behind_the_other() {
        let frame = draw_rows([2, 5], 2, |first, rgba, depth_mm| {
            for (row, depths) in (first..).zip(depth_mm.chunks_mut(2)) {
                depths.fill(row as f32);
            }
            assert_eq!(rgba.len(), depth_mm.len());
            Ok::<(), ()>(())
        });
        let depths = frame.expect("no row fails").depth_mm;
        assert_eq!(
            depths,
            [0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0],
            "the last has no other with it"
        );
    }

    #[test]
    fn columns_that_are_drawn_stand_side_by_side() {
        let frame = draw_columns([2, 5], 2, |first, rgba, depth_mm| {
            for (column, depths) in (first..).zip(depth_mm.chunks_mut(2)) {
                depths.copy_from_slice(&[column as f32, 10.0 + column as f32]);
            }
            rgba[0] = [1.0; 4];
            Ok::<(), ()>(())
        });
        let frame = frame.expect("no column fails");
        assert_eq!((frame.width, frame.height), (5, 2));
        assert_eq!(frame.depth_mm, [0.0, 1.0, 2.0, 3.0, 4.0, 10.0, 11.0, 12.0, 13.0, 14.0]);
        let (clear, drawn) = ([0.0; 4], [1.0; 4]);
        assert_eq!(frame.rgba[..5], [drawn, clear, drawn, clear, drawn]);
        assert_eq!(frame.rgba[5..], [clear; 5]);
    }

    #[test]
    fn a_row_that_fails_leaves_no_frame() {
        assert_eq!(draw_rows([3, 9], 1, |row, _, _| if row == 4 { Err(row) } else { Ok(()) }).err(), Some(4));
    }
}
