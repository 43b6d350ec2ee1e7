"""Command lines and INI files of programs that call `povray`, as their sources have them, each on a small scene.

A row says who calls, with what, and the file that must be there afterwards; a `>` in front of it stands for the standard output.
"""

import concurrent.futures
import os
import shlex
import shutil
import subprocess
import sys

import written_scenes

ROWS = [
    # Molecules.
    ("ase", "povray ase.ini", "ase.png"),
    ("pymol", "povray +FN -D +Imolecule.pov +Otmp_pymol.png +W120 +H90 +A", "tmp_pymol.png"),
    ("jmol", "povray jmol.pov.ini", "jmol.pov.png"),
    ("vmd", "povray +W120 +H90 -Ivmdscene.pov -Ovmdscene.pov.tga +D +X +A +FT", "vmdscene.pov.tga"),
    ("vmd-comment", "povray +W120 +H90 -Ivmdscene.pov -Ovmdscene.pov.tga +P +X +A +FT +C", "vmdscene.pov.tga"),
    ("vmd-stereo", "povray +W120 +H90 -Ivmdscene.pov -Ovmdscene.pov.tga +P +X +A +FT +C -UV", "vmdscene.pov.tga"),
    ("vmd-png", "povray +W120 +H90 -Ivmdscene.pov -Ovmd.png -D +X +A +FN +UA", "vmd.png"),
    ("vmd-quality", "povray +W120 +H90 -Ivmdscene.pov -Ovmd.tga -D +X +C +A +AM2 +R4 +FT +UA +Q11", "vmd.tga"),
    ("vmd-two-extensions", "povray +W120 +H90 -Ivmdscene.pov -Ovmd.png +X +A +FT +UA", "vmd.png.tga"),
    ("vmd-fog", "povray +W120 +H90 -Ivmdmesh.pov -Ovmdmesh.tga +X +FT", "vmdmesh.tga"),
    ("openbabel", "povray +V +A +D0 +Q9 +W120 +H90 molecule.pov", "molecule.png"),
    ("coot", "povray +L/sw/share/povray-3.6/include +FN16 -UV +H90 +W120 molecule.pov", "molecule.png"),
    ("avogadro", "povray +Imolecule.pov +Omolecule.png +W120 +H90 +V +D +FN +Q10 +A +UA", "molecule.png"),
    ("rdkit", "povray +Imolecule.pov +Oout.png +W120 +H90 +Q9 +A +FN +UA -D +L.", "out.png"),
    ("canvas3d", "povray canvas.ini", "canvas.png"),
    ("mcstas", "povray -W120 -H90 +a0.3 +SP16 molecule.pov +P", "molecule.png"),
    # Bricks.
    ("leocad", "povray +Ibricks.pov +W120 +H90 -O- +Q11 +R3 +A0.1 +J0.5 +FN -D", ">out.png"),
    ("leocad-draft", "povray +Ibricks.pov +W120 +H90 -O- +Q5 +A0.1 +FN -D", ">out.png"),
    ("leocad-quoted", "povray '+I\"bricks.pov\"' +W120 +H90 '+O\"out.png\"' +FN -D", "out.png"),
    ("lpub", "povray '+I\"bricks.pov\"' '+O\"out.png\"' +W120 +H90 +UA +A +Q9 +FN -D", "out.png"),
    ("ldraw-steps", "povray +Ibricks.pov +Oout.png +W120 +H90 -Q11 +ua +FN +KI1 +KFI1 +KF3 +KFF3 +A", "out3.png"),
    # Modellers.
    ("blender", "povray blender.ini -d", "out.png"),
    ("blender-preview", "povray -d preview.ini", "prev.png"),
    ("blender-border", "povray border.ini -d", "out.png"),
    ("poseray", "povray bricks.pov +W120 +H90 +FN +AM2 +A0.01 +r3 +Q9 +C -UA +MV3.7", "bricks.png"),
    ("freecad", "povray +Q9 +P +A +W120 +H90 '+O\"my picture.png\"' bricks.pov", "my picture.png"),
    ("wings", "povray +Ibricks.pov +Oout.png +W120 +H90 +FN +AM1 +A0.3 +R2 -D -P", "out.png"),
    ("maker", "povray maker.ini", "maker.png"),
    ("lightwave", "povray movie.ini[LOW]", "movie-3.png"),
    # Mathematics, maps, data.
    ("sage", "povray bricks.pov +O\"out.png\" Width=120 Height=90 Quality=9 Display=off", "out.png"),
    ("vapory", "povray +W120 +H90 +A0.01 -D +Oout.png bricks.pov", "out.png"),
    ("vapory-stream", "povray +W120 +H90 -D +FP +O- bricks.pov", ">out.ppm"),
    ("grass", "povray +Ibricks.pov +Oout.png +D +P +W120 +H90 +A", "out.png"),
    ("octave", "povray 'Input_File_Name=bricks.pov' 'Output_File_Name=out.png' Width=120 Height=90", "out.png"),
    ("cellmech", "povray -d -GD -GR -GS +Ibricks.pov +H90 +W120 -O-", ">out.png"),
    ("frames", "povray -H90 -W120 Quality=11 Antialias=on bricks.pov", "bricks.png"),
    ("checks", "povray -W120 -H90 +A0.1 Display=false bricks.pov", "bricks.png"),
    ("favicon", "povray bricks.pov -Oout.png +A0.1 -w64 -h64 +UA +R8", "out.png"),
    ("small-letters", "povray +L. +L.. +ibricks.pov +fp +oout.ppm +a +w120 +h90 +q3 -d", "out.ppm"),
    ("quicklook", "povray -Iquick.ini +oout.png +H90 +W120 +SP256 +P bricks.pov", "out.png"),
    ("ini-and-output", "povray maker.ini +Oout/x.png", "out/x.png"),
    ("morpho", "povray bricks.pov +Oout.png +A +W120 +H90", "out.png"),
    ("scherk", "povray +Ibricks.pov +FN +W120 +H90 +KFI1 +KFF4 +SF2 +EF3", "bricks3.png"),
    ("dataset", "povray +Ibricks.pov +Oout.png +W120 +H90 Declare=val00=0.1 Declare=val10=-2 +FN16 +wt1 -d +L/usr/share/povray-3.7/include "
                "Declare=use_baking=2 +A0.0", "out.png"),
    ("board", "povray Output_File_Name=out.png Input_File_Name=bricks.pov +K-5 Output_File_Type=N +W120 +H90", "out.png"),
    ("movie-command", "povray move.ini[go]", "move2.png"),
    ("life", "povray life.ini +W60 +H45", "life2.bmp"),
    ("benchmark", "povray bench.ini +W120 +H90", "bricks.png"),
    ("jupyter", "povray +W120 +H90 +FN +Oout.png -D +UA +A0.3 bricks.pov", "out.png"),
    ("web-identicon", "povray '+I\"bricks.pov\"' +FN +W90 +H90 '+O\"out.png\"' +Q8 +AM2 +A0.5 -D", "out.png"),
    ("game", "povray +Ibricks.pov +Oout.png +FN -D -P +W120 +H90 +WT2 +Q9 -A", "out.png"),
    ("hdr", "povray +Ibricks.pov +Oout.hdr +W120 +H90 +A0.3 -D +Q9 +AM2 +R2 +FH", "out.hdr"),
    ("compressed", "povray +Ibricks.pov +Oout.tga +W120 +H90 +FC", "out.tga"),
    ("jpeg", "povray +Ibricks.pov +Oout.jpg +W120 +H90 +FJ", "out.jpg"),
    ("bmp", "povray +Ibricks.pov +Oout.bmp +W120 +H90 +FB", "out.bmp"),
]


def picture_of(produced, png):
    """Makes a PNG of what a program wrote, by ImageMagick; not of Radiance's files, which the converter rounds."""
    if produced.endswith(".png"):
        shutil.copy(produced, png)
    elif not produced.endswith(".hdr"):
        subprocess.run(["convert", produced, f"png:{png}"], check=True)


def run(name, command, output):
    """Runs a row in a folder of its own. Returns what went wrong, or an empty string."""
    os.makedirs(f"{name}/out")
    os.makedirs("pictures", exist_ok=True)
    written_scenes.write(name)
    produced = output.lstrip(">")
    with open(os.path.join(name, produced if output[0] == ">" else "stdout"), "wb") as stdout, \
            open(f"{name}/stderr", "wb") as stderr:
        code = subprocess.run(shlex.split(command), cwd=name, stdin=subprocess.DEVNULL, stdout=stdout, stderr=stderr,
                              check=False).returncode
    produced = os.path.join(name, produced)
    if code:
        problem = f"exit code {code}"
    elif not os.path.isfile(produced) or not os.path.getsize(produced):
        problem = f"no {output}"
    else:
        picture_of(produced, f"pictures/{name}.png")
        problem = ""
    if problem:
        with open(f"{name}/stderr", encoding="utf-8", errors="replace") as file:
            said = [line for line in file.read().splitlines() if line.strip()]
        print(f"{name}: {command}: {problem}: {' | '.join(said[-3:])}")
    os.rename(name, f"{name}.done")
    return problem


rows = [row for row in ROWS if row[2].endswith("png") or shutil.which("convert")]
with concurrent.futures.ThreadPoolExecutor(4) as pool:  # POV-Ray waits more than it computes
    sys.exit(1 if any(list(pool.map(lambda row: run(*row), rows))) else 0)
