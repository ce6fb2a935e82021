# Animations: a .glb read by the specification, its interpolated poses against the run's, and what assimp says of it.
import json
import os
import shutil
import struct
import subprocess
import tempfile
import unittest

import numpy as np

import scree

PROGRAM = os.environ.get("SCREE_PROGRAM_PATH", "")
TYPES = {5126: np.float32, 5122: np.int16}
WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


class Glb:
    """A .glb file, as a viewer reads it."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        magic, version, length, json_length, kind = struct.unpack("<5I", data[:20])
        assert (magic, version, length, kind) == (0x46546C67, 2, len(data), 0x4E4F534A)
        self.tree = json.loads(data[20:20 + json_length])
        binary_length, kind = struct.unpack("<2I", data[20 + json_length:28 + json_length])
        assert kind == 0x004E4942 and json_length % 4 == 0 and binary_length % 4 == 0
        self.binary = data[28 + json_length:]
        assert len(self.binary) == binary_length == self.tree["buffers"][0]["byteLength"]
        self.size = len(data)

    def array(self, accessor):
        one = self.tree["accessors"][accessor]
        view = self.tree["bufferViews"][one["bufferView"]]
        width = WIDTHS[one["type"]]
        offset = view.get("byteOffset", 0) + one.get("byteOffset", 0)
        kind = np.dtype(TYPES[one["componentType"]])
        assert offset + one["count"] * width * kind.itemsize <= view.get("byteOffset", 0) + view["byteLength"]
        values = np.frombuffer(self.binary, kind, one["count"] * width, offset).reshape(-1, width)
        return np.maximum(values / 32767, -1) if one.get("normalized") else values

    def poses(self, node, times):
        """translation, rotation and scale of a node at each time."""
        made = {key: np.tile(self.tree["nodes"][node][key], (len(times), 1)).astype(float) for key in ("translation", "rotation", "scale")}
        for channel in self.tree.get("animations", [{"channels": []}])[0]["channels"]:
            if channel["target"]["node"] != node:
                continue
            sampler = self.tree["animations"][0]["samplers"][channel["sampler"]]
            at, values = self.array(sampler["input"])[:, 0], self.array(sampler["output"]).astype(float)
            assert (np.diff(at) > 0).all()
            k = np.clip(np.searchsorted(at, times, side="right") - 1, 0, len(at) - 1)
            after = np.minimum(k + 1, len(at) - 1)
            if sampler["interpolation"] == "STEP":
                made[channel["target"]["path"]] = values[k]
                continue
            part = np.where(after > k, (times - at[k]) / np.maximum(at[after] - at[k], 1e-9), 0)[:, None].clip(0, 1)
            if channel["target"]["path"] == "rotation":
                made["rotation"] = slerp(values[k], values[after], part)
            else:
                made["translation"] = values[k] + (values[after] - values[k]) * part
        return made


def slerp(a, b, part):
    cosine = (a * b).sum(1, keepdims=True)
    b = np.where(cosine < 0, -b, b)
    angle = np.arccos(np.clip(np.abs(cosine), 0, 1))
    sine = np.sin(angle)
    near = sine < 1e-6
    sine = np.where(near, 1, sine)
    made = np.where(near, a + (b - a) * part, (np.sin((1 - part) * angle) * a + np.sin(part * angle) * b) / sine)
    return made / np.linalg.norm(made, axis=1, keepdims=True)


class Animations(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "run.glb")

    def follow(self, world, steps):
        """Records a run here and in the file; returns both."""
        seen = [world.read("position", "orientation", "exists")]
        with world.export(self.path):
            for _ in range(steps):
                world.step()
                seen.append(world.read("position", "orientation", "exists"))
        return seen, Glb(self.path)

    def compare(self, seen, file, rate=60):
        times = (np.arange(len(seen)) / rate).astype(np.float32)  # as the file has them
        worst = worst_turn = 0
        for body in range(len(file.tree["nodes"])):
            poses = file.poses(body, times)
            exists = np.array([one["exists"][body] for one in seen])
            np.testing.assert_array_equal(poses["scale"].any(1), exists)
            if not exists.any():
                continue
            place = np.array([one["position"][body] for one in seen])[exists]
            turn = np.array([one["orientation"][body] for one in seen])[exists]
            if body == 0 and np.allclose(place, 0):
                continue  # the ground plane
            worst = max(worst, np.linalg.norm(poses["translation"][exists] - place, axis=1).max())
            turn = turn / np.linalg.norm(turn, axis=1, keepdims=True)
            apart = [np.linalg.norm(poses["rotation"][exists] - side * turn, axis=1) for side in (1, -1)]
            worst_turn = max(worst_turn, 2 * np.minimum(*apart).max())
        self.assertLess(worst, 1e-4)
        self.assertLess(np.degrees(worst_turn), .05)

    def test_interpolated_poses_are_the_runs(self):
        world = scree.World(scree.demo("mix", 80), backend="cpu")
        seen, file = self.follow(world, 150)
        self.compare(seen, file)
        keys = sum(len(file.array(sampler["input"])) for sampler in file.tree["animations"][0]["samplers"])
        self.assertLess(keys, .8 * 2 * 80 * 150)

    def test_fragments_appear_when_their_body_breaks(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        scene.add(scree.Box((.4, .2, .2)), position=(0, 6, 0), name="brick", fracture=scree.Fracture(impulse=100, pieces=5))
        world = scree.World(scene, backend="cpu")
        seen, file = self.follow(world, 120)
        self.assertFalse(seen[-1]["exists"][1])
        self.compare(seen, file)
        self.assertEqual(file.tree["nodes"][1]["name"], "brick")

    def test_two_thousand_bodies_and_three_hundred_frames_are_small(self):
        world = scree.World(scree.demo("mix", 2000), backend="cpu")
        with world.export(self.path, every=2):
            world.step(600)
        print(f"2,000 bodies, 300 frames: {os.path.getsize(self.path) / 1e6:.1f} MB")
        self.assertLess(os.path.getsize(self.path), 40e6)

    def test_shapes_are_closed_and_face_outwards(self):
        scene = scree.Scene(gravity=(0, 0, 0))
        shapes = [scree.Sphere(.4), scree.Capsule(.2, .3), scree.Box((.3, .2, .1)), scree.Cylinder(.3, .2), scree.Cone(.3, .5),
                  scree.Ellipsoid((.3, .2, .4)), scree.Hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]),
                  scree.Compound([scree.Part(scree.Box((.5, .1, .1))), scree.Part(scree.Sphere(.2), (0, 1, 0))])]
        volumes = [4 / 3 * np.pi * .064, np.pi * .04 * .6 + 4 / 3 * np.pi * .008, 8 * .006, np.pi * .09 * .4, np.pi * .09 * .5 / 3,
                   4 / 3 * np.pi * .024, 1 / 6, 8 * .005 + 4 / 3 * np.pi * .008]
        for i, shape in enumerate(shapes):
            scene.add(shape, position=(3 * i, 0, 0))
        world = scree.World(scene, backend="cpu")
        world.export(self.path).close()
        file = Glb(self.path)
        self.assertNotIn("animations", file.tree)
        for i, volume in enumerate(volumes):
            node = file.tree["nodes"][i]
            attributes = file.tree["meshes"][node["mesh"]]["primitives"][0]["attributes"]
            points = (file.array(attributes["POSITION"]) * node["scale"]).reshape(-1, 3, 3)
            normals = file.array(attributes["NORMAL"]).reshape(-1, 3, 3)
            inside = np.einsum("ij,ij->i", points[:, 0], np.cross(points[:, 1], points[:, 2])).sum() / 6
            self.assertAlmostEqual(inside / volume, 1, delta=.06, msg=str(shapes[i]))
            faces = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
            large = np.linalg.norm(faces, axis=1) > 1e-9
            self.assertTrue(((faces[:, None] * normals / np.asarray(node["scale"])).sum(2)[large] > 0).all(), shapes[i])

    def test_the_last_line_of_a_script_suffices(self):
        world = scree.World(scree.demo("mix", 20), backend="cpu")
        world.step(30)
        world.export(self.path)
        first = Glb(self.path)
        np.testing.assert_allclose(first.tree["nodes"][5]["translation"], world.position[5], atol=1e-6)
        self.assertNotIn("animations", first.tree)
        world.step(20)
        del world
        self.assertIn("animations", Glb(self.path).tree)
        with self.assertRaises(ValueError):
            scree.World(scree.demo("mix", 20), backend="cpu").export("run.fbx")
        with self.assertRaises(OSError):
            scree.World(scree.demo("mix", 20), backend="cpu").export("/nowhere/run.glb")

    def test_value_clips_are_files_of_their_own(self):
        path = os.path.join(self.folder.name, "run.usda")
        world = scree.World(scree.demo("mix", 20), backend="cpu")
        with world.export(path, every=2, clips=5):
            world.step(20)
        self.assertEqual(sorted(os.listdir(path + ".clips")), ["clip.000000.usda", "clip.000001.usda", "clip.000002.usda", "manifest.usda"])
        with open(path, encoding="utf-8") as file:
            self.assertIn("double2[] active = [(0, 0), (10, 1), (20, 2)]", file.read())
        for wrong in ({"path": self.path, "clips": 5}, {"path": path, "clips": -1}):
            with self.assertRaises(ValueError):
                world.export(**wrong)

    @unittest.skipUnless(PROGRAM, "SCREE_PROGRAM_PATH is not set")
    def test_the_program_writes_it_and_assimp_reads_it(self):
        run = subprocess.run([PROGRAM, "run", "wrecking", "--steps", "90", "--backend", "cpu", "--quiet", "--export", self.path, "--export-every", "2"],
                             stderr=subprocess.PIPE, text=True, check=False)
        self.assertIn(run.returncode, (0, 1), run.stderr)
        file = Glb(self.path)
        self.assertEqual(file.tree["asset"]["version"], "2.0")
        world = scree.World(scree.demo("wrecking"), backend="cpu")
        seen = [world.read("position", "orientation", "exists")]
        for _ in range(45):
            world.step(2)
            seen.append(world.read("position", "orientation", "exists"))
        self.assertEqual(len(file.tree["nodes"]), len(world))
        if shutil.which("assimp"):
            told = subprocess.run(["assimp", "info", self.path], stdout=subprocess.PIPE, text=True, check=True).stdout
            self.assertIn("Animations:         1", told)


if __name__ == "__main__":
    unittest.main()
