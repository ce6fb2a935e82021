# The package itself: types, the examples of README and book, and the example scripts' first steps.
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import scree

SOURCE = pathlib.Path(os.environ.get("SCREE_SOURCE", pathlib.Path(__file__).resolve().parents[2]))


def run(*command, **more):
    made = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **more)
    return made.returncode, made.stdout


def has(module):
    return run(sys.executable, "-c", f"import {module}")[0] == 0


class Package(unittest.TestCase):
    @unittest.skipUnless(has("mypy"), "mypy is not installed")
    def test_the_types_are_right(self):
        with tempfile.TemporaryDirectory() as cache:
            code, output = run(sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, str(SOURCE / "demos/python/scree"))
        self.assertEqual(code, 0, output)

    def test_everything_that_is_offered_is_explained(self):
        import inspect
        for name in scree.__all__:
            one = getattr(scree, name)
            if not inspect.isclass(one) and not inspect.isfunction(one):
                continue
            self.assertTrue(inspect.getdoc(one), name)
            for member, what in vars(one).items() if inspect.isclass(one) else ():
                if not member.startswith("_") and (inspect.isfunction(what) or isinstance(what, property)):
                    self.assertTrue(inspect.getdoc(getattr(one, member)), f"{name}.{member}")

    def test_the_examples_of_readme_and_book_run(self):
        """Those of lessons are pieces of one script each: demos/site/lessons.py runs them."""
        pages = [SOURCE / "README.md", *(page for page in sorted((SOURCE / "demos/docs").rglob("*.md")) if page.parent.name != "lessons")]
        examples = [(page, block) for page in pages for block in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)]
        self.assertGreaterEqual(len(examples), 2)
        self.assertEqual(examples[0][0].name, "README.md")
        for page, block in examples:
            with self.subTest(page=page.name):
                code, output = run(sys.executable, "-c", block, cwd=tempfile.gettempdir())
                self.assertEqual(code, 0, output)

    def test_every_python_that_is_here_calls_the_library(self):
        """Also those without numpy, of which the package says that it is missing."""
        pythons = {os.path.realpath(found) for folder in [*os.environ["PATH"].split(os.pathsep), *map(str, pathlib.Path.home().glob(".pyenv/versions/*/bin"))]
                   for found in pathlib.Path(folder).glob("python3.[0-9]*") if re.fullmatch(r"python3\.(9|[1-9]\d)", found.name)}
        self.assertTrue(pythons)
        program = """
import ctypes, sys, types
sys.modules["scree"] = package = types.ModuleType("scree")
package.__path__ = [sys.argv[1]]
from scree._library import LIBRARY, WorldOptions, check, sized
scene, world, hash = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_uint64()
check(LIBRARY.scree_scene_demo(b"stack", 0, 1, ctypes.byref(scene)))
check(LIBRARY.scree_world_create(scene, ctypes.byref(sized(WorldOptions, backend=b"cpu")), ctypes.byref(world)))
check(LIBRARY.scree_world_step(world, 30, None, None))
check(LIBRARY.scree_world_hash(world, ctypes.byref(hash)))
print(f"{hash.value:016x}")
"""
        world = scree.World(scree.demo("stack"), backend="cpu")
        world.step(30)
        for python in sorted(pythons):
            if run(python, "-c", "")[0]:
                continue  # a stand-in for one that is not chosen
            with self.subTest(python=python):
                code, output = run(python, "-c", program, scree.__path__[0])
                self.assertEqual((code, output.strip()), (0, world.state_hash()))
                code, output = run(python, "-c", "import numpy")
                if code:
                    code, output = run(python, "-c", "import scree")
                    self.assertEqual(code, 1)
                    self.assertIn("pip install numpy", output)

    def test_the_version_is_the_projects(self):
        self.assertIn(f"VERSION {scree.__version__} ", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
