# Many copies of a scene at once.
import numpy as np
import pytest

import scree


def boxes(height=2.0):
    scene = scree.Scene()
    scene.add(scree.Plane())
    scene.add(scree.Box((0.5, 0.5, 0.5)), position=[(0.1 * i, height + 1.2 * i, 0) for i in range(4)])
    return scene


def test_every_copy_has_the_bits_of_the_scene_alone_and_arrays_have_an_axis_of_copies():
    alone, world = scree.World(boxes(), backend="cpu"), scree.World(boxes(), backend="cpu", copies=6)
    assert world.copies == 6 and world.position.shape == (6, 5, 3) and world.asleep.shape == (6, 5)
    world.apply(world.ids([2, 3], [4]), impulse=(900, 0, 0))
    alone.step(50)
    world.step(50)
    same = [hash == alone.state_hash() for hash in world.state_hashes()]
    assert same == [True, True, True, True, False, True]
    assert np.array_equal(world.position[1], alone.position)
    world.reset([4])
    assert np.array_equal(world.position[4], scree.World(boxes(), backend="cpu").position)
    assert np.array_equal(world.position[3], alone.position)
    world.reset()
    world.step(50)
    assert set(world.state_hashes()) == {alone.state_hash()}


def test_poses_gravity_and_scenes_of_copies():
    world = scree.World([boxes(2), boxes(3), boxes(4)], backend="cpu")
    assert list(world.position[:, 1, 1]) == [2, 3, 4]
    heights = np.zeros((3, 4, 3))
    heights[:, :, 1] = 5 + np.arange(4) * 1.2
    world.set(world.ids(range(1, 5)), position=heights, velocity=(0, 1, 0))
    assert np.allclose(world.position[:, 1:], heights) and np.allclose(world.velocity[:, 1:], (0, 1, 0))
    world.set_gravity_of(1, (0, 0, 0))
    world.step(10)
    assert world.velocity[1, 1, 1] == pytest.approx(1) and world.velocity[0, 1, 1] < 0.1
    assert world.gravity_of(1) == (0, 0, 0) and world.statistics_of(1)["bodies"] == 5
    hits = world.cast_rays([(0, 50, 0)] * 3, (0, -1, 0), copy=[0, 1, 2])
    assert list(hits.body) == list(world.ids([4])[:, 0])
    assert len(world.snapshot(2)) == 5


def test_what_copies_cannot_do_is_refused():
    with pytest.raises(ValueError, match="at least 1"):
        scree.World(boxes(), backend="cpu", copies=0)
    with pytest.raises(ValueError, match="2 scenes"):
        scree.World([boxes(), boxes()], backend="cpu", copies=3)
    world = scree.World(boxes(), backend="cpu", copies=2)
    with pytest.raises(RuntimeError, match="2 copies of its scene"):
        world.add(scree.Sphere(1.0))
    with pytest.raises(IndexError, match="copy 2 of 2"):
        world.ids(copies=[2])
    with pytest.raises(ValueError, match="a mask of the shape"):
        world.reset(np.zeros(3, dtype=bool))
