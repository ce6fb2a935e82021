# Whether demos/site makes pages of the book and the reference, and tells what is wrong in them: tests/house/site_pages.py.
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(TOP / "demos" / "site"))
import book  # noqa: E402
import check  # noqa: E402
import doxygen_pages  # noqa: E402
import lessons  # noqa: E402
import python_pages  # noqa: E402


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        subprocess.run([TOP / "demos/docs/reference", "--xml", cls.folder / "reference"], check=True, stdout=subprocess.DEVNULL)
        cls.reference = doxygen_pages.Reference(cls.folder / "reference" / "xml")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def header(self, name):
        return doxygen_pages.HeaderPage(self.reference, name).text()

    def test_all_is_staged(self):
        stage = self.folder / "stage"
        done = subprocess.run([sys.executable, "-B", TOP / "demos/site/stage.py", stage, "--reference", self.folder / "reference" / "xml"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertGreater(len(list(stage.rglob("*.md"))), 100)
        for page in ("index.md", "book.md", "guide/bodies.md", "lessons/drop-a-box.md", "project/changes.md", "api/c.md", "api/cpp/world.md"):
            self.assertTrue((stage / "docs" / page).is_file(), page)
        self.assertIn("](api/cpp/", (stage / "docs" / "api" / "index.md").read_text().replace("](cpp/", "](api/cpp/"))

    def test_recordings_are_opened_by_pictures_and_lessons(self):
        stage, recordings, made = (self.folder / name for name in ("recorded", "recordings", "lessons"))
        for folder in (recordings, made):
            folder.mkdir()
        for name in ("wall", "lesson-stack"):
            (recordings / f"{name}.html").write_text("<p>a run</p>")
        for name in lessons.names():
            (made / f"{name}.jpg").write_text("")
        (made / "stack.json").write_text("{}")
        command = [sys.executable, "-B", TOP / "demos/site/stage.py", stage, "--reference", self.folder / "reference" / "xml",
                   "--lessons", made, "--recordings", recordings]
        self.assertEqual(subprocess.run(command, check=False).returncode, 0)
        gallery = (stage / "docs" / "guide" / "gallery.md").read_text()
        self.assertIn("[![](../pictures/wall.jpg)](../recordings/wall.html ", gallery)
        self.assertNotIn("](../recordings/stack.html", gallery)
        lesson = (stage / "docs" / "lessons" / "stack.md").read_text()
        self.assertIn("](stack.json)", lesson)
        self.assertIn("](../recordings/lesson-stack.html)", lesson)
        shutil.rmtree(stage)
        (recordings / "walk.html").write_text("")
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("walk.html: the gallery has no picture of that demo", done.stdout)
        self.assertFalse(stage.exists())

    def test_links_that_lead_nowhere_are_told(self):
        page = book.Page("README.md", lambda path: None)
        self.assertTrue(page.on_site())
        self.assertEqual(page.faults, [])
        page.text = "# A\n[b](demos/docs/nowhere.md) [c](demos/docs/limits.md#nowhere) [d](demos/docs/limits.md) `[e](f)`\n```\n[g](h)\n```\n"
        self.assertIn("[d](limits.md) `[e](f)`", page.on_site())
        self.assertEqual(len(page.faults), 2)

    def test_lists_and_tables_get_their_blank_lines(self):
        page = book.Page("README.md", lambda path: None)
        page.text = "# A\nwords\n- one\n  more\n- two\n\nwords\n| a |\n|---|\n| b |\nwords\n## A\n"
        self.assertEqual(page.on_site(), "# A { #a }\nwords\n\n- one\n  more\n- two\n\nwords\n\n| a |\n|---|\n| b |\n\nwords\n## A { #a-1 }\n")

    def test_the_reference_has_what_headers_say(self):
        world = self.header("compute/world.h")
        self.assertIn("## class World { #World }", world)
        self.assertIn("### step { #World-step }", world)
        self.assertIn('<td><code>velocity</code></td><td><code>vec3</code></td><td></td><td>m/s</td>', world)
        c = self.header("demos/c/scree.h")
        self.assertIn("### scree_world_step { #scree_world_step }", c)
        self.assertIn("between steps, at least once in 20 ms", c)
        self.assertIn('<a href="#scree_world">scree_world</a>', c)
        for header in [*book.public_headers(), "demos/c/scree.h"]:
            self.assertGreater(len(self.header(header).splitlines()), 6, header)

    def test_python_has_signatures_types_shapes_and_units(self):
        pages = python_pages.pages()
        self.assertIn("### World.cast_rays { #World-cast_rays }", pages["world"])
        self.assertIn("- `position`: (3,) or (n, 3), of the centre of mass, m;", pages["scene"])
        self.assertIn('scree.Box(half_extents: Vector = (0.5, 0.5, 0.5))', pages["shapes"])
        self.assertIn('<a href="shapes.html#Shape">Shape</a>', pages["scene"])

    def test_a_built_site_is_checked(self):
        site = self.folder / "site"
        site.mkdir()
        for i in range(60):
            (site / f"{i}.html").write_text('<h1 id="a">A</h1><a href="1.html#a">b</a><img src="c.png"><a href="https://example.com">d</a>')
        (site / "c.png").write_text("")
        self.assertEqual(check.faults_of(site), [])
        (site / "1.html").write_text('<a href="2.html#b"></a><a href="e.html"></a><script src="https://example.com/f.js"></script>')
        (site / "g.css").write_text("a { background: url(//example.com/h) }")
        faults = check.faults_of(site)
        self.assertEqual(len([fault for fault in faults if fault.startswith("1.html")]), 3)
        self.assertEqual(len([fault for fault in faults if fault.startswith("g.css")]), 1)

    def test_lessons_are_scripts(self):
        self.assertEqual(len(lessons.names()), 10)
        for name in lessons.names():
            compile(lessons.script_of(name), name, "exec")
            self.assertIn("\nassert ", lessons.script_of(name), name)


if __name__ == "__main__":
    unittest.main()
