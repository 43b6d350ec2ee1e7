"""Pictures as arrays, as files in memory, and as notebooks show them."""

import io
import pickle

import celltrace
import numpy
import pytest

PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture
def colours(ball):
    ball.background = (0, 0, 3)  # brighter than a display
    return celltrace.render(ball, width=40, height=30, colours=True)


def test_colours_are_saved(tmp_path, colours):
    for name, first in (("a.exr", b"v/1\x01"), ("a.hdr", b"#?RADIANCE"), ("a.png", PNG), ("a.ppm", b"P6")):
        try:
            celltrace.save(tmp_path / name, colours)
        except celltrace.InputError as error:
            assert "exr" in name and "OpenEXR" in str(error)
            continue
        assert (tmp_path / name).read_bytes().startswith(first)
    assert (celltrace.load(tmp_path / "a.png") == celltrace.to_image(colours)).all()


def test_colours_become_pictures(ball, colours):
    assert (celltrace.to_image(colours) == celltrace.render(ball, width=40, height=30)).all()
    deep = celltrace.to_image(colours, bits=16)
    assert deep.dtype == numpy.uint16 and (deep[0, 0] == [0, 0, 65535, 65535]).all()
    half = celltrace.to_image(numpy.full((1, 1, 3), celltrace.srgb(0.5, 0.5, 0.5)[0], numpy.float32), 8)
    assert (half == [128, 128, 128, 255]).all()
    with pytest.raises(ValueError, match="8 or 16"):
        celltrace.to_image(colours, bits=10)
    for wrong in (colours.astype(float), celltrace.to_image(colours)):
        with pytest.raises(TypeError, match="float32"):
            celltrace.to_image(wrong)


def test_colours_that_are_for_display_stay_so(tmp_path):
    path = tmp_path / "old.pov"
    path.write_text("camera { location -3*z } background { rgb 0.5 } sphere { 0, 1 pigment { rgb x } finish { ambient 1 } }")
    colours = celltrace.render(path, width=8, height=6, colours=True)
    assert colours.gamma is None and colours[1:].gamma is None
    assert (celltrace.to_image(colours) == celltrace.render(path, width=8, height=6)).all()
    assert abs(int(celltrace.to_image(colours)[0, 0, 0]) - 127) <= 1


def test_files_in_memory(colours):
    pixels = celltrace.to_image(colours)
    file = io.BytesIO()
    celltrace.save(file, pixels)
    assert file.getvalue() == celltrace.encode(pixels) and file.getvalue().startswith(PNG)
    assert (celltrace.load(io.BytesIO(file.getvalue())) == pixels).all()
    assert celltrace.encode(pixels[..., :3], "ppm").startswith(b"P6")
    assert celltrace.encode(colours, "hdr").startswith(b"#?RADIANCE")
    with pytest.raises(celltrace.InputError, match="xyz"):
        celltrace.encode(pixels, "xyz")
    with pytest.raises(TypeError, match="float32"):
        celltrace.encode(pixels.astype(float))


def test_a_format_besides_the_name(tmp_path, colours):
    celltrace.save(tmp_path / "picture", colours, "png")
    assert (celltrace.load(tmp_path / "picture") == celltrace.to_image(colours)).all()


def test_first_hits_in_files(ball):
    session = celltrace.Session(ball, width=20, height=10, colours=True, first_hits=True)
    colours = session.render()
    try:
        plain = celltrace.encode(colours, "exr")
    except celltrace.InputError:
        pytest.skip("without OpenEXR")
    hits = celltrace.encode(colours, "exr", first_hits=session.first_hits)
    assert b"N.X" in hits and b"N.X" not in plain
    assert b"N.X" in celltrace.encode(colours, "exr", first_hits=session.first_hits, full_floats=True)
    with pytest.raises(ValueError, match="normal"):
        celltrace.encode(colours, "exr", first_hits={**session.first_hits, "normal": numpy.zeros((1, 2, 3))})


def test_pictures_are_arrays(ball, colours):
    pixels = celltrace.render(ball, width=20, height=10)
    assert isinstance(pixels, numpy.ndarray) and isinstance(pixels, celltrace.Picture)
    assert type(pixels.mean()) is numpy.float64 and type(pixels.max()) is numpy.uint8
    assert type((pixels == pixels).all()) is numpy.bool_
    assert type(pixels == pixels) is numpy.ndarray and type(pixels / 2) is numpy.ndarray
    assert type(pixels.sum(axis=2)) is numpy.ndarray and type(colours.mean(axis=(0, 1))) is numpy.ndarray
    assert type(colours * 0.5) is celltrace.Picture and type(colours[2:5, ::-1, :3]) is celltrace.Picture
    assert pixels[0, 0, 0] == 0 and pixels[..., 0]._repr_png_() is None
    assert numpy.vstack([pixels, pixels]).shape == (20, 20, 4)
    assert type(numpy.asarray(pixels)) is numpy.ndarray
    pixels[0, 0] = 7
    assert (pixels[0, 0] == 7).all()


def test_notebooks_show_pictures(ball, colours):
    pixels = celltrace.render(ball, width=20, height=10)
    assert (celltrace.load(io.BytesIO(pixels._repr_png_())) == pixels).all()
    shown = celltrace.load(io.BytesIO(colours[:10]._repr_png_()))
    assert (shown == celltrace.to_image(colours)[:10]).all()
    assert celltrace.Picture(numpy.zeros((2, 2, 3), numpy.uint8))._repr_png_().startswith(PNG)
    assert (colours > 1)._repr_png_() is None if hasattr(colours > 1, "_repr_png_") else True


def test_pictures_are_pickled(colours):
    colours.gamma = None
    again = pickle.loads(pickle.dumps(colours))
    assert type(again) is celltrace.Picture and again.gamma is None and (again == colours).all()


def spans(pixels):
    """How wide and high what is red is."""
    rows, columns = numpy.nonzero(pixels[..., 0])
    return numpy.ptp(columns) + 1, numpy.ptp(rows) + 1


@pytest.mark.parametrize("width, height", [(120, 120), (160, 90), (60, 120), (120, 90)])
def test_balls_are_round_whatever_shape_a_picture_has(ball, width, height):
    ball.background = 0
    across, down = spans(celltrace.render(ball, width=width, height=height))
    assert abs(across - down) <= 1
    session = celltrace.Session(ball, width=64, height=64)
    session.set_picture(width=width, height=height)
    assert spans(session.render()) == (across, down)
    session.set_camera(ball.camera.replace(location=(0, 0, -6)))
    across, down = spans(session.render())
    assert abs(across - down) <= 1
    assert session.scene.camera.framing == "width" and session.scene.camera.right == ball.camera.right
    session.replace(ball)
    assert abs(numpy.subtract(*spans(session.render()))) <= 1


def test_an_aspect_that_is_given_stays(ball):
    ball.background = 0
    ball.camera = celltrace.Camera.look_at((0, 0, -9), 0, angle=40, aspect=2)
    across, down = spans(celltrace.render(ball, width=100, height=100))
    assert abs(2 * across - down) <= 2
    assert celltrace.Camera().framing == "fixed"


def test_hands(ball):
    ball.add(celltrace.Sphere((1, 0, 0), 0.2), material=celltrace.Material(emission=1, colour=(0, 1, 0)))
    def side(**hand):
        ball.camera = celltrace.Camera.look_at((0, 0, -5), 0, **hand)
        return numpy.nonzero(celltrace.render(ball, width=80, height=60)[..., 1] > 100)[1].mean() > 40
    assert side() and not side(right_handed=True)
