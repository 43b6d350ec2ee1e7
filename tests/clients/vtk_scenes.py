"""Scenes of VTK's POV exporter, rendered as the comment at the top of each says: `povray NAME.pov +W320 +H240`."""

import math
import os
import re

import vtk

import calls


def actor_of(source, colour=(0.8, 0.8, 0.8), normals=False):
    port = source.GetOutputPort()
    if normals:
        smooth = vtk.vtkPolyDataNormals()
        smooth.SetInputConnection(port)
        port = smooth.GetOutputPort()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(port)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    return actor


def scalars_of(source, function):
    """The data of a source with a scalar at every point, which VTK's tables make colours."""
    source.Update()
    data = vtk.vtkPolyData()
    data.DeepCopy(source.GetOutput())
    values = vtk.vtkFloatArray()
    for i in range(data.GetNumberOfPoints()):
        values.InsertNextValue(function(*data.GetPoint(i)))
    data.GetPointData().SetScalars(values)
    return data


def sphere():
    source = vtk.vtkSphereSource()
    source.SetThetaResolution(24)
    source.SetPhiResolution(16)
    return [actor_of(source, (0.9, 0.4, 0.2))]


def flat():
    source = vtk.vtkCubeSource()
    actor = actor_of(source, (0.3, 0.6, 0.9))
    actor.GetProperty().SetInterpolationToFlat()
    actor.RotateX(25)
    actor.RotateY(35)
    return [actor]


def cone():
    source = vtk.vtkConeSource()
    source.SetResolution(20)
    actor = actor_of(source, (0.2, 0.8, 0.3))
    actor.GetProperty().SetSpecular(0.8)
    actor.GetProperty().SetSpecularPower(30)
    actor.RotateZ(40)
    return [actor]


def clear():
    """A translucent shell around another shape."""
    shell, core = sphere()[0], flat()[0]
    shell.GetProperty().SetOpacity(0.35)
    core.SetScale(0.5)
    return [core, shell]


def scalars():
    source = vtk.vtkPlaneSource()
    source.SetResolution(24, 24)
    hills = vtk.vtkWarpScalar()
    hills.SetInputData(scalars_of(source, lambda x, y, z: 0.15 * math.sin(9 * x) * math.cos(7 * y)))
    actor = actor_of(hills)
    actor.GetMapper().SetScalarRange(-0.15, 0.15)
    actor.RotateX(-60)
    return [actor]


def contour():
    """An isosurface of a sampled quadric."""
    quadric = vtk.vtkQuadric()
    quadric.SetCoefficients(0.5, 1, 0.2, 0, 0.1, 0, 0, 0.2, 0, 0)
    sample = vtk.vtkSampleFunction()
    sample.SetSampleDimensions(20, 20, 20)
    sample.SetImplicitFunction(quadric)
    surface = vtk.vtkContourFilter()
    surface.SetInputConnection(sample.GetOutputPort())
    surface.GenerateValues(3, 0.2, 1.0)
    actor = actor_of(surface)
    actor.GetMapper().SetScalarRange(0.1, 1.1)
    actor.RotateY(30)
    return [actor]


def strips():
    """A cylinder of triangle strips."""
    source = vtk.vtkCylinderSource()
    source.SetResolution(30)
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(source.GetOutputPort())
    stripper = vtk.vtkStripper()
    stripper.SetInputConnection(triangles.GetOutputPort())
    actor = actor_of(stripper, (0.7, 0.3, 0.7))
    actor.RotateX(50)
    return [actor]


def tubes():
    """A line that winds, with a tube around it."""
    points, line = vtk.vtkPoints(), vtk.vtkCellArray()
    line.InsertNextCell(60)
    for i in range(60):
        points.InsertNextPoint(0.5 * math.cos(0.3 * i), 0.5 * math.sin(0.3 * i), 0.03 * i - 0.9)
        line.InsertCellPoint(i)
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetLines(line)
    tube = vtk.vtkTubeFilter()
    tube.SetInputData(data)
    tube.SetRadius(0.08)
    tube.SetNumberOfSides(12)
    actor = actor_of(tube, (0.9, 0.8, 0.1))
    actor.RotateX(65)
    return [actor]


def glyphs():
    """An arrow at every point of a sphere."""
    points = vtk.vtkSphereSource()
    points.SetThetaResolution(10)
    points.SetPhiResolution(8)
    arrow = vtk.vtkArrowSource()
    glyph = vtk.vtkGlyph3D()
    glyph.SetInputConnection(points.GetOutputPort())
    glyph.SetSourceConnection(arrow.GetOutputPort())
    glyph.SetVectorModeToUseNormal()
    glyph.SetScaleFactor(0.25)
    return [actor_of(glyph, (0.5, 0.7, 1.0))]


def quads():
    """Cells with four corners and a superquadric of many."""
    source = vtk.vtkSuperquadricSource()
    source.SetPhiRoundness(0.4)
    source.SetThetaRoundness(1.6)
    source.ToroidalOn()
    source.SetThetaResolution(32)
    actor = actor_of(source, (0.9, 0.9, 0.9), normals=True)
    actor.RotateX(60)
    return [actor]


def render(name, actors, change=None):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0.1, 0.2, 0.3)
    for actor in actors:
        renderer.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.AddRenderer(renderer)
    window.SetSize(240, 180)
    if change:
        change(renderer)
    renderer.ResetCamera()
    window.Render()
    exporter = vtk.vtkPOVExporter()
    exporter.SetRenderWindow(window)
    exporter.SetFileName(f"{name}.pov")
    exporter.Write()
    with open(f"{name}.pov", encoding="utf-8") as file:
        switches = re.search(r"^// (\+W\d+ \+H\d+)", file.read(), re.M).group(1).split()
    calls.povray(f"{name}.pov", *switches)


def lit(renderer):
    """Replaces VTK's lamp at the camera by three, one of them a spotlight."""
    for place, colour, cone_angle in [((3, 4, 5), (1, 0.9, 0.8), 0), ((-4, 1, 2), (0.2, 0.3, 0.6), 0), ((0, 3, 3), (0.5,) * 3, 20)]:
        light = vtk.vtkLight()
        light.SetPosition(*place)
        light.SetFocalPoint(0, 0, 0)
        light.SetColor(*colour)
        if cone_angle:
            light.SetPositional(True)
            light.SetConeAngle(cone_angle)
        renderer.AddLight(light)


def parallel(renderer):
    renderer.GetActiveCamera().ParallelProjectionOn()


short = os.environ.get("CELLTRACE_SHORT")
for make in (clear, scalars, glyphs) if short else (sphere, flat, cone, clear, scalars, contour, strips, tubes, glyphs, quads):
    render(make.__name__, make())
if not short:
    render("lights", sphere() + cone(), lit)
    render("parallel", glyphs() + flat(), parallel)
calls.leave()
