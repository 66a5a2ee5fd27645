use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

const REDRAW: Duration = Duration::from_millis(100);

/// A line on the terminal that tells how far long work is, and is gone with it; nothing where stderr is no terminal.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// Work of unknown length.
    pub fn start(what: &'static str) -> Self {
        let bar = ProgressBar::new_spinner().with_message(what);
        if !bar.is_hidden() {
            bar.enable_steady_tick(REDRAW);
        }
        Self { bar }
    }

    /// How many bytes of how many are done.
    pub fn bytes(&self, done: u64, total: u64) {
        self.set(done, total, "{msg} {wide_bar} {binary_bytes}/{binary_total_bytes}, {eta} left");
    }

    /// How many bytes of how many are done, and how fast.
    pub fn rate(&self, done: u64, total: u64) {
        let template =
            "{msg} {wide_bar} {binary_bytes}/{binary_total_bytes}, {binary_bytes_per_sec}, {eta} left";
        self.set(done, total, template);
    }

    /// How many pieces of how many are done.
    pub fn pieces(&self, done: u64, total: u64) {
        self.set(done, total, "{msg} {wide_bar} {pos}/{len}, {eta} left");
    }

    /// What is being done now.
    pub fn on(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// Which share is done, from 0 to 1.
    pub fn share(&self, done: f32) {
        self.set((f64::from(done) * 1000.0) as u64, 1000, "{msg} {wide_bar} {percent} %, {eta} left");
    }

    fn set(&self, done: u64, total: u64, template: &str) {
        if self.bar.is_hidden() {
            return;
        }
        if self.bar.length().is_none() {
            self.bar.set_length(total);
            self.bar
                .set_style(ProgressStyle::with_template(template).expect("the templates above are sound"));
        }
        self.bar.set_position(done);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
