# The Python package scree.
"""scree: a rigid body simulator with the same bits on every GPU and on the CPU.

    scene = scree.Scene()
    scene.add(scree.Plane())
    boxes = scene.add(scree.Box(), position=[[0, 0.5 + 1.01 * i, 0] for i in range(10)])
    world = scree.World(scene)
    world.step(120)
    print(world.position[boxes[-1]], world.state_hash())

Lengths in m, times in s, masses in kg, angles in rad; y is up. Arrays are in the order of ids.
"""
from scree import _native
from scree._errors import CheckpointError, DeviceError, SceneError
from scree._native import version as __version__
from scree.camera import Camera, Picture, write_png
from scree.joints import Axis, Ball, ConeTwist, Coupling, Distance, Fixed, Hinge, JointKind, Limits, Motor, SixDof, Slider, Spring
from scree.measures import Measures, MeasureTable
from scree.recording import Recording, View
from scree.scene import Scene, demo, demos, from_json, load, schema
from scree.shapes import (Box, Capsule, Compound, Cone, Cylinder, Decompose, Ellipsoid, Filter, FilterGroups, Fracture, HeightField, Hull, Mesh, Part, Plane,
                          Shape, Sphere, Tyre)
from scree.world import DebugDrawing, EventKind, Export, Tables, World

__all__ = ["Axis", "Ball", "Box", "Camera", "Capsule", "CheckpointError", "Compound", "Cone", "ConeTwist", "Coupling", "Cylinder", "DebugDrawing", "Decompose", "DeviceError",
           "Distance", "Ellipsoid", "EventKind", "Export", "Filter", "FilterGroups", "Fixed", "Fracture", "HeightField", "Hinge", "Hull", "JointKind", "Limits",
           "MeasureTable", "Measures", "Mesh", "Motor", "Part", "Picture", "Plane", "Recording", "Scene", "SceneError", "Shape", "SixDof", "Slider", "Sphere", "Spring", "Tables",
           "Tyre", "View", "World", "__version__", "demo", "demos", "from_json", "load", "schema", "write_png"]
