# Usual mistakes: scenes as containers, read-only copies, misspelt attributes, shapes and kinds of arguments, missing files.
import copy
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import scree


def pair():
    scene = scree.Scene()
    scene.add(scree.Plane())
    scene.add(scree.Sphere(), position=(0, 2, 0), name="lamp")
    return scene


class Scenes(unittest.TestCase):
    def test_a_scene_is_a_container_of_ids(self):
        scene = pair()
        self.assertEqual(list(scene), [0, 1])
        self.assertTrue("lamp" in scene and 1 in scene and np.int64(1) in scene)
        self.assertFalse("lmap" in scene or 2 in scene or -1 in scene or None in scene)
        self.assertEqual((scene["lamp"], scene[1], scene.names), (1, 1, ["", "lamp"]))
        for wrong, kind in ((99, IndexError), (-1, IndexError), ("lmap", KeyError), (1.5, TypeError)):
            with self.assertRaises(kind):
                scene[wrong]
        with self.assertRaisesRegex(KeyError, 'nearest: "lamp"'):
            scene["lmap"]

    def test_scenes_are_pickled_and_copied(self):
        scene = pair()
        scene.settings = {"substeps": 3}
        scene.at(1, gravity={"gravity": [0, 1, 0]})
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "tetra.obj")
            path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", encoding="utf-8")
            scene.add(scree.Mesh(file=str(path)))
            whole = scene.hash
        for again in (pickle.loads(pickle.dumps(scene)), copy.copy(scene), copy.deepcopy(scene)):  # the file is gone
            self.assertEqual((again.hash, again.settings["substeps"], len(again)), (whole, 3, 3))
            again.add(scree.Box())
            self.assertEqual(len(scene), 3)

    def test_bytes_are_no_mask(self):
        world = scree.World(pair(), backend="cpu", copies=4)
        with self.assertRaisesRegex(ValueError, "look like a mask, which is of bools"):
            world.reset(np.array([0, 0, 0, 1], np.uint8))
        world.reset(np.array([0, 0, 0, 1], bool))
        with self.assertRaisesRegex(TypeError, "are told by whole numbers, or a mask of bools, not by names"):
            world.reset(["lamp"])

    def test_a_body_has_a_mass(self):
        scene = scree.Scene()
        scene.add(scree.Box((.5, .5, .5)), position=[(0, i, 0) for i in range(3)], mass=[1, 2, 3])
        scene.add(scree.Hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]), mass=7)
        scene.add(scree.Plane())
        world = scree.World(scene, backend="cpu")
        np.testing.assert_allclose(world.mass, [1, 2, 3, 7, 0], rtol=1e-6)
        world.set_mass(0, 5)
        self.assertEqual(world.mass[0], 5)
        added = world.add(scree.Sphere(), position=(5, 0, 0), mass=4)
        self.assertAlmostEqual(float(world.mass[added]), 4, places=5)
        self.assertEqual(scree.World(scene, backend="cpu", copies=2).mass.shape, (2, 5))
        for shape, fields, what in ((scree.Plane(), {"mass": 1}, "a Plane has none"), (scree.Box(), {"mass": 1, "density": 5}, "already"),
                                    (scree.Sphere(), {"inertial": {"mass": 1}}, "mass= gives a mass"),
                                    (scree.Sphere(.01), {"mass": 1e9}, "World.set_mass"), (scree.Sphere(), {"mass": -1}, "density out of")):
            with self.assertRaisesRegex(ValueError, what):
                scene.add(shape, **fields)

    def test_check_tells_of_joints_apart_and_meshes_inside_out(self):
        scene = scree.Scene()
        scene.add(scree.Box(), position=[(0, 0, 0), (4, 0, 0)])
        scene.add_joint(scree.Hinge(), 0, 1)
        self.assertRegex(scene.check()[0], "^/joints/0: its anchors are 4 m apart")
        scene = scree.Scene()
        corners, faces = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
        scene.add(scree.Mesh(corners, faces))
        self.assertEqual(scene.check(), [])
        scene.add(scree.Mesh(corners, faces[:, ::-1]))
        self.assertRegex(scene.check()[0], "/bodies/1/.*inside out")


class Worlds(unittest.TestCase):
    def test_copies_cannot_be_taken_for_the_state(self):
        world = scree.World(pair(), backend="cpu")
        for name in ("position", "orientation", "velocity", "angular_velocity", "asleep", "exists", "mass"):
            with self.assertRaisesRegex(ValueError, "read-only"):
                getattr(world, name)[0] = 1
        with self.assertRaisesRegex(ValueError, "read-only"):
            world.read()["position"][0] = 1
        with self.assertRaises(AttributeError):
            world.positon = 1
        with self.assertRaises(AttributeError):
            world.position = 1

    def test_shapes_are_not_guessed(self):
        scene = pair()
        world = scree.World(scene, backend="cpu")
        column = np.ones((3, 1))
        for refused in (lambda: scene.add(scree.Box(), position=column), lambda: world.set([0, 1, 1], position=column),
                        lambda: world.set(1, position=0), lambda: world.set_mass(1, [1, 2])):
            with self.assertRaisesRegex(ValueError, "has the shape"):
                refused()
        self.assertEqual(len(scene), 2)
        with self.assertRaises(IndexError):
            world.set([False], position=(0, 3, 0))
        with self.assertRaisesRegex(ValueError, "threads: is -1"):
            scree.World(scene, threads=-1)

    def test_mistakes_are_told_in_plain_words(self):
        scene = pair()
        world = scree.World(scene, backend="cpu")
        for mistake, what in ((lambda: world.step(1.5), "number of steps: is a whole number, not 1.5"),
                              (lambda: world.run("2"), "seconds: is a number, not '2'"),
                              (lambda: world.restore(None), "restore: takes the bytes of save"),
                              (lambda: scene.add(scree.Box), r"is the class Box; make one: scree.Box\(\)"),
                              (lambda: scene.add("box"), "is a shape, such as"),
                              (lambda: scene.add(scree.Box(), position="up"), "position: is made of numbers"),
                              (lambda: world.set_mass(1, "heavy"), "mass: is made of numbers"),
                              (lambda: world.grip(1.5, (0, 0, 0), (0, 0, 0)), "body: is a whole number"),
                              (lambda: world.explode((0, 0, 0), None, 1), "radius: is a number"),
                              (lambda: world.drive("car"), "vehicle: is a whole number"),
                              (lambda: world.roll_back(None), "steps: is a whole number"),
                              (lambda: world.exclude("lamp", 0), "body: is a whole number"),
                              (lambda: world.tune(substeps=2.5), "substeps: is a whole number"),
                              (lambda: scree.World(None), "simulates a Scene, a scene file or a list"),
                              (lambda: world.cast_shapes(scree.Sphere, (0, 0, 0), (0, 1, 0)), "is the class Sphere"),
                              (lambda: scree.from_json({}), "reads a text")):
            with self.subTest(what):
                with self.assertRaisesRegex(TypeError, what) as caught:
                    mistake()
                self.assertNotIn("incompatible function arguments", str(caught.exception))
        world.restore(memoryview(world.save()))
        for mistake, kind, what in ((lambda: world.remove_joint(-1), IndexError, "joint -1"), (lambda: world.drive(-1), IndexError, "vehicle -1"),
                                    (lambda: world.statistics_of(-1), IndexError, "copy -1"), (lambda: world.step(10**12), ValueError, "number of steps"),
                                    (lambda: world.cast_rays((0, 0, 0), (0, 1, 0), mask=-1), ValueError, "mask: is -1"),
                                    (lambda: scene.vehicle_bodies(9), IndexError, "vehicle 9 of 0"), (lambda: scene.exclude(0, 77), IndexError, "77 of 2"),
                                    (lambda: scree.demo("pil"), KeyError, 'nearest: "pile"'), (lambda: scree.demo("pile", bodies=-4), ValueError, "bodies: is -4")):
            with self.assertRaisesRegex(kind, what):
                mistake()

    def test_a_step_beyond_memory_raises_MemoryError(self):
        crowd = """
import resource
import scree
scene = scree.Scene()
for _ in range(600):
    scene.add(scree.Box((1, 1, 1)))
world = scree.World(scene, backend="cpu", threads=1)
taken = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (taken + 100_000_000, taken + 100_000_000))
try:
    world.step()
except MemoryError as error:
    print(error)
"""
        run = subprocess.run([sys.executable, "-c", crowd], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertRegex(run.stdout, "^step 1 is beyond memory: 179700 contacts take .* body 0 alone may touch 599 others")

    def test_what_says_nothing_or_no_number_is_refused(self):
        scene = pair()
        world = scree.World(scene, backend="cpu", threads=1)
        for mistake, what in ((lambda: world.apply(1, force=(0, "5", 0)), "force: is made of numbers"),
                              (lambda: world.apply(1, force=np.array([0, "5", 0], dtype=object)), "force: is made of numbers"),
                              (lambda: world.cast_rays((0, 9, 0), (0, -1, 0), "5"), "reach: is made of numbers"),
                              (lambda: world.closest_points(("0", "1", "0")), "points: is made of numbers"),
                              (lambda: world.set_joint_coordinates([]), "give one at least of coordinate, rate"),
                              (lambda: world.set_drive([]), "give one at least of stiffness"),
                              (lambda: world.set(1), "give one at least of position"),
                              (lambda: world.set_origin(1), "give one at least of position"),
                              (lambda: world.apply(1, offset=(0, 1, 0)), "give one at least of force"),
                              (lambda: scree.Hinge(limit=(0, 1)), 'scree.Hinge has no "limit"; nearest: "limits"'),
                              (lambda: scree.Box(half_extent=(1, 1, 1)), 'nearest: "half_extents"'),
                              (lambda: scree.Fixed(limits=(0, 1)), 'scree.Fixed has no "limits"')):
            with self.assertRaisesRegex(TypeError, what):
                mistake()
        with self.assertRaisesRegex(KeyError, r"coordinates.*joints\(\).coordinates is of joints"):
            world.read("coordinates")
        with self.assertRaisesRegex(KeyError, "known: position"):
            world.read("positions")
        self.assertEqual(copy.deepcopy(scree.Hinge(limits=(0, 1))), pickle.loads(pickle.dumps(scree.Hinge((0, 1)))))

    def test_names_are_of_one(self):
        scene = pair()
        scene.add_joint(scree.Ball(), "lamp", anchor=(0, 3, 0), name="chain")
        world = scree.World(scene, backend="cpu", copies=2)
        self.assertEqual((world["lamp"], world[3], world.names, list(world)), (1, 3, ["", "lamp"], [0, 1, 2, 3]))
        self.assertTrue("lamp" in world and 3 in world and "lmap" not in world and 4 not in world)
        for wrong, kind, what in (("lmap", KeyError, 'nearest: "lamp"'), ("chain", KeyError, r'joint 0 is: world.joint\("chain"'), (4, IndexError, "4 of 4")):
            with self.assertRaisesRegex(kind, what):
                world[wrong]
        scene.add(scree.Sphere(), position=(3, 2, 0), name="lamp")
        for find in (lambda: scene["lamp"], lambda: scree.World(scene, backend="cpu")["lamp"], lambda: scene.add_joint(scree.Ball(), "lamp", 0)):
            with self.assertRaisesRegex(KeyError, '"lamp" names bodies 1 and 2'):
                find()

    def test_missing_files_are_of_one_kind(self):
        for ending in ("json", "urdf", "xml", "glb", "gltf", "usda", "usdc", "usdz", "obj", "stl"):
            with self.assertRaises(FileNotFoundError):
                scree.load(f"/nowhere/no.{ending}")

    def test_bodies_of_copies_are_named_alike_everywhere(self):
        world = scree.World(pair(), backend="cpu", copies=3)
        world.run(2)
        lamps = world.ids([1])
        forces = world.touch_force(lamps)
        self.assertEqual(forces.shape, (3, 1, 3))
        np.testing.assert_allclose(forces[:, 0, 1], 9.81 * world.mass[:, 1], rtol=.02)
        world.set_mass(lamps, [[1], [2], [3]])
        np.testing.assert_array_equal(world.mass[:, 1], [1, 2, 3])
        world.set_material(lamps, friction=.2)
        world.wake(lamps)


if __name__ == "__main__":
    unittest.main()
