"""What every program is asked to draw: transfer functions, views, and the camera."""
import math

import numpy as np

WHITE = [1, 1, 1]

# Points are a value, an sRGB colour and an opacity per mm: glassbrick's `unit`, VTK's scalar opacity unit distance.
BONE = [(140, [0.43, 0.23, 0.16], 0.0), (260, [0.66, 0.4, 0.29], 0.06), (450, [0.87, 0.73, 0.56], 0.35),
        (900, [0.95, 0.89, 0.78], 0.75), (1800, [1, 0.98, 0.94], 0.95)]
SKIN = [(-250, [0.9, 0.7, 0.6], 0.0), (-100, [0.9, 0.7, 0.6], 0.6), (200, [1, 0.85, 0.75], 0.9)]
HAZE = [(-150, [0.8, 0.5, 0.4], 0.0), (50, [0.9, 0.6, 0.5], 0.004), (200, [1, 0.8, 0.6], 0.01),
        (1500, [1, 1, 0.9], 0.1)]
GREY = [(-1000, WHITE, 0.0), (1500, WHITE, 1.0)]

# Name, points, mode, shaded.
VIEWS = [("bone, opaque", BONE, "dvr", False), ("skin, opaque", SKIN, "dvr", False),
         ("haze, see-through", HAZE, "dvr", False), ("MIP", GREY, "mip", False),
         ("bone, shaded", BONE, "dvr", True)]

HALF_FOV = math.radians(15)
ENTRIES = 1024


def linear_from_srgb(colors):
    colors = np.asarray(colors, np.float64)
    return np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)


def srgb_from_linear(colors):
    colors = np.clip(colors, 0, 1)
    return np.where(colors <= 0.0031308, colors * 12.92, 1.055 * colors ** (1 / 2.4) - 0.055)


def baked(points):
    """The values, linear-light colours and opacities per mm of a transfer function's table, as glassbrick bakes it."""
    at, colors, opacities = (np.array(column, np.float64) for column in zip(*points))
    values = np.linspace(at[0], at[-1], ENTRIES)
    srgb = np.stack([np.interp(values, at, colors[:, channel]) for channel in range(3)], axis=1)
    return values, linear_from_srgb(srgb), np.interp(values, at, opacities)


class Camera:
    """glassbrick's default framing: the box of the voxels' faces, seen in perspective, from the front without angles."""

    def __init__(self, extent, spacing, direction, origin, zoom=1.0, azimuth=0.0, elevation=0.0):
        world_from_voxel = np.asarray(direction, np.float64) * np.asarray(spacing, np.float64)
        self.target = np.asarray(origin) + world_from_voxel @ ((np.asarray(extent) - 1) / 2)
        self.radius = math.hypot(*(n * s for n, s in zip(extent, spacing))) / 2
        self.distance = self.radius / math.sin(HALF_FOV)
        a, e = math.radians(azimuth), math.radians(elevation)
        towards_eye = np.array([math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e)])
        self.eye = self.target + self.distance * towards_eye
        self.up = [0, 0, 1] if abs(elevation) < 90 else [0, -math.copysign(1, elevation), 0]
        self.fov_y_deg = 2 * math.degrees(math.atan(math.tan(HALF_FOV) / zoom))
