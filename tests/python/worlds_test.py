# Worlds from Python: the program's bits, arrays in the order of ids, exact states, views, threads and interruption.
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import scree

PROGRAM = os.environ.get("SCREE_PROGRAM_PATH", "")


def pile(count=64, **fields):
    scene = scree.Scene()
    scene.add(scree.Plane())
    grid = np.arange(count)
    place = np.stack([grid % 4 * 1.1, .6 + grid // 16 * 1.05, grid // 4 % 4 * 1.1], 1)
    ids = scene.add(scree.Box(), position=place, **fields)
    return scene, ids


def backends():
    return ["cpu"] + (["vulkan"] if scree._native.has_vulkan else [])


class SameBits(unittest.TestCase):
    @unittest.skipUnless(PROGRAM, "SCREE_PROGRAM_PATH is not set")
    def test_hashes_are_the_programs(self):
        for demo, bodies, steps in (("mix", 100, 90), ("wrecking", 0, 60)):
            scene = scree.demo(demo, bodies)
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "scene.json")
                scene.save(path)
                for backend in backends():
                    made = subprocess.run([PROGRAM, "run", path, "--steps", str(steps), "--backend", backend, "--report", "-", "--quiet"],
                                          stdout=subprocess.PIPE, check=False)
                    report = json.loads(made.stdout)
                    world = scree.World(scree.load(path), backend=backend)
                    world.step(steps)
                    self.assertEqual(world.state_hash(), report["state_hash"], (demo, backend))

    @unittest.skipUnless(PROGRAM, "SCREE_PROGRAM_PATH is not set")
    def test_timed_events_happen_as_in_the_program(self):
        scene, ids = pile(16)
        scene.at(.2, explosion={"centre": [1.5, 0, 1.5], "radius": 6, "speed": 8})
        scene.at(.5, gravity={"gravity": [3, -9.81, 0]})
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.json")
            scene.save(path)
            made = subprocess.run([PROGRAM, "run", path, "--steps", "80", "--backend", "cpu", "--report", "-", "--quiet"],
                                  stdout=subprocess.PIPE, check=False)
        world = scree.World(scene, backend="cpu")
        world.step(50)
        world.step(30)
        self.assertEqual(world.state_hash(), json.loads(made.stdout)["state_hash"])

    def test_threads_and_batches_change_no_bit(self):
        scene, _ = pile()
        worlds = [scree.World(scene, backend="cpu", threads=threads) for threads in (1, 2)]
        worlds[0].step(100)
        for _ in range(100):
            worlds[1].step()
        self.assertEqual(worlds[0].state_hash(), worlds[1].state_hash())
        self.assertEqual(worlds[0].steps, 100)

    def test_a_world_goes_back_to_states_that_it_keeps(self):
        scene, ids = pile()
        world = scree.World(scene, backend="cpu")
        hashes = []
        for _ in range(12):
            world.keep_state()
            world.step()
            hashes.append(world.state_hash())
        self.assertEqual(world.kept_states, list(range(2, 12)))
        world.apply(ids, impulse=(5, 0, 0))
        world.roll_back(10)
        self.assertEqual(world.steps, 2)
        world.step(10)
        self.assertEqual(world.state_hash(), hashes[-1])
        with self.assertRaisesRegex(IndexError, "no state is kept 3 steps before step 12: those of steps 2 are"):
            world.roll_back(3)
        world.drop_states()
        self.assertEqual(world.kept_states, [])

    def test_a_restored_world_goes_on_with_the_same_bits(self):
        scene, ids = pile()
        world = scree.World(scene, backend="cpu")
        world.step(30)
        mark = world.save()
        self.assertIsInstance(mark, bytes)
        world.step(60)
        end = world.state_hash()
        world.apply(ids, impulse=(5, 0, 0))
        world.step(20)
        world.restore(mark)
        world.step(60)
        self.assertEqual(world.state_hash(), end)
        other = scree.World(scene, backend="cpu", threads=1)
        other.restore(mark)
        other.step(60)
        self.assertEqual(other.state_hash(), end)
        with self.assertRaises(scree.CheckpointError):
            world.restore(mark[:-1])
        with self.assertRaises(ValueError):
            world.restore(b"")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.checkpoint")
            world.write_checkpoint(path, "noted")
            self.assertEqual(other.read_checkpoint(path), "noted")
        self.assertEqual(other.state_hash(), end)


class Scripted(unittest.TestCase):
    @unittest.skipUnless(PROGRAM, "SCREE_PROGRAM_PATH is not set")
    def test_a_world_that_follows_the_fountain_has_the_programs_bits(self):
        made = subprocess.run([PROGRAM, "run", "fountain", "--bodies", "300", "--steps", "25", "--backend", "cpu", "--report", "-", "--quiet"],
                              stdout=subprocess.PIPE, check=False)
        world = scree.World(scree.demo("fountain", bodies=300), backend="cpu")
        before = len(world.position)
        world.follow_demo("fountain", bodies=300)
        world.step(25)
        self.assertEqual(world.state_hash(), json.loads(made.stdout)["state_hash"])
        after = len(world.position)
        self.assertEqual(after, before + 3 * (300 // 36))
        world.follow_demo(None)
        world.step(12)
        self.assertEqual(len(world.position), after)
        with self.assertRaisesRegex(ValueError, "fontain"):
            world.follow_demo("fontain")


class Bulk(unittest.TestCase):
    def test_set_and_read_in_the_order_of_ids(self):
        for backend in backends():
            scene, ids = pile(5000 if backend == "cpu" else 64)  # with thousands, rows differ from ids
            world = scree.World(scene, backend=backend)
            world.step(2)
            rng = np.random.default_rng(3)
            position = rng.uniform(-100, 100, (len(ids), 3)).astype(np.float32)
            velocity = rng.uniform(-1, 1, (len(ids), 3)).astype(np.float32)
            world.set(ids, position=position, velocity=velocity)
            np.testing.assert_array_equal(world.position[ids], position)
            np.testing.assert_array_equal(world.velocity[ids], velocity)
            world.set(ids, velocity=world.velocity[ids] * .5)
            np.testing.assert_array_equal(world.velocity[ids], velocity * np.float32(.5))
            world.set(ids[:3], orientation=(0, 0, 0, 2))
            np.testing.assert_array_equal(world.orientation[ids[:3]], [[0, 0, 0, 1]] * 3)

    def test_forces_move_bodies(self):
        scene = scree.Scene(gravity=(0, 0, 0))
        ids = scene.add(scree.Sphere(.5), position=[(0, 0, 0), (5, 0, 0), (10, 0, 0)], density=1000)
        world = scree.World(scene, backend="cpu")
        mass = 1000 * 4 / 3 * np.pi * .125
        world.apply(ids[:2], impulse=[(mass, 0, 0), (0, 2 * mass, 0)])
        world.apply(ids[2], force=(0, 0, 60 * mass))
        world.step()
        np.testing.assert_allclose(world.velocity, [(1, 0, 0), (0, 2, 0), (0, 0, 1)], atol=1e-4)

    def test_wrong_ids_and_values_change_nothing(self):
        scene, ids = pile(8)
        world = scree.World(scene, backend="cpu")
        before = world.state_hash()
        with self.assertRaises(IndexError):
            world.set([1, 99], velocity=(0, 0, 0))
        with self.assertRaises(IndexError):
            world.set(-1, velocity=(0, 0, 0))
        with self.assertRaises(ValueError):
            world.set(ids, velocity=np.full((8, 3), np.nan))
        with self.assertRaises(ValueError):
            world.set(ids, velocity=np.zeros((7, 3)))
        with self.assertRaises(TypeError):
            world.set(ids * 1.0, velocity=(0, 0, 0))
        with self.assertRaises(ValueError):
            world.apply([1, 0], force=(0, 1, 0))  # the ground is fixed
        with self.assertRaises(ValueError):
            world.step(-1)
        self.assertEqual(world.state_hash(), before)

    def test_masks_have_the_length_of_what_they_choose_from(self):
        scene, ids = pile(8)
        world = scree.World(scene, backend="cpu")
        several = scree.World(scene, backend="cpu", copies=2)
        before = world.state_hash(), several.state_hash()
        for wrong in (np.array([False, True, True]), np.zeros(0, dtype=bool), np.ones(10, dtype=bool), [True] * 3):
            for one in (world, several):
                for use in (lambda: one.set(wrong, velocity=(0, 9, 0)), lambda: one.apply(wrong, force=(0, 9, 0)),
                            lambda: one.wake(wrong), lambda: one.set_material(wrong, friction=1), lambda: one.set_mass(wrong, 1),
                            lambda: one.set_filter(wrong, {"category": 2}), lambda: one.set_motion(wrong, "fixed"),
                            lambda: one.move(wrong, (0, 0, 0)), lambda: one.handles(wrong), lambda: one.touch_force(wrong),
                            lambda: one.ids(wrong), lambda: one.ids(copies=wrong), lambda: one.remove(wrong)):
                    with self.assertRaisesRegex(IndexError, "a mask of"):
                        use()
        with self.assertRaisesRegex(IndexError, r"a mask of the shape \(9, 2\)"):
            several.set(np.ones((9, 2), dtype=bool), velocity=(0, 9, 0))
        self.assertEqual((world.state_hash(), several.state_hash()), before)
        mask = np.arange(9) == 3
        world.set(mask, velocity=(0, 9, 0))
        several.set(np.stack([mask, mask]), velocity=(0, 9, 0))
        self.assertEqual(world.velocity[3, 1], 9)
        np.testing.assert_array_equal(several.velocity[:, 3, 1], [9, 9])

    def test_bodies_come_and_go(self):
        scene, ids = pile(8)
        world = scree.World(scene, backend="cpu")
        world.step(5)
        born = world.add(scree.Sphere(.2), position=[(0, 9, 0), (2, 9, 0)], velocity=(0, -1, 0))
        np.testing.assert_array_equal(born, [9, 10])
        handles = world.handles(born)
        world.step(10)
        world.remove(handles[:1])
        np.testing.assert_array_equal(world.are_valid(handles), [False, True])
        self.assertFalse(world.exists[9])
        with self.assertRaises(IndexError):
            world.remove(handles[:1])
        world.step(2)
        self.assertEqual(world.add(scree.Box((.1, .1, .1)), (0, 9, 0)), 9)
        self.assertFalse(world.are_valid(handles)[0])


class Contacts(unittest.TestCase):
    def test_a_box_at_rest_bears_its_weight(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        box = scene.add(scree.Box((.5, .5, .5)), position=(0, .5, 0), density=1000)
        world = scree.World(scene, backend="cpu", sleeping=False)
        world.step(120)
        contacts = world.contacts()
        self.assertEqual(len(contacts), 1)
        self.assertEqual((contacts.a[0], contacts.b[0], contacts["count"][0]), (0, 1, 4))
        self.assertAlmostEqual(float(contacts.force.sum()) / 9810, 1, places=2)
        np.testing.assert_allclose(world.touch_force(box)[0], (0, 9810, 0), atol=100)
        self.assertEqual(contacts.position.shape, (1, 4, 3))

    def test_events_begin_hit_and_end(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        ball = scene.add(scree.Sphere(.5), position=(0, 2, 0), restitution=.8)
        world = scree.World(scene, backend="cpu", events={"hit_speed": 1})
        world.step(120)
        events = world.events()
        kinds = [scree.EventKind(e.kind) for e in events]
        self.assertEqual(kinds[:1], [scree.EventKind.begin])
        self.assertIn(scree.EventKind.hit, kinds)
        hit = events[events.kind == scree.EventKind.hit][0]
        self.assertEqual((hit.a, hit.b), (0, ball))
        self.assertGreater(hit.speed, 4)
        self.assertEqual(len(world.events()), 0)

    def test_events_that_nobody_asked_for_warn(self):
        scene, _ = pile(4)
        world = scree.World(scene, backend="cpu")
        with self.assertWarns(RuntimeWarning):
            self.assertEqual(len(world.events()), 0)
        world.step(60)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertGreater(len(world.events()), 0)

    def test_a_body_breaks(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        brick = scene.add(scree.Box((.4, .2, .2)), position=(0, 6, 0), fracture=scree.Fracture(impulse=100, pieces=5))
        world = scree.World(scene, backend="cpu", events=True)
        self.assertEqual(world.exists.sum(), 2)
        world.step(120)
        self.assertFalse(world.exists[brick])
        self.assertEqual(world.exists.sum(), 6)
        self.assertIn(scree.EventKind.body_broke, world.events().kind)


class Model(unittest.TestCase):
    def test_sensors_tell_what_overlaps_them(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        gate = scene.add(scree.Box((1, .2, 1)), position=(0, 2, 0), motion="fixed", role="sensor")
        ball = scene.add(scree.Sphere(.3), position=(0, 4, 0))
        world = scree.World(scene, backend="cpu", events={"contacts": False})
        world.step(36)
        self.assertEqual(world.sensed().body.tolist(), [ball])
        self.assertEqual(world.sensed().sensor.tolist(), [gate])
        world.step(60)
        kinds = world.events().kind.tolist()
        self.assertEqual(kinds, [scree.EventKind.sensor_begin, scree.EventKind.sensor_end])
        self.assertEqual(len(world.sensed()), 0)

    def test_kinematic_bodies_arrive(self):
        scene = scree.Scene()
        lift = scene.add(scree.Box(), position=(0, 0, 0), motion="kinematic")
        world = scree.World(scene, backend="cpu")
        world.move(lift, (0, 1, 0), steps=30)
        world.step(15)
        self.assertAlmostEqual(float(world.position[lift, 1]), .5, places=3)
        world.step(30)
        np.testing.assert_allclose(world.position[lift], (0, 1, 0), atol=1e-5)

    def test_masses_change(self):
        scene = scree.Scene()
        boxes = scene.add(scree.Box((.5, .5, .5)), position=[(0, 5, 0), (5, 5, 0)])
        world = scree.World(scene, backend="cpu")
        world.set_mass(boxes, (10, 40))
        for box in boxes:
            world.apply([box], impulse=(40, 0, 0))
        world.step()
        np.testing.assert_allclose(world.velocity[boxes, 0], (4, 1), rtol=1e-5)
        with self.assertRaises(scree.SceneError):
            world.set_mass(boxes, 0)

    def test_materials_and_fields_change(self):
        scene = scree.Scene()
        scene.add(scree.Plane(), friction=1.0)
        box = scene.add(scree.Box((.5, .25, .5)), position=(0, .25, 0), velocity=(3, 0, 0), friction=.5)
        slid = []
        for friction in (None, 0.0):
            world = scree.World(scene, backend="cpu")
            if friction is not None:
                world.set_material(box, friction=friction)
            world.step(60)
            slid.append(float(world.position[box, 0]))
        self.assertLess(slid[0], 1.5)
        self.assertAlmostEqual(slid[1], 3, delta=.1)
        scene = scree.Scene()
        scene.add(scree.Sphere(.5), position=(0, -.5, 0), density=500)
        scene.set_fields(water={"offset": 0})
        world = scree.World(scene, backend="cpu")
        world.step(600)
        self.assertLess(abs(float(world.position[0, 1])), .4)
        with self.assertRaises(TypeError):
            world.set_fields(tide=1)

    def test_a_periodic_cell_wraps_and_stretches(self):
        scene = scree.Scene(gravity=(0, 0, 0))
        scene.set_periodic((2, 0, 2), centre=(1, 0, 1))
        scene.add(scree.Sphere(.1), position=(1.9, 0, 1), velocity=(3, 0, 0))
        world = scree.World(scene, backend="cpu")
        world.step(12)
        self.assertAlmostEqual(float(world.position[0, 0]), .5, delta=1e-4)
        world.cell_rate = (.5, 0, -.5)
        world.step(60)
        self.assertEqual(world.cell_rate, (.5, 0, -.5))
        self.assertAlmostEqual(world.cell_size[0], 2 * (1 + .5 / 60)**60, delta=1e-4)
        self.assertEqual(world.cell_size[1], 0)
        with self.assertRaises(scree.SceneError):
            world.cell_rate = (0, 1, 0)

    def test_the_nearest_points(self):
        scene, ids = pile(4)
        world = scree.World(scene, backend="cpu")
        near = world.closest_points([(0, 1.4, 0), (0, 50, 0)], 5)
        self.assertEqual(near.body.tolist(), [ids[0], -1])
        self.assertAlmostEqual(float(near.distance[0]), .3, places=4)
        self.assertEqual(world.closest_points([(0, 1.4, 0), (0, 50, 0)], np.inf).body.tolist(), [ids[0]] * 2)


class Queries(unittest.TestCase):
    def test_rays_as_arrays(self):
        scene, ids = pile(16)
        world = scree.World(scene, backend="cpu")
        origins = np.array([(0, 10, 0), (0, 10, 50), (50, 1, 50)])
        hits = world.cast_rays(origins, [(0, -2, 0), (0, -1, 0), (0, 1, 0)])
        self.assertEqual(hits.body.tolist(), [ids[0], 0, -1])
        np.testing.assert_allclose(hits.distance[:2], (10 - 1.1, 10), atol=1e-5)
        self.assertEqual(hits.distance[2], np.inf)
        np.testing.assert_allclose(hits.normal[0], (0, 1, 0))
        self.assertEqual(world.rays_hit(origins, (0, -1, 0)).tolist(), [True, True, True])
        self.assertEqual(world.rays_hit(origins, (0, -1, 0), 2).tolist(), [False, False, True])
        starts, through = world.cast_rays_through(origins, (0, -1, 0))
        self.assertEqual(through[starts[0]:starts[1]].body.tolist(), [ids[0], 0])
        grid = world.cast_rays(np.zeros((3, 4, 3)) + (0, 5, 0), (0, -1, 0))
        self.assertEqual(grid.shape, (3, 4))
        with self.assertRaises(ValueError):
            world.cast_rays((0, 0, 0), (0, 0, 0))
        with self.assertRaises(ValueError):
            world.cast_rays((0, 0), (0, 0, 1))

    def test_casts_and_overlaps(self):
        scene, ids = pile(16)
        world = scree.World(scene, backend="cpu")
        stop = world.cast_shapes(scree.Sphere(.5), (0, 10, 0), (0, -1, 0), 20)
        self.assertEqual(stop.body[0], ids[0])
        self.assertAlmostEqual(float(stop.point[0, 1]), 1.6, places=3)
        for away, found in ((-1, ids[0]), (1, -1)):
            self.assertEqual(world.cast_shapes(scree.Sphere(.5), (0, 10, 0), (0, away, 0), np.inf).body.tolist(), [found])
        starts, parts = world.overlaps(scree.Box((.2, .2, .2)), [(0, .6, 0), (0, 30, 0)])
        self.assertEqual(parts[starts[0]:starts[1]].body.tolist(), [ids[0]])
        self.assertEqual(starts.tolist(), [0, 1, 1])

    def test_hulls_and_compounds_are_cast_and_depths_told(self):
        scene, ids = pile(16)
        world = scree.World(scene, backend="cpu")
        half = .5
        cube = scree.Hull([(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)])
        stop = world.cast_shapes(cube, (0, 10, 0), (0, -1, 0), 20)
        self.assertAlmostEqual(float(stop.point[0, 1]), 1.6, places=3)
        dumbbell = scree.Compound([scree.Part(scree.Sphere(.2), position=(0, -1, 0)), scree.Part(scree.Sphere(.2), position=(0, 1, 0))])
        stop = world.cast_shapes(dumbbell, (0, 10, 0), (0, -1, 0), 20)
        self.assertAlmostEqual(float(stop.point[0, 1]), 2.3, places=3)
        starts, deep = world.penetrations(scree.Sphere(.5), [(0, 1.5, 0), (0, 30, 0)])
        self.assertEqual(starts.tolist(), [0, 1, 1])
        self.assertEqual(deep.body.tolist(), [ids[0]])
        self.assertAlmostEqual(float(deep.depth[0]), .1, places=4)
        np.testing.assert_allclose(deep.normal[0], (0, 1, 0), atol=1e-5)
        with self.assertRaisesRegex(scree.SceneError, "not a plane"):
            world.cast_shapes(scree.Plane(), (0, 10, 0), (0, -1, 0))
        # Out of what it touches, and through what it ignores: one, or one for each, -1 for none.
        touching = (0, 1.499, 0)
        self.assertEqual(world.cast_shapes(scree.Sphere(.5), touching, (0, 1, 0)).body.tolist(), [ids[0]])
        self.assertEqual(world.cast_shapes(scree.Sphere(.5), touching, (0, 1, 0), solid=False).body.tolist(), [-1])
        self.assertEqual(world.cast_shapes(scree.Sphere(.5), touching, (0, -1, 0), solid=False).body.tolist(), [ids[0]])
        both = world.cast_shapes(scree.Sphere(.5), [touching] * 2, (0, 1, 0), ignore=[-1, ids[0]])
        self.assertEqual(both.body.tolist(), [ids[0], -1])
        self.assertEqual(len(world.overlaps(scree.Sphere(.5), touching, ignore=ids[0])[1]), 0)
        self.assertEqual(len(world.penetrations(scree.Sphere(.5), touching, ignore=ids[0])[1]), 0)

    def test_groups_that_are_kept_apart(self):
        groups = scree.FilterGroups()
        groups.separate(1, 1)
        self.assertFalse(groups.collide(1, 1))
        self.assertTrue(groups.collide(0, 1))
        scene = scree.Scene()
        scene.add(scree.Plane())
        boxes = scene.add(scree.Box(), position=[(0, .5, 0), (0, 2, 0)], filter=groups.filter_of(1))
        world = scree.World(scene, backend="cpu")
        world.step(120)
        np.testing.assert_allclose(world.position[boxes, 1], .5, atol=.02)
        with self.assertRaises(IndexError):
            groups.separate(0, 32)

    def test_lines_and_points_to_draw(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        box = scene.add(scree.Box(), position=(0, .5, 0), color="#f00")
        with self.assertRaisesRegex(scree.SceneError, '/bodies/2/color: .*"#ff8000" or "#f80"; is the string "red"'):
            scene.add(scree.Box(), color="red")
        world = scree.World(scene, backend="cpu")
        world.step(5)  # it is awake
        drawn = world.debug_drawing(box, contacts=False)
        self.assertEqual(drawn.lines.shape, (12, 2, 3))
        self.assertEqual(drawn.line_colors.tolist(), [[1, 0, 0]] * 12)
        self.assertEqual(drawn.points.shape, (0, 3))
        np.testing.assert_allclose(np.linalg.norm(drawn.lines[:, 1] - drawn.lines[:, 0], axis=1), 1, atol=1e-5)
        touching = world.debug_drawing(shapes=False)
        self.assertEqual(touching.points.shape, (4, 3))
        self.assertEqual(touching.point_colors.shape, (4, 3))
        self.assertEqual(world.debug_drawing(box, contacts=False, boxes=True).lines.shape, (24, 2, 3))
        with self.assertRaisesRegex(ValueError, "segments"):
            world.debug_drawing(segments=1)
        with self.assertRaises(IndexError):
            world.debug_drawing([7])


class Views(unittest.TestCase):
    def test_views_show_the_tables_and_hold_them(self):
        scene, ids = pile(5000)
        world = scree.World(scene, backend="cpu")
        world.step()
        poses = world.tables.poses
        rows = world.tables.ids
        self.assertFalse(poses.flags.writeable)
        by_id = np.empty((len(world), 3), np.float32)
        by_id[rows] = poses["position"]
        np.testing.assert_array_equal(by_id, world.position)
        before = poses["position"].copy()
        world.step(3)
        self.assertTrue((poses["position"] != before).any())
        mark = world.save()
        for change in (lambda: world.add(scree.Sphere(), (0, 50, 0)), lambda: world.remove(1), lambda: world.restore(mark)):
            with self.assertRaises(BufferError):
                change()
        with self.assertRaises(ValueError):
            poses["position"][0] = 0
        inner = poses["position"]
        del poses, rows
        with self.assertRaises(BufferError):
            world.restore(mark)
        del inner
        world.restore(mark)

    def test_a_view_keeps_its_world(self):
        scene, _ = pile(8)
        poses = scree.World(scene, backend="cpu").tables.poses
        self.assertTrue(np.isfinite(poses["position"]).all())

    @unittest.skipUnless(scree._native.has_vulkan, "built without Vulkan")
    def test_a_device_has_no_views(self):
        scene, _ = pile(8)
        world = scree.World(scene, backend="vulkan")
        with self.assertRaises(BufferError):
            world.tables.poses


class Threads(unittest.TestCase):
    def test_other_threads_run_while_a_world_steps(self):
        scene, _ = pile(512)
        world = scree.World(scene, backend="cpu", threads=1, sleeping=False)
        counted = 0
        ready = threading.Event()

        def work():
            ready.set()
            world.step(200)

        thread = threading.Thread(target=work)
        thread.start()
        ready.wait()
        while thread.is_alive():
            counted += 1
            time.sleep(1e-4)
        thread.join()
        self.assertGreater(counted, 20)

    def test_a_world_is_stepped_by_one_thread_at_a_time(self):
        scene, _ = pile(512)
        world = scree.World(scene, backend="cpu", threads=1, sleeping=False)
        thread = threading.Thread(target=lambda: world.step(300))
        thread.start()
        refused = 0
        while thread.is_alive():
            try:
                world.position
            except RuntimeError:
                refused += 1
        thread.join()
        self.assertGreater(refused, 0)
        self.assertEqual(world.steps, 300)

    def test_an_interrupt_ends_the_run_between_steps(self):
        code = ("import scree, sys\n"
                "s = scree.Scene(); s.add(scree.Plane()); s.add(scree.Sphere(), position=(0, 5, 0))\n"
                "w = scree.World(s, backend='cpu', sleeping=False)\n"
                "print('on', flush=True)\n"
                "try: w.step(2000000000)\n"
                "except KeyboardInterrupt: print('off', w.steps > 0, w.step() is None)\n")
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as run:
            self.assertEqual(run.stdout.readline(), "on\n")
            time.sleep(.3)
            run.send_signal(signal.SIGINT)
            self.assertEqual(run.communicate(timeout=20)[0], "off True True\n")

    def test_an_interrupt_is_heard_during_a_long_step(self):
        code = ("import scree, time\n"
                "w = scree.World(scree.demo('pile', 20000), backend='cpu', threads=1, substeps=64, sleeping=False)\n"
                "print('on', flush=True)\n"
                "try: w.step(1000)\n"
                "except KeyboardInterrupt: print('off', flush=True)\n"
                "before = w.steps; w.step(); print(w.steps == before + 1)\n")
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as run:
            self.assertEqual(run.stdout.readline(), "on\n")
            time.sleep(.5)
            begin = time.monotonic()
            run.send_signal(signal.SIGINT)
            self.assertEqual(run.stdout.readline(), "off\n")
            self.assertLess(time.monotonic() - begin, 1)
            self.assertEqual(run.communicate(timeout=300)[0], "True\n")

    def test_an_interrupt_that_nobody_handles_ends_python_during_a_long_step(self):
        code = ("import scree\n"
                "w = scree.World(scree.demo('pile', 20000), backend='cpu', threads=1, substeps=64, sleeping=False)\n"
                "print('on', flush=True)\n"
                "w.step(1000)\n")
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
            self.assertEqual(run.stdout.readline(), "on\n")
            time.sleep(.5)
            begin = time.monotonic()
            run.send_signal(signal.SIGINT)
            self.assertIn("KeyboardInterrupt", run.communicate(timeout=300)[1])
            self.assertLess(time.monotonic() - begin, 2)
            self.assertEqual(run.returncode, -signal.SIGINT)

    def test_a_bar_shows_progress(self):
        code = ("import scree\n"
                "from scree import _progress\n"
                "_progress.Bar.PATIENCE = 0\n"
                "w = scree.World(scree.demo('pile', 1000), backend='cpu')\n"
                "w.step(900, progress=True)\n")
        run = subprocess.run([sys.executable, "-c", code], stderr=subprocess.PIPE, check=True)
        self.assertIn(b"/900 steps", run.stderr)
        self.assertTrue(run.stderr.endswith(b"\r"))


if __name__ == "__main__":
    unittest.main()
