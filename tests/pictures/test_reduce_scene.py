"""What tools/reduce-scene leaves of a scene that cannot look the same twice, and what it says of others.

  test_reduce_scene.py TOOL PROGRAM
"""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL, PROGRAM = str(Path(sys.argv[1]).resolve()), str(Path(sys.argv[2]).resolve())

SCENE = """camera { location -5*z }
light_source { -9*z, rgb 1 }
sphere { -x, 1 pigment { rgb 1 } %s }
sphere { 2*x, 1 }
"""


@unittest.skipUnless(shutil.which("povray"), "POV-Ray is not installed")
class ReduceScene(unittest.TestCase):
    def reduce(self, finish):
        """(exit code, output, what is left or None)."""
        with tempfile.TemporaryDirectory() as folder:
            scene, smaller = Path(folder) / "scene.pov", Path(folder) / "smaller.pov"
            scene.write_text(SCENE % finish)
            done = subprocess.run([sys.executable, TOOL, str(scene), str(smaller), "--celltrace", PROGRAM, "--size", "40x30"],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=200)
            return done.returncode, done.stdout.decode(), smaller.read_text() if smaller.exists() else None

    def test_what_looks_different_is_left(self):
        code, output, left = self.reduce("finish { crand 1 }")
        self.assertEqual(code, 0, output)
        self.assertIn("crand 1", left)
        self.assertIn("light_source", left)
        self.assertNotIn("2*x", left)

    def test_what_looks_the_same_is_not_reduced(self):
        code, output, left = self.reduce("")
        self.assertEqual((code, left), (1, None))
        self.assertIn("scene.pov looks the same", output)

    def test_what_is_not_rendered_is_not_reduced(self):
        code, output, left = self.reduce("no_such_word")
        self.assertEqual((code, left), (1, None))
        self.assertIn("scene.pov is not rendered by both", output)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
