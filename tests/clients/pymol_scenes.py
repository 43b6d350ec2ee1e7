"""Scenes of PyMOL, whose `ray` command with renderer 1 exports, runs `povray` and loads its picture: pymol -cq FILE."""

import math
import os
import sys

from pymol import cmd
from pymol.cgo import ALPHA, BEGIN, COLOR, CONE, CYLINDER, END, NORMAL, SPHERE, TRIANGLES, VERTEX

sys.path.insert(0, os.environ["CELLTRACE_CLIENTS"])
import molecules  # noqa: E402


def molecule(atoms, name):
    with open(f"{name}.xyz", "w", encoding="utf-8") as file:
        file.write(molecules.xyz(atoms, name))
    cmd.load(f"{name}.xyz", name)


def peptide():
    cmd.read_pdbstr(molecules.helix_pdb(), "helix")
    cmd.hide("everything")
    cmd.orient()


def small(shape, atoms=molecules.ethanol):
    molecule(atoms(), "small")
    cmd.hide("everything")
    cmd.show(shape)
    cmd.orient()
    cmd.turn("x", 30)
    cmd.turn("y", 20)


def sticks():
    small("sticks")


def lines():
    small("lines")


def spheres():
    small("spheres")


def balls():
    small("sticks")
    cmd.show("spheres")
    cmd.set("sphere_scale", 0.25)
    cmd.set("stick_radius", 0.12)


def clear_spheres():
    small("spheres", molecules.benzene)
    cmd.set("sphere_transparency", 0.5)


def nonbonded():
    small("nb_spheres", lambda: [("O", (2.5 * i, 0.4 * i * i, 0.0)) for i in range(4)])


def dots():
    small("dots", molecules.benzene)


def mesh():
    small("mesh")


def surface():
    small("surface")
    cmd.color("marine")


def clear_surface():
    small("surface", molecules.ferrocene)
    cmd.show("sticks")
    cmd.set("transparency", 0.4)


def surface_of_colours():
    small("surface")


def cartoon():
    peptide()
    cmd.show("cartoon")
    cmd.spectrum("b")


def ribbon():
    peptide()
    cmd.show("ribbon")
    cmd.show("lines")


def putty():
    peptide()
    cmd.cartoon("putty")
    cmd.show("cartoon")


def fog():
    peptide()
    cmd.show("sticks")
    cmd.bg_color("white")
    cmd.set("ray_trace_fog", 1)
    cmd.set("fog", 1.2)


def shapes():
    """Spheres, a cylinder, a cone and a strip of triangles of the user's own."""
    parts = [COLOR, 0.9, 0.3, 0.2, SPHERE, -2.0, 0.0, 0.0, 1.0, CYLINDER, -1.0, 0.0, 0.0, 2.0, 0.5, 1.0, 0.3,
             0.2, 0.7, 0.9, 0.9, 0.9, 0.1, CONE, 2.0, 0.5, 1.0, 3.5, 0.5, 1.0, 0.8, 0.0, 0.2, 0.8, 0.2, 0.2, 0.8, 0.2, 1.0, 0.0,
             ALPHA, 0.6, BEGIN, TRIANGLES]
    for i in range(12):
        for j in (i, i + 1, i + 0.5):
            angle = math.pi * j / 6
            parts += [NORMAL, 0.0, 0.0, 1.0, COLOR, 0.08 * i, 0.5, 0.9, VERTEX, 2.5 * math.cos(angle), 2.5 * math.sin(angle),
                      -1.0 if j != i + 0.5 else 1.0]
    cmd.load_cgo(parts + [END], "shapes")
    cmd.zoom("shapes")


def ellipsoids():
    """Atoms with anisotropic temperature factors, and no shadows."""
    lines = []
    for i, (element, (x, y, z)) in enumerate(molecules.ethanol()):
        lines.append(f"HETATM{i + 1:5}  {element:<3} LIG A   1    {x:8.3f}{y:8.3f}{z:8.3f}  1.00 20.00          {element:>2}")
        lines.append(f"ANISOU{i + 1:5}  {element:<3} LIG A   1  {500 + 90 * i:7}{900:7}{300 + 60 * i:7}{120:7}{-60:7}{40:7}      {element:>2}")
    cmd.read_pdbstr("\n".join(lines + ["END", ""]), "aniso")
    cmd.hide("everything")
    cmd.show("ellipsoids")
    cmd.show("sticks")
    cmd.set("ray_shadow", 0)
    cmd.orient()


for scene in (sticks, lines, spheres, balls, clear_spheres, nonbonded, dots, mesh, surface, clear_surface, surface_of_colours,
              cartoon, ribbon, putty, fog, shapes, ellipsoids):
    cmd.reinitialize()
    cmd.set("batch_prefix", scene.__name__)
    scene()
    cmd.ray(240, 180, renderer=1)
    cmd.png(f"{scene.__name__}.png")  # over the file that `povray` left: what PyMOL has read of it
