#!/usr/bin/env python3
"""Renders scenes of programs that call POV-Ray, with celltrace in POV-Ray's place, and compares the pictures.

  tests/clients/run.py --celltrace PROGRAM [options] [CLIENT...]

A client's script exports its scenes and renders them by its own command, `povray`, which is found first in the PATH. It runs
three times: with celltrace and nothing changed; with celltrace and with POV-Ray, both without jitter, whose numbers are
random. Exit codes: 0 done, 1 a scene fails or differs, 77 no client or no POV-Ray is installed.
"""

import argparse
import importlib.util
import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True  # the sources stay as they are
from png import alpha_psnr, colour_type  # noqa: E402

HERE = Path(__file__).resolve().parent
SKIPPED = 77

# A `povray` that notes what it is called with. Without jitter the scenes lose the word, which Povray's -J leaves to lights,
# and -D and -P keep POV-Ray from waiting for a key in front of its picture.
OWN = """#!/bin/sh
printf '%s\\n' "$*" >> '{log}'
exec '{program}' "$@"
"""
PLAIN = """#!/bin/sh
grep -rlZE --include='*.pov' 'adaptive [0-9]+ +jitter' '{folder}' 2>/dev/null |
  xargs -0 -r sed -i -E 's/(adaptive [0-9]+) +jitter/\\1/'
exec '{program}' "$@" -D -P -J
"""


class Client:
    """A program that exports scenes: its Debian package, how its script is run, and how many pictures that makes at least."""

    def __init__(self, name, package, command, pictures, needs, display=False):
        self.name, self.package, self.command, self.pictures = name, package, command, pictures
        self.needs, self.display = needs, display

    def is_installed(self):
        return self.needs() and (not self.display or shutil.which("xvfb-run"))


def module_in(python, name):
    return subprocess.run([python, "-c", f"import {name}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          check=False).returncode == 0


def python_with(name):
    """An interpreter that has a module: this one or the distribution's. None without one."""
    if importlib.util.find_spec(name):
        return sys.executable
    return next((p for p in ("/usr/bin/python3",) if os.path.exists(p) and module_in(p, name)), None)


def scripted(name, package, module, pictures, display=False):
    python = python_with(module) if module else sys.executable
    return Client(name, package, [python, f"{name}_scenes.py"], pictures, lambda: python is not None, display)


def of_program(name, package, program, pictures, command=None, display=False):
    command = command or [sys.executable, f"{name}_scenes.py"]
    return Client(name, package, command, pictures, lambda: shutil.which(program), display)


def clients():
    return [
        scripted("ase", "python3-ase", "ase", 11),
        of_program("pymol", "pymol", "pymol", 17, ["pymol", "-cq", "pymol_scenes.py"]),
        of_program("jmol", "jmol", "jmol", 17, display=True),
        scripted("vtk", "python3-vtk9", "vtkmodules", 11, display=True),
        of_program("openbabel", "openbabel", "obabel", 4),
        of_program("blender", "blender", "blender", 6, ["blender", "-b", "-P", "blender_scenes.py"]),
        scripted("mayavi", "mayavi2", "mayavi", 3, display=True),
        scripted("command_lines", "povray", None, 45),
    ]


def run_client(client, folder, program, wrapper, timeout, short):
    """Runs a client's script in `folder` with `program` as `povray`. Returns what went wrong, or an empty string."""
    bin_folder = folder / "bin"
    bin_folder.mkdir(parents=True)
    scenes = folder / "scenes"
    scenes.mkdir()
    (folder / "program").mkdir()
    named_povray = folder / "program" / "povray"  # celltrace reads POV-Ray's own INI files where it is called so
    named_povray.symlink_to(program)
    povray = bin_folder / "povray"
    povray.write_text(wrapper.format(folder=scenes, program=named_povray, log=folder / "calls.log"))
    povray.chmod(povray.stat().st_mode | stat.S_IXUSR)
    environment = dict(os.environ, PATH=f"{bin_folder}:{os.environ['PATH']}", CELLTRACE_CLIENTS=str(HERE), HOME=str(folder),
                       TMPDIR=str(scenes), PYTHONPATH=str(HERE), PYTHONDONTWRITEBYTECODE="1")
    if short:
        environment["CELLTRACE_SHORT"] = "1"
    command = [str(HERE / part) if part.endswith("_scenes.py") else part for part in client.command]
    if client.display:
        # Without -noreset it would start anew, and refuse windows meanwhile, whenever a script closes its only one.
        command = ["xvfb-run", "-a", "-s", "-screen 0 640x480x24 -noreset", *command]
    with open(folder / "log", "wb") as log:
        try:
            code = subprocess.run(command, cwd=scenes, env=environment, stdin=subprocess.DEVNULL, stdout=log,
                                  stderr=subprocess.STDOUT, timeout=timeout, check=False).returncode
        except subprocess.TimeoutExpired:
            return f"not done in {timeout} s"
    return f"exit code {code}, see {folder / 'log'}" if code else ""


def compare(celltrace, picture, reference, min_psnr):
    """A pair: the PSNR as text, and why the picture is not right, or an empty string."""
    if colour_type(picture) != colour_type(reference):
        return "", "has other channels"
    result = subprocess.run([celltrace, "compare", "--json", str(picture), str(reference)], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, check=False)
    if result.returncode:
        return "", result.stderr.decode("utf-8", "replace").strip()
    psnr = json.loads(result.stdout)["psnr"]
    values = [value for value in (psnr, alpha_psnr(picture, reference)) if value is not None]
    if not values:
        return "identical", ""
    return f"{min(values):.1f} dB", "" if min(values) >= min_psnr else f"below {min_psnr:g} dB"


def pictures_in(folder):
    if (folder / "pictures").is_dir():
        folder = folder / "pictures"
    return {str(path.relative_to(folder)): path for path in sorted(folder.rglob("*.png"))}


def test(client, work, options):
    """Prints a line for each picture. Returns the number of failures."""
    runs = {"povray": (options.povray, PLAIN), "celltrace": (options.celltrace, PLAIN), "unchanged": (options.celltrace, OWN)}
    folders, failures = {}, 0
    for run, (program, wrapper) in runs.items():
        folders[run] = work / client.name / run
        problem = run_client(client, folders[run], program, wrapper, options.timeout, options.short)
        if problem:
            print(f"{client.name:13} {run}: {problem}")
            failures += 1
    found = {run: pictures_in(folder / "scenes") for run, folder in folders.items()}
    passed = 0
    for name, reference in found["povray"].items():
        if name not in found["celltrace"] or name not in found["unchanged"]:
            psnr, problem, jittered = "", "no picture", ""
        else:
            psnr, problem = compare(options.celltrace, found["celltrace"][name], reference, options.min_psnr)
            jittered, jitter_problem = compare(options.celltrace, found["unchanged"][name], reference, 15)
            problem = problem or jitter_problem
        passed += not problem
        if problem or not options.quiet:
            print(f"{client.name:13} {name:30} {psnr:>10} {jittered:>10}  {problem}")
    expected = 3 if options.short else client.pictures
    if len(found["povray"]) < expected:
        print(f"{client.name:13} {len(found['povray'])} pictures by POV-Ray, expected {expected}")
        failures += 1
    print(f"{client.name:13} {passed} of {len(found['povray'])}")
    return failures + len(found["povray"]) - passed


def main():
    parser = argparse.ArgumentParser(description="Compares celltrace with POV-Ray under programs that call it.")
    parser.add_argument("clients", nargs="*", metavar="CLIENT", help="default: all that are installed")
    parser.add_argument("--celltrace", required=True)
    parser.add_argument("--povray", default=shutil.which("povray"))
    parser.add_argument("--min-psnr", type=float, default=40, metavar="DB", help="without jitter")
    parser.add_argument("--timeout", type=float, default=600, metavar="S", help="of one client's scenes")
    parser.add_argument("--short", action="store_true", help="the first three scenes of ASE and VTK")
    parser.add_argument("--work", metavar="DIR", help="keep scenes, pictures and logs in this folder")
    parser.add_argument("--quiet", action="store_true", help="print pictures that fail only")
    options = parser.parse_args()
    known = clients()
    unknown = set(options.clients) - {client.name for client in known}
    if unknown:
        parser.error(f"unknown: {' '.join(sorted(unknown))}; known: {' '.join(client.name for client in known)}")
    options.celltrace = os.path.abspath(options.celltrace)
    if not options.povray or not shutil.which(options.povray):
        print("Skipped: there is no povray to compare with.")
        return SKIPPED
    options.povray = shutil.which(options.povray)
    if options.work:
        shutil.rmtree(options.work, ignore_errors=True)
    work = Path(options.work or tempfile.mkdtemp(prefix="celltrace-clients-")).absolute()
    ran = failures = 0
    for client in known:
        if options.clients and client.name not in options.clients:
            continue
        if not client.is_installed():
            print(f"{client.name:13} skipped: {client.package}{' or xvfb' if client.display else ''} is not installed")
            continue
        ran += 1
        failures += test(client, work, options)
        sys.stdout.flush()
    if not options.work:
        shutil.rmtree(work)
    if not ran:
        print("Skipped: no client is installed.")
        return SKIPPED
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
