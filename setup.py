"""The wheel of pyproject.toml: CMake builds the Python package and nothing else.

CELLTRACE_BUILD_FOLDER names a build folder that has it already; CELLTRACE_CMAKE_ARGUMENTS are further arguments for
CMake, and CMAKE_BUILD_PARALLEL_LEVEL says how many compilers run at once.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

SOURCE = pathlib.Path(__file__).resolve().parent
WORK = SOURCE / "build-wheel"  # not build, which is CMake's


def has(program):
    return shutil.which(program) is not None


def pybind11_folder():
    """Of a pybind11 that pip has installed; CMake finds one of the system itself."""
    try:
        import pybind11
    except ImportError:
        return []
    return [f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"]


def build(folder):
    """As little as the package needs."""
    arguments = ["-DCMAKE_BUILD_TYPE=Release", "-DCELLTRACE_COMPONENTS=celltrace",
                 "-DBUILD_SHARED_LIBS=OFF", "-DCELLTRACE_UNITY=ON", "-DCELLTRACE_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}",
                 "-DCELLTRACE_PYTHON_DIR=.", *pybind11_folder()]
    if has("ninja"):
        arguments += ["-G", "Ninja"]
    if has("ccache"):
        arguments += ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
    arguments += shlex.split(os.environ.get("CELLTRACE_CMAKE_ARGUMENTS", ""))
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, *arguments], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "celltrace_python"], check=True)


class BuildPackage(build_py):
    def run(self):
        if getattr(self, "editable_mode", False):
            sys.exit("celltrace cannot be installed editable: let PYTHONPATH name the folder python of a build instead")
        built = os.environ.get("CELLTRACE_BUILD_FOLDER")
        folder = pathlib.Path(built) if built else WORK / sys.implementation.cache_tag
        if not built:
            build(folder)
        with tempfile.TemporaryDirectory() as prefix:
            subprocess.run(["cmake", "--install", folder, "--component", "python", "--prefix", prefix, "--strip"], check=True)
            package = next(pathlib.Path(prefix).rglob("celltrace/__init__.py")).parent
            shutil.copytree(package, pathlib.Path(self.build_lib) / "celltrace", dirs_exist_ok=True)


class BinaryDistribution(Distribution):
    """For one version of Python on one kind of machine."""

    def has_ext_modules(self):
        return True


WORK.mkdir(exist_ok=True)
setup(
    version=re.search(r"project\(celltrace\s+VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1],
    cmdclass={"build_py": BuildPackage},
    distclass=BinaryDistribution,
    options={"build": {"build_base": str(WORK)}, "egg_info": {"egg_base": str(WORK)}},
)
