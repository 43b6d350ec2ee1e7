"""Molecules and meshes for the scenes of client programs, all computed here.

A molecule is a list of (element, (x, y, z)) in Angstrom.
"""

import math


def ring(element, count, radius, height=0.0, turn=0.0):
    angles = [2 * math.pi * i / count + turn for i in range(count)]
    return [(element, (radius * math.cos(a), radius * math.sin(a), height)) for a in angles]


def water():
    return [("O", (0.0, 0.0, 0.12)), ("H", (0.0, 0.76, -0.47)), ("H", (0.0, -0.76, -0.47))]


def benzene():
    return ring("C", 6, 1.39) + ring("H", 6, 2.48)


def ethanol():
    return [("C", (-1.17, -0.40, 0.0)), ("C", (0.05, 0.51, 0.0)), ("O", (1.19, -0.32, 0.0)),
            ("H", (-2.08, 0.20, 0.0)), ("H", (-1.15, -1.04, 0.89)), ("H", (-1.15, -1.04, -0.89)),
            ("H", (0.02, 1.16, 0.89)), ("H", (0.02, 1.16, -0.89)), ("H", (1.95, 0.26, 0.0))]


def ferrocene():
    """Two rings of carbon around iron: a metal, and bonds that no table of valences has."""
    return ([("Fe", (0.0, 0.0, 0.0))] + ring("C", 5, 1.21, 1.65) + ring("C", 5, 1.21, -1.65, math.pi / 5)
            + ring("H", 5, 2.29, 1.63) + ring("H", 5, 2.29, -1.63, math.pi / 5))


def rock_salt(cells, constant=5.64):
    """A cube of sodium chloride with `cells` cells a side."""
    atoms = []
    for i in range(2 * cells):
        for j in range(2 * cells):
            for k in range(2 * cells):
                element = "Na" if (i + j + k) % 2 == 0 else "Cl"
                atoms.append((element, tuple(constant / 2 * x for x in (i, j, k))))
    return atoms


# Atoms of a residue of an ideal alpha helix: distance from the axis (Angstrom), angle (degrees) and place along it.
_HELIX = [("N", "N", 1.55, 0.0, 0.0), ("CA", "C", 2.28, 27.6, 0.90), ("C", "C", 1.69, 74.8, 1.63),
          ("O", "O", 2.02, 76.6, 2.85), ("CB", "C", 3.29, 18.8, -0.22)]


def helix_pdb(residues=12):
    """A helix of alanine as a PDB file's text: 100 degrees and 1.5 Angstrom a residue."""
    lines = [f"HELIX    1   1 ALA A    1  ALA A {residues:4}  1{residues:36}"]
    serial = 1
    for residue in range(residues):
        for name, element, radius, angle, rise in _HELIX:
            turn = math.radians(angle + 100 * residue)
            x, y, z = radius * math.cos(turn), radius * math.sin(turn), rise + 1.5 * residue - 0.75 * residues
            lines.append(f"ATOM  {serial:5}  {name:<3} ALA A{residue + 1:4}    {x:8.3f}{y:8.3f}{z:8.3f}"
                         f"  1.00{10 + 3 * residue:6.2f}          {element:>2}")
            serial += 1
    return "\n".join(lines + ["TER", "END", ""])


def xyz(atoms, title="atoms"):
    """An XYZ file's text."""
    return "\n".join([str(len(atoms)), title] + [f"{e} {x:.4f} {y:.4f} {z:.4f}" for e, (x, y, z) in atoms]) + "\n"
