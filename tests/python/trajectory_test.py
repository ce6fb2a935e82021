# Trajectories of scree run against a world that is stepped here.
import csv
import os
import subprocess
import tempfile
import unittest

import numpy as np

import scree

PROGRAM = os.environ.get("SCREE_PROGRAM_PATH", "")


def run(*arguments):
    return subprocess.run([PROGRAM, "run", *arguments, "--backend", "cpu", "--quiet"], stderr=subprocess.PIPE, text=True, check=False)


@unittest.skipUnless(PROGRAM, "SCREE_PROGRAM_PATH is not set")
class Trajectories(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.scene = scree.demo("mix", 30)
        cls.path = os.path.join(cls.folder.name, "scene.json")
        cls.scene.save(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def file(self, name):
        return os.path.join(self.folder.name, name)

    def test_arrays_by_time_and_body(self):
        made = run(self.path, "--steps", "60", "--trajectory", self.file("run.npz"), "--trajectory-every", "4")
        self.assertIn(made.returncode, (0, 1), made.stderr)
        with np.load(self.file("run.npz")) as run_file:
            data = dict(run_file)
        self.assertEqual(data["time"].shape, (16,))
        np.testing.assert_allclose(data["time"], np.arange(16) * 4 / 60)
        ids = data["body"]
        self.assertEqual(data["position"].shape, (16, len(ids), 3))
        world = scree.World(scree.load(self.path), backend="cpu")
        for moment in range(16):
            if moment:
                world.step(4)
            for name in ("position", "orientation", "velocity", "angular_velocity", "exists"):
                np.testing.assert_array_equal(data[name][moment], getattr(world, name)[ids])
        statistics = world.statistics
        np.testing.assert_allclose(data["kinetic_energy"][-1].sum(), statistics["kinetic_energy"], rtol=1e-5)
        np.testing.assert_allclose(data["momentum"][-1].sum(0), statistics["momentum"], rtol=1e-4, atol=1e-2)
        np.testing.assert_allclose(data["potential_energy"][-1].sum(), statistics["potential_energy"], rtol=1e-5)

    def test_lines_by_time_and_body(self):
        made = run(self.path, "--steps", "10", "--trajectory", self.file("run.csv"), "--trajectory-bodies", "5,9")
        self.assertIn(made.returncode, (0, 1), made.stderr)
        with open(self.file("run.csv"), newline="", encoding="utf-8") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(len(lines), 11 * 2)
        self.assertEqual([line["body"] for line in lines[:2]], ["5", "9"])
        world = scree.World(scree.load(self.path), backend="cpu")
        world.step(10)
        last = np.array([[line[axis] for axis in "xyz"] for line in lines[-2:]], dtype=np.float32)
        np.testing.assert_array_equal(last, world.position[[5, 9]])

    def test_wrong_usage_leaves_no_file(self):
        for arguments, word in ((("--trajectory", self.file("run.txt")), ".npz"),
                                (("--trajectory", self.file("a.npz"), "--trajectory-bodies", "nobody"), "nobody"),
                                (("--trajectory", self.file("a.npz"), "--trajectory-bodies", "9999"), "counted from 0"),
                                (("--trajectory-every", "2"), "--trajectory FILE")):
            made = run(self.path, "--steps", "2", *arguments)
            self.assertEqual(made.returncode, 2, made.stderr)
            self.assertIn(word, made.stderr)
        self.assertFalse(os.path.exists(self.file("a.npz")))
        self.assertEqual([name for name in os.listdir(self.folder.name) if ".part-" in name], [])


if __name__ == "__main__":
    unittest.main()
