"""Pictures: from files, from code, by sessions, into arrays."""

import celltrace
import numpy
import pytest


def test_a_file_becomes_an_array(scene_file):
    pixels = celltrace.render(scene_file, width=64, height=48)
    assert pixels.shape == (48, 64, 4) and pixels.dtype == numpy.uint8
    assert tuple(pixels[0, 0]) == (0, 0, 255, 255)
    middle = pixels[24, 32]
    assert middle[0] > 100 and middle[1] < 10 and middle[2] < 10


def test_code_makes_the_picture_of_the_file(scene_file, ball):
    from_file = celltrace.render(str(scene_file), width=64, height=48)
    assert celltrace.compare(from_file, celltrace.render(ball, width=64, height=48))["max_difference"] <= 1


def test_alpha_is_clear_where_nothing_is(ball):
    ball.background = 0
    picture = celltrace.render(ball, width=32, height=24, alpha=True)
    assert picture[0, 0, 3] == 0 and picture[12, 16, 3] == 255
    ball.background_transparency = 0
    assert celltrace.render(ball, width=32, height=24, alpha=True)[0, 0, 3] == 255


def test_first_hits_are_arrays(ball):
    session = celltrace.Session(ball, width=32, height=24, first_hits=True)
    assert session.first_hits is None
    session.render()
    hits = session.first_hits
    assert hits["depth"].shape == (24, 32) and hits["normal"].shape == (24, 32, 3)
    assert numpy.isinf(hits["depth"][0, 0]) and hits["object"][0, 0] == 0 and not hits["normal"][0, 0].any()
    assert 3.9 < hits["depth"][12, 16] < 4.1 and hits["normal"][12, 16, 2] < -0.9 and hits["object"][12, 16] > 0


def test_colours_are_numbers(ball):
    colours = celltrace.render(ball, width=32, height=24, colours=True)
    assert colours.shape == (24, 32, 4) and colours.dtype == numpy.float32
    assert colours[0, 0, :3] == pytest.approx((0, 0, 1))


def test_a_text_is_a_scene():
    scene = celltrace.Scene.from_text("sphere { 0, R pigment { rgb Colour } }",
                                      declares={"R": 2, "Colour": 0.5})
    assert scene.objects[0].shape == celltrace.Sphere(0, 2)
    assert scene.materials[scene.objects[0].material].colour == (0.5, 0.5, 0.5)


def test_backends_agree(ball):
    native = celltrace.render(ball, width=64, height=64)
    session = celltrace.Session(ball, width=64, height=64, backend="cell_emu", spes=2, schedule="lockstep",
                                cache=celltrace.Cache(4, 64, "lru"))
    emulated = session.render()
    assert numpy.abs(native.astype(int) - emulated).max() <= 1
    assert session.statistics["backend"] == "cell_emu"
    assert len(session.statistics["spes"]) == 2


def test_a_session_makes_what_has_changed(ball):
    session = celltrace.Session(ball, width=64, height=48)
    assert session.statistics is None
    first = session.render()
    session.set_transform(0, celltrace.Transform.translate((1, 0, 0)))
    session.set_material(0, session.scene.materials[0].replace(colour=(0, 1, 0)))
    second = session.render()
    assert session.statistics["accelerator"]["preparation"] != "new"
    red, green = first[..., 0].astype(int), second[..., 1].astype(int)
    assert red.argmax() < green.argmax() and green.max() > 100
    session.show(0, False)
    assert (session.render() == (0, 0, 255, 255)).all()
    session.set_camera(celltrace.Camera(direction=(0, 0, -1)))
    session.set_light(0, celltrace.Light(colour=0))
    session.set_picture(width=20, height=10)
    assert session.render().shape == (10, 20, 4)
    with pytest.raises(celltrace.InputError, match="7"):
        session.show(7)
    with pytest.raises(TypeError, match="set_picture has no 'spes'"):
        session.set_picture(spes=1)


def test_time_and_memory_can_be_limited(ball):
    assert celltrace.render(ball, width=40, height=30, most_seconds=1000, most_memory=1 << 30).shape == (30, 40, 4)
    with pytest.raises(celltrace.Cancelled):
        celltrace.render(ball, width=40, height=30, most_seconds=1e-9)
    with pytest.raises(celltrace.InputError, match="1000 are allowed"):
        celltrace.render(ball, width=40, height=30, most_memory=1000)
    into = numpy.zeros((30, 40, 4), numpy.uint8)
    session = celltrace.Session(ball, width=40, height=30, most_seconds=1e-9)
    for _ in range(2):
        with pytest.raises(celltrace.Cancelled):
            session.render(into=into)


def test_words_of_the_program_are_known(ball):
    usual = celltrace.render(ball, width=40, height=30)
    assert (celltrace.render(ball, width=40, height=30, balance="static", accelerator="auto") == usual).all()


@pytest.mark.parametrize("channels", [3, 4])
def test_pixels_go_into_an_array_of_the_callers(ball, channels):
    session = celltrace.Session(ball, width=40, height=30)
    whole = numpy.zeros((60, 100, channels), numpy.uint8)
    window = whole[10:40, 20:60]
    assert session.render(into=window) is window
    assert (window == session.render()[..., :channels]).all()
    assert not whole[:10].any() and not whole[:, :20].any() and not whole[40:].any() and not whole[:, 60:].any()
    for wrong in (whole, window[:, ::-1], window.astype(float), window[::-1]):
        with pytest.raises(ValueError, match="into"):
            session.render(into=wrong)


def test_files_of_pictures(tmp_path, ball):
    pixels = celltrace.render(ball, width=20, height=10)
    celltrace.save(tmp_path / "ball.png", pixels)
    assert (celltrace.load(tmp_path / "ball.png") == pixels).all()
    celltrace.save(tmp_path / "ball.ppm", pixels[::-1, ::2, :3])
    assert (celltrace.load(tmp_path / "ball.ppm") == pixels[::-1, ::2]).all()
    celltrace.save(tmp_path / "deep.png", pixels.astype(numpy.uint16) * 257)
    assert (celltrace.load(tmp_path / "deep.png") == pixels).all()
    with pytest.raises(TypeError):
        celltrace.save(tmp_path / "ball.png", pixels.astype(float))
    with pytest.raises(ValueError):
        celltrace.save(tmp_path / "ball.png", pixels[..., 0])
    with pytest.raises(celltrace.InputError, match="ball.xyz"):
        celltrace.save(tmp_path / "ball.xyz", pixels)


def test_regions(ball):
    pixels = celltrace.render(ball, width=40, height=30, region=(10, 5, 30, 25))
    assert pixels[5:25, 10:30, 2].any() and not pixels[:5, :, :3].any() and not pixels[:, 30:, :3].any()
