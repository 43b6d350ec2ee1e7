"""Scenes of Open Babel, which only writes them; rendered as its README says, with its babel_povray3.inc beside them."""

import glob
import shutil
import subprocess

import calls
import molecules

# Scenes by name: the molecule and the options of the writer.
SCENES = {
    "balls": ("ethanol", ["-xm", "BAS"]),
    "spacefill": ("ferrocene", ["-xm", "SPF"]),
    "sticks": ("benzene", ["-xm", "CST"]),
    "checkered": ("water", ["-xc", "-xf", "-xs", "-xm", "SPF"]),
    "transparent": ("ethanol", ["-xt"]),
}

for file in glob.glob("/usr/share/openbabel/*/babel_povray3.inc")[:1]:
    shutil.copy(file, ".")
for scene, (molecule, options) in SCENES.items():
    with open(f"{scene}.xyz", "w", encoding="utf-8") as file:
        file.write(molecules.xyz(getattr(molecules, molecule)(), molecule))
    subprocess.run(["obabel", f"{scene}.xyz", "-O", f"{scene}.pov", *options], check=True, stderr=subprocess.DEVNULL)
    calls.povray("+V", "+A", "+D0", "+Q9", "+W240", "+H180", f"{scene}.pov")
calls.leave()
