# Scenes from Python: bulk building, files, and errors that name the place.
import json
import os
import tempfile
import unittest

import numpy as np

import scree


class Building(unittest.TestCase):
    def test_many_bodies_in_one_call(self):
        scene = scree.Scene(gravity=(0, -9.81, 0))
        positions = np.random.default_rng(1).uniform(-5, 5, (100, 3))
        turns = np.tile([0, 0, 0, 1], (100, 1))
        ground = scene.add(scree.Plane())
        ids = scene.add(scree.Box((.5, .5, .5)), position=positions, orientation=turns, friction=.6)
        self.assertEqual(ground, 0)
        self.assertEqual(ids.dtype, np.int64)
        np.testing.assert_array_equal(ids, np.arange(1, 101))
        self.assertEqual(len(scene), 101)
        world = scree.World(scene, backend="cpu")
        np.testing.assert_array_equal(world.position[ids], positions.astype(np.float32))
        self.assertEqual(world.position.shape, (101, 3))
        self.assertEqual(world.orientation.dtype, np.float32)

    def test_numbers_of_each_body(self):
        scene = scree.Scene()
        friction = np.array([.1, .2, .3], dtype=np.float32)
        scene.add(scree.Sphere(), position=np.zeros((3, 3)), friction=friction, velocity=(1, 2, 3))
        bodies = json.loads(scene.to_json())["bodies"]
        np.testing.assert_allclose([body["friction"] for body in bodies], friction, rtol=1e-6)
        self.assertEqual(bodies[2]["velocity"], [1, 2, 3])

    def test_every_shape_is_simulated(self):
        scene = scree.Scene()
        tetrahedron = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        shapes = [scree.Sphere(.4), scree.Capsule(.2, .3), scree.Box((.3, .2, .1)), scree.Cylinder(.3, .2), scree.Cone(.3, .5),
                  scree.Ellipsoid((.3, .2, .4)), scree.Hull(tetrahedron),
                  scree.Compound([scree.Part(scree.Box((.5, .1, .1))), scree.Part(scree.Sphere(.2), (.5, 0, 0), density=100)])]
        for i, shape in enumerate(shapes):
            scene.add(shape, position=(2 * i, 3, 0))
        scene.add(scree.HeightField(np.zeros((4, 30)), 1.0), position=(8, 0, 0))
        floor = scene.add(scree.Mesh([(-50, -1, -50), (50, -1, -50), (50, -1, 50), (-50, -1, 50)], [(0, 2, 1), (0, 3, 2)]))
        world = scree.World(scene, backend="cpu")
        world.step(240)
        self.assertTrue(np.isfinite(world.position).all())
        self.assertTrue((world.position[:len(shapes), 1] > -.1).all())
        self.assertEqual(floor, len(shapes) + 1)

    def test_descriptions_have_the_keys_of_scene_files(self):
        from dataclasses import fields
        for kind, name in ((scree.Filter, "filter"), (scree.Tyre, "tyre"), (scree.Fracture, "fracture")):
            self.assertLessEqual({one.name for one in fields(kind)}, set(scree._native.keys(name)))

    def test_joints_vehicles_and_what_happens(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        door = scene.add(scree.Box((.5, 1, .05)), position=(.5, 1.2, 0), name="door")
        hinge = scene.add_joint(scree.Hinge(limits=(-.1, 1.5), friction=.1, armature=2), None, "door", anchor=(0, 1.2, 0), axis=(0, 1, 0))
        car = scene.add_car((5, 0, 0))
        scene.at(.5, impulse={"body": door, "impulse": [0, 0, -200], "offset": [.4, 0, 0]})
        self.assertEqual((hinge, car), (0, 0))
        world = scree.World(scene, backend="cpu")
        world.drive(car, throttle=1)
        world.step(120)
        self.assertGreater(world.vehicles().speed[car], 3)
        self.assertGreater(abs(world.joints().coordinates[hinge, 3]), .3)
        self.assertEqual(len(scene.vehicle_bodies(car)), 5)

    def test_a_file_reads_back_to_the_same_bits(self):
        scene = scree.demo("wall")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wall.json")
            scene.save(path)
            again = scree.load(path)
        self.assertEqual(scene.hash, again.hash)
        self.assertEqual(scree.from_json(scene.to_json()).hash, scene.hash)
        self.assertEqual(scene.copy().hash, scene.hash)



class Grains(unittest.TestCase):
    region = {"box": {"lower": (-.5, 0, -.5), "upper": (.5, 1, .5)}}

    def test_they_follow_a_curve_and_have_ids(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        ids = scene.add_grains(sieve=[(.02, 0), (.03, 40), (.06, 100)], region=self.region, count=1000, friction=.7,
                               shapes=[{"form": {"polyhedron": {"elongation": .7}}}])
        np.testing.assert_array_equal(ids, np.arange(1, 1001))
        self.assertEqual(scene.notes, [])
        self.assertEqual(len(scene.add_grains(sieve=np.array([(.02, 0), (.06, 50), (.1, 100)]), region=self.region, count=5)), 5)
        self.assertIn("5 grains miss the sieve curve by", scene.notes[0])
        world = scree.World(scene, backend="cpu")
        self.assertEqual(len(world.position), 1006)

    def test_they_are_poured_during_a_run(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        rain = {"name": "rain", "size": .05, "count": 40, "region": {"box": {"lower": (-.5, 2, -.5), "upper": (.5, 2.5, .5)}}}
        self.assertEqual(len(scene.add_grains(**rain, count_rate=100, start=.1)), 0)
        world = scree.World(scene, backend="cpu")
        world.run(seconds=1)
        self.assertEqual(len(world.position), 41)
        self.assertTrue((world.position[1:, 1] < 2).all())

    def test_errors_name_the_place(self):
        scene = scree.Scene()
        for keys, place in (({"size": .05}, "/grains/0"), ({"size": -1, "count": 3}, "/grains/0/size"),
                            ({"size": 3, "count": 3}, "/grains/0/region"),
                            ({"sieve": [(.1, 0), (.05, 100)], "count": 3}, "/grains/0/sieve/1/size")):
            with self.assertRaises(scree.SceneError) as caught:
                scene.add_grains(region=self.region, **keys)
            self.assertEqual(caught.exception.pointer, place)
        self.assertEqual(len(scene), 0)
        with self.assertRaisesRegex(ValueError, "sieve: is"):
            scene.add_grains(sieve=[.1, .2], region=self.region, count=3)
        with self.assertRaises(TypeError):
            scene.add_grains(sizes=.1, region=self.region, count=3)


class Bonds(unittest.TestCase):
    def test_bonds_hold_near_bodies_until_they_break(self):
        scene = scree.Scene(gravity=(0, 0, 0))
        scene.add(scree.Sphere(.1), [(0, 0, 0), (.2, 0, 0)], name="stone")
        scene.add_bonds(bodies="stone", tension=1e3)
        self.assertIn('"bond_pairs"', scene.to_json())
        world = scree.World(scene, backend="cpu")
        for force, together in ((20, True), (200, False)):
            for _ in range(60):
                world.apply([0, 1], force=[(-force, 0, 0), (force, 0, 0)])
                world.step()
            self.assertEqual(world.position[1, 0] - world.position[0, 0] < .21, together)
        for keys, pointer in (({"tension": -1}, "/bonds/0/tension"), ({"bodies": "sand"}, "/bonds/0/bodies")):
            with self.assertRaises(scree.SceneError) as raised:
                scene.add_bonds(**keys)
            self.assertEqual(raised.exception.pointer, pointer)
        with self.assertRaises(TypeError):
            scene.add_bonds(tensoin=1)

    def test_a_servo_wall_presses_with_its_stress(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        scene.add(scree.Box((.3, .3, .3)), position=(0, .3, 0))
        lid = scene.add(scree.Box((.25, .05, .25)), position=(0, 1, 0), name="lid")
        joint = scene.add_servo_wall("lid", stress=4e3, max_speed=1)
        self.assertEqual(scene.joint_names[joint], "lid")
        world = scree.World(scene, backend="cpu", sleeping=False)
        world.set_measures(bodies=[lid])
        world.run(seconds=2)
        self.assertAlmostEqual(world.measures().bodies.row("lid")["force"][1] / .25, 4e3, delta=8)
        world.set_motor(joint, 1, 6e3 * .25)
        world.run(seconds=1)
        self.assertAlmostEqual(world.measures().bodies.row("lid")["force"][1] / .25, 6e3, delta=12)
        other = scene.add(scree.Sphere(.1), position=(3, 1, 0))
        for keys, pointer in (({"stress": -1}, "/servo_walls/0/stress"), ({"stress": 1}, "/servo_walls/0/area")):
            with self.assertRaises(scree.SceneError) as raised:
                scene.add_servo_wall(other, **keys)
            self.assertEqual(raised.exception.pointer, pointer)
        with self.assertRaises(TypeError):
            scene.add_servo_wall("lid", stress=1, speed=1)


class Imports(unittest.TestCase):
    def test_a_robot_of_a_urdf_and_one_of_mjcf(self):
        folder = os.path.join(os.environ["SCREE_SOURCE"], "tests", "imports")
        arm = scree.load(os.path.join(folder, "arm.urdf"))
        self.assertFalse(any("mimic" in note for note in arm.notes))
        self.assertEqual(arm.joint_names[-1], "right_finger mimics left_finger")
        world = scree.World(arm, backend="cpu")
        before = world.position
        world.set_drive(world.joint_ids()[0], stiffness=1e5, damping=1e3)  # holds the arm by its efforts
        world.step(60)
        np.testing.assert_allclose(world.position, before, atol=2e-3)
        np.testing.assert_allclose(world.joint_positions, 0, atol=2e-3)
        dog = scree.load(os.path.join(folder, "quadruped.xml"), keyframe="home", axes="file")
        np.testing.assert_allclose(dog.gravity, (0, 0, -9.81), rtol=1e-6)
        with self.assertRaisesRegex(scree.SceneError, r"quadruped.xml:\d+: .*without --strict it would be a note"):
            scree.load(os.path.join(folder, "quadruped.xml"), strict=True)
        with self.assertRaisesRegex(ValueError, "axes: is"):
            scree.load(os.path.join(folder, "quadruped.xml"), axes="z")

    def test_a_set_of_usd(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "set.usda")
            with open(path, "w") as file:
                file.write('#usda 1.0\n(\n    metersPerUnit = 0.01\n    upAxis = "Z"\n)\ndef Sphere "ball" (\n    prepend apiSchemas = '
                           '["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]\n)\n{\n    double radius = 25\n'
                           '    double3 xformOp:translate = (0, 0, 400)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
                           'def DistantLight "sun" {}\n')
            world = scree.World(scree.load(path), backend="cpu")
            ball = world["/ball"]
            np.testing.assert_allclose(world.position[ball], (0, 4, 0), atol=1e-6)
            self.assertTrue(any("/sun: DistantLight" in note for note in scree.load(path).notes))
            world.run(seconds=.5)
            self.assertAlmostEqual(world.position[ball][1], 4 - 9.81 / 8, delta=.05)
            with self.assertRaisesRegex(scree.SceneError, "/sun"):
                scree.load(path, strict=True)

    def test_a_broken_robot_names_file_and_line(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "robot.urdf")
            with open(path, "w") as file:
                file.write("<robot name='r'>\n<link/>\n</robot>")
            with self.assertRaises(scree.SceneError) as caught:
                scree.load(path)
            self.assertTrue(str(caught.exception).startswith(path + ":2: "))

    def test_a_mesh_beside_the_folder_is_read_where_that_is_allowed(self):
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "urdf"))
            with open(os.path.join(folder, "corner.obj"), "w") as file:
                file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
            path = os.path.join(folder, "urdf", "robot.urdf")
            with open(path, "w") as file:
                file.write("<robot name='r'><link name='a'><collision><geometry><mesh filename='../corner.obj'/></geometry>"
                           "</collision></link></robot>")
            with self.assertRaisesRegex(scree.SceneError, "allow_outside=True.*packages="):
                scree.load(path)
            for allowed in ({"allow_outside": True}, {"packages": {"any": folder}}):
                self.assertEqual(len(scree.load(path, base="free", **allowed)), 1)


class Errors(unittest.TestCase):
    def test_a_scene_that_cannot_be_names_the_place(self):
        scene = scree.Scene()
        scene.add(scree.Sphere(), position=np.zeros((3, 3)))
        scene.add(scree.Sphere(radius=-1))
        with self.assertRaises(ValueError) as caught:
            scree.World(scene, backend="cpu")
        self.assertIsInstance(caught.exception, scree.SceneError)
        self.assertEqual(caught.exception.pointer, "/bodies/3/shape/sphere/radius")
        self.assertIn("/bodies/3/shape/sphere/radius", str(caught.exception))

    def test_errors_are_of_pythons_kinds(self):
        scene = scree.Scene()
        with self.assertRaises(TypeError) as caught:
            scene.add(scree.Sphere(), fricton=1)
        self.assertIn('"friction"', str(caught.exception))
        with self.assertRaises(ValueError):
            scene.add(scree.Sphere(), position=[(0, 0)])
        with self.assertRaises(ValueError):
            scene.add(scree.Sphere(), position=np.zeros((3, 3)), friction=[.1, .2])
        with self.assertRaises(scree.SceneError):
            scene.add(scree.Sphere(radius=float("nan")))
        with self.assertRaises(KeyError):
            scene["nobody"]
        with self.assertRaises(KeyError):
            scree.demo("nothing")
        with self.assertRaises(OSError):
            scree.load("/nowhere/at/all.json")
        with self.assertRaises(TypeError):
            scree.World(scene, substep=3)
        with self.assertRaises(ValueError):
            scree.World(scene, backend="abacus")
        with self.assertRaises(scree.SceneError) as settings:
            scree.World(scene, backend="cpu", rate=-1)
        self.assertEqual(settings.exception.pointer, "/settings/rate")
        with self.assertRaises(scree.SceneError) as joint:
            scene.add_joint(scree.Hinge(limits=("low", 1)), 0)
        self.assertTrue(joint.exception.pointer.startswith("/joints/0/"))

    def test_a_broken_file_names_file_and_place(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write('{"bodies": [{"shape": {"cube": {}}}]}')
            file.flush()
            with self.assertRaises(scree.SceneError) as caught:
                scree.load(file.name)
        self.assertEqual(caught.exception.pointer, "/bodies/0/shape")
        self.assertIn(file.name, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
