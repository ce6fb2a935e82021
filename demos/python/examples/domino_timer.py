# A run of dominoes, timed by ray gates, as in a laboratory: how fast does the wave go?
"""python3 domino_timer.py [FOLDER]: prints the wave's speed between gates, for three spacings, and writes a picture."""
import pathlib
import sys

import numpy as np

import scree

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
folder.mkdir(parents=True, exist_ok=True)
COUNT, HEIGHT, THICK = 60, .5, .06


def run(spacing):
    """Times at which each gate, a ray across the run just above lying dominoes, was crossed: (gates,), s."""
    scene = scree.Scene()
    scene.add(scree.Plane(), friction=.6)
    x = np.arange(COUNT) * spacing
    tiles = scene.add(scree.Box((THICK / 2, HEIGHT / 2, .12)), position=np.column_stack([x, np.full(COUNT, HEIGHT / 2), np.zeros(COUNT)]),
                      density=700, friction=.4)
    world = scree.World(scene, rate=240, substeps=8)
    # A gate looks at the front of every tenth tile, near its top, from the side: the ray is free, then blocked.
    gates = tiles[10::10]
    origins = np.column_stack([x[10::10] + THICK, np.full(len(gates), HEIGHT * .9), np.full(len(gates), -1.0)])
    times = np.full(len(gates), np.nan)
    world.apply(tiles[0], impulse=(3, 0, 0), offset=(0, HEIGHT * .4, 0))
    while world.time < 20 and np.isnan(times).any():
        world.step()
        blocked = world.rays_hit(origins, (0, 0, 1), 2.0)
        times[np.isnan(times) & blocked] = world.time
        if len(gates) // 2 == np.isfinite(times).sum() and not (folder / f"dominoes_{spacing:g}.png").exists():
            middle = x[COUNT // 2]
            world.render(scree.Camera((middle + 2, 2.2, 5), (middle, .2, 0), 40), (960, 540), color="speed", color_range=(0, 3),
                         legend=True, caption=f"dominoes {spacing:g} m apart after {world.time:.2f} s").save(folder / f"dominoes_{spacing:g}.png")
    return times


for spacing in (.15, .22, .3):
    times = run(spacing)
    speeds = 10 * spacing / np.diff(times)
    print(f"spacing {spacing:.2f} m: gates at {np.array2string(times, precision=3)} s; "
          f"the wave runs at {speeds.mean():.2f} m/s, within {np.ptp(speeds) / 2:.2f}")
