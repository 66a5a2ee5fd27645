"""A volume in pygfx, by its own materials and by a march that takes glassbrick's samples."""
import math

import numpy as np
import pygfx
import wgpu

from pygfx_composite import CompositeMaterial
from views import ENTRIES, baked

ISO_OPACITY_PER_MM = 0.25


def choose_adapter(software):
    """Makes pygfx draw by Vulkan, in software where asked for."""
    adapters = [a for a in wgpu.gpu.enumerate_adapters_sync() if a.info["backend_type"] == "Vulkan"]
    adapters = [a for a in adapters if (a.info["adapter_type"] == "CPU") == software]
    if not adapters:
        kind = "software" if software else "hardware"
        raise RuntimeError(f"there is no {kind} Vulkan driver (mesa-vulkan-drivers has one in software)")
    pygfx.renderers.wgpu.select_adapter(adapters[0])
    return f"{adapters[0].info['device']}, {adapters[0].info['description']}"


def own_step_voxels(extent):
    """What a pixel's march advances by in pygfx 0.17, in voxels whatever their spacing; no option changes it."""
    return min(max(math.sqrt(max(extent)) / 20, 0.1), 0.8)


def sampled_floats(voxels):
    """Voxels as what pygfx draws fastest, and that in words: 16-bit floats where they are as good as exact, 32-bit ones else.
    (Integers of 16 bits it interpolates by eight loads, which takes longer than either.)"""
    with np.errstate(over="ignore"):
        half = voxels.astype(np.float16)
    apart = max(float(np.abs(h.astype(np.float32) - v).max()) for h, v in zip(half, voxels))
    if apart <= np.ptp(voxels) / 1000:
        return half, "16-bit floats" + (f", rounded by up to {apart:g}" if apart else "")
    return voxels.astype(np.float32), "32-bit floats"


def iso_value(points):
    """The lowest value at which a transfer function reaches the opacity per mm of a surface, or None."""
    values, _, opacities = baked(points)
    reached = np.flatnonzero(opacities >= ISO_OPACITY_PER_MM)
    return float(values[reached[0]]) if len(reached) else None


def table(points, fourth):
    """A colour table with four columns, and the values at its ends, so that entries are at the centres of texels."""
    values, colors, opacities = baked(points)
    if fourth == "extinction":
        columns = np.column_stack([colors, -np.log(1 - np.minimum(opacities, 0.9999))])
    elif fourth == "opacity, in the colours":
        columns = np.column_stack([colors * opacities[:, None], np.ones(ENTRIES)])
    else:
        columns = np.column_stack([colors, np.ones(ENTRIES)])
    texture = pygfx.Texture(columns.astype(np.float32), dim=1, colorspace="physical")
    half = (values[1] - values[0]) / 2
    return {"map": pygfx.TextureMap(texture, filter="linear", wrap="clamp"), "clim": (values[0] - half, values[-1] + half)}


class Pygfx:
    """A volume, a camera and a picture's size. `own`: pygfx's own materials at its own step."""

    def __init__(self, voxels, spacing, direction, origin, camera, size, step_voxels, opacity_cutoff, software, own):
        self.driver = choose_adapter(software)
        self.own, self.opacity_cutoff, self.step_mm = own, opacity_cutoff, step_voxels * min(spacing)
        grid, self.stored_as = sampled_floats(voxels)
        # The world's origin is at the first voxel, for pygfx 0.17 leaves a volume's place out of the depths of its iso material.
        world_from_voxel = np.eye(4)
        world_from_voxel[:3, :3] = np.asarray(direction) * np.asarray(spacing)
        self.volume = pygfx.Volume(pygfx.Geometry(grid=pygfx.Texture(grid, dim=3)), None)
        self.volume.local.matrix = world_from_voxel
        self.scene = pygfx.Scene()
        self.scene.add(self.volume)
        self.camera = pygfx.PerspectiveCamera(camera.fov_y_deg, 1, depth_range=(camera.distance - 1.01 * camera.radius,
                                                                               camera.distance + 1.01 * camera.radius))
        self.camera.local.position = camera.eye - np.asarray(origin)
        self.camera.world.reference_up = camera.up
        self.camera.look_at(camera.target - np.asarray(origin))
        target = pygfx.Texture(dim=2, size=(size, size, 1), format="rgba8unorm")
        self.renderer = pygfx.WgpuRenderer(target, pixel_scale=1, ppaa="none", enable_events=False)

    def set_view(self, points, mode, shaded):
        """Says in words what is drawn for a view; raises LookupError where pygfx has nothing like it."""
        if not self.own:
            column = "extinction" if mode == "dvr" else "opacity, in the colours"
            self.volume.material = CompositeMaterial(self.step_mm, self.opacity_cutoff, mode, shaded, **table(points, column))
            return "march of ours" if mode == "dvr" else "MIP, samples of ours"
        if mode == "mip":
            self.volume.material = pygfx.VolumeMipMaterial(**table(points, "opacity, in the colours"))
            return "MIP"
        value = iso_value(points)
        if value is None:
            raise LookupError("has no compositing, and the view no surface for its iso material")
        self.volume.material = pygfx.VolumeIsoMaterial(threshold=value, **table(points, "none"))
        return f"iso at {value:.0f}, shaded"

    def draw(self):
        """Draws a frame, and returns its pixels, sRGB in bytes."""
        self.renderer.render(self.scene, self.camera)
        return self.renderer.snapshot()[..., :3]
