import celltrace
import pytest


@pytest.fixture
def scene_file(tmp_path):
    """A red ball before a blue wall, as a file."""
    path = tmp_path / "ball.pov"
    path.write_text("""
        #version 3.7;
        global_settings { assumed_gamma 1 }
        camera { location -5*z look_at 0 angle 40 right x*image_width/image_height }
        light_source { <4, 6, -8>, 1 }
        background { rgb <0, 0, 1> }
        sphere { 0, 1 pigment { rgb <1, 0, 0> } }
        """)
    return path


@pytest.fixture
def ball():
    """The same, built in code."""
    scene = celltrace.Scene()
    scene.camera = celltrace.Camera.look_at((0, 0, -5), (0, 0, 0), angle=40)
    scene.add_light(celltrace.Light((4, 6, -8)))
    scene.background = (0, 0, 1)
    scene.add(celltrace.Sphere(0, 1), material=celltrace.Material(colour=(1, 0, 0)))
    return scene


@pytest.fixture
def slow_options():
    """With these a frame of the ball takes many seconds."""
    return {"width": 2400, "height": 2400, "antialiasing": celltrace.Antialiasing(depth=9, threshold=0)}
