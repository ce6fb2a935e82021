# Many copies of a scene at once.
import unittest

import numpy as np

import scree


def boxes(height=2.0):
    scene = scree.Scene()
    scene.add(scree.Plane())
    scene.add(scree.Box((0.5, 0.5, 0.5)), position=[(0.1 * i, height + 1.2 * i, 0) for i in range(4)])
    return scene


class Copies(unittest.TestCase):
    def test_every_copy_has_the_bits_of_the_scene_alone_and_arrays_have_an_axis_of_copies(self):
        alone, world = scree.World(boxes(), backend="cpu"), scree.World(boxes(), backend="cpu", copies=6)
        self.assertEqual(world.copies, 6)
        self.assertEqual(world.position.shape, (6, 5, 3))
        self.assertEqual(world.asleep.shape, (6, 5))
        world.apply(world.ids([2, 3], [4]), impulse=(900, 0, 0))
        alone.step(50)
        world.step(50)
        same = [hash == alone.state_hash() for hash in world.state_hashes()]
        self.assertEqual(same, [True, True, True, True, False, True])
        self.assertTrue(np.array_equal(world.position[1], alone.position))
        world.reset([4])
        self.assertTrue(np.array_equal(world.position[4], scree.World(boxes(), backend="cpu").position))
        self.assertTrue(np.array_equal(world.position[3], alone.position))
        world.reset()
        world.step(50)
        self.assertEqual(set(world.state_hashes()), {alone.state_hash()})

    def test_poses_gravity_and_scenes_of_copies(self):
        world = scree.World([boxes(2), boxes(3), boxes(4)], backend="cpu")
        self.assertEqual(list(world.position[:, 1, 1]), [2, 3, 4])
        heights = np.zeros((3, 4, 3))
        heights[:, :, 1] = 5 + np.arange(4) * 1.2
        world.set(world.ids(range(1, 5)), position=heights, velocity=(0, 1, 0))
        self.assertTrue(np.allclose(world.position[:, 1:], heights))
        self.assertTrue(np.allclose(world.velocity[:, 1:], (0, 1, 0)))
        world.set_gravity_of(1, (0, 0, 0))
        world.step(10)
        self.assertAlmostEqual(world.velocity[1, 1, 1], 1, places=5)
        self.assertLess(world.velocity[0, 1, 1], 0.1)
        self.assertEqual(world.gravity_of(1), (0, 0, 0))
        self.assertEqual(world.statistics_of(1)["bodies"], 5)
        hits = world.cast_rays([(0, 50, 0)] * 3, (0, -1, 0), copy=[0, 1, 2])
        self.assertEqual(list(hits.body), list(world.ids([4])[:, 0]))
        self.assertEqual(len(world.snapshot(2)), 5)

    def test_what_copies_cannot_do_is_refused(self):
        with self.assertRaisesRegex(ValueError, "at least 1"):
            scree.World(boxes(), backend="cpu", copies=0)
        with self.assertRaisesRegex(ValueError, "2 scenes"):
            scree.World([boxes(), boxes()], backend="cpu", copies=3)
        world = scree.World(boxes(), backend="cpu", copies=2)
        with self.assertRaisesRegex(RuntimeError, "2 copies of its scene"):
            world.add(scree.Sphere(1.0))
        with self.assertRaisesRegex(IndexError, "copy 2 of 2"):
            world.ids(copies=[2])
        with self.assertRaisesRegex(ValueError, "a mask of the shape"):
            world.reset(np.zeros(3, dtype=bool))


if __name__ == "__main__":
    unittest.main()
