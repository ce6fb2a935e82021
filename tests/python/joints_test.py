# Joints from Python: by name, in bulk and in copies; torques, servos, coordinates; the frames in which bodies were described.
import json
import pathlib
import tempfile
import unittest

import numpy as np

import scree

TWIST = 3

CART = """<mujoco><option gravity="0 0 -9.81"/><worldbody>
  <body name="cart" pos="0 0 1"><joint name="rail" type="slide" axis="1 0 0"/><geom type="box" size=".2 .1 .1" mass="2"/>
    <body name="pole"><joint name="pin" type="hinge" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 .6" size=".04" mass=".3"/></body>
  </body></worldbody><actuator><motor joint="rail"/></actuator></mujoco>"""

ROBOT = """<robot name="r"><link name="base"/>
  <link name="upper"><inertial><origin xyz="0.25 0 0.02"/><mass value="2"/><inertia ixx=".1" iyy=".2" izz=".2" ixy="0.03" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0.3 0 0" rpy="0 0.4 0"/><geometry><box size=".5 .1 .1"/></geometry></collision></link>
  <joint name="elbow" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0.06 0 0.5"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="0" velocity="1"/></joint></robot>"""


def loaded(text, name, **options):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, name)
        path.write_text(text, encoding="utf-8")
        return scree.load(path, **options)


def arm(links=3, **kind):
    """Links along x that turn about z, from the world on."""
    scene = scree.Scene(gravity=(0, 0, 0))
    for i in range(links):
        scene.add(scree.Box((.4, .1, .1)), position=(.5 + i, 0, 0), name=f"link {i}")
        scene.add_joint(scree.Hinge(**kind), i - 1 if i else None, i, anchor=(i, 0, 0), axis=(0, 0, 1), name=f"joint {i}")
    return scene


class Names(unittest.TestCase):
    def test_joints_are_found_by_name(self):
        scene = loaded(ROBOT, "robot.urdf", axes="file")
        self.assertEqual(scene.joint_names, ["elbow"])
        self.assertEqual(scene.joint("elbow"), 0)
        with self.assertRaisesRegex(KeyError, r"no body is named .*but joint 0 is: scene.joint\(.*elbow"):
            scene["elbow"]
        with self.assertRaisesRegex(KeyError, 'nearest: "elbow"'):
            scene.joint("elbwo")
        world = scree.World(scene, backend="cpu")
        self.assertEqual((world.joint("elbow"), world.joint_names), (0, ["elbow"]))
        with self.assertRaisesRegex(KeyError, 'nearest: "elbow"'):
            world.set_drive("elbwo", target=1)

    def test_joints_of_copies_have_the_shape_of_copies(self):
        world = scree.World(arm(3), copies=4, backend="cpu")
        self.assertEqual(world.joints().shape, (4, 3))
        self.assertEqual(world.joints().rates.shape, (4, 3, 6))
        self.assertEqual(world.drives().shape, (4, 3))
        np.testing.assert_array_equal(world.joint_ids(["joint 2", 0], copies=[1, 3]), [[5, 3], [11, 9]])
        np.testing.assert_array_equal(world.joint_ids(np.array(["joint 2"])), world.joint_ids("joint 2"))
        with self.assertRaisesRegex(TypeError, "takes one name, not list; of several: joint_ids"):
            world.joint(["joint 2"])
        world.set_joint_coordinates(world.joint_ids([0, 1]), np.arange(8).reshape(4, 2) / 10, [1, 2])
        np.testing.assert_allclose(world.joints().coordinates[:, :2, TWIST], np.arange(8).reshape(4, 2) / 10, atol=1e-5)
        np.testing.assert_allclose(world.joints().rates[:, :, TWIST], [[1, 2, 0]] * 4, atol=1e-5)
        world.set_drive(["joint 0"], stiffness=10, target=[[1], [2], [3], [4]])  # of every copy
        np.testing.assert_array_equal(world.drives().target[:, 0], [1, 2, 3, 4])
        self.assertEqual(world.drives().stiffness[2].tolist(), [10, 0, 0])
        with self.assertRaisesRegex(ValueError, "target: has the shape"):
            world.set_drive(world.joint_ids([0, 1]), target=[1, 2, 3])

    def test_copies_are_driven_as_worlds_alone(self):
        alone = scree.World(arm(3), backend="cpu")
        many = scree.World(arm(3), backend="cpu", copies=3)
        torques = np.random.default_rng(3).normal(size=(3, 3)).astype(np.float32)
        for _ in range(20):
            alone.apply_joint_forces([0, 1, 2], torques[1])
            many.apply_joint_forces(many.joint_ids(), torques)
            alone.step()
            many.step()
        self.assertEqual(many.state_hashes()[1], alone.state_hash())


class Control(unittest.TestCase):
    def test_the_motors_of_a_file_are_forces_on_joints(self):
        world = scree.World(loaded(CART, "cart.xml", axes="file"), backend="cpu", rate=240)
        for _ in range(60):
            world.apply_joint_forces("rail", 4.6)
            world.step()
        momentum = (world.mass[:, None] * world.velocity)[:, 0].sum()
        self.assertAlmostEqual(momentum, 4.6 * .25, delta=.01)
        for wrong, what in ((np.nan, "not finite"), ([1, 2], "force: has the shape")):
            with self.assertRaisesRegex(ValueError, what):
                world.apply_joint_forces("rail", wrong)
        with self.assertRaisesRegex(IndexError, "joint 7 of 2"):
            world.apply_joint_forces(7, 1)
        with self.assertRaisesRegex(ValueError, "axis: unknown 'spin'"):
            world.apply_joint_forces(0, 1, axis="spin")

    def test_motors_and_springs_leave_each_other(self):
        world = scree.World(arm(2, spring=scree.Spring(10000, 500, 1)), backend="cpu")
        world.set_motor([0, 1], .5, [10, 20])
        found = world.drives()
        self.assertEqual(found.stiffness.tolist(), [10000, 10000])
        self.assertEqual(found.motor_force.tolist(), [10, 20])
        world.set_spring(0, scree.Spring(5000))
        self.assertEqual((world.drives().stiffness.tolist(), world.drives().motor_speed.tolist()), ([5000, 10000], [.5, .5]))
        world.set_motor([0, 1], 0, 0)
        world.set_drive([0, 1], damping=1000, target=[.3, -.4])
        self.assertEqual(world.drives().stiffness.tolist(), [5000, 10000])
        world.run(4)
        np.testing.assert_allclose(world.joints().coordinates[:, TWIST], [.3, -.4], atol=1e-3)
        self.assertTrue(np.isinf(world.drives().max_force).all() and np.isinf(world.drives().upper).all())
        self.assertTrue(world.drives(axis="x").locked.all())
        world.set_drive([True, False], max_force=np.inf)

    @unittest.skipUnless(scree._native.has_vulkan, "built without Vulkan")
    def test_servos_have_the_same_bits_on_every_backend(self):
        hashes = set()
        for backend in ("cpu", "vulkan"):
            world = scree.World(arm(5), backend=backend, copies=9)
            random = np.random.default_rng(7)
            world.set_joint_coordinates(world.joint_ids(), random.uniform(-1, 1, (9, 5)), random.uniform(-1, 1, (9, 5)))
            for i in range(40):
                if i % 10 == 0:  # explicit and implicit ones, with and without stiffness
                    world.set_drive(world.joint_ids(), stiffness=[0, 10, 1e3, 1e5, 1e7], damping=10 ** random.uniform(0, 5, (9, 5)),
                                    target=random.uniform(-1, 1, (9, 5)), target_speed=random.uniform(-3, 3, (9, 5)),
                                    max_force=10 ** random.uniform(1, 6, (9, 5)))
                world.apply_joint_forces(world.joint_ids(), random.uniform(-9, 9, (9, 5)))
                world.step()
            hashes.add(world.state_hash())
        self.assertEqual(len(hashes), 1)

    def test_positions_and_rates_are_those_along_or_about_each_joint(self):
        scene = arm(1)
        scene.add(scree.Sphere(.1), position=(0, 5, 0))
        scene.add_joint(scree.Slider(), None, 1, anchor=(0, 5, 0), axis=(0, 1, 0), name="rail")
        for world in (scree.World(scene, backend="cpu"), scree.World(scene, copies=2, backend="cpu")):
            world.set_joint_coordinates(["joint 0", "rail"], [7, .25], rate=[1, -2])  # more than a turn
            shape = world.joints().shape
            np.testing.assert_allclose(world.joint_positions, np.broadcast_to([7, .25], shape), atol=1e-5)
            np.testing.assert_allclose(world.joint_rates, np.broadcast_to([1, -2], shape), atol=1e-5)
            self.assertEqual((world.joint_positions.shape, world.joint_positions.flags.writeable), (shape, False))

    def test_an_imported_effort_bounds_drives_alone(self):
        text = ROBOT.replace('effort="0"', 'effort="3"')
        world = scree.World(loaded(text, "robot.urdf", axes="file"), backend="cpu")
        self.assertEqual(world.drives().max_force.tolist(), [3])
        world.step(30)
        self.assertGreater(abs(world.joint_positions[0]), .3)  # nothing holds it
        world.set_drive("elbow", stiffness=1e4, damping=1e3)
        self.assertEqual(world.drives().max_force.tolist(), [3])

    def test_a_robot_is_set_up(self):
        scene = loaded(ROBOT, "robot.urdf", axes="file")
        world = scree.World(scene, backend="cpu")
        world.set_joint_coordinates("elbow", .5, rate=.25)
        self.assertAlmostEqual(float(world.joints().coordinates[0, TWIST]), .5, delta=1e-5)
        self.assertAlmostEqual(float(world.joints().rates[0, TWIST]), .25, delta=1e-5)
        with self.assertRaisesRegex(ValueError, "3 is outside of its limits, -2 to 2"):
            world.set_joint_coordinates("elbow", 3)

    def test_authored_frames_are_told(self):
        world = scree.World(loaded(ROBOT, "robot.urdf", axes="file"), backend="cpu")
        upper = len(world) - 1
        position, orientation = world.origin([upper])
        np.testing.assert_allclose(position, [[.06, 0, .5]], atol=1e-6)  # of the link
        np.testing.assert_allclose(np.abs(orientation), [[0, 0, 0, 1]], atol=1e-6)
        world.set_joint_coordinates("elbow", np.pi / 2)
        np.testing.assert_allclose(world.origin(upper)[0], [[.06, 0, .5]], atol=1e-6)
        np.testing.assert_allclose(np.abs(world.origin()[1][upper]), [0, .5 ** .5, 0, .5 ** .5], atol=1e-6)
        self.assertGreater(np.linalg.norm(world.position[upper] - position[0]), .2)
        many = scree.World(loaded(ROBOT, "robot.urdf", axes="file"), backend="cpu", copies=3)
        self.assertEqual(many.origin()[0].shape, (3, len(world), 3))
        self.assertEqual(many.origin(many.ids([upper]))[1].shape, (3, 1, 4))

    def test_a_file_of_a_snapshot_keeps_the_frames(self):
        ell = scree.Compound([scree.Part(scree.Box((.5, .1, .1)), position=(.5, 0, 0)), scree.Part(scree.Box((.1, .5, .1)), position=(0, .5, 0))])
        scene = scree.Scene()
        scene.add(ell, position=(0, 2, 0))
        self.assertNotIn("origin", json.loads(scene.to_json())["bodies"][0])
        world = scree.World(scene, backend="cpu")
        self.assertGreater(np.abs(world.position[0] - (0, 2, 0)).max(), .1)
        again = scree.World(scree.from_json(world.snapshot().to_json()), backend="cpu")
        for one in (world, again):
            np.testing.assert_allclose(one.origin(0)[0], [[0, 2, 0]], atol=1e-6)

    def test_bodies_are_placed_as_they_were_described(self):
        ell = scree.Compound([scree.Part(scree.Box((.5, .1, .1)), position=(.5, 0, 0)), scree.Part(scree.Box((.1, .5, .1)), position=(0, .5, 0))])
        turn = np.array([.1, -.7, .5, .5]) / np.linalg.norm([.1, -.7, .5, .5])
        scene, there = scree.Scene(), scree.Scene()
        scene.add(ell)
        there.add(ell, position=(3, 1, 2), orientation=turn)
        world, wanted = (scree.World(one, backend="cpu") for one in (scene, there))
        world.set_origin(0, (3, 1, 2), 2 * turn)
        np.testing.assert_allclose(world.position, wanted.position, atol=1e-5)
        np.testing.assert_allclose(np.abs(np.sum(world.orientation * wanted.orientation, axis=1)), 1, atol=1e-6)
        world.set_origin([0], position=(0, 0, 0))
        np.testing.assert_allclose(np.concatenate(world.origin(0), axis=1), [[0, 0, 0, *turn]], atol=1e-6)
        many = scree.World(scene, backend="cpu", copies=3)
        many.set_origin(many.ids(), position=[[[1, 0, 0]], [[2, 0, 0]], [[3, 0, 0]]])
        np.testing.assert_allclose(many.origin()[0][:, 0, 0], [1, 2, 3], atol=1e-6)



class Couplings(unittest.TestCase):
    def test_gears_a_follower_and_a_tendon(self):
        scene = scree.Scene(gravity=(0, 0, 0))
        for i, name in enumerate(("small", "large", "slide")):
            scene.add(scree.Sphere(0.2), position=(i, 0, 0))
            kind = scree.Slider() if name == "slide" else scree.Hinge()
            scene.add_joint(kind, None, i, anchor=(i, 0, 0), axis=(0, 0, 1), name=name)
        scene.add_joint(scree.Coupling({"small": 20, "large": 50}), name="gear")
        scene.add_joint(scree.Coupling([("slide", 1), ("large", 0, "twist")], curve=(-0.1, -0.02), offset=0), name="cam")
        scene.add_joint(scree.Coupling({"small": 1}, limits=(-1, 2), offset=0), name="stop")
        world = scree.World(scene, backend="cpu", copies=2)
        self.assertEqual(scree.from_json(scene.to_json()).hash, scene.hash)
        for _ in range(240):
            world.apply_joint_forces("small", 5)
            world.step()
        angles = world.joint_positions[0]
        self.assertAlmostEqual(angles[0], 2, delta=1e-3)
        self.assertAlmostEqual(angles[1], -0.4 * angles[0], delta=1e-5)
        self.assertAlmostEqual(angles[2], 0.1 * angles[1] + 0.02 * angles[1]**2, delta=1e-5)
        self.assertAlmostEqual(angles[3], 0, delta=1e-4)
        self.assertAlmostEqual(angles[5], 2, delta=1e-3)
        with self.assertRaisesRegex(scree.SceneError, 'no joint named "none"'):
            scene.add_joint(scree.Coupling({"none": 1}))


if __name__ == "__main__":
    unittest.main()
