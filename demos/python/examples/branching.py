# Exact branching: saves a state, tries ten throws from it, keeps the best, and goes on with the same bits.
"""python3 branching.py [FILE.png]: a planner that knocks a can off a tower and leaves the tower standing."""
import sys

import numpy as np

import scree

scene = scree.Scene()
scene.add(scree.Plane())
tower = scene.add(scree.Box((.25, .25, .25)), position=[(0, .25 + .5 * i, 0) for i in range(5)], density=500)
can = scene.add(scree.Cylinder(.1, .15), position=(0, 2.65, 0), density=300)
ball = scene.add(scree.Sphere(.15), position=(-4, 2, 0), density=1500, gravity_scale=0.0)  # waits in the air

world = scree.World(scene)
world.run(1)
rest = world.position
mark = world.save()


def outcome(height):
    """Throws the ball from the saved state: whether the can is down, how far the tower has moved, m, and the state's name."""
    world.restore(mark)
    world.set(ball, position=(-4, height, 0), velocity=(9, 0, 0))
    world.run(3)
    now = world.position
    return bool(now[can, 1] < 2.3), float(np.linalg.norm((now - rest)[tower], axis=1).max()), world.state_hash()


tries = {}
for height in np.linspace(1.6, 3.0, 10):
    down, moved, state = tries[height] = outcome(height)
    print(f"thrown at {height:.2f} m: the can {'falls' if down else 'stays'}, the tower moves by {moved:5.3f} m, state {state}")

best = min((height for height, (down, _, _) in tries.items() if down), key=lambda height: tries[height][1])
assert outcome(best) == tries[best], "a branch that is taken again gives the same bits"
print(f"kept: {best:.2f} m, state {world.state_hash()}, as tried")
if len(sys.argv) > 1:
    world.render(scree.Camera((3.5, 2.5, 6), (0, 1.4, 0)), (800, 600), color="body", caption=f"kept: thrown at {best:.2f} m").save(sys.argv[1])
