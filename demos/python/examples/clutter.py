# Settles clutter in a bin, and films it with depth and ids: what makers of data sets need.
"""python3 clutter.py [FOLDER]: writes colour, depth and ids of 8 views, with their cameras and every body's pose."""
import json
import pathlib
import sys

import numpy as np

import scree

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "clutter")
folder.mkdir(parents=True, exist_ok=True)
rng = np.random.default_rng(7)

scene = scree.Scene()
scene.add(scree.Plane())
for x, z, width, depth in ((-1.05, 0, .05, 1.1), (1.05, 0, .05, 1.1), (0, -1.05, 1, .05), (0, 1.05, 1, .05)):
    scene.add(scree.Box((width, .4, depth)), position=(x, .4, z), motion="fixed")


def thrown(count):
    """Positions above the bin and random orientations of that many bodies."""
    turns = rng.normal(size=(count, 4))
    places = np.column_stack([rng.uniform(-.7, .7, count), rng.uniform(.6, 5, count), rng.uniform(-.7, .7, count)])
    return {"position": places, "orientation": turns / np.linalg.norm(turns, axis=1)[:, None]}


kinds = {}
for name, shape in {"box": scree.Box((.12, .08, .16)), "can": scree.Cylinder(.08, .14), "ball": scree.Sphere(.12), "egg": scree.Ellipsoid((.08, .12, .08)),
                    "stone": scree.Hull(rng.normal(size=(24, 3)) * (.12, .08, .1)),
                    "hammer": scree.Compound([scree.Part(scree.Box((.03, .2, .03))), scree.Part(scree.Box((.1, .04, .05)), (0, .2, 0))])}.items():
    for body in scene.add(shape, **thrown(25), friction=.5, rolling_resistance=.002):
        kinds[int(body)] = name

world = scree.World(scene)
while world.time < 20 and world.statistics["asleep"] < .95 * len(kinds):
    world.run(.5)
print(f"{world.statistics['asleep']} of {len(kinds)} bodies sleep after {world.time:g} s on {world.device}")

views = []
for i in range(8):
    angle = 2 * np.pi * i / 8
    camera = scree.Camera((3 * np.sin(angle), 2.6, 3 * np.cos(angle)), (0, .25, 0), vertical_fov=40)
    size = (640, 480)
    picture = world.render(camera, size, channels=("color", "depth", "body"), color="body")
    picture.save(folder / f"color_{i}.png")
    scree.write_png(folder / f"depth_{i}.png", np.where(np.isfinite(picture.depth), picture.depth * 1000, 0).clip(0, 65535).astype(np.uint16))
    np.savez_compressed(folder / f"labels_{i}.npz", depth=picture.depth, body=picture.body)
    seen, pixels = np.unique(picture.body, return_counts=True)
    views.append({"world_to_camera": camera.world_to_camera().tolist(), "intrinsics": camera.intrinsics(size).tolist(),
                  "pixels": {int(body): int(count) for body, count in zip(seen, pixels) if body in kinds}})
state = world.read("position", "orientation")
poses = {body: {"kind": kind, "position": state["position"][body].tolist(), "orientation": state["orientation"][body].tolist()}
         for body, kind in kinds.items()}
(folder / "scene.json").write_text(json.dumps({"state_hash": world.state_hash(), "views": views, "bodies": poses}, indent=1), encoding="utf-8")
print(f"{folder}: 8 views of {len(poses)} bodies; state {world.state_hash()}")
