#define_import_path glassbrick::light
#import glassbrick::frame::frame
#import glassbrick::rays::Ray

// Light from the eye on surfaces (Phong 1975): the shaded colour. A zero gradient leaves the colour as it is.
fn shade(color: vec3f, gradient: vec3f, ray: Ray) -> vec3f {
    let normal_length = length(frame.normal_from_gradient * gradient);
    if normal_length == 0.0 {
        return color;
    }
    // n·l without leaving voxel space: the gradient along the ray is the same in every space.
    let n_dot_l = min(abs(dot(gradient, ray.step)) / (normal_length * ray.step_length_mm), 1.0);
    let specular = select(frame.phong.z * pow(n_dot_l, frame.phong.w), 0.0, n_dot_l == 0.0);
    return color * (frame.phong.x + frame.phong.y * n_dot_l) + specular;
}
