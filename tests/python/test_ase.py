"""Pictures of atoms, as ASE makes them by POV-Ray."""

import shutil
import subprocess

import numpy
import pytest

ase = pytest.importorskip("ase")
pytest.importorskip("ase.io.pov")

import celltrace  # noqa: E402
import celltrace.ase  # noqa: E402


@pytest.fixture
def atoms():
    from ase.build import bulk, molecule
    made = bulk("Au", cubic=True) * (2, 2, 1)
    made.extend(molecule("CH3CH2OH"))
    made.positions[-9:] += (4, 4, 6)
    made.cell[2, 2] = 9
    return made


def ase_picture(folder, atoms, **keywords):
    """That of ASE's own file by POV-Ray."""
    from ase.io.pov import write_pov
    path = folder / "atoms.pov"
    write_pov(path, atoms, **keywords)
    settings = dict(line.split("=") for line in path.with_suffix(".ini").read_text().splitlines() if "=" in line and line[0] != ";")
    alpha = "+UA" if settings["Output_Alpha"] == "on" else "-UA"
    subprocess.run(["povray", "-D", "-P", "+A0.1", "-J", "+WT1", alpha, f"+W{int(float(settings['Width']))}",
                    f"+H{int(float(settings['Height']))}", f"+I{path}", f"+O{path}.png"],
                   cwd=folder, check=True, stderr=subprocess.DEVNULL)
    return celltrace.load(f"{path}.png")


@pytest.mark.skipif(not shutil.which("povray"), reason="there is no povray")
@pytest.mark.parametrize("keywords, settings", [
    ({}, {}),
    ({"rotation": "10z,-80x,20y"}, {"canvas_width": 300}),
    ({"rotation": "-70x", "radii": 0.5}, {"bonds": True, "celllinewidth": 0.1}),
    ({"show_unit_cell": 0, "colors": None}, {"textures": "jmol", "transmittances": 0.3, "canvas_height": 200}),
    ({}, {"camera_type": "perspective", "camera_dist": 30, "point_lights": [((10, 10, 40), (1, 0.5, 0.5))],
          "transparent": False}),
])
def test_as_ase_has_it(tmp_path, atoms, keywords, settings):
    if isinstance(settings.get("textures"), str):
        settings = {**settings, "textures": [settings["textures"]] * len(atoms),
                    "transmittances": [settings["transmittances"]] * len(atoms)}
    theirs = {**settings}
    if theirs.pop("bonds", False):
        from ase.io.pov import get_bondpairs
        theirs["bondatoms"] = get_bondpairs(atoms)
    expected = ase_picture(tmp_path, atoms, povray_settings=theirs, **keywords)
    made = celltrace.ase.render(atoms, **keywords, **settings)
    assert made.shape == expected.shape
    difference = celltrace.compare(made, expected)
    assert difference["psnr"] > 30, difference  # ASE writes two digits of each number


def test_sizes_and_scenes(atoms):
    assert celltrace.ase.render(atoms, width=100).shape[1] == 100
    assert celltrace.ase.render(atoms, height=90).shape[0] == 90
    assert celltrace.ase.render(atoms, width=50, height=40, alpha=False).shape == (40, 50, 4)
    scene = celltrace.ase.scene(atoms, bonds=[(0, 1), (1, 2, (0, 0, 0), 2), (2, 3, (0, 0, 0), 3)])
    assert len(scene.objects) == 12 + len(atoms) + 2 + 4 + 6
    assert len(scene.materials) < 10
    fixed = atoms.copy()
    fixed.set_constraint(ase.constraints.FixAtoms([0, 1]))
    assert len(celltrace.ase.scene(fixed, exportconstraints=True).objects) == 12 + len(atoms) + 4
    with pytest.raises(ValueError, match="chrome"):
        celltrace.ase.scene(atoms, textures=["chrome"] * len(atoms))
    with pytest.raises(TypeError):
        celltrace.ase.render(atoms, shininess=3)
