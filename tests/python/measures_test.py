# Measures of granular media from Python: arrays, gates over steps, words of scene files, mistakes.
import os
import tempfile
import unittest

import numpy as np

import scree

G = 9.81


def heap(count=40):
    scene = scree.Scene()
    scene.add(scree.Plane(), name="floor")
    grid = np.arange(count)
    place = np.stack([grid % 4 * .22 - .33, .11 + grid // 16 * .21, grid // 4 % 4 * .22 - .33], 1)
    return scene, scene.add(scree.Sphere(.1), position=place)


class Measures(unittest.TestCase):
    def test_a_heap_in_regions_on_a_grid_and_per_body(self):
        scene, balls = heap()
        world = scree.World(scene, backend="cpu", threads=1)
        world.set_measures(regions=[{"name": "box", "shape": {"box": {"lower": (-9, -9, -9), "upper": np.array([9, 9, 9])}}}],
                           bodies=["floor", balls[0]], grid={"lower": (-2, 0, -2), "upper": (2, 1, 2), "cell": (1, .25, 1)})
        world.run(seconds=4)
        now = world.measures()
        self.assertEqual((now.step, now.time), (240, 4))
        ball = 1000 * 4 / 3 * np.pi * .001
        self.assertEqual(now.all["bodies"], 40)
        self.assertEqual(now.regions.names, ["box"])
        box = now.regions.row("box")
        self.assertAlmostEqual(box["mass"], 40 * ball, delta=1e-3 * ball)
        self.assertAlmostEqual(box["solid_fraction"] * 18**3, 40 * ball / 1000, delta=1e-5)
        self.assertEqual(now.regions.stress.shape, (1, 3, 3))
        self.assertEqual(now.bodies.names, ["floor", "body 1"])
        self.assertAlmostEqual(now.bodies.force[0, 1], -40 * ball * G, delta=.01 * 40 * ball * G)
        self.assertEqual(now.grid.stress.shape, (4, 4, 4, 3, 3))
        self.assertEqual(now.grid.bodies.sum(), 40)
        self.assertEqual(len(now.grains.coordination), len(world.position))
        touching = np.zeros(len(world.position))
        for contact in world.contacts():
            if contact["force"][:contact["count"]].sum() > 0:
                touching[[contact["a"], contact["b"]]] += 1
        self.assertTrue((now.grains.coordination[balls] == touching[balls]).all())
        self.assertAlmostEqual(now.all["coordination"], touching[balls].mean(), places=12)
        self.assertIn("stress", dict(now.regions))
        with self.assertRaises(AttributeError):
            now.regions.stres
        with self.assertRaises(KeyError):
            now.regions.row("bx")

    def test_a_gate_counts_every_step(self):
        scene = scree.Scene(gravity=(0, 0, 0))
        scene.add(scree.Sphere(.05), position=[(0, .01 + .2 * i, 0) for i in range(50)], velocity=(0, -3, 0))
        world = scree.World(scene, backend="cpu", threads=1)
        world.set_measures(gates=[{"name": "out", "centre": (0, 0, 0), "u": (.1, 0, 0), "v": (0, 0, .1)}])
        world.step(60)
        told = world.measures().gates.row("out")
        self.assertEqual((told["bodies_forward"], told["bodies_backward"], told["seconds"]), (15, 0, 1))
        self.assertAlmostEqual(told["mass_flow"], 15 * 1000 * 4 / 3 * np.pi * .05**3, places=4)
        self.assertEqual(world.measures().gates.row("out")["forward"], 0)

    def test_a_scene_says_what_is_measured(self):
        scene, _ = heap(4)
        world = scree.World(scene, backend="cpu", threads=1)
        self.assertEqual(world.measures().regions.names, [])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.json")
            scene.save(path)
            with open(path, encoding="utf-8") as file:
                text = file.read().replace('"bodies": [', '"measures": {"regions": [{"shape": {"sphere": {"centre": [0, 0, 0], "radius": 1}}}]}, "bodies": [', 1)
            self.assertEqual(scree.World(scree.from_json(text), backend="cpu", threads=1).measures().regions.names, ["region 0"])

    def test_mistakes_have_their_place(self):
        scene, _ = heap(4)
        world = scree.World(scene, backend="cpu", threads=1)
        for given, place in ((dict(regions=[{"shape": {"sphere": {"centre": (0, 0, 0), "radius": -1}}}]), "/regions/0/shape/sphere/radius"),
                             (dict(bodies=["flor"]), "/bodies/0/body"), (dict(bodies=[99]), "/bodies/0/body"),
                             (dict(gates=[{"centre": (0, 0, 0), "u": (1, 0, 0), "v": (1, 0, 0)}]), "/gates/0/v"),
                             (dict(grid={"lower": (0, 0, 0), "upper": (1, 1, 1)}), "/grid")):
            with self.assertRaises(scree.SceneError) as caught:
                world.set_measures(**given)
            self.assertEqual(caught.exception.pointer, place)
        with self.assertRaises(IndexError):
            world.set_measures(copy=3)
        world.measures()  # still


if __name__ == "__main__":
    unittest.main()
