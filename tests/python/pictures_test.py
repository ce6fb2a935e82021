# Pictures from Python and on the command line: depth, ids and normals against rays, and the colours where they belong.
import os
import subprocess
import tempfile
import unittest

import numpy as np

import scree

PROGRAM = os.environ.get("SCREE_PROGRAM_PATH", "")


def assorted():
    world = scree.World(scree.demo("assortment", 60), backend="cpu")
    world.step(150)
    return world


class Channels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.world = assorted()
        cls.camera = cls.world.camera
        cls.size = (160, 120)
        cls.picture = cls.world.render(cls.camera, cls.size, channels=("depth", "body", "normal", "part"))

    def test_shapes_and_types(self):
        for name, shape, kind in (("depth", (120, 160), np.float32), ("body", (120, 160), np.int32), ("normal", (120, 160, 3), np.float32)):
            self.assertEqual(self.picture[name].shape, shape)
            self.assertEqual(self.picture[name].dtype, kind)
        self.assertIs(self.picture.depth, self.picture["depth"])
        self.assertEqual(list(self.picture), ["depth", "body", "normal", "part"])
        with self.assertRaises(AttributeError):
            self.picture.color
        self.assertGreater(len(np.unique(self.picture.body)), 5)

    def test_they_are_what_rays_meet(self):
        origins, directions = self.camera.rays(self.size)
        hits = self.world.cast_rays(origins, directions, solid=False)
        np.testing.assert_array_equal(self.picture.body, hits.body)
        np.testing.assert_array_equal(self.picture.part, hits.part)
        # numpy and the picture round a ray's direction by themselves, so normals of round shapes may differ in the last place.
        np.testing.assert_allclose(self.picture.normal, hits.normal, rtol=0, atol=5e-7)
        along = (hits.point.astype(float) - self.camera.eye) @ self.camera.forward
        seen = hits.body >= 0
        np.testing.assert_allclose(self.picture.depth[seen], along[seen], atol=1e-3)
        self.assertTrue(np.isinf(self.picture.depth[~seen]).all())

    def test_depth_gives_the_points_back(self):
        points = self.camera.points(self.picture.depth)
        origins, directions = self.camera.rays(self.size)
        hits = self.world.cast_rays(origins, directions, solid=False)
        near = (hits.body >= 0) & (hits.distance < 100)
        np.testing.assert_allclose(points[near], hits.point[near], atol=1e-3)

    def test_pinhole_and_pose_agree_with_the_pixels(self):
        points = self.camera.points(self.picture.depth)[40:80, 40:120].reshape(-1, 3)
        points = points[np.isfinite(points).all(1)]
        seen = (self.camera.world_to_camera() @ np.c_[points, np.ones(len(points))].T)[:3] * [[1], [-1], [-1]]
        pixels = self.camera.intrinsics(self.size) @ seen
        pixels = (pixels[:2] / pixels[2]).T
        np.testing.assert_allclose(pixels % 1, .5, atol=.01)

    def test_parallel_rays(self):
        camera = scree.Camera((0, 30, .001), (0, 0, 0), 40, orthographic=True)
        scene = scree.Scene()
        scene.add(scree.Plane())
        scene.add(scree.Box((2, 2, 2)), position=(0, 2, 0))
        picture = scree.World(scene, backend="cpu").render(camera, (64, 64), channels=("depth", "body"))
        np.testing.assert_allclose(picture.depth[32, 32], 26, atol=.02)
        self.assertEqual(picture.body[32, 32], 1)
        self.assertEqual(picture.body[0, 0], 0)

    def test_flow_is_the_motion_in_pixels(self):
        scene = scree.Scene(gravity=(0, 0, 0))
        scene.add(scree.Plane(offset=-3))
        scene.add(scree.Sphere(1), velocity=(3, 0, 0))
        world = scree.World(scene, backend="cpu")
        camera = scree.Camera((0, 0, 10), (0, 0, 0), 60)
        size = (200, 150)
        flow = world.render(camera, size, channels="flow", seconds_before=.1).flow
        focal = camera.intrinsics(size)[0, 0]
        np.testing.assert_allclose(flow[75, 100], (focal * .3 / 9, 0), atol=.05)
        self.assertTrue((flow[140] == 0).all())
        moved = scree.Camera((-.5, 0, 10), (-.5, 0, 0), 60)
        flow = world.render(camera, size, channels="flow", seconds_before=.1, camera_before=moved).flow
        np.testing.assert_allclose(flow[75, 100], (focal * (.3 - .5) / 9, 0), atol=.05)

    def test_wrong_channels_and_cameras(self):
        with self.assertRaises(ValueError):
            self.world.render(self.camera, (64, 48), channels=("depht",))
        with self.assertRaises(ValueError):
            self.world.render(scree.Camera((0, 0, 0), (0, 0, 0)), (64, 48), channels="depth")
        with self.assertRaises(ValueError):
            self.world.render(self.camera, (0, 48), channels="depth")
        with self.assertRaises(TypeError):
            self.world.render(self.camera, (64, 48), sample=4)


class Colours(unittest.TestCase):
    def render(self, world, *arguments, **named):
        try:
            return world.render(*arguments, **named)
        except (scree.DeviceError, ValueError) as error:
            self.skipTest(str(error))

    def test_bodies_are_where_their_ids_are(self):
        scene = scree.Scene()
        scene.add(scree.Plane())
        ids = scene.add(scree.Sphere(.9), position=[(-2.5, 1, 0), (0, 1, 0), (2.5, 1, 0)])
        world = scree.World(scene, backend="cpu")
        picture = self.render(world, scree.Camera((0, 3, 12), (0, 1, 0)), (320, 240), channels=("color", "body"), color="body")
        self.assertEqual(picture.color.shape, (240, 320, 3))
        self.assertEqual(picture.color.dtype, np.uint8)
        ground = picture.color[picture.body == 0].mean(0)
        means = [picture.color[picture.body == i].mean(0) for i in ids]
        for mean in means:
            self.assertGreater(np.abs(mean - ground).max(), 20)
        self.assertGreater(np.abs(means[0] - means[1]).max(), 20)

    def test_the_same_state_gives_the_same_pixels(self):
        world = assorted()
        first = self.render(world, size=(128, 96))
        np.testing.assert_array_equal(first.color, self.render(world, size=(128, 96)).color)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.png")
            first.save(path)
            with open(path, "rb") as file:
                self.assertTrue(file.read().startswith(b"\x89PNG"))
            scree.write_png(path, (np.nan_to_num(np.ones((4, 5))) * 1000).astype(np.uint16))
        with self.assertRaises(ValueError):
            world.render(size=(128, 96), color="taste")


@unittest.skipUnless(PROGRAM, "SCREE_PROGRAM_PATH is not set")
class CommandLine(unittest.TestCase):
    def test_channels_are_those_of_python(self):
        with tempfile.TemporaryDirectory() as folder:
            frames = os.path.join(folder, "frames")
            run = subprocess.run([PROGRAM, "run", "mix", "--bodies", "50", "--steps", "40", "--backend", "cpu", "--frames", frames, "--size",
                                  "96x64", "--camera", "still", "--channels", "depth,ids,normals,flow", "--quiet"], stderr=subprocess.PIPE, text=True,
                                 check=False)
            if "need OpenGL ES or Vulkan" in run.stderr:
                self.skipTest(run.stderr)
            self.assertIn(run.returncode, (0, 1), run.stderr)
            names = sorted(os.listdir(frames))
            count = sum(name.startswith("frame_") for name in names)
            self.assertEqual(len(names), count * 9)
            world = scree.World(scree.demo("mix", 50), backend="cpu")
            world.step(40)
            picture = world.render(world.camera, (96, 64), channels=("depth", "body", "normal"))
            # Those of the program are drawn, those of Python rays: they differ on edges, and there in few pixels.
            depth, ids, normals = (np.load(os.path.join(frames, f"{name}_{count - 1:06}.npy")) for name in ("depth", "ids", "normals"))
            self.assertLess((ids != picture.body).mean(), 0.002)
            same = (ids == picture.body) & (ids >= 0)
            self.assertLess((np.abs(depth - picture.depth)[same] > 1e-4 * depth[same]).mean(), 0.002)
            self.assertLess((np.abs(normals - picture.normal).max(axis=2)[same] > 5e-3).mean(), 0.002)
            import matplotlib.image
            levels = matplotlib.image.imread(os.path.join(frames, f"depth_{count - 1:06}.png")) * 65535
            near = np.isfinite(depth) & (depth < 60)
            np.testing.assert_allclose(levels[near], depth[near] * 1000, atol=1)

    def test_channels_need_frames(self):
        run = subprocess.run([PROGRAM, "run", "mix", "--channels", "depth"], stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(run.returncode, 2)
        self.assertIn("--frames", run.stderr)


if __name__ == "__main__":
    unittest.main()
