# Runs in Blender: opens a .glb and compares every object at every frame with the run's poses.
import json
import sys

import bpy
import mathutils
import numpy as np

np.bool = bool  # the importer of Debian's Blender 3.4 says np.bool, which Debian's numpy 1.24 has no more
path, poses, result, picture = sys.argv[sys.argv.index("--") + 1:]
run = np.load(poses)
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = int(run["rate"])
bpy.ops.import_scene.gltf(filepath=path)
objects = [next(o for o in bpy.data.objects if o.name == name) for name in run["names"]]
upright = mathutils.Matrix.Rotation(np.pi / 2, 4, "X")  # glTF has y up, Blender z, in meshes too

distance = angle = 0.0
wrong_presence = 0
for frame in range(len(run["position"])):
    scene.frame_set(frame)
    for body, thing in enumerate(objects):
        place, turn, size = thing.matrix_world.decompose()
        exists = bool(run["exists"][frame, body])
        wrong_presence += (max(abs(s) for s in size) > 1e-3) != exists
        if not exists:
            continue
        q = run["orientation"][frame, body]
        expected = upright @ mathutils.Matrix.LocRotScale(mathutils.Vector(run["position"][frame, body]),
                                                          mathutils.Quaternion((q[3], q[0], q[1], q[2])), None) @ upright.inverted()
        distance = max(distance, (place - expected.translation).length)
        away = turn.rotation_difference(expected.to_quaternion())
        angle = max(angle, 2 * np.arcsin(min(1.0, np.linalg.norm((away.x, away.y, away.z)))))

if picture:
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = mathutils.Vector(run["eye"])
    camera.rotation_euler = (mathutils.Vector(run["target"]) - camera.location).to_track_quat("-Z", "Y").to_euler()
    light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    light.data.energy = 3
    light.rotation_euler = (.6, .3, 0)
    for thing in (camera, light):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("world")
    scene.world.color = (.5, .5, .5)
    scene.frame_set(int(run["frame"]))
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 8
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = 480, 320
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)

with open(result, "w", encoding="utf-8") as file:
    json.dump({"distance": distance, "angle": float(np.degrees(angle)), "wrong_presence": int(wrong_presence),
               "objects": len(objects), "materials": len(bpy.data.materials)}, file)
