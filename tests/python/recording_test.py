# Recordings that play in a browser, and what notebooks get of them.
import base64
import os
import subprocess
import sys
import tempfile
import types
import unittest

import scree


def page_is_there():
    try:
        scree.World(scree.demo("cradle"), backend="cpu").record()
        return True
    except RuntimeError as error:
        assert "esbuild" in str(error)
        return False


class Shell:
    """What a view asks of IPython."""

    def __init__(self):
        self.hooks = []
        self.events = self
        self.shown = []

    def register(self, name, hook):
        assert name == "post_run_cell"
        self.hooks.append(hook)

    def unregister(self, name, hook):
        self.hooks.remove(hook)

    def display(self, parts, raw, display_id):
        assert raw and display_id
        self.shown.append(parts)
        return self

    def update(self, parts, raw):
        self.shown.append(parts)


@unittest.skipUnless(page_is_there(), "built without the viewer")
class Recordings(unittest.TestCase):
    def setUp(self):
        self.world = scree.World(scree.demo("pile", bodies=30), backend="cpu")

    def test_a_recording_has_the_steps_within_its_with_statement(self):
        with self.world.record(fps=20, title="<mine>") as recording:
            self.world.step(30)
        self.world.step(30)
        self.assertEqual(len(recording), 11)
        self.assertIn("<title>&lt;mine&gt; · scree</title>", recording.html())
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.html")
            recording.save(path)
            with open(path, encoding="utf-8") as file:
                self.assertEqual(file.read(), recording.html())
            with self.assertRaises(OSError):
                recording.save(os.path.join(folder, "none", "run.html"))

    def test_the_program_writes_the_same_frames(self):
        program = os.environ.get("SCREE_PROGRAM_PATH", "")
        if not program:
            self.skipTest("no program")
        with self.world.record(events=True) as recording:
            self.world.step(60)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.html")
            subprocess.run([program, "run", "pile", "--bodies", "30", "--steps", "60", "--backend", "cpu", "--quiet", "--html", path], check=True)
            with open(path, encoding="utf-8") as file:
                theirs = file.read()
        blocks = [page.count('data-kind="frames"') for page in (recording.html(), theirs)]
        self.assertEqual(blocks[0], blocks[1])
        self.assertGreater(blocks[0], 0)

    def test_bits_are_those_without_it(self):
        other = scree.World(scree.demo("pile", bodies=30), backend="cpu")
        with self.world.record(show=["contacts"], color="speed", events=True):
            self.world.step(50)
        other.step(50)
        self.assertEqual(self.world.state_hash(), other.state_hash())

    def test_the_parts_for_notebooks(self):
        with self.world.record() as recording:
            self.world.step(10)
        for thing in (recording, recording.view()):
            parts = thing._repr_mimebundle_()
            self.assertEqual(set(parts), {"text/plain", "text/html", "image/png"})
            self.assertEqual(base64.b64decode(parts["image/png"])[:8], b"\x89PNG\r\n\x1a\n")
            html = parts["text/html"]
            self.assertIn(f"data:image/png;base64,{parts['image/png']}", html)
            self.assertIn('sandbox="allow-scripts"', html)
            srcdoc = html.split('srcdoc="')[1].split('"')[0]
            self.assertEqual(srcdoc.replace("&quot;", '"').replace("&amp;", "&"), recording.html())
        self.assertIn("height: 300px", recording.view(300)._repr_mimebundle_()["text/html"])
        self.assertNotIn("IPython", sys.modules)

    def test_without_a_picture_there_is_the_viewer(self):
        recording = self.world.record(color="speed")
        recording._world = types.SimpleNamespace(render=self.refuse)
        self.assertEqual(set(recording.view()._repr_mimebundle_()), {"text/plain", "text/html"})

    @staticmethod
    def refuse(**_):
        raise scree.DeviceError("no canvas")

    def test_later_steps_appear_when_their_cell_is_done(self):
        shell = Shell()
        ipython = types.ModuleType("IPython")
        ipython.get_ipython, ipython.display = lambda: shell, shell
        sys.modules["IPython"] = ipython
        try:
            view = self.world.view(height=200)
            view._ipython_display_()
            self.assertEqual(len(shell.hooks), 1)
            shell.hooks[0](None)
            self.assertEqual(len(shell.shown), 1, "a cell without a step shows nothing anew")
            self.world.step(4)
            shell.hooks[0](None)
            self.assertEqual(len(shell.shown), 2)
            self.assertIn("View of 3 frames", shell.shown[-1]["text/plain"])
            self.world.step(2)
            view.update()
            self.assertIn("View of 4 frames", shell.shown[-1]["text/plain"])
            self.assertIn("seek(2)", shell.shown[-1]["text/html"])
            view.close()
            view.close()
            self.assertEqual(shell.hooks, [])
            self.world.step(2)
            self.assertEqual(len(view.recording), 4)
        finally:
            del sys.modules["IPython"]

    def test_what_is_refused(self):
        for options, kind in (({"fps": -1}, ValueError), ({"fps": "fast"}, TypeError), ({"sky": "green"}, scree.SceneError), ({"copy": 1}, IndexError),
                              ({"legend": True}, TypeError), ({"colour": "speed"}, TypeError)):
            with self.assertRaises(kind, msg=str(options)):
                self.world.record(**options)
        with self.assertRaises(ValueError):
            self.world.view(height=-1)


if __name__ == "__main__":
    unittest.main()
