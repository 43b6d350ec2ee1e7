"""Scenes of Blender's POV-Ray add-on, which exports, runs `povray FILE.ini -d` and loads the picture: blender -b -P FILE."""

import math
import os
import sys

import bpy

sys.path.insert(0, os.environ["CELLTRACE_CLIENTS"])
import molecules  # noqa: E402


def material(name, colour, alpha=1.0):
    made = bpy.data.materials.new(name)
    made.diffuse_color = (*colour, alpha)
    made.pov.alpha = alpha
    made.pov.use_transparency = alpha < 1
    made.pov.diffuse_color = colour
    return made


def place(made, **transforms):
    for name, value in transforms.items():
        setattr(bpy.context.object, name, value)
    bpy.context.object.data.materials.append(made)


def stage():
    """Removes all and puts camera, a lamp and a floor."""
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.object.camera_add(location=(6, -6, 4.5), rotation=(math.radians(62), 0, math.radians(45)))
    bpy.context.scene.camera = bpy.context.object
    bpy.ops.object.light_add(type="POINT", location=(4, -2, 6))
    bpy.context.object.data.energy = 1000
    bpy.ops.mesh.primitive_plane_add(size=8)
    place(material("floor", (0.6, 0.6, 0.5)))


def meshes():
    bpy.ops.mesh.primitive_cube_add(size=1.5, location=(0, 0, 0.75))
    place(material("red", (0.8, 0.1, 0.1)))
    bpy.ops.mesh.primitive_cone_add(location=(2, 0.5, 1))
    place(material("green", (0.1, 0.7, 0.2)))
    bpy.ops.mesh.primitive_torus_add(location=(-1.8, -0.5, 0.4))
    place(material("blue", (0.1, 0.2, 0.8)))


def smooth():
    bpy.ops.mesh.primitive_monkey_add(size=2.5, location=(0, 0, 1.3), rotation=(0, 0, math.radians(40)))
    bpy.ops.object.shade_smooth()
    place(material("skin", (0.8, 0.5, 0.3)))


def atoms():
    """Spheres of a molecule and glass around one of them."""
    for element, (x, y, z) in molecules.ethanol():
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.35 if element == "H" else 0.55, location=(1.2 * x, 1.2 * y, 1.2 * z + 1.6))
        bpy.ops.object.shade_smooth()
        place(material(element, {"H": (0.9,) * 3, "C": (0.3,) * 3, "O": (0.8, 0.1, 0.1)}[element]))


def transparent():
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0, 0, 0.6))
    place(material("core", (0.9, 0.7, 0.1)))
    bpy.ops.mesh.primitive_ico_sphere_add(radius=1.4, location=(0, 0, 1.4))
    place(material("shell", (0.3, 0.6, 0.9), 0.4))


def orthographic():
    """A camera whose `angle` has no number in the scene."""
    meshes()
    bpy.context.scene.camera.data.type = "ORTHO"
    bpy.context.scene.camera.data.ortho_scale = 7


def lamps():
    """A sun, a spotlight and an area lamp, under a sky."""
    smooth()
    for kind, settings in (("SUN", {"energy": 2}), ("SPOT", {"energy": 500, "spot_size": 0.8}), ("AREA", {"energy": 300, "size": 1.5})):
        bpy.ops.object.light_add(type=kind, location=(3, -3, 5), rotation=(math.radians(35), math.radians(15), 0))
        for name, value in settings.items():
            setattr(bpy.context.object.data, name, value)
    bpy.context.scene.world.pov.use_sky_blend = True


folder = os.getcwd()
bpy.ops.preferences.addon_enable(module="render_povray")
for scene in (meshes, smooth, atoms, transparent, lamps, orthographic):
    stage()
    scene()
    settings = bpy.context.scene
    settings.render.engine = "POVRAY_RENDER"
    settings.render.resolution_x, settings.render.resolution_y, settings.render.resolution_percentage = 240, 180, 100
    # Radiosity, which is on by default, is random, and celltrace does not have it yet.
    settings.pov.radio_enable = False
    settings.pov.tempfiles_enable = False
    settings.pov.deletefiles_enable = False
    settings.pov.scene_path = folder + "/"
    settings.pov.scene_name = scene.__name__
    settings.pov.antialias_enable = True
    settings.render.filepath = os.path.join(folder, f"{scene.__name__}.png")
    bpy.ops.render.render(write_still=True)
