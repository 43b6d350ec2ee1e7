"""What scenes are made of."""

import celltrace
import numpy
import pytest


def cube(corner_type=float, index_type=numpy.int64):
    """A cube from -1 to 1 of 12 triangles."""
    vertices = numpy.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], corner_type)
    triangles = numpy.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                             [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]], index_type)
    return vertices, triangles


def seen(shape, **options):
    scene = celltrace.Scene()
    scene.camera = celltrace.Camera.look_at((3, 4, -5), (0, 0, 0), angle=50)
    scene.add_light(celltrace.Light((3, 4, -5)))
    scene.add(shape, material=celltrace.Material(colour=1), **options)
    return celltrace.render(scene, width=64, height=48)


@pytest.mark.parametrize("corner_type", [numpy.float32, float, int])
@pytest.mark.parametrize("index_type", [numpy.int32, numpy.uint32, numpy.int64, numpy.uint8])
def test_meshes_of_any_numbers(corner_type, index_type):
    mesh = celltrace.Mesh(*cube(corner_type, index_type))
    assert celltrace.compare(seen(mesh), seen(celltrace.Box()))["psnr"] is None or \
        celltrace.compare(seen(mesh), seen(celltrace.Box()))["psnr"] > 40
    assert mesh.vertices.dtype == numpy.float32 and mesh.vertices.shape == (8, 3)
    assert (mesh.triangles == cube()[1]).all()


def test_meshes_show_their_arrays_without_letting_them_change():
    rows = celltrace.Mesh(*cube()).vertices  # which outlives the mesh's name
    assert (rows == cube()[0]).all()
    with pytest.raises(ValueError):
        rows[0, 0] = 2


def test_smooth_meshes_and_surface_coordinates():
    vertices, triangles = cube()
    flat, smooth = seen(celltrace.Mesh(vertices, triangles)), seen(celltrace.Mesh(vertices, triangles, normals=vertices))
    assert (flat != smooth).any()
    normals = numpy.array([[0, 1, 0]])
    one = celltrace.Mesh(vertices, triangles, normals=normals, normal_indices=numpy.zeros((12, 3), int))
    assert (seen(one) != smooth).any()
    scene = celltrace.Scene()
    scene.camera = celltrace.Camera.look_at((0, 0, -5), (0, 0, 0))
    halves = celltrace.Material.from_pov("pigment { uv_mapping gradient x color_map { [0.5 rgb x] [0.5 rgb y] } }"
                                         " finish { emission 1 diffuse 0 ambient 0 }")
    quad = celltrace.Mesh([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], numpy.array([[0, 1, 2], [0, 2, 3]]),
                          uv=[[0, 0], [1, 0], [1, 1], [0, 1]])
    scene.add(quad, material=halves)
    pixels = celltrace.render(scene, width=40, height=30)
    assert (pixels[:, :19, 0] == 255).all() and (pixels[:, 21:, 1] == 255).all()


@pytest.mark.parametrize("arguments, text", [
    ((numpy.zeros((3, 2)), numpy.zeros((1, 3), int)), "vertices: the shape has to be"),
    ((numpy.zeros((3, 3)), numpy.zeros((1, 4), int)), "triangles: the shape has to be"),
    ((numpy.zeros((3, 3)), numpy.zeros((1, 3))), "whole numbers"),
    ((numpy.zeros((3, 3)), numpy.array([[0, 1, 3]])), "row 0 has the index 3, and vertices has 3 rows"),
    ((numpy.zeros((3, 3)), numpy.array([[0, 1, -1]])), "row 0 has the index -1, and vertices"),
])
def test_wrong_arrays(arguments, text):
    with pytest.raises(ValueError, match=text):
        celltrace.Mesh(*arguments)


@pytest.mark.parametrize("shape", [
    celltrace.Sphere(), celltrace.Disc(normal=(0, 1, -1)), celltrace.Box(), celltrace.Cylinder(),
    celltrace.Cone(cap=(0, 2, 0)), celltrace.Torus(), celltrace.Quadric(),
    celltrace.Superellipsoid(0.5, 3),
    celltrace.Polygon([[(-1, -1, 0), (1, -1, 0), (0, 1, 0)]]), celltrace.Plane(),
    celltrace.Csg("difference", [celltrace.Object(celltrace.Box()), celltrace.Object(celltrace.Sphere(radius=1.3))]),
], ids=lambda shape: type(shape).__name__)
def test_each_shape_is_seen(shape):
    pixels = seen(shape)
    assert pixels[..., 0].max() > 60
    scene = celltrace.Scene()
    scene.add(shape)
    assert scene.objects[0].shape == shape


def test_values_do_not_change():
    light = celltrace.Light((1, 2, 3), colour=0.5, kind="spotlight")
    assert light.location == (1, 2, 3) and light.colour == (0.5, 0.5, 0.5)
    with pytest.raises(AttributeError):
        light.location = (0, 0, 0)
    moved = light.replace(location=numpy.array([4, 5, 6]))
    assert moved.location == (4, 5, 6) and moved.kind == "spotlight" and light.location == (1, 2, 3)
    assert light == light.replace() and light != moved and light != 7
    assert repr(light) == "Light(location=(1.0, 2.0, 3.0), colour=(0.5, 0.5, 0.5), kind='spotlight')"
    assert celltrace.Light(area=celltrace.LightArea(columns=3)).area.columns == 3


@pytest.mark.parametrize("make, error, text", [
    (lambda: celltrace.Light(place=0), TypeError, "Light has no 'place'"),
    (lambda: celltrace.Light(location="here"), TypeError, "location: cannot be 'here'"),
    (lambda: celltrace.Light(location=(1, 2)), TypeError, r"location: cannot be \(1, 2\) \(three numbers"),
    (lambda: celltrace.Material(colour="red"), TypeError, r"cannot be 'red' .*celltrace.srgb\(\) makes them"),
    (lambda: celltrace.Csg("union", [celltrace.Sphere()]), TypeError, r"parts: cannot be .* \(objects, placed"),
    (lambda: setattr(celltrace.Scene(), "background", "white"), TypeError, r"background: cannot be 'white' .*srgb"),
    (lambda: setattr(celltrace.Scene(), "camera", None), TypeError, r"camera: cannot be None \(a Camera\)"),
    (lambda: setattr(celltrace.Scene(), "lights", [1]), TypeError, r"lights: cannot be \[1\] \(a tuple of Light\)"),
    (lambda: celltrace.render("x.pov", width=3.5), TypeError, r"width: cannot be 3.5 \(a whole number\)"),
    (lambda: celltrace.render("x.pov", antialiasing=True), TypeError, r"cannot be True \(an Antialiasing, or None\)"),
    (lambda: celltrace.render("x.pov", declares=["a"]), TypeError, r"declares: cannot be \['a'\] \(a dict of"),
    (lambda: celltrace.render("x.pov", limits={"seconds": "a"}), TypeError, "limits: cannot be "),
    (lambda: celltrace.render("x.pov", limits={"second": 1}), ValueError, "did you mean 'seconds'"),
    (lambda: celltrace.render("x.pov", limits={"render-seconds": 1}), ValueError, "most_seconds and most_memory"),
    (lambda: celltrace.render("x.pov", message=3), TypeError, r"message: cannot be 3 \(a function"),
    (lambda: celltrace.render("sphere { 0, 1 }"), ValueError, r"Scene.from_text\(\) makes a Scene of a text"),
    (lambda: celltrace.Camera.look_at(0, 1, fov=40), TypeError, r"look_at\(\) has no 'fov'"),
    (lambda: celltrace.Camera.look_at(0, 1, angel=40), TypeError, "did you mean 'angle'"),
    (lambda: celltrace.Camera.look_at("a", 1, sky=2), TypeError,
     r"look_at\(location, target, angle=67.38, aspect=None, sky=\(0, 1, 0\), ...\) "
     r"cannot be called with \(str, int, sky=int\)"),
    (lambda: celltrace.Transform.translate(1, 2, 3), TypeError,
     r"translate\(offset\) cannot be called with \(int, int, int\)"),
    (lambda: celltrace.Scene().add_light((1, 2, 3)), TypeError, r"add_light\(light\) cannot be called with \(tuple\)"),
    (lambda: celltrace.Scene.from_text(b"".join), TypeError, r"from_text\(text, ...\) cannot be called with"),
    (lambda: celltrace.Session("x.pov"), TypeError, r"Session\(scene, ...\) cannot be called with \(str\)"),
    (lambda: celltrace.Session(), TypeError, r"cannot be called with \(\)"),
    (lambda: celltrace.save("x.png", "y.png"), TypeError, "picture: has to be an array, not a str"),
    (lambda: celltrace.save("x.png", [[1, 2]]), TypeError, "of uint8 or uint16"),
    (lambda: celltrace.save("x.png", numpy.zeros((2, 3), numpy.uint8)), ValueError,
     r"has to be \(height, width, 3 or 4\), and is \(2, 3\)"),
    (lambda: celltrace.save(numpy.zeros((2, 3, 3), numpy.uint8), "x.png"), TypeError, "comes before the picture"),
    (lambda: celltrace.save("x.png", None, quality=3), TypeError, r"save\(\) has no 'quality'"),
    (lambda: celltrace.compare("a.png", "b.png"), TypeError, "a: has to be an array, not a str"),
    (lambda: celltrace.Light(kind="lamp"), ValueError, "'lamp' is none of point, spotlight, cylinder"),
    (lambda: celltrace.Sphere(0, 1, 2), TypeError, "at most 2"),
    (lambda: celltrace.Sphere(0, centre=1), TypeError, "twice"),
    (lambda: celltrace.Object(7), TypeError, "shape"),
    (lambda: celltrace.Object(None), TypeError, "shape"),
    (lambda: celltrace.Scene().add(celltrace.Sphere(), material="red"), TypeError, "an index or a Material"),
    (lambda: celltrace.Camera.look_at(0, 0), celltrace.InputError, "where it looks to"),
    (lambda: celltrace.Material.from_pov("} sphere { 0, 1 }  sphere { 0, 1"), celltrace.InputError, "one object"),
    (lambda: celltrace.Material.from_pov("pigment { ovus }"), celltrace.SceneError, "<material>:1"),
    (lambda: celltrace.render("x.pov", widht=3), TypeError, "'widht'"),
    (lambda: celltrace.render(3), TypeError, ""),
    (lambda: celltrace.Session(celltrace.Scene(), backend="gpu"), ValueError, "gpu"),
    (lambda: celltrace.Session(celltrace.Scene(), balance="none"), ValueError, "none of gde"),
    (lambda: celltrace.render(celltrace.Scene(), width=0), celltrace.InputError, ""),
    (lambda: celltrace.Scene.from_text("", limits={"speed": 1}), ValueError, "speed"),
    (lambda: celltrace.Scene.from_text("", width=3), TypeError, "width"),
])
def test_what_is_wrong_says_so(make, error, text):
    with pytest.raises(error, match=text):
        make()


def test_transforms():
    move, turn = celltrace.Transform.translate((1, 2, 3)), celltrace.Transform.rotate((0, 90, 0))
    assert move.point(0) == (1, 2, 3)
    assert turn.then(move).point((1, 0, 0)) == pytest.approx((1, 2, 2))
    assert (move.rows == [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 2, 3]]).all()
    assert celltrace.Transform(move.rows) == move and move.inverse().then(move) == celltrace.Transform()
    with pytest.raises(celltrace.InputError):
        celltrace.Transform(numpy.zeros((4, 3))).inverse()


def test_lists_of_a_scene_are_set_as_a_whole():
    scene = celltrace.Scene()
    scene.add_light(celltrace.Light(0))
    scene.lights = [light.replace(colour=2) for light in scene.lights] + [celltrace.Light(1)]
    assert [light.colour[0] for light in scene.lights] == [2, 1]
    other = scene.copy()
    other.lights = ()
    assert len(scene.lights) == 2 and not other.lights
