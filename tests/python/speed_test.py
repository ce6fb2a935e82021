# What Python costs: bulk transfers, a step's overhead, and memory over a thousand worlds.
import gc
import time
import unittest

import numpy as np

import scree


def best(work, rounds=15):
    """Milliseconds of the fastest round: what the machine is busy with besides does not count."""
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return 1e3 * min(times)


def resident():
    """Resident memory of this process, bytes."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096


def looping():
    total = 0
    for i in range(100000):
        total += i
    return total


class Speed(unittest.TestCase):
    """Limits are parts of what this processor takes for 100,000 turns of a loop."""

    @classmethod
    def setUpClass(cls):
        cls.loop = best(looping)
        print(f"100,000 turns of a loop: {cls.loop:.2f} ms")
        scene = scree.Scene(gravity=(0, 0, 0))
        grid = np.arange(10000)
        place = np.stack([grid % 22 * 2.0, grid // 22 % 22 * 2.0, grid // 484 * 2.0], 1)
        cls.ids = scene.add(scree.Box(), position=place)
        cls.world = scree.World(scene, backend="cpu")
        cls.world.step(2)

    def test_setting_ten_thousand_bodies_takes_less_than_two_and_a_half_loops(self):
        position, velocity = self.world.position, self.world.velocity
        took = best(lambda: self.world.set(self.ids, position=position, velocity=velocity))
        print(f"set of 10,000 positions and velocities: {took:.2f} ms")
        self.assertLess(took, 2.5 * self.loop)

    def test_reading_ten_thousand_positions_takes_less_than_half_a_loop(self):
        took = best(lambda: self.world.position)
        print(f"read of 10,000 positions: {took:.3f} ms")
        self.assertLess(took, self.loop / 2)

    def test_a_step_costs_little_more_than_in_the_library(self):
        scene = scree.Scene()
        scene.add(scree.Sphere(), gravity_scale=0.0)
        world = scree.World(scene, backend="cpu", threads=1, sleeping=False)
        steps = 1000

        def one_by_one():
            for _ in range(steps):
                world.step()

        world.step(steps)
        inside, outside = best(lambda: world.step(steps)), best(one_by_one)
        print(f"a step: {1e3 * inside / steps:.2f} us in the library, {1e3 * (outside - inside) / steps:.2f} us more from Python")
        self.assertLess((outside - inside) / steps, self.loop / 100)


class Memory(unittest.TestCase):
    def test_a_thousand_worlds_leave_nothing_behind(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        scene.add(scree.Box(), position=[(0, i, 0) for i in range(20)])
        scene.add(scree.Hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]), position=(3, 2, 0))

        def live():
            world = scree.World(scene, backend="cpu", threads=1)
            world.step(2)
            mark = world.save()
            world.tables.poses["position"].sum()
            world.restore(mark)
            world.contacts()
            world.render(size=(16, 12), channels="depth")

        for _ in range(100):
            live()
        gc.collect()
        before = resident()
        for _ in range(1000):
            live()
        gc.collect()
        grown = resident() - before
        print(f"1,000 worlds: {grown / 1e6:.2f} MB more")
        self.assertLess(grown, 4e6)


if __name__ == "__main__":
    unittest.main()
