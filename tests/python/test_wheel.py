"""The wheel that `pip install .` makes, of a build that is there: CELLTRACE_BUILD_FOLDER. It compiles nothing;
tools/test-wheel.sh does it all."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import celltrace
import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif("CELLTRACE_BUILD_FOLDER" not in os.environ, reason="CELLTRACE_BUILD_FOLDER names no build")


def run(*command, **keywords):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **keywords)
    assert not done.returncode, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    missing = [name for name in ("pip", "setuptools", "wheel", "venv") if not importlib.util.find_spec(name)]
    if missing:
        pytest.skip(f"without {missing}")
    copy = tmp_path_factory.mktemp("source")  # building writes beside setup.py
    for name in ("pyproject.toml", "setup.py", "LICENSE", "README.md", "CMakeLists.txt"):
        shutil.copy(SOURCE / name, copy)
    shutil.copytree(SOURCE / "src/python/celltrace", copy / "src/python/celltrace")
    run(sys.executable, "-m", "pip", "wheel", "--no-index", "--no-build-isolation", "--no-deps", "--wheel-dir", copy / "out", copy)
    return next((copy / "out").glob("*.whl"))


def test_what_is_in_it(wheel):
    version = celltrace.__version__
    assert wheel.name.startswith(f"celltrace-{version}-cp3") and "linux" in wheel.name
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
        metadata = archive.read(f"celltrace-{version}.dist-info/METADATA").decode()
    package = {path.name for path in pathlib.Path(celltrace.__file__).parent.iterdir() if path.is_file()}
    assert {f"celltrace/{name}" for name in package} == {name for name in names if name.startswith("celltrace/")}
    assert {"py.typed", "__init__.pyi", "ase.py"} < package
    assert f"celltrace-{version}.dist-info/LICENSE" in names
    assert "Requires-Dist: numpy" in metadata and "License: MIT" in metadata and f"Version: {version}\n" in metadata


def test_it_installs(wheel, tmp_path):
    run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", tmp_path / "venv")
    python = tmp_path / "venv/bin/python"
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    run(python, "-m", "pip", "install", "--no-index", "--no-deps", wheel, env=environment, cwd=tmp_path)
    said = run(python, "-c", "import celltrace; print(celltrace.__file__); "
               "print(celltrace.render(celltrace.Scene(), width=4, height=3).shape)", env=environment, cwd=tmp_path)
    assert str(tmp_path) in said and "(3, 4, 4)" in said
