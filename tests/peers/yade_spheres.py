# Steps the spheres and planes of a scene file by Yade, and prints what it took: the part of tests/peers/yade that Yade's own Python runs.
import json
import math
import os
import resource
import time

from yade import *  # noqa: F403

job = json.loads(os.environ["YADE_JOB"])
with open(job["scene"]) as file:
    scene = json.load(file)
material = O.materials.append(FrictMat(young=job["young"], poisson=0.3, frictionAngle=math.atan(job["friction"]), density=job["density"]))
spheres = []
for body in scene["bodies"]:
    if "sphere" in body["shape"]:
        spheres.append(O.bodies.append(sphere(body["position"], body["shape"]["sphere"]["radius"], material=material)))
    else:
        plane = body["shape"]["plane"]
        normal = plane.get("normal", [0, 1, 0])
        axis = [abs(part) for part in normal].index(1)
        O.bodies.append(wall(plane.get("offset", 0) * normal[axis], axis=axis, sense=normal[axis], material=material))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(gravity=(0, -9.81, 0), damping=0.2),
]
O.dt = 0.3 * PWaveTimeStep()
steps = round(job["seconds"] / O.dt)
begin = time.time()
while O.iter < steps and time.time() - begin < job["limit"]:
    O.run(min(200, steps - O.iter), True)
taken = time.time() - begin
overlaps = [contact.geom.penetrationDepth for contact in O.interactions if contact.isReal]
print(json.dumps({
    "steps": O.iter, "ms": 1000 * taken / O.iter, "simulated": O.time,
    "mean": sum(overlaps) / max(1, len(overlaps)), "greatest": max(overlaps, default=0),
    "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024,
    "height": sum(O.bodies[i].state.pos[1] for i in spheres) / len(spheres),
}))
