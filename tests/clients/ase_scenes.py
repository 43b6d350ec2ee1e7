"""Scenes of ASE, rendered by its own call of `povray FILE.ini`."""

import itertools
import math
import os
import subprocess

import numpy
from ase import Atoms
from ase.constraints import FixAtoms
from ase.io.pov import get_bondpairs, set_high_bondorder_pairs, write_pov

import calls
import molecules


def atoms_of(molecule, **settings):
    return Atoms([element for element, _ in molecule], [place for _, place in molecule], **settings)


def render(name, atoms, povray=None, **projection):
    """Writes and renders a scene. ASE raises an error where `povray` returns one or leaves no picture."""
    settings = {"canvas_width": 200}
    settings.update(povray or {})
    settings = {key: value for key, value in settings.items() if value is not None}
    try:
        write_pov(f"{name}.pov", atoms, povray_settings=settings, **projection).render()
    except (OSError, RuntimeError, subprocess.SubprocessError) as error:
        calls.failed(f"{name}: {error}")


def cell_of_salt():
    atoms = atoms_of(molecules.rock_salt(1), cell=[5.64] * 3, pbc=True)
    atoms.rotate(0, "x")
    return atoms


def density():
    """A gaussian at the middle of a grid, for an isosurface."""
    axis = numpy.linspace(-1, 1, 16)
    x, y, z = numpy.meshgrid(axis, axis, axis, indexing="ij")
    return numpy.exp(-3 * (x * x + y * y + 0.5 * z * z))


def scenes():
    benzene = atoms_of(molecules.benzene())
    ethanol = atoms_of(molecules.ethanol())
    ferrocene = atoms_of(molecules.ferrocene())
    salt = cell_of_salt()
    tilted = {"rotation": "10x,-20y,5z"}

    # The height of most of these is no whole number, as ASE derives it from the molecule.
    yield "default", benzene, {"canvas_width": None}, {}
    yield "bonds", ethanol, {"bondatoms": get_bondpairs(ethanol), "transparent": False}, {
        "radii": [0.3] * len(ethanol), **tilted}
    yield "cell", salt, {"canvas_height": 180, "canvas_width": None, "celllinewidth": 0.1}, {
        "show_unit_cell": 2, **tilted}
    styles = ["simple", "pale", "intermediate", "vmd", "jmol", "ase2", "ase3", "glass", "glass2"]
    yield "styles", ethanol, {"textures": styles, "transparent": False}, tilted
    yield "transmittances", ferrocene, {"transmittances": [0.1 * (i % 8) for i in range(len(ferrocene))]}, tilted
    yield "fog", salt, {"depth_cueing": True, "cue_density": 0.05, "camera_dist": 10.0, "transparent": False}, tilted
    yield "perspective", ferrocene, {"camera_type": "perspective", "camera_dist": 20.0, "transparent": False}, tilted
    yield "points", benzene, {"area_light": None, "background": "Gray20", "transparent": False,
                              "point_lights": [[(5, 5, 20), "White"], [(-20, 2, 5), (0.8, 0.3, 0.1)]]}, tilted
    fixed = salt.copy()
    fixed.set_constraint(FixAtoms([0, 2, 5]))
    yield "constraints", fixed, {"exportconstraints": True, "transparent": False}, tilted
    pairs = set_high_bondorder_pairs(get_bondpairs(benzene), {
        (0, 1): ((0, 0, 0), 2, (0.1, 0.1, 0)), (2, 3): ((0, 0, 0), 3, (0.1, -0.2, 0)),
        (4, 5): ((0, 0, 0), 2, (0.0, 0.15, 0))})
    yield "orders", benzene, {"bondatoms": pairs}, {"radii": [0.25] * len(benzene), **tilted}
    many = atoms_of(molecules.rock_salt(3))
    shift = many.get_positions()
    many.set_positions(shift + 0.4 * numpy.sin(shift[:, [1, 2, 0]] * math.pi / 7))
    yield "many", many, {"textures": ["ase2"] * len(many), "canvas_width": 240}, tilted


def isosurface(salt):
    """A mesh2 of a density, as ASE 3.22 writes it where scikit-image still has the function that it calls."""
    from skimage import measure
    if not hasattr(measure, "marching_cubes_lewiner"):
        measure.marching_cubes_lewiner = measure.marching_cubes
    render("isosurface", salt, {"transparent": False}, show_unit_cell=2, rotation="10x,-20y,5z",
           isosurface_data={"density_grid": density(), "cut_off": 0.4, "color": (0.2, 0.5, 0.8, 0.3)})


short = 3 if os.environ.get("CELLTRACE_SHORT") else None
for scene in itertools.islice(scenes(), short):
    render(scene[0], scene[1], scene[2], **scene[3])
try:
    if not short:
        isosurface(cell_of_salt())
except ImportError:
    pass  # scikit-image is not installed
calls.leave()
