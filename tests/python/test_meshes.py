"""Meshes with colours and holes, surfaces of grids, and cameras that see all of something."""

import celltrace
import numpy
import pytest

QUAD = numpy.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
HALVES = numpy.array([[0, 1, 2], [0, 2, 3]])
GLOW = celltrace.Material(emission=1, diffuse=0, ambient=0)  # looks as its colour


def colours_of(*meshes, material=GLOW):
    """A picture of what is between -1 and 1, linear."""
    scene = celltrace.Scene()
    scene.camera = celltrace.Camera(kind="orthographic", location=(0, 0, -5), right=(2, 0, 0), up=(0, 2, 0))
    for mesh in meshes:
        scene.add(mesh, material=material)
    return celltrace.render(scene, width=64, height=64, colours=True)[..., :3]


def test_srgb():
    assert celltrace.srgb("#ff0000") == (1, 0, 0) and celltrace.srgb("#FFF") == (1, 1, 1)
    assert celltrace.srgb("#1f77b4") == pytest.approx((0.01370, 0.18447, 0.45641), abs=1e-4)
    assert celltrace.srgb(0.5, 0.5, 0.5) == pytest.approx([0.21404] * 3, abs=1e-4)
    assert celltrace.srgb((0.5, 0.5, 0.5, 0.25)) == celltrace.srgb(0.5, 0.5, 0.5)
    many = celltrace.srgb(numpy.array([[255, 0, 128], [0, 0, 0]], numpy.uint8))
    assert many.shape == (2, 3) and many[0, 2] == pytest.approx(0.21586, abs=1e-4)
    for wrong in ("#12345", (1, 2), 0.5, [[1, 2]]):
        with pytest.raises(ValueError, match="srgb"):
            celltrace.srgb(wrong)
    with pytest.raises(TypeError):
        celltrace.srgb(1, 2)


def test_srgb_of_matplotlib():
    colours = pytest.importorskip("matplotlib.colors")
    assert celltrace.srgb("tab:blue") == celltrace.srgb(colours.to_rgb("tab:blue"))
    with pytest.raises(ValueError):
        celltrace.srgb("blueish")


def test_srgb_is_what_is_shown():
    mesh = celltrace.Mesh(QUAD, HALVES)
    for material in (GLOW.replace(colour=celltrace.srgb("#1f77b4")),
                     celltrace.Material.from_pov("pigment { srgb <31, 119, 180> / 255 } "
                                                 "finish { emission 1 diffuse 0 ambient 0 }")):
        pixel = celltrace.to_image(colours_of(mesh, material=material))[32, 32]
        assert numpy.abs(pixel.astype(int) - [0x1F, 0x77, 0xB4, 255]).max() <= 1


def test_places_in_materials():
    for text, line, column in (("pigment { ovus }", 1, 11), ("pigment { rgb 1 }\n  pigmnt { rgb 1 }", 2, 3)):
        with pytest.raises(celltrace.SceneError) as caught:
            celltrace.Material.from_pov(text)
        assert (caught.value.file, caught.value.line, caught.value.column) == ("<material>", line, column)


def test_colours_of_vertices():
    corners = numpy.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], float)
    seen = colours_of(celltrace.Mesh(QUAD, HALVES, colours=corners))
    assert numpy.allclose([seen[-1, 0], seen[-1, -1], seen[0, -1], seen[0, 0]], corners, atol=0.05)
    assert numpy.allclose(seen[32, 32], (corners[0] + corners[2]) / 2, atol=0.05)
    plain = colours_of(celltrace.Mesh(QUAD, HALVES, colours=numpy.full((4, 3), 0.25)))
    assert numpy.allclose(plain, 0.25, atol=1e-3)


def test_instances_share_materials():
    mesh = celltrace.Mesh(QUAD, HALVES, colours=numpy.eye(4, 3))
    scene = celltrace.Scene()
    first, second, other = (scene.add(mesh, material=material) for material in (GLOW, GLOW, GLOW.replace(phong=1)))
    assert len(scene.materials) == 8
    shapes = [scene.objects[i].shape for i in (first, second, other)]
    assert shapes[0] == shapes[1] != shapes[2]
    scene.materials = scene.materials[:8]
    scene.add(mesh, material=GLOW)
    assert len(scene.materials) == 12
    assert scene.add(mesh, material=0, no_shadow=True) == 4 and scene.objects[4].no_shadow


def test_many_colours_become_fewer():
    """By less than what can be seen."""
    random = numpy.random.default_rng(0)
    side = 160
    grid = numpy.stack(numpy.meshgrid(numpy.linspace(-1, 1, side), numpy.linspace(-1, 1, side)), axis=-1)
    u, v = (grid[..., i] * 0.5 + 0.5 for i in range(2))
    colours = numpy.stack([u, v, 1 - u * v], axis=-1)
    mesh = celltrace.surface(grid[..., 0], grid[..., 1], 0 * u, colours=colours)
    scene = celltrace.Scene()
    scene.add(mesh, material=GLOW)
    assert 500 < len(scene.materials) <= 4096
    seen = celltrace.to_image(colours_of(mesh)).astype(int)
    x = (numpy.arange(64) + 0.5) / 64
    wanted = numpy.stack([numpy.tile(x, (64, 1)), numpy.tile(x[::-1, None], (1, 64)), 1 - numpy.outer(x[::-1], x)], axis=-1)
    wanted = celltrace.to_image(wanted.astype(numpy.float32)).astype(int)
    assert numpy.abs(seen - wanted)[2:-2, 2:-2].mean() < 2
    noise = celltrace.surface(grid[..., 0], grid[..., 1], 0 * u, colours=random.random((side, side, 3)))
    scene = celltrace.Scene()
    scene.add(noise, material=GLOW)
    assert 500 < len(scene.materials) <= 4096


def test_values_and_maps():
    values = QUAD[:, 0]
    ramp = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 1]])
    for colour_map in (ramp, ramp.tolist(), lambda x: numpy.stack([numpy.interp(x, [0, 0.5, 1], ramp[:, i]) for i in range(3)], axis=-1)):
        seen = colours_of(celltrace.Mesh(QUAD, HALVES, values=values, colour_map=colour_map))
        assert numpy.allclose(seen[:, 0], 0, atol=0.05) and numpy.allclose(seen[:, -1], 1, atol=0.08)
        assert numpy.allclose(seen[20, 32], [1, 0, 0], atol=0.08)
    clipped = colours_of(celltrace.Mesh(QUAD, HALVES, values=values, colour_map=ramp, value_range=(2, 4)))
    assert numpy.allclose(clipped, 0, atol=1e-3)
    same = colours_of(celltrace.Mesh(QUAD, HALVES, values=[3, 3, 3, 3], colour_map=ramp))
    assert numpy.allclose(same, [1, 0, 0], atol=0.02)
    default = colours_of(celltrace.Mesh(QUAD, HALVES, values=values))
    assert numpy.allclose(default[32, 0], celltrace.srgb("#440154"), atol=0.02)
    assert numpy.allclose(default[32, -1], celltrace.srgb("#fde725"), atol=0.05)


def test_maps_of_matplotlib():
    matplotlib = pytest.importorskip("matplotlib")
    viridis = matplotlib.colormaps["viridis"]
    with pytest.raises(ValueError, match=r"has no 'virids' \(did you mean 'viridis'"):
        celltrace.Mesh(QUAD, HALVES, values=QUAD[:, 0], colour_map="virids")
    pictures = [colours_of(celltrace.Mesh(QUAD, HALVES, values=QUAD[:, 0], colour_map=colour_map))
                for colour_map in (viridis, "viridis", None)]
    assert (pictures[0] == pictures[1]).all() and numpy.abs(pictures[0] - pictures[2]).max() < 0.02
    shown = celltrace.to_image(pictures[0])[32, :, :3] / 255
    assert numpy.abs(shown - viridis((numpy.arange(64) + 0.5) / 64)[:, :3]).max() < 0.02


def test_the_finish_is_the_objects():
    mesh = celltrace.Mesh(QUAD, HALVES, values=QUAD[:, 0])
    clear = colours_of(mesh, material=GLOW.replace(transmit=1))
    assert numpy.allclose(clear, 0, atol=1e-6)


def test_holes():
    vertices = QUAD.copy()
    vertices[1] = numpy.nan
    with pytest.raises(ValueError, match="vertices: row 1 is not finite .*skip_nan"):
        celltrace.Mesh(vertices, HALVES)
    mesh = celltrace.Mesh(vertices, HALVES, skip_nan=True)
    assert (mesh.triangles == [[0, 2, 3]]).all() and numpy.isfinite(mesh.vertices).all()
    seen = colours_of(mesh, material=GLOW.replace(colour=1))
    assert seen[10, 10].all() and not seen[-10, -10].any()
    values = numpy.array([0, numpy.inf, 1, 1])
    with pytest.raises(ValueError, match="values: row 1"):
        celltrace.Mesh(QUAD, HALVES, values=values)
    assert len(celltrace.Mesh(QUAD, HALVES, values=values, skip_nan=True).triangles) == 1
    normals = numpy.array([[0, 0, -1], [0, 0, numpy.nan]])
    both = celltrace.Mesh(QUAD, HALVES, normals=normals, normal_indices=[[0, 0, 1], [0, 0, 0]], skip_nan=True)
    assert (both.triangles == [[0, 2, 3]]).all()
    assert not len(celltrace.Mesh(0 * QUAD + numpy.nan, HALVES, skip_nan=True).triangles)


def test_surfaces():
    x = numpy.linspace(-1, 1, 21)
    z = numpy.add.outer(x, x) * 0
    z[8:13, 8:13] = numpy.nan
    mesh = celltrace.surface(x, x, z)
    assert len(mesh.triangles) == 2 * (20 * 20 - 6 * 6) + 2  # at two corners half a square is left
    seen = colours_of(mesh, material=GLOW.replace(colour=1))
    assert not seen[30:34, 30:34].any() and seen[5, 5].all()
    wave = celltrace.surface(x, x, numpy.add.outer(x ** 2, x ** 2), values=numpy.add.outer(x, x), colour_map=[[0, 0, 0], [1, 1, 1]])
    assert wave.vertices.shape == (441, 3)
    smooth = celltrace.Scene()
    with pytest.raises(ValueError, match="one shape"):
        celltrace.surface(x, x, z[:-1])
    assert smooth.add(celltrace.surface(x, x, z, smooth=False)) == 0


def test_lists_are_arrays():
    assert (celltrace.Mesh(QUAD.tolist(), HALVES.tolist()).triangles == HALVES).all()


@pytest.mark.parametrize("make, error, text", [
    (lambda: celltrace.Mesh(QUAD, HALVES, normals=numpy.ones((2, 3))), ValueError, "normals: has 2 rows, and vertices has 4"),
    (lambda: celltrace.Mesh(QUAD, HALVES, normals=numpy.ones((2, 3)), normal_indices=HALVES[:1]), ValueError,
     "normal_indices: row 0 has the index 2, and normals has 2 rows"),
    (lambda: celltrace.Mesh(QUAD, HALVES, normals=QUAD, normal_indices=HALVES[:1]), ValueError,
     "normal_indices: has 1 rows, and triangles has 2"),
    (lambda: celltrace.Mesh(QUAD, HALVES, normal_indices=HALVES), TypeError, "no normals"),
    (lambda: celltrace.Mesh(QUAD, HALVES, uv=QUAD[:, :2], values=QUAD[:, 0]), TypeError, "uv, values"),
    (lambda: celltrace.Mesh(QUAD, HALVES, colours=QUAD, values=QUAD[:, 0]), TypeError, "colours, values"),
    (lambda: celltrace.Mesh(QUAD, HALVES, colour_map="viridis"), TypeError, "for values"),
    (lambda: celltrace.Mesh("abc", HALVES), ValueError, "vertices: has to be an array of numbers"),
    (lambda: celltrace.Mesh([[0, 0, 0], [1, 0]], HALVES), ValueError, "vertices: has to be an array of numbers"),
    (lambda: celltrace.Mesh(QUAD, HALVES, uv="a"), ValueError, "uv: has to be an array of numbers"),
    (lambda: celltrace.Mesh(QUAD, HALVES, skip_nans=True), TypeError, r"Mesh\(\) has no 'skip_nans' \(did you mean 'skip_nan'"),
    (lambda: celltrace.Mesh(QUAD), TypeError, r"Mesh\(vertices, triangles, ...\) cannot be called with"),
    (lambda: celltrace.Mesh(QUAD, HALVES, colours=QUAD[:3]), ValueError, "colours: the shape"),
    (lambda: celltrace.Mesh(QUAD, HALVES, values=QUAD), ValueError, "values: the shape"),
    (lambda: celltrace.Mesh(QUAD, HALVES, values=QUAD[:, 0], value_range=(2, 1)), ValueError, "value_range"),
    (lambda: celltrace.Mesh(QUAD, HALVES, values=QUAD[:, 0], colour_map=[[1, 2]]), ValueError, "colour_map"),
    (lambda: celltrace.Object(celltrace.Mesh(QUAD, HALVES, colours=QUAD)), ValueError, "Scene.add"),
    (lambda: celltrace.Scene().add(celltrace.Mesh(QUAD, HALVES, colours=QUAD), material="red"), TypeError, "Material"),
    (lambda: celltrace.Scene().add(celltrace.Mesh(QUAD, HALVES, colours=QUAD), material=3), ValueError, "index"),
    (lambda: celltrace.Scene().add(celltrace.Mesh(QUAD, HALVES, colours=QUAD), material=celltrace.Material.from_pov(
        "texture { checker texture { pigment { rgb 1 } } texture { pigment { rgb 0 } } }")), ValueError, "layers"),
    (lambda: celltrace.Camera.fit(celltrace.Scene()), ValueError, "nothing"),
    (lambda: celltrace.Camera.fit(QUAD[:, :2]), ValueError, "shape"),
    (lambda: celltrace.Camera.fit(QUAD, kind="fisheye"), ValueError, "kind"),
    (lambda: celltrace.Camera.fit(QUAD, aspect=0), ValueError, "aspect"),
    (lambda: celltrace.render(celltrace.Scene(), clock=1), TypeError, "clock: is for scenes that are read"),
    (lambda: celltrace.Session(celltrace.Scene(), limits={}), TypeError, "limits: is for scenes that are read"),
    (lambda: celltrace.render(celltrace.Scene(), widht=1), TypeError, "did you mean 'width'"),
])
def test_what_is_wrong_says_so(make, error, text):
    with pytest.raises(error, match=text):
        make()


def block(fit, width, height):
    """A picture of a scene that `fit` makes a camera for."""
    scene = celltrace.Scene()
    scene.add(celltrace.Box((-1, 0, -1), (1, 3, 1)), material=GLOW.replace(colour=(1, 0, 0)))
    scene.add(celltrace.Sphere((2, 0, 0), 0.5), material=GLOW.replace(colour=(1, 0, 0)))
    scene.add(celltrace.Plane((0, 1, 0), -5), material=GLOW)
    scene.camera = fit(scene)
    return celltrace.render(scene, width=width, height=height)[..., 0] > 0


@pytest.mark.parametrize("width, height", [(100, 100), (160, 80), (80, 160)])
@pytest.mark.parametrize("keywords", [
    {}, {"angle": 90}, {"direction": (1, 0, 0)}, {"direction": (0, -1, 0), "sky": (0, 0, 1)}, {"kind": "orthographic"},
    {"right_handed": True}, {"direction": (1, -2, 3), "kind": "orthographic"}])
def test_cameras_see_all(width, height, keywords):
    seen = block(lambda scene: celltrace.Camera.fit(scene, **keywords), width, height)
    rows, columns = numpy.nonzero(seen)
    assert not seen[0].any() and not seen[-1].any() and not seen[:, 0].any() and not seen[:, -1].any()
    assert max(numpy.ptp(rows), numpy.ptp(columns)) > 0.8 * min(width, height)


@pytest.mark.parametrize("kind", ["perspective", "orthographic"])
@pytest.mark.parametrize("width, height", [(160, 80), (80, 160)])
def test_cameras_fill_pictures_of_their_aspect(kind, width, height):
    """By a bar that is as wide, or as high, as the picture."""
    scene = celltrace.Scene()
    size = numpy.array([width, height, 1]) / 80
    scene.add(celltrace.Box(-size, size), material=GLOW.replace(colour=1))
    scene.camera = celltrace.Camera.fit(scene, (0, 0, 1), aspect=width / height, kind=kind)
    rows, columns = numpy.nonzero(celltrace.render(scene, width=width, height=height)[..., 0] > 0)
    assert numpy.ptp(rows) > 0.9 * height and numpy.ptp(columns) > 0.9 * width
    assert rows.min() > 0 and columns.min() > 0 and rows.max() < height - 1 and columns.max() < width - 1


def test_cameras_see_all_kinds():
    shapes = [celltrace.Sphere(1, 2), celltrace.Disc(radius=3), celltrace.Cylinder(), celltrace.Cone(), celltrace.Torus(),
              celltrace.Quadric(1, 0, -2, -5), celltrace.Superellipsoid(0.3, 0.3), celltrace.Mesh(QUAD, HALVES),
              celltrace.Polygon([[(-1, -1, 0), (1, -1, 0), (0, 1, 0)]]),
              celltrace.Prism([celltrace.CurveSegment((0, 2, 0, 0), (0, 0, 0, 0)),
                               celltrace.CurveSegment((2, -2, 0, 0), (0, 2, 0, 0)),
                               celltrace.CurveSegment((0, 0, 0, 0), (2, -2, 0, 0))], 0, 1),
              celltrace.Lathe([celltrace.CurveSegment((1, 1, 0, 0), (0, 2, 0, 0))]),
              celltrace.SurfaceOfRevolution([celltrace.SorPiece(0, 1, (1, 1, 0, 0))]),
              celltrace.Blob(0.1, [celltrace.BlobComponent((1, 0, 0), (1, 0, 0), 2, 3)]),
              celltrace.Csg("intersection", [celltrace.Object(celltrace.Box(-9, 9)), celltrace.Object(celltrace.Sphere())]),
              celltrace.Csg("difference", [celltrace.Object(celltrace.Box()), celltrace.Object(celltrace.Sphere(0, 9))
                                           .replace(transform=celltrace.Transform.translate(9))])]
    for shape in shapes:
        scene = celltrace.Scene()
        scene.add(shape, material=GLOW.replace(colour=1), transform=celltrace.Transform.rotate((0, 30, 10)))
        scene.camera = celltrace.Camera.fit(scene)
        seen = celltrace.render(scene, width=80, height=80)[..., 0] > 0
        rows, columns = numpy.nonzero(seen)
        assert max(numpy.ptp(rows), numpy.ptp(columns)) > 45, shape
        assert not seen[0].any() and not seen[-1].any() and not seen[:, 0].any() and not seen[:, -1].any(), shape
    points = numpy.array([[0, 0, 0], [1, 2, 3], [numpy.nan, 0, 0]])
    assert celltrace.Camera.fit(points).framing == "whole"
    assert celltrace.Camera.fit(celltrace.Mesh(QUAD, HALVES)) == celltrace.Camera.fit(QUAD)
