# The package itself: stubs, types, the examples of README and book, and the example scripts' first steps.
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
    @unittest.skipUnless(has("mypy.stubtest"), "mypy is not installed")
    def test_the_stubs_are_true(self):
        code, output = run(sys.executable, "-m", "mypy.stubtest", "scree", env={**os.environ, "MYPYPATH": os.path.dirname(scree.__path__[0])})
        self.assertEqual(code, 0, output)

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
        pages = [SOURCE / "README.md", *sorted((SOURCE / "demos/docs").rglob("*.md"))]
        examples = [(page, block) for page in pages for block in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)]
        self.assertGreaterEqual(len(examples), 2)
        self.assertEqual(examples[0][0].name, "README.md")
        for page, block in examples:
            with self.subTest(page=page.name):
                code, output = run(sys.executable, "-c", block, cwd=tempfile.gettempdir())
                self.assertEqual(code, 0, output)

    def test_the_version_is_the_projects(self):
        self.assertIn(f"VERSION {scree.__version__} ", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
