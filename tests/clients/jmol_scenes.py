"""Scenes of Jmol, which writes NAME.pov and NAME.pov.ini; rendered as its manual says: `povray NAME.pov.ini`."""

import subprocess

import calls
import molecules

_SETUP = "set antialiasDisplay false; background [x203040]; rotate x 25; rotate y 15;"

# Scenes by name: the molecule's file and Jmol's commands.
SCENES = {
    "balls": ("ethanol.xyz", "spacefill 23%; wireframe 0.15;"),
    "spacefill": ("ethanol.xyz", "spacefill 100%; wireframe off;"),
    "wireframe": ("ferrocene.xyz", "spacefill off; wireframe 1;"),
    "sticks": ("ferrocene.xyz", "spacefill off; wireframe 0.25;"),
    "cartoon": ("helix.pdb", "spacefill off; wireframe off; cartoons on; color structure;"),
    "ribbon": ("helix.pdb", "spacefill off; wireframe off; ribbons on; color group;"),
    "trace": ("helix.pdb", "spacefill off; wireframe off; trace on;"),
    "rockets": ("helix.pdb", "spacefill off; wireframe off; rockets on; color chain;"),
    "backbone": ("helix.pdb", "spacefill off; wireframe off; backbone 0.4;"),
    "dots": ("ethanol.xyz", "spacefill 23%; dots on;"),
    "surface": ("ethanol.xyz", "isosurface solvent 1.2 color lightblue;"),
    "translucent": ("ethanol.xyz", "isosurface vdw color translucent 0.6 orange;"),
    "mesh": ("ethanol.xyz", "spacefill 15%; isosurface vdw mesh nofill color white;"),
    "cell": ("salt.xyz", "unitcell [{0 0 0} {5.64 0 0} {0 5.64 0} {0 0 5.64}]; unitcell 0.05; spacefill 30%; axes on;"),
    "perspective": ("salt.xyz", "set perspectiveDepth off; spacefill 50%; set zshade on; slab 80; depth 10; slab on;"),
    "clear_atoms": ("benzene.xyz", "spacefill 60%; wireframe 0.2; color atoms translucent 0.5; set specular off;"),
    "drawn": ("ethanol.xyz", "draw line1 LINE {-2 -2 0} {2 2 0} color red; draw plane1 PLANE {2 0 0} {0 2 0} {0 0 2} color translucent green;"
                             " draw arrow1 ARROW {0 0 0} {2 -2 1} color yellow; vectors on; measure (atomno=1) (atomno=3);"),
}


models = {f"{name}.xyz": molecules.xyz(getattr(molecules, name)(), name) for name in ("ethanol", "benzene", "ferrocene")}
models["salt.xyz"] = molecules.xyz(molecules.rock_salt(2), "salt")
models["helix.pdb"] = molecules.helix_pdb()
script = []
for scene, (model, commands) in SCENES.items():
    # In the script: with -n Jmol ends before it has loaded a file.
    script += [f'load data "model {model}"', models[model].rstrip("\n"), f'end "model {model}"',
               f"{_SETUP} {commands} refresh;", f'write POVRAY "{scene}.pov";']
with open("scenes.spt", "w", encoding="utf-8") as file:
    file.write("\n".join(script + ["exitJmol;", ""]))
subprocess.run(["jmol", "-n", "-x", "-g", "240x180", "-s", "scenes.spt"], check=True, stdout=subprocess.DEVNULL,
               stderr=subprocess.DEVNULL, timeout=300)
for scene in SCENES:
    calls.povray(f"{scene}.pov.ini")
calls.leave()
