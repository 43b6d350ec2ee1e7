"""What tools/compare-with-povray reports, beside pictures that celltrace itself made and beside POV-Ray's.

  test_compare_with_povray.py TOOL --celltrace PROGRAM
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL, PROGRAM = str(Path(sys.argv[1]).resolve()), str(Path(sys.argv[3]).resolve())

SCENE = """
#version 3.7;
global_settings { assumed_gamma 1 }
#include "colour.inc"
camera { location -5*z look_at 0 }
light_source { <-3, 5, -6> rgb 1 }
sphere { 0, 1 pigment { rgb Colour } }
"""


class CompareWithPovray(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        self.scenes = self.root / "scenes"
        self.scenes.mkdir()
        self.write("good.pov", SCENE)
        self.write("colour.inc", "#declare Colour = <.9, .5, .1>;\n")

    def write(self, name, text):
        (self.scenes / name).write_text(text)

    def run_tool(self, *arguments, stdout=subprocess.PIPE):
        """(exit code, text report, rows by the scene's name)."""
        report = self.root / "report.json"
        report.unlink(missing_ok=True)
        process = subprocess.run([sys.executable, TOOL, "--celltrace", PROGRAM, "--size", "40x30", "--json", str(report),
                                  *map(str, arguments)], stdout=stdout, stderr=subprocess.PIPE, timeout=200)
        rows = json.loads(report.read_text())["scenes"] if report.exists() else []
        text = (process.stdout or b"").decode() + process.stderr.decode()
        return process.returncode, text, {row["scene"]: row for row in rows}

    def make_reference(self, folder, *switches):
        folder.mkdir(exist_ok=True)
        subprocess.run([PROGRAM, "good.pov", "+W40", "+H30", "-o", str(folder / "good.ref.png"), "--quiet", *switches],
                       cwd=self.scenes, check=True)

    def test_a_picture_is_identical_to_itself(self):
        self.make_reference(self.root / "references")
        code, text, rows = self.run_tool("--references", self.root / "references", "--min-psnr", 99, self.scenes)
        self.assertEqual(code, 0, text)
        self.assertTrue(rows["good.pov"]["identical"])
        self.assertIsNone(rows["good.pov"]["ratio"])
        self.assertRegex(text, r"good\.pov +identical")

    def test_a_pipe_that_nobody_reads_loses_no_report(self):
        self.make_reference(self.root / "references")
        reading, writing = os.pipe()
        os.close(reading)
        code, text, rows = self.run_tool("--references", self.root / "references", self.scenes, stdout=writing)
        os.close(writing)
        self.assertEqual((code, text), (0, ""))
        self.assertTrue(rows["good.pov"]["identical"])

    def test_another_picture_is_too_far_away(self):
        self.make_reference(self.root / "references", "--max-level", "1")
        self.write("colour.inc", "#declare Colour = <.1, .5, .9>;\n")
        page = self.root / "page"
        code, text, rows = self.run_tool("--references", self.root / "references", "--min-psnr", 40, "--html", page,
                                         self.scenes / "good.pov")
        self.assertEqual(code, 1, text)
        row, = rows.values()
        self.assertLess(row["psnr"], 40)
        html = (page / "index.html").read_text()
        for side in ("povray", "celltrace", "difference"):
            self.assertIn(f'src="pictures/{row["pictures"][side]}"', html)
            self.assertTrue((page / "pictures" / row["pictures"][side]).is_file())

    def test_an_error_is_told_and_fails(self):
        self.write("bad.pov", "sphere { 0, 1\n")
        self.make_reference(self.root / "references")
        shutil.copy(self.root / "references" / "good.ref.png", self.root / "references" / "bad.png")
        code, text, rows = self.run_tool("--references", self.root / "references", "--min-psnr", 40, self.scenes)
        self.assertEqual(code, 1, text)
        self.assertEqual(rows["bad.pov"]["status"], "error")
        self.assertIn("bad.pov:2:1: error:", rows["bad.pov"]["error"])
        self.assertEqual(rows["good.pov"]["status"], "compared")
        self.assertLess(text.index("good.pov"), text.index("bad.pov"))

    def test_without_anything_to_compare_with_it_skips(self):
        code, text, _ = self.run_tool("--povray", "no-such-povray", self.scenes)
        self.assertEqual(code, 77, text)
        self.assertIn("skipped", text)

    def test_what_cannot_be_done_is_said(self):
        code, text, _ = self.run_tool(self.root / "missing.pov")
        self.assertEqual(code, 1)
        self.assertIn("missing.pov: no such scene or folder", text)

    @unittest.skipUnless(shutil.which("povray"), "POV-Ray is not installed")
    def test_povray_is_asked_once(self):
        self.write("refused.pov", "sphere { 0, 1 no_such_word }\n")
        arguments = ("--cache", self.root / "cache", self.scenes)
        _, text, first = self.run_tool(*arguments)
        self.assertGreater(first["good.pov"]["psnr"] or 100, 45, text)
        self.assertGreaterEqual(first["good.pov"]["ratio"], 0)
        self.assertEqual(first["refused.pov"]["status"], "refused by POV-Ray")
        self.assertIn("refused.pov:1:", first["refused.pov"]["povray"]["error"])
        _, _, second = self.run_tool(*arguments)
        self.write("colour.inc", "#declare Colour = <.1, .5, .9>;\n")
        _, _, third = self.run_tool(*arguments)
        _, _, larger = self.run_tool("--size", "80x60", *arguments)
        self.assertEqual([rows["good.pov"]["povray"]["cached"] for rows in (first, second, third, larger)],
                         [False, True, False, False])
        self.assertEqual(first["good.pov"]["psnr"], second["good.pov"]["psnr"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
