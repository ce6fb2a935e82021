# Animations in Blender, headless: every body where the run has it at every frame.
import json
import os
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

import scree

BLENDER = shutil.which("blender")
HERE = os.path.dirname(os.path.abspath(__file__))


@unittest.skipUnless(BLENDER, "blender is not installed (Debian: apt-get install blender)")
class Blender(unittest.TestCase):
    def judge(self, scene, steps, every=1, eye=(8, -14, 7), target=(0, 0, 1), picture=""):
        """Exports a run and has Blender compare it; returns what it measured."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.glb")
            world = scree.World(scene, backend="cpu")
            seen = [world.read("position", "orientation", "exists")]
            with world.export(path, every=every):
                for _ in range(steps // every):
                    world.step(every)
                    seen.append(world.read("position", "orientation", "exists"))
            with open(path, "rb") as file:
                data = file.read()
            length = int.from_bytes(data[12:16], "little")
            nodes = json.loads(data[20:20 + length])["nodes"]
            planes = [i for i, node in enumerate(nodes) if "ground" in node["name"] or np.allclose(seen[0]["position"][i], 0)]
            chosen = [i for i in range(len(nodes)) if i not in planes]
            for i, node in enumerate(nodes):  # names of their own, which Blender would shorten or count up
                node["name"] = f"n{i}"
            text = json.dumps(json.loads(data[20:20 + length]) | {"nodes": nodes}).encode()
            text += b" " * (-len(text) % 4)
            rest = data[20 + length:]
            with open(path, "wb") as file:
                file.write(data[:8] + (20 + len(text) + len(rest)).to_bytes(4, "little") + len(text).to_bytes(4, "little") + b"JSON" + text + rest)
            poses = os.path.join(folder, "poses.npz")
            np.savez(poses, rate=60 // every, names=[f"n{i}" for i in chosen], eye=eye, target=target, frame=len(seen) // 2,
                     **{key: np.array([one[key][chosen] for one in seen]) for key in ("position", "orientation", "exists")})
            result = os.path.join(folder, "result.json")
            run = subprocess.run([BLENDER, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                                  os.path.join(HERE, "blender_check.py"), "--", path, poses, result, picture],
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            self.assertTrue(os.path.exists(result), run.stdout[-3000:])
            with open(result, encoding="utf-8") as file:
                made = json.load(file)
        print(made)
        self.assertEqual(made["objects"], len(chosen))
        self.assertLess(made["distance"], 1e-4)
        self.assertLess(made["angle"], .05)
        self.assertEqual(made["wrong_presence"], 0)

    def test_bodies_that_fall_and_roll(self):
        self.judge(scree.demo("mix", 80), 150, picture=os.environ.get("SCREE_BLENDER_PICTURE", ""))

    def test_bodies_that_break(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        scene.add(scree.Box((.4, .2, .2)), position=(0, 6, 0), name="brick", fracture=scree.Fracture(impulse=100, pieces=5))
        self.judge(scene, 120)


if __name__ == "__main__":
    unittest.main()
