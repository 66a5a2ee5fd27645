/// A finished picture in linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    pub width: u32,
    pub height: u32,
    /// Premultiplied red, green, blue and alpha of each pixel, row 0 on top.
    pub rgba: Vec<[f32; 4]>,
    /// Depth along the camera's forward direction of what each pixel shows, +inf where it shows nothing.
    pub depth_mm: Vec<f32>,
}

impl Frame {
    /// A frame that shows nothing.
    pub fn transparent(width: u32, height: u32) -> Self {
        let pixels = width as usize * height as usize;
        Self { width, height, rgba: vec![[0.0; 4]; pixels], depth_mm: vec![f32::INFINITY; pixels] }
    }
}
