#!/usr/bin/env python3
# Scenes at the ends of all documented ranges, through the Python module, on the CPU.
#
#     PYTHONPATH=build/release/python tests/fuzz/extremes.py [--scenes 20000] [--seed 1] [--compare PROGRAM --share 100] [--findings DIR]
#
# A scene is a small demo or a heap of random shapes and joints, of which some values become the ends of their ranges in the schema,
# and some keys that it leaves out are added. What must hold of each that the checker accepts: 20 steps take at most 10 s of the
# processor for every hundred bodies, fragments included, no body goes into quarantine, and all values are finite; of one in SHARE,
# also that the device has the CPU's bits. Findings are kept; the exit status is 1 if there are any.

import argparse
import copy
import json
import math
import pathlib
import random
import resource
import signal
import subprocess
import sys
import time

STEPS, SECONDS = 20, 10.0
CHUNK = 200  # scenes of one process
MOST_BODIES = 400
DEMOS = {"rest": 0, "seesaw": 0, "slopes": 0, "cradle": 0, "chain": 0, "bridge": 0, "pendulums": 0, "machine": 0, "glass": 0, "assortment": 12,
         "mix": 27, "terrain": 8, "shatter": 6, "compounds": 0, "solids": 0, "drive": 0, "ragdolls": 11, "turntable": 0, "wrecking": 0, "wall": 0}
SLOW = {"drive", "shatter", "wrecking", "wall"}


class TooSlow(Exception):
    pass


def ranges_of(schema):
    """By key: the ends of its ranges, wherever the schema has it."""
    found = {}

    def visit(key, value):
        if isinstance(value, list):
            for item in value:
                visit(key, item)
        if not isinstance(value, dict):
            return
        if value.get("type") in ("number", "integer") and key:
            low = value.get("minimum", value.get("exclusiveMinimum", -1e6))
            high = value.get("maximum", value.get("exclusiveMaximum", 1e12))
            found.setdefault(key, set()).add((low, high, "exclusiveMinimum" in value, value["type"] == "integer"))
        for name, item in value.items():
            if name == "properties":
                for own, one in item.items():
                    visit(own, one)
            else:
                visit(key, item)

    visit("", schema)
    return {key: sorted(found[key]) for key in sorted(found)}


def end_of(rng, ranges):
    low, high, open_low, whole = rng.choice(ranges)
    least = low if not open_low else low + (1 if whole else 1e-6 * max(1, abs(low)))
    value = rng.choice([least, high, high, least + (high - least) * rng.random(), 0 if low <= 0 <= high else least,
                        math.copysign(math.exp(rng.uniform(math.log(1e-6), math.log(max(abs(high), 1e-5)))), rng.choice([high, least, 1]) or 1)])
    value = min(max(value, least), high)
    return int(value) if whole else value


def places(value, path=()):
    yield path, value
    if isinstance(value, dict):
        for key, item in value.items():
            yield from places(item, path + (key,))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from places(item, path + (index,))


def put(root, path, value):
    for key in path[:-1]:
        root = root[key]
    root[path[-1]] = value


def key_of(path):
    return next((key for key in reversed(path) if isinstance(key, str)), "")


def axis(rng, ranges):
    made = {}
    kind = rng.randrange(6)
    if kind == 0:
        return {"locked": True}
    if kind == 1:
        low, high = sorted(rng.uniform(-1, 1) for _ in range(2))
        made["limits"] = {"lower": low, "upper": high}
    if kind in (2, 3):
        made["spring"] = {key: end_of(rng, ranges[key]) for key in ("stiffness", "damping", "rest")}
    if kind in (3, 4):
        made["motor"] = {"speed": end_of(rng, [(-1e4, 1e4, False, False)]), "max_force": 10.0 ** rng.uniform(-3, 12)}
    elif kind == 5:
        made["friction"] = 10.0 ** rng.uniform(-3, 12)
    return made


def joint(rng, ranges, bodies):
    kind = rng.choice(["ball", "hinge", "slider", "fixed", "distance", "cone_twist", "six_degrees"])
    value = {"ball": lambda: {"friction": 10.0 ** rng.uniform(-3, 12)}, "hinge": lambda: axis(rng, ranges), "slider": lambda: axis(rng, ranges),
             "fixed": dict, "distance": lambda: {"greatest": 10.0 ** rng.uniform(-3, 3)},
             "cone_twist": lambda: {"swing": rng.uniform(0, 3.1), "twist": {"lower": -rng.random(), "upper": rng.random()}},
             "six_degrees": lambda: {name: axis(rng, ranges) for name in ("x", "y", "z", "twist", "swing_y", "swing_z") if rng.random() < 0.7}}
    made = {"kind": {kind: value[kind]()}, "a": rng.randrange(bodies)}
    if rng.random() < 0.8:
        made["b"] = rng.randrange(bodies)
    for anchor in ("anchor_a", "anchor_b"):
        if rng.random() < 0.5:
            made[anchor] = [rng.uniform(-1, 1) * 10 ** rng.choice([-2, 0, 0, 2, 5]) for _ in range(3)]
    return made


def size(rng):
    return 10 ** rng.choice([rng.uniform(-2.9, 2), rng.uniform(-1, 0), rng.uniform(-1, 0)])


def shape(rng):
    kind = rng.choice(["box", "sphere", "capsule", "cylinder", "cone", "ellipsoid", "hull"])
    if kind == "box":
        return {"box": {"half_extents": [size(rng) for _ in range(3)]}}
    if kind == "sphere":
        return {"sphere": {"radius": size(rng)}}
    if kind == "cone":
        return {"cone": {"radius": size(rng), "height": size(rng)}}
    if kind == "ellipsoid":
        return {"ellipsoid": {"radii": [size(rng) for _ in range(3)]}}
    if kind == "hull":
        scale = [size(rng) for _ in range(3)]
        return {"hull": {"points": [[rng.uniform(-1, 1) * one for one in scale] for _ in range(rng.randrange(4, 12))]}}
    return {kind: {"radius": size(rng), "half_height": size(rng)}}


def mesh(rng):
    side = rng.randrange(2, 9)
    scale = 10 ** rng.uniform(-1, 2)
    vertices = [[scale * (x - side / 2), scale * rng.uniform(-.3, .3), scale * (z - side / 2)] for z in range(side + 1) for x in range(side + 1)]
    triangles = []
    for z in range(side):
        for x in range(side):
            k = z * (side + 1) + x
            triangles += [[k, k + side + 1, k + 1], [k + 1, k + side + 1, k + side + 2]]
    return {"mesh": {"vertices": vertices, "triangles": triangles}}


def heap(rng, ranges):
    bodies = [{"motion": "fixed", "shape": rng.choice([lambda: {"plane": {"normal": [0, 1, 0], "offset": 0}}, lambda: mesh(rng)])()}]
    span = 10 ** rng.uniform(-1, 1)
    for _ in range(rng.choice([2, 5, 10, 30, 90])):
        body = {"shape": shape(rng), "position": [rng.uniform(-span, span), rng.uniform(0, 2 * span), rng.uniform(-span, span)]}
        if rng.random() < 0.1:
            body["fracture"] = {"impulse": 10.0 ** rng.uniform(-6, 6), "pieces": rng.randrange(2, 20)}
        bodies.append(body)
    made = {"bodies": bodies}
    if rng.random() < 0.5:
        made["joints"] = [joint(rng, ranges, len(bodies)) for _ in range(rng.randrange(1, 12))]
    return made


EXTRAS = {"velocity": 3, "angular_velocity": 3, "gravity_scale": 1, "density": 1, "friction": 1, "restitution": 1, "rolling_resistance": 1,
          "spinning_resistance": 1, "cohesion": 1, "cohesion_range": 1, "static_friction": 1, "linear_damping": 1, "angular_damping": 1, "surface_velocity": 3}


def scene_of(rng, demos, ranges):
    root = heap(rng, ranges) if rng.random() < 0.5 else copy.deepcopy(demos[rng.choice([name for name in demos if name not in SLOW or rng.random() < .3])])
    if rng.random() < 0.5:
        root["gravity"] = [rng.choice([0, 0, -9.81, 9810, -9810, 1e4, -1e4]) for _ in range(3)]
    bodies = [body for body in root["bodies"] if body.get("motion") != "fixed"]
    for key in rng.sample(sorted(EXTRAS), rng.choice([0, 1, 2])):
        for body in rng.sample(bodies, max(1, int(len(bodies) * rng.choice([0, .2, 1])))) if bodies else []:
            values = [end_of(rng, ranges.get(key, [(-1e4, 1e4, False, False)])) for _ in range(3)]
            body[key] = values if EXTRAS[key] == 3 else values[0]
    if rng.random() < 0.3 and len(root["bodies"]) > 1:
        root.setdefault("joints", []).append(joint(rng, ranges, len(root["bodies"])))
    numbers = [path for path, value in places(root) if isinstance(value, (int, float)) and not isinstance(value, bool) and key_of(path) in ranges
               and key_of(path) not in ("a", "b", "gravity", "normal", "orientation", "group", "category", "mask", "seed", "version")]
    for path in rng.sample(numbers, min(len(numbers), rng.choice([0, 0, 1, 2, 4]))):
        put(root, path, end_of(rng, ranges[key_of(path)]))
    if rng.random() < 0.2:
        root["settings"] = {"rate": rng.choice([10, 60, 240, 1000]), "substeps": rng.choice([1, 4, 8, 64])}
    return root


def too_slow(*_):
    raise TooSlow


def judged(scree, text):
    """(accepted, bodies, seconds, None or what is wrong)."""
    import numpy as np
    try:
        scene = scree.from_json(text)
        begin = time.process_time()
        world = scree.World(scene, backend="cpu", threads=1)
    except (ValueError, MemoryError):
        return False, 0, 0.0, None
    bodies = max(100, len(world))
    if len(world) > MOST_BODIES * 12:
        return False, 0, 0.0, None
    limit = SECONDS * bodies / 100
    signal.signal(signal.SIGALRM, too_slow)
    signal.setitimer(signal.ITIMER_REAL, 3 * limit)
    try:
        for _ in range(STEPS):
            world.step()
            if time.process_time() - begin > limit:
                return True, bodies, limit, f"slow: more than {limit:.0f} s for {len(world)} bodies, at step {world.steps}"
    except TooSlow:
        return True, bodies, limit, f"slow: a step takes longer than {limit:.0f} s with {len(world)} bodies"
    except MemoryError as error:
        return True, bodies, 0.0, f"memory: {str(error)[:300]}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    spent = time.process_time() - begin
    statistics = world.statistics
    values = np.concatenate([np.asarray(column, dtype=np.float64).ravel() for column in
                             (world.position, world.velocity, world.angular_velocity, world.orientation)])
    loads = world.joints()
    loads = [np.asarray(loads[name], dtype=np.float64).ravel() for name in loads.dtype.names if loads.dtype[name].base.kind == "f"]
    wrong = None
    if statistics["not_finite"] or not np.isfinite(values).all():
        wrong = f"not finite: {statistics['not_finite']} bodies"
    elif loads and np.isnan(np.concatenate(loads)).any():
        wrong = "not finite: the load of a joint"
    elif not all(np.isfinite(value).all() for value in (np.asarray(v, dtype=np.float64) for v in statistics.values())):
        wrong = f"not finite: statistics {statistics}"
    return True, bodies, spent, wrong


def work(first, count, share, program, findings):
    import scree
    ranges = ranges_of(scree.schema())
    demos = {name: json.loads(scree.demo(name, many).to_json() if many else scree.demo(name).to_json()) for name, many in DEMOS.items()}
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_DATA, (6 * 2**30,) * 2)
    for seed in range(first, first + count):
        rng = random.Random(seed)
        text = json.dumps(scene_of(rng, demos, ranges))
        print(f"seed {seed}", flush=True)
        accepted, bodies, spent, wrong = judged(scree, text)
        if accepted and not wrong and program and seed % share == 0:
            file = findings / "compared.json"
            file.write_text(text)
            done = subprocess.run([program, "compare", str(file), "--steps", str(STEPS), "-q"], capture_output=True, timeout=600)
            wrong = None if done.returncode == 0 else f"compare ends with {done.returncode}: {(done.stdout + done.stderr).decode()[-300:]}"
        if wrong:
            (findings / f"{seed}.json").write_text(text)
        print(json.dumps({"seed": seed, "accepted": accepted, "bodies": bodies, "seconds": spent, "wrong": wrong}), flush=True)


def main():
    options = argparse.ArgumentParser(description="Scenes at the ends of all documented ranges, through the Python module, on the CPU.")
    options.add_argument("--scenes", type=int, default=20000)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--compare", default="", help="the program, which compares a share of the scenes with the device")
    options.add_argument("--share", type=int, default=100)
    options.add_argument("--findings", type=pathlib.Path, default=pathlib.Path("fuzz-findings"))
    options.add_argument("--work", type=int, nargs=2, help=argparse.SUPPRESS)
    asked = options.parse_args()
    asked.findings.mkdir(parents=True, exist_ok=True)
    if asked.work:
        work(*asked.work, asked.share, asked.compare, asked.findings)
        return 0
    tried = accepted = 0
    slowest, findings = (0.0, 0), []
    first, end = asked.seed * 10**6, asked.seed * 10**6 + asked.scenes
    while first < end:
        child = subprocess.Popen([sys.executable, "-B", __file__, "--work", str(first), str(min(CHUNK, end - first)), "--share", str(asked.share),
                                  "--compare", asked.compare, "--findings", str(asked.findings)], stdout=subprocess.PIPE, text=True)
        last = None
        for line in child.stdout:
            if line.startswith("seed "):
                last = int(line.split()[1])
                continue
            told = json.loads(line)
            tried, accepted, first, last = tried + 1, accepted + told["accepted"], told["seed"] + 1, None
            slowest = max(slowest, (told["seconds"] * 100 / max(told["bodies"], 1), told["seed"]))
            if told["wrong"]:
                findings.append(told["seed"])
                print(f"FOUND {told['seed']}: {told['wrong']}", flush=True)
        status = child.wait()
        if last is not None:
            findings.append(last)
            tried, first = tried + 1, last + 1
            print(f"FOUND {last}: the process ends with {status}", flush=True)
        elif status != 0:
            sys.exit(f"a worker ends with {status}")
    print(f"{tried} scenes, {accepted} accepted, the slowest {slowest[0]:.2f} s for {STEPS} steps of 100 bodies (seed {slowest[1]}), "
          f"{len(findings)} findings" + (f" in {asked.findings}" if findings else ""))
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
