use std::ops::Range;

use glam::Vec3;
use glassbrick_volume::Ray;

/// The sample numbers below `count` of a ray that lie in the half-open box [low, high).
///
/// Positions along a ray are monotone on each axis, in `f32` too, so the samples in a box follow one another.
pub fn samples_in_box(ray: &Ray, [low, high]: [Vec3; 2], count: u32) -> Range<u32> {
    let (mut first, mut end) = (0, count);
    for axis in 0..3 {
        let along = Axis { start: ray.start[axis], step: ray.step[axis] };
        let (low, high) = (low[axis], high[axis]);
        let (enter, leave) = if along.step > 0.0 {
            (along.first(count, low, |q| q >= low), along.first(count, high, |q| q >= high))
        } else if along.step < 0.0 {
            (along.first(count, high, |q| q < high), along.first(count, low, |q| q < low))
        } else if (low..high).contains(&along.start) {
            continue;
        } else {
            return 0..0;
        };
        first = first.max(enter);
        end = end.min(leave);
        if first >= end {
            return 0..0;
        }
    }
    first..end
}

#[derive(Clone, Copy)]
struct Axis {
    start: f32,
    step: f32,
}

impl Axis {
    fn at(self, number: u32) -> f32 {
        self.start + number as f32 * self.step
    }

    /// The first number up to `count` from which on `passed` holds, found from an estimate of where `bound` is met.
    fn first(self, count: u32, bound: f32, passed: impl Fn(f32) -> bool) -> u32 {
        let estimate = ((bound - self.start) / self.step).clamp(0.0, count as f32) as u32;
        // The estimate is almost always off by less than two.
        let low = estimate.saturating_sub(1);
        let high = (estimate + 2).min(count);
        let low_is_before = low == 0 || !passed(self.at(low - 1));
        let high_is_after = high == count || passed(self.at(high));
        if low_is_before && high_is_after {
            (low..high).find(|&number| passed(self.at(number))).unwrap_or(high)
        } else {
            self.search(count, passed)
        }
    }

    fn search(self, count: u32, passed: impl Fn(f32) -> bool) -> u32 {
        let (mut low, mut high) = (0, count);
        while low < high {
            let middle = low + (high - low) / 2;
            if passed(self.at(middle)) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_holds_exactly_the_samples_in_the_box() {
        let steps = [0.0, 1e-9, -1e-9, 0.013, -0.4, 1.0, -1.7, 3e-7];
        let starts = [-0.5, -0.501, 59.5, 59.500_004, 12.25, 140.0, -30.0];
        let bounds = [Vec3::splat(-0.5), Vec3::splat(59.5)];
        for start in starts {
            for x in steps {
                for y in [0.0, 0.31, -0.2] {
                    let ray = Ray {
                        start: Vec3::new(start, 20.0, 59.0),
                        step: Vec3::new(x, y, 0.0),
                        step_length_mm: 1.0,
                    };
                    let inside = |number: &u32| {
                        let q = ray.sample(*number);
                        q.cmpge(bounds[0]).all() && q.cmplt(bounds[1]).all()
                    };
                    let by_hand: Vec<u32> = (0..300).filter(inside).collect();
                    let found: Vec<u32> = samples_in_box(&ray, bounds, 300).collect();
                    assert_eq!(found, by_hand, "start {start}, step {x} {y}");
                }
            }
        }
    }
}
