"""Calls of `povray` by scripts of scenes, which go on after one that fails."""

import subprocess
import sys

_failed = []


def povray(*arguments):
    """Runs `povray` without its messages."""
    code = subprocess.run(["povray", *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          check=False).returncode
    if code:
        failed(f"povray {' '.join(arguments)}: exit code {code}")


def failed(what):
    _failed.append(what)
    print(what)


def leave():
    """Ends the script, with 1 if a call has failed."""
    sys.exit(1 if _failed else 0)
