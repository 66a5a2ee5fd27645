"""A march of ours inside pygfx, which has no compositing of its own. Its box, volume sampler, colour table and maximum are
pygfx's; the samples are those that glassbrick takes, on planes a step apart, and rays stop at an opacity as glassbrick's do."""
import re

from pygfx.materials import VolumeRayMaterial
from pygfx.objects import Volume
from pygfx.renderers.wgpu import register_wgpu_render_function
from pygfx.renderers.wgpu.shaders.volumeshader import VolumeRayShader

SAMPLES = """
    let view_from_data = u_stdinfo.cam_transform * u_wobject.world_transform;
    let depth_per_voxel = -(view_from_data * vec4<f32>(view_ray, 0.0)).z;
    let front_depth = -(view_from_data * vec4<f32>(front_pos, 1.0)).z;
    let first = (ceil(front_depth / STEP_MM - 0.5) + 0.5) * STEP_MM;
    let first_pos = front_pos + view_ray * ((first - front_depth) / depth_per_voxel);
    let step_pos = view_ray * (STEP_MM / depth_per_voxel);
    let nsteps = i32(floor(dot(back_pos - first_pos, view_ray) / length(step_pos))) + 1;
    if (nsteps < 1) { discard; }
    let start_coord = (first_pos + vec3<f32>(0.5)) / sizef;
    let step_coord = step_pos / sizef;
"""

COMPOSITE = """
    fn shaded(color: vec3<f32>, coord: vec3<f32>, sizef: vec3<f32>, step_coord: vec3<f32>) -> vec3<f32> {
        let dx = vec3<f32>(1.0 / sizef.x, 0.0, 0.0);
        let dy = vec3<f32>(0.0, 1.0 / sizef.y, 0.0);
        let dz = vec3<f32>(0.0, 0.0, 1.0 / sizef.z);
        let gradient = vec3<f32>(
            sample_vol(coord + dx, sizef).r - sample_vol(coord - dx, sizef).r,
            sample_vol(coord + dy, sizef).r - sample_vol(coord - dy, sizef).r,
            sample_vol(coord + dz, sizef).r - sample_vol(coord - dz, sizef).r);
        let normal = (vec4<f32>(gradient, 0.0) * u_wobject.world_transform_inv).xyz;
        if (dot(normal, normal) == 0.0) { return color; }
        let light = (u_wobject.world_transform * vec4<f32>(-step_coord * sizef, 0.0)).xyz;
        let cosine = abs(dot(normalize(normal), normalize(light)));
        return color * (0.1 + 0.9 * cosine) + 0.2 * pow(cosine, 10.0);
    }

    fn raycast(sizef: vec3<f32>, nsteps: i32, start_coord: vec3<f32>, step_coord: vec3<f32>) -> RenderOutput {
        let world_step = (u_wobject.world_transform * vec4<f32>(step_coord * sizef, 0.0)).xyz;
        let step_mm = length(world_step);
        var color = vec3<f32>(0.0);
        var alpha = 0.0;
        for (var iter = 0; iter < nsteps; iter = iter + 1) {
            let coord = start_coord + f32(iter) * step_coord;
            // The table's alpha is extinction.
            let seen = sample_colormap(sample_vol(coord, sizef).r);
            if (seen.a > 0.0) {
                let weight = (1.0 - alpha) * (1.0 - exp(-seen.a * step_mm));
                color += weight * SHADE;
                alpha += weight;
                if (alpha >= OPACITY_CUTOFF) { break; }
            }
        }
        var out: RenderOutput;
        out.color = vec4<f32>(color, 1.0);
        out.coord = start_coord;
        out.depth = 0.5;
        return out;
    }
"""


class CompositeMaterial(VolumeRayMaterial):
    """Emission and absorption, or the maximum, at samples a step apart."""

    def __init__(self, step_mm, opacity_cutoff, mode, shaded, **kwargs):
        super().__init__(**kwargs)
        self.step_mm, self.opacity_cutoff, self.shaded = step_mm, opacity_cutoff, shaded
        self.render_mode = {"dvr": "composite", "mip": "mip"}[mode]


@register_wgpu_render_function(Volume, CompositeMaterial)
class CompositeShader(VolumeRayShader):
    def __init__(self, wobject):
        super().__init__(wobject)
        material = wobject.material
        # What differs between materials stands in the shader's variables too, for shaders are kept by them.
        self["step_mm"], self["opacity_cutoff"], self["shaded"] = material.step_mm, material.opacity_cutoff, material.shaded

    def get_code(self):
        code = super().get_code()
        shade = "shaded(seen.rgb, coord, sizef, step_coord)" if self["shaded"] else "seen.rgb"
        march = COMPOSITE.replace("SHADE", shade).replace("OPACITY_CUTOFF", str(float(self["opacity_cutoff"])))
        samples = SAMPLES.replace("STEP_MM", str(float(self["step_mm"])))
        code, steps = re.subn(r"let nsteps = .*?let step_coord = [^;]*;", lambda _: samples, code, count=1, flags=re.DOTALL)
        before = "$$ elif mode == 'minip'"
        if not steps or before not in code:
            raise RuntimeError("this pygfx marches by a shader that this script doesn't know; it was written for pygfx 0.17")
        return code.replace(before, f"$$ elif mode == 'composite'\n{march}\n{before}", 1)
