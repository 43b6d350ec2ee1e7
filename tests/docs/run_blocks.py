#!/usr/bin/env python3
"""Runs what stands in fenced blocks of a page, in their order, in a folder of the page's own.

    run_blocks.py PAGE.md --work FOLDER --source CHECKOUT --program CELLTRACE [...]

By a block's language:

    cpp       compiled, with the comment `given` before it: `#include`s go to the top, other lines into a function if
              there is nothing that has to stand outside of one. All of a page are one file, each in a namespace
    c         compiled as an SPE's program for the emulator
    cmake     a project is configured with it, which has main.cpp and the checkout as celltrace and third_party/celltrace
    sh        run by bash; the program, scene.pov and the checkout's tools and examples are there
    console   the lines after `$ ` run, the others are what they print; `...` is any text
    python    run
    pov       rendered, small
    text      nothing; for what people read only

Comments before a block, one after the other:

    <!-- given CODE -->        what the reader has already
    <!-- file: NAME -->        written to the file, as well
    <!-- needs: PROGRAM -->    skipped where there is no such program, or for python:MODULE no such module
    <!-- output within 2 % -->  numbers may be that far from those that are shown; words and signs are as they are
    <!-- output varies -->     what is shown is an example
    <!-- fails -->             each command has to fail
    <!-- not run: REASON -->

A block that is in no language of these, without a reason, is an error.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap

FENCE = re.compile(r"^( *)```(\S*)\n(.*?)^\1```$", re.M | re.S)
COMMENTS = re.compile(r"((?:<!--(?:(?!-->).)*-->\s*)*)\Z", re.S)
COMMENT = re.compile(r"<!--\s*(given|file:|needs:|output varies|output within|fails|not run:)(.*?)-->", re.S)
# What cannot stand in a function.
OUTSIDE = re.compile(r"^(TEST_CASE|int main|template|namespace|using namespace)", re.M)


class Failed(Exception):
    pass


# A number that is no part of a word, such as 1,024 or -3.5e-7.
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:,\d{3})*(?:\.\d+)?(?:[eE][-+]?\d+)?(?!\w)")


def is_output(shown, printed, percent=None):
    """Whether a command printed what is shown, in which `...` is any text. With `percent` numbers may be that far off, and
    columns be as wide as these take."""
    shown, printed = shown.strip(), printed.strip()
    parts = shown.split("...")
    if percent is None:
        return re.fullmatch(".*".join(re.escape(part) for part in parts), printed, re.S) is not None
    numbers = []

    def pattern_of(part):
        pieces = NUMBER.split(part)
        numbers.extend(NUMBER.findall(part))
        words = (re.sub(r"(?:\\?\s)+", r"\\s+", re.escape(piece)) for piece in pieces)
        return f"({NUMBER.pattern})".join(words)

    found = re.fullmatch(".*".join(pattern_of(part) for part in parts), printed, re.S)
    if not found:
        return False
    value = lambda text: float(text.replace(",", ""))
    return all(abs(value(a) - value(b)) <= abs(value(a)) * percent / 100 for a, b in zip(numbers, found.groups()))


class Block:
    def __init__(self, page_text, match):
        self.line = page_text[:match.start()].count("\n") + 1
        _, self.language, text = match.groups()
        self.text = textwrap.dedent(text)
        before = COMMENTS.search(page_text[:match.start()]).group(1)
        self.notes = {note: textwrap.dedent(more).strip() for note, more in COMMENT.findall(before)}


def run(command, folder, environment, text=None, seconds=300, has_to_fail=False):
    """What it printed; Failed with it if it fails, or does not though it has to."""
    done = subprocess.run(command, cwd=folder, env=environment, input=text, text=True, timeout=seconds,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if (done.returncode != 0) != has_to_fail:
        raise Failed(f"{' '.join(map(str, command))}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Page:
    def __init__(self, options):
        self.options = options
        self.folder = options.work
        self.parts = []  # lines and texts of blocks in C++
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        source = options.source
        shutil.copy(source / "examples/scenes/first.pov", self.folder / "scene.pov")
        for name in ("tools", "examples"):
            (self.folder / name).symlink_to(source / name)
        (self.folder / "celltrace").symlink_to(options.prefix)
        programs = [options.program.parent] + [pathlib.Path(folder) for folder in options.path]
        self.environment = {**os.environ, "HOME": str(self.folder), "LC_ALL": "C.UTF-8",
                            "PATH": ":".join(map(str, programs + [os.environ["PATH"]])),
                            "PYTHONPATH": str(options.python_package or ""), "PYTHONDONTWRITEBYTECODE": "1",
                            "CXX": options.compiler, "BUILD": str(options.build), "CMAKE_CXX_COMPILER_LAUNCHER": options.launcher,
                            "CMAKE_GENERATOR": "Ninja"}

    def run(self, command, **more):
        return run(command, self.folder, self.environment, **more)

    def cpp(self, block, given):
        self.parts.append((block.line - given.count("\n"), given + "\n" + block.text))
        return "compiled with the others"

    def compile_parts(self):
        """All blocks in C++; errors name the line of the page."""
        includes, rest = [], []
        for line, text in self.parts:
            includes += re.findall(r"^#include.*$", text, re.M)
            text = f'#line {line} "{self.options.page}"\n' + re.sub(r"^#include.*$", "", text, flags=re.M)
            if not OUTSIDE.search(text):
                text = f"void block();\nvoid block() {{\n{text}\n}}"
            rest.append(f"namespace line_{line} {{\n{text}\n}}\n")
        if self.parts:
            self.compile("\n".join(dict.fromkeys(includes)) + "\n" + "".join(rest), "-std=c++20", "-Wall", "-Wextra",
                         "-Wno-unused", "-Wno-unused-parameter", "-Wno-main")

    def c(self, block, given):
        self.compile(given + "\n" + block.text, "-std=c++20", "-Dmain=spe_program")

    def compile(self, text, *flags):
        (self.folder / "block.cpp").write_text(text)
        launcher = [self.options.launcher] if self.options.launcher else []
        self.run([*launcher, self.options.compiler, *flags, f"-I{self.options.source}/include",
                  f"-I{self.options.source}/include/celltrace/sdk", f"-I{self.options.build}/include",
                  "-c", "block.cpp", "-o", "block.o"])

    def cmake(self, block, given):
        project = self.folder / "cmake"
        shutil.rmtree(project, ignore_errors=True)
        (project / "third_party").mkdir(parents=True)
        for name in ("celltrace", "third_party/celltrace"):
            (project / name).symlink_to(self.options.source)
        (project / "main.cpp").write_text("int main() {}\n")
        text = given + "\n" + block.text
        (project / "CMakeLists.txt").write_text(text)
        self.run(["cmake", "-S", "cmake", "-B", "cmake/build", f"-DCMAKE_PREFIX_PATH={self.options.prefix}"])

    def sh(self, block, given):
        self.run(["bash", "-euo", "pipefail", "-c", given + "\n" + block.text])

    def console(self, block, given):
        commands = re.split(r"^\$ ", block.text, flags=re.M)[1:]
        if not commands:
            raise Failed("no line begins with `$ `")
        within = block.notes.get("output within")
        percent = float(within.removesuffix("%")) if within is not None else None
        setting = given + "\n"
        for command in commands:
            line, _, shown = command.partition("\n")
            printed = self.run(["bash", "-euo", "pipefail", "-c", setting + line], has_to_fail="fails" in block.notes)
            if line.startswith(("export ", "cd ")):
                setting += line + "\n"
            if shown.strip() and "output varies" not in block.notes and not is_output(shown, printed, percent):
                raise Failed(f"{line}\nprints\n{printed}\nand not\n{shown}")

    def python(self, block, given):
        if not self.options.python_package:
            return "not run: there is no Python package in this build"
        self.run([sys.executable if not self.options.python else self.options.python, "-"],
                 text=given + "\n" + block.text)

    def pov(self, block, given):
        (self.folder / "block.pov").write_text(given + "\n" + block.text)
        self.run([self.options.program, "block.pov", "-W", "64", "-H", "48", "--quiet", "-o", "block.png"])

    def text(self, block, given):
        return "for reading"

    def do(self, block):
        """What there is to say; nothing: it was run."""
        if "file:" in block.notes:
            path = self.folder / block.notes["file:"]
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text)
        if "not run:" in block.notes:
            return "not run: " + block.notes["not run:"]
        for program in block.notes.get("needs:", "").split():
            if program.startswith("python:"):
                module = program.removeprefix("python:")
                if subprocess.run(["python3", "-c", f"import {module}"], env=self.environment, stderr=subprocess.DEVNULL).returncode:
                    return f"not run: Python has no {module}"
            elif not shutil.which(program, path=self.environment["PATH"]):
                return f"not run: there is no {program}"
        languages = {"cpp", "c", "cmake", "sh", "console", "python", "pov", "text"}
        if block.language not in languages:
            if "file:" in block.notes:
                return None
            raise Failed(f"'{block.language}' is no language that blocks are run in, and there is no reason why not")
        return getattr(self, block.language)(block, block.notes.get("given", ""))


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("page", type=pathlib.Path)
    for name in ("work", "source", "build", "program", "prefix"):
        parser.add_argument("--" + name, type=pathlib.Path, required=True)
    parser.add_argument("--compiler", required=True)
    parser.add_argument("--launcher", default="")
    parser.add_argument("--path", action="append", default=[], help="a folder of programs")
    parser.add_argument("--python", help="the interpreter that the package is for")
    parser.add_argument("--python-package", type=pathlib.Path)
    options = parser.parse_args()

    page_text = options.page.read_text()
    blocks = [Block(page_text, match) for match in FENCE.finditer(page_text)]
    if len(blocks) != len(re.findall(r"^ *```", page_text, re.M)) / 2:
        sys.exit(f"{options.page}: a fence has no end")
    page = Page(options)
    failures = 0

    def attempt(what, work):
        nonlocal failures
        try:
            why = work()
            print(f"{what}: {why or 'ok'}", flush=True)
        except (Failed, subprocess.TimeoutExpired) as failure:
            failures += 1
            print(f"{what}: FAILED: {failure}", flush=True)

    for block in blocks:
        attempt(f"{options.page.name}:{block.line}: {block.language}", lambda: page.do(block))
    if page.parts:
        attempt("all blocks in C++", page.compile_parts)
    sys.exit(failures > 0)


if __name__ == "__main__":
    main()
