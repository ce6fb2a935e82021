# Throws a ball at a wall of bricks that break, films it, and exports it to Blender.
"""python3 breaking_wall.py [FOLDER]: frames in FOLDER, wall.glb for Blender, and rubble.json for scree view."""
import pathlib
import sys

import numpy as np

import scree

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "breaking_wall")
folder.mkdir(parents=True, exist_ok=True)

scene = scree.Scene()
scene.add(scree.Plane())
half = np.array((.3, .15, .15))
rows, columns = 12, 10
places = [((column - columns / 2 + .5 * (row % 2)) * 2 * half[0], half[1] * (2 * row + 1), 0) for row in range(rows) for column in range(columns)]
bricks = scene.add(scree.Box(half), position=places, density=1800, friction=.7, name="brick",
                   fracture=scree.Fracture(impulse=900, cutting="voronoi", pieces=7, seed=4))
ball = scene.add(scree.Sphere(.45), position=(-.6, 1.6, 7), velocity=(0, 2.5, -22), density=5000, name="ball")

world = scree.World(scene, events=True)
camera = scree.Camera((6, 3.2, 7), (0, 1.4, -1), 45)
animation = world.export(folder / "wall.glb")
frames, broken = 0, 0
for frame in range(60):
    world.step(2)
    events = world.events()
    broken += int((events.kind == scree.EventKind.body_broke).sum())
    caption = f"{world.time:.2f} s, {broken} bricks broken"
    world.render(camera, (960, 540), color="speed", color_range=(0, 12), legend=True, caption=caption).save(folder / f"frame_{frame:06}.png")
    frames += 1

animation.close()
standing = np.linalg.norm(world.position[bricks] - np.asarray(places), axis=1) < .05
print(f"{frames} frames in {folder}: {broken} of {len(bricks)} bricks broke, {int((standing & world.exists[bricks]).sum())} stand")
world.snapshot().save(folder / "rubble.json")
