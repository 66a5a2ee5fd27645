"""Renderers of others as contestants, each in a process of its own: one that a driver ends takes nobody along."""
import multiprocessing
import os
import re
import tempfile
import time
from importlib.metadata import version

import numpy as np
import SimpleITK

from views import Camera, baked, linear_from_srgb


class Lost(Exception):
    """Why there is no picture, in one line."""


def one_line(text):
    """The last line of a message, without a terminal's colours, what a log puts before it, and a table's bars."""
    lines = [re.sub(r"\x1b\[\d+m", "", line).split("ERR|")[-1].strip() for line in text.splitlines()]
    return next((line.replace("|", "/") for line in reversed(lines) if line), "said nothing")


def load(path):
    """The image at a path, one number a voxel in three dimensions."""
    try:
        image = SimpleITK.ReadImage(path)
    except RuntimeError as error:
        raise Lost(f"{path}: SimpleITK can't read it: {one_line(str(error))}") from None
    if image.GetDimension() != 3 or image.GetNumberOfComponentsPerPixel() != 1:
        raise Lost(f"{path}: not a volume of one number a voxel")
    return image


class VtkGpu:
    """VTK's GPU mapper. Colours are given and taken in linear light."""

    def __init__(self, voxels, placing, camera, arguments, _cutoff):
        from vtk_caster import Vtk
        spacing, direction, origin = placing
        self.vtk = Vtk(voxels, spacing, origin, camera, arguments.size, direction, arguments.step)
        self.about = f"vtk {version('vtk')}"

    def set_view(self, points, mode, shaded):
        self.window = self.vtk.window(self.vtk.gpu_mapper(), list(zip(*baked(points))), mode, shaded)
        return ""

    def draw(self):
        import vtk
        from vtk.util import numpy_support
        self.window.Render()
        self.window.WaitForCompletion()
        size, pixels = self.vtk.size, vtk.vtkUnsignedCharArray()
        self.window.GetRGBACharPixelData(0, 0, size - 1, size - 1, 0, pixels)
        if "OpenGL" not in self.about:
            said = self.window.ReportCapabilities().splitlines()
            names = [line.split(":", 1)[1].strip() for line in said if line.startswith(("OpenGL renderer", "OpenGL version"))]
            self.about += f", OpenGL: {', '.join(names)}"
        return numpy_support.vtk_to_numpy(pixels).reshape(size, size, 4)[::-1, :, :3]

    @staticmethod
    def linear(pixels):
        return pixels / 255


class PygfxGpu:
    """pygfx, by its own materials or by a march that takes our samples."""

    def __init__(self, voxels, placing, camera, arguments, cutoff, own):
        from pygfx_caster import Pygfx, own_step_voxels
        self.pygfx = Pygfx(voxels, *placing, camera, arguments.size, arguments.step, cutoff, not arguments.hardware, own)
        step = f"{own_step_voxels(voxels.shape):.2g} voxels of its own" if own else "as asked for"
        self.about = (f"pygfx {version('pygfx')}, wgpu {version('wgpu')}, {self.pygfx.driver}; steps {step}; "
                      f"voxels as {self.pygfx.stored_as}")
        self.set_view, self.draw = self.pygfx.set_view, self.pygfx.draw

    @staticmethod
    def linear(pixels):
        return linear_from_srgb(pixels / 255)


KINDS = {"vtk": VtkGpu, "pygfx": lambda *rest: PygfxGpu(*rest, own=True), "pygfx-step": lambda *rest: PygfxGpu(*rest, own=False)}


def contestant_for(name, arguments, cutoff):
    image = load(arguments.volume)
    placing = image.GetSpacing(), np.reshape(image.GetDirection(), (3, 3)), image.GetOrigin()
    camera = Camera(image.GetSize(), *placing, arguments.zoom, arguments.azimuth, arguments.elevation)
    return KINDS[name](SimpleITK.GetArrayFromImage(image), placing, camera, arguments, cutoff)


def draw_frames(contestant, count):
    """Milliseconds of each frame, and the last one in linear light."""
    times = []
    for _ in range(count + 1):
        start = time.perf_counter()
        pixels = contestant.draw()
        times.append((time.perf_counter() - start) * 1e3)
    return times, contestant.linear(pixels)


def serve(pipe, log, name, arguments, cutoff):
    """Draws what the pipe asks for. What libraries and drivers print goes to the log."""
    log = os.open(log, os.O_WRONLY | os.O_APPEND)
    os.dup2(log, 1)
    os.dup2(log, 2)
    try:
        contestant, shown = contestant_for(name, arguments, cutoff), None
        while True:
            view, count = pipe.recv()
            try:
                if view != shown:
                    words, shown = contestant.set_view(*view[1:]), view
            except LookupError as error:
                pipe.send(Lost(error.args[0]))
                continue
            times, picture = draw_frames(contestant, count)
            pipe.send((words, times, picture, contestant.about))
    except EOFError:
        return
    except ModuleNotFoundError as error:
        pipe.send(f"needs {error.name}: pip install {error.name}")
    except Exception as error:
        pipe.send(one_line(str(error) or type(error).__name__))


class Peer:
    """A contestant's process, started when it first draws, and again where it ended."""

    def __init__(self, name, arguments, cutoff):
        self.name, self.arguments, self.cutoff, self.about, self.process = name, arguments, cutoff, None, None

    def start(self):
        self.log = tempfile.NamedTemporaryFile()
        self.pipe, theirs = multiprocessing.Pipe()
        self.process = multiprocessing.Process(target=serve, args=(theirs, self.log.name, self.name, self.arguments, self.cutoff),
                                               daemon=True)
        self.process.start()
        theirs.close()

    def stop(self):
        if self.process:
            self.process.kill()
            self.process.join()
            self.process = None

    def frames(self, view, count):
        """What is drawn, milliseconds of each frame (the first not yet warm), and the last picture."""
        if not self.process:
            self.start()
        try:
            self.pipe.send((view, count))
            answer = self.pipe.recv() if self.pipe.poll(self.arguments.limit) else f"took longer than {self.arguments.limit:g} s"
        except (EOFError, OSError):
            self.process.join(10)
            answer = f"its process ended ({self.process.exitcode}){self.said()}"
        if isinstance(answer, Lost):
            raise answer
        if isinstance(answer, str):
            self.stop()
            raise Lost(answer)
        words, times, picture, self.about = answer
        said = self.said()
        if not picture.any():
            raise Lost(f"drew nothing{said}")
        return f"{words}{said}".strip(), times, picture

    def said(self):
        """The last error that its libraries have printed since this was asked for."""
        lines = self.log.read().decode(errors="replace").splitlines()
        errors = [line for line in lines if "error" in line.lower() or "ERR|" in line]
        return f" (it said: {one_line(errors[-1])})" if errors else ""
