# Sweeps friction: how far boxes slide on an incline, against Coulomb's law, with a plot.
"""python3 friction_sweep.py [FILE.png]: one world, forty inclines."""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import scree

file = sys.argv[1] if len(sys.argv) > 1 else "friction_sweep.png"
SLOPE, SECONDS, GRAVITY = np.radians(25), 1.0, 9.81
friction = np.linspace(0, .8, 40)

scene = scree.Scene(gravity=(0, -GRAVITY, 0))
turn = (0, 0, np.sin(-SLOPE / 2), np.cos(-SLOPE / 2))  # downhill is +x
along, up = np.array((np.cos(SLOPE), -np.sin(SLOPE), 0)), np.array((np.sin(SLOPE), np.cos(SLOPE), 0))
lanes = np.column_stack([np.zeros(40), np.zeros(40), np.arange(40) * 1.0])
scene.add(scree.Box((10, .1, .4)), position=lanes - .1 * up, orientation=turn, motion="fixed", friction=friction)
boxes = scene.add(scree.Box((.2, .1, .2)), position=lanes - 5 * along + .1 * up, orientation=turn, friction=friction)

world = scree.World(scene, rate=120, sleeping=False)
start = world.position[boxes]
world.run(SECONDS)
slid = (world.position[boxes] - start) @ along

law = np.maximum(0, .5 * GRAVITY * (np.sin(SLOPE) - friction * np.cos(SLOPE)) * SECONDS**2)
print(f"greatest difference from Coulomb's law: {np.abs(slid - law).max():.4f} m of {law.max():.2f} m")

figure, axes = plt.subplots(figsize=(7, 4.5))
axes.plot(friction, law, color="0.6", label=r"$\frac{1}{2} g (\sin\alpha - \mu \cos\alpha) t^2$")
axes.plot(friction, slid, "o", markersize=4, color="tab:orange", label="scree")
axes.axvline(np.tan(SLOPE), color="0.8", linestyle="--")
axes.annotate(r"$\mu = \tan\alpha$", (np.tan(SLOPE), law.max() * .8), textcoords="offset points", xytext=(6, 0))
axes.set(xlabel="friction", ylabel=f"way in {SECONDS:g} s, m", title=f"Boxes on an incline of {np.degrees(SLOPE):.0f} degrees")
axes.legend(frameon=False)
figure.tight_layout()
figure.savefig(file, dpi=120)
print(file)
