"""A copy of the sources and a build of it, in which tools change lines, for tools/mutate and bench/sweep-thresholds."""

import contextlib
import os
import shutil
import subprocess
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
# Few things take long to compile, and little is built that is not asked for.
LEAN = ["-DCELLTRACE_WIDE_SIMD=OFF", "-DCELLTRACE_SPU_GXX=", "-DCELLTRACE_BENCH=OFF", "-DCELLTRACE_EXAMPLES=OFF",
        "-DCELLTRACE_WERROR=OFF"]


class ScratchBuild:
    """In a folder of its own, which stays for the next time. One thread at a time may use it."""

    def __init__(self, folder):
        self.sources, self.build = folder / "sources", folder / "build"
        # Objects that another copy has compiled are taken from ccache.
        self.environment = {**os.environ, "CCACHE_BASEDIR": str(folder), "CCACHE_NOHASHDIR": "1",
                            "CCACHE_SLOPPINESS": "pch_defines,time_macros"}

    def prepare(self, options):
        """Copies what git knows, and configures it. Only files that differ are written, so that little is built again."""
        names = subprocess.run(["git", "ls-files", "-z"], cwd=TOP, check=True, capture_output=True).stdout.split(b"\0")
        for name in filter(None, names):
            source, target = TOP / os.fsdecode(name), self.sources / os.fsdecode(name)
            if source.is_file() and not (target.is_file() and target.read_bytes() == source.read_bytes()):
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, target)
        subprocess.run(["tools/configure.sh", "release", "-B", str(self.build), *LEAN, *options], cwd=self.sources,
                       check=True, stdout=subprocess.DEVNULL, env=self.environment)

    def make(self, targets, jobs=1):
        """Whether they could be built."""
        command = ["ninja", "-C", str(self.build), "-j", str(jobs), *targets]
        return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, env=self.environment).returncode == 0

    @contextlib.contextmanager
    def changed(self, path, text):
        """The file has this text meanwhile."""
        path = self.sources / path
        before = path.read_text()
        try:
            path.write_text(text)
            yield
        finally:
            path.write_text(before)
