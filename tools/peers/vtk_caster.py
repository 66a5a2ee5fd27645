"""A volume in VTK's ray casters, set up to draw what glassbrick draws."""
import numpy as np
import vtk
from vtk.util import numpy_support

IDENTITY = np.eye(3)


def world_about(origin, direction):
    """The matrix that turns a volume around its first voxel to its direction."""
    turn = np.eye(4)
    turn[:3, :3] = direction
    turn[:3, 3] = np.asarray(origin) - np.asarray(direction) @ np.asarray(origin)
    matrix = vtk.vtkMatrix4x4()
    matrix.DeepCopy(turn.ravel())
    return matrix


class Vtk:
    """A volume, a camera and a picture's size."""

    def __init__(self, voxels, spacing, origin, camera, size, direction=IDENTITY, step_voxels=1.0):
        image = vtk.vtkImageData()
        image.SetDimensions(*voxels.shape[::-1])
        image.SetSpacing(*spacing)
        image.SetOrigin(*origin)
        image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(np.ascontiguousarray(voxels).ravel(), deep=False))
        self.image, self.origin, self.direction = image, origin, direction
        self.camera, self.size, self.step_mm = camera, size, step_voxels * min(spacing)

    def cpu_mapper(self, threads):
        mapper = vtk.vtkFixedPointVolumeRayCastMapper()
        mapper.SetNumberOfThreads(threads)
        mapper.IntermixIntersectingGeometryOff()
        mapper.SetInteractiveSampleDistance(self.step_mm)
        return mapper

    def gpu_mapper(self):
        mapper = vtk.vtkOpenGLGPUVolumeRayCastMapper()
        mapper.UseJitteringOff()
        return mapper

    def window(self, mapper, points, mode, shaded):
        """A window off screen that draws the volume by control points of a value, a colour and an opacity per mm."""
        mapper.SetInputData(self.image)
        mapper.AutoAdjustSampleDistancesOff()
        mapper.SetSampleDistance(self.step_mm)
        mapper.SetImageSampleDistance(1)
        if mode == "mip":
            mapper.SetBlendModeToMaximumIntensity()
        properties = vtk.vtkVolumeProperty()
        opacity, color = vtk.vtkPiecewiseFunction(), vtk.vtkColorTransferFunction()
        for value, rgb, alpha in points:
            opacity.AddPoint(value, alpha)
            color.AddRGBPoint(value, *rgb)
        properties.SetScalarOpacity(opacity)
        properties.SetScalarOpacityUnitDistance(1.0)
        properties.SetColor(color)
        properties.SetInterpolationTypeToLinear()
        properties.SetShade(shaded)
        properties.SetAmbient(0.1)
        properties.SetDiffuse(0.9)
        properties.SetSpecular(0.2)
        properties.SetSpecularPower(10)
        volume = vtk.vtkVolume()
        volume.SetMapper(mapper)
        volume.SetProperty(properties)
        if not np.array_equal(self.direction, IDENTITY):
            volume.SetUserMatrix(world_about(self.origin, self.direction))
        renderer = vtk.vtkRenderer()
        renderer.AddVolume(volume)
        window = vtk.vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(self.size, self.size)
        window.AddRenderer(renderer)
        camera = renderer.GetActiveCamera()
        camera.SetFocalPoint(*self.camera.target)
        camera.SetPosition(*self.camera.eye)
        camera.SetViewUp(*self.camera.up)
        camera.SetViewAngle(self.camera.fov_y_deg)
        renderer.ResetCameraClippingRange()
        return window
