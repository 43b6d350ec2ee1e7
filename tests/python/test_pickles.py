"""Values and scenes go to other processes, and are copied."""

import copy
import multiprocessing
import pickle

import celltrace
import numpy
import pytest

TENT = ([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1], [0, 1.5, 0]], [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
EVERYTHING = """
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 7 }
camera { location <0, 2, -6> look_at 0 }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.2, 0.3, 0.6>] [1 rgb 1] } } }
fog { distance 60 rgb 0.5 }
rainbow { angle 30 width 5 distance 100 direction z color_map { [0 rgbt <1, 0, 0, 0.5>] [1 rgbt <0, 0, 1, 0.5>] } }
light_source { <4, 6, -8>, 1 area_light x, y, 2, 2 }
light_source { <-4, 6, -8>, 0.5 spotlight point_at 0 }
#declare Stone = texture { pigment { granite color_map { [0 rgb 0.2] [1 rgb <1, 0.9, 0.8>] } warp { turbulence 0.3 } }
  normal { bumps 0.3 scale 0.1 } finish { phong 0.5 } }
plane { y, -1 texture { checker texture { Stone } texture { pigment { rgb <0.2, 0.4, 0.2> } } } }
difference { box { -1, 1 } sphere { 0, 1.3 } texture { Stone } rotate 30 * y }
sphere { <2, 0, 0>, 0.8 pigment { rgbf <1, 1, 1, 0.9> } interior { ior 1.4 } texture { pigment { rgbt <0, 0, 1, 0.8> } } }
light_group { light_source { <0, 5, 0>, rgb x } sphere { <-2, 0, 0>, 0.5 pigment { rgb 1 } } global_lights on }
mesh { triangle { <-1, 2, 0>, <1, 2, 0>, <0, 3, 0> texture { Stone } } triangle { <1, 2, 0>, <2, 3, 0>, <0, 3, 0> }
  pigment { wood } clipped_by { sphere { <0, 2.5, 0>, 1 } } }
torus { 1, 0.2 pigment { marble turbulence 1 } translate y }
"""


def again(value, protocol=pickle.HIGHEST_PROTOCOL):
    return pickle.loads(pickle.dumps(value, protocol))


def picture(scene):
    return celltrace.render(scene, width=48, height=36)


def picture_sum(scene):
    return int(picture(scene).astype(int).sum())


@pytest.fixture
def everything():
    return celltrace.Scene.from_text(EVERYTHING)


@pytest.mark.parametrize("value", [
    celltrace.Sphere((1, 2, 3), 4), celltrace.Plane((1, 2, 3), 4), celltrace.Disc((1, 2, 3), (4, 5, 6), 7, 8),
    celltrace.Box((1, 2, 3), (4, 5, 6)), celltrace.Cylinder((1, 2, 3), (4, 5, 6), 7, True),
    celltrace.Cone((1, 2, 3), (4, 5, 6), 7, 8, True), celltrace.Torus(3, 2), celltrace.Quadric(1, 2, 3, 4),
    celltrace.Polynomial(2, [1, 0, 0, 0, 1, 0, 0, 1, 0, -1]),
    celltrace.Prism([celltrace.CurveSegment((0, 1, 0, 0), (1, 2, 3, 4))], 0, 2),
    celltrace.Lathe([celltrace.CurveSegment((1, 1, 0, 0), (0, 2, 0, 0))]),
    celltrace.SurfaceOfRevolution([celltrace.SorPiece(0, 1, (1, 0, 0, 0))]),
    celltrace.Blob(0.5, [celltrace.BlobComponent((1, 0, 0), (1, 0, 0), 2, 3)]),
    celltrace.Superellipsoid(2, 3), celltrace.Polygon([[(-1, -1, 0), (1, -1, 0), (0, 1, 0)]]),
    celltrace.Transform.rotate((10, 20, 30)), celltrace.Interior(1.5, 2, 3, (4, 5, 6), 7, True),
    celltrace.Light((1, 2, 3), 4, "spotlight", area=celltrace.LightArea(columns=7, circular=True)),
    celltrace.Material(colour=(1, 2, 3), roughness=0.25, conserve_energy=True),
    celltrace.Camera.look_at((1, 2, 3), 0), celltrace.Camera.look_at((1, 2, 3), 0, aspect=2),
    celltrace.Object(celltrace.Sphere(3), celltrace.Transform.translate(4), 5, 6, True),
    celltrace.Antialiasing("adaptive", 0.1, 5), celltrace.Cache(2, 64, "lru"),
    celltrace.Csg("merge", [celltrace.Object(celltrace.Box()), celltrace.Object(celltrace.Torus())]),
], ids=lambda value: type(value).__name__)
def test_values(value):
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        assert again(value, protocol) == value
    assert copy.deepcopy(value) is value and copy.copy(value) is value  # it does not change
    assert copy.deepcopy([value, {"a": value}]) == [value, {"a": value}]


def test_meshes():
    mesh = celltrace.Mesh(*TENT, normals=numpy.ones((5, 3)), uv=numpy.zeros((5, 2)))
    same = again(mesh)
    assert (same.vertices == mesh.vertices).all() and (same.triangles == mesh.triangles).all()
    scene = celltrace.Scene()
    for i in range(2):
        scene.add(mesh, transform=celltrace.Transform.translate(i))
    first, second = again(scene).objects
    assert first.shape == second.shape  # still one mesh
    coloured = again(celltrace.Mesh(*TENT, values=range(5)))
    assert scene.add(coloured) == 2


def test_scenes(everything):
    expected = picture(everything)
    for same in (again(everything), copy.deepcopy(everything), copy.copy(everything)):
        assert (picture(same) == expected).all()
        same.lights = ()
    assert len(everything.lights) > 1
    assert again(everything).max_trace_level == 7


def test_parts_of_scenes(everything):
    """Materials with patterns, and objects with clips, as they are in a scene."""
    other = everything.copy()
    other.materials = again(everything.materials)
    other.objects = [again(thing) for thing in everything.objects]
    other.lights = again(everything.lights)
    assert (picture(other) == picture(everything)).all()
    pattern = celltrace.Material.from_pov("pigment { checker rgb 1, rgb 0 } normal { dents 0.2 }")
    balls = []
    for material in (pattern, again(pattern)):
        scene = celltrace.Scene()
        scene.camera = celltrace.Camera.look_at((0, 0, -4), 0)
        scene.add_light(celltrace.Light((3, 4, -5)))
        scene.add(celltrace.Sphere(), material=material)
        balls.append(picture(scene))
    assert (balls[0] == balls[1]).all() and balls[0].std() > 10


def test_framing_goes_along(ball):
    assert (celltrace.render(again(ball), width=40, height=40) == celltrace.render(ball, width=40, height=40)).all()


@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_other_processes(ball, everything, method):
    with multiprocessing.get_context(method).Pool(1) as pool:
        assert pool.map(picture_sum, [ball, everything]) == [picture_sum(ball), picture_sum(everything)]


def test_errors():
    with pytest.raises(celltrace.SceneError) as caught:
        celltrace.Scene.from_text("sphere { 0, 1 }\nsfere { 0, 1 }")
    same = again(caught.value)
    assert (same.line, same.file, str(same)) == (2, "<string>", str(caught.value))
    assert same.findings[0].severity == "error" and same.findings[0].column == 1


@pytest.mark.parametrize("harm", [lambda b: b[:-3], lambda b: b + b"x", lambda b: b"", lambda b: b[:30] + b"\xff" * 40,
                                  lambda b: b.replace(celltrace.__version__.encode(), b"9.9.9")])
def test_other_bytes(everything, harm):
    state = everything.__getstate__()
    with pytest.raises(celltrace.InputError, match="version"):
        celltrace.Scene.__new__(celltrace.Scene).__setstate__(harm(state))


def test_any_byte_may_be_wrong(everything):
    """No crash: an error, or a scene that rendering may refuse."""
    state = bytearray(everything.__getstate__())
    random = numpy.random.default_rng(1)
    for _ in range(300):
        wrong = bytearray(state)
        for place in random.integers(0, len(wrong), 3):
            wrong[place] = random.integers(0, 256)
        try:
            celltrace.Scene.__new__(celltrace.Scene).__setstate__(bytes(wrong))
        except celltrace.Error:
            pass
