#!/usr/bin/env python3
# Mutated inputs through the program: scenes, recordings, checkpoints, MJCF, URDF, glTF, GLB, USD, OBJ and STL.
#
#     tests/fuzz/fuzz.py PROGRAM --seconds 600 [--jobs 2] [--seed 1] [--devices] [--findings DIR]
#
# Seeds are demos of a few bodies, the files of tests/imports, and what else the corpus beside this file has. What must hold of every
# mutant: no signal, no exit status but 0, 1 and 2, an error that names the file, an end within 10 s of the processor, memory within 200 times the file
# and 200 MB; checkpoints are damaged, not forged (.github/SECURITY.md); of what is accepted: no body that is not finite and not told, the same hash and the same bytes from a checkpoint in the
# middle, and on the CPU while it flushes denormals; with --devices also on the Vulkan device. Findings are kept with the command
# that shows them; the exit status is 1 if there are any.

import argparse
import concurrent.futures
import json
import pathlib
import random
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import time

import mutation

HERE = pathlib.Path(__file__).resolve().parent
IMPORTS = HERE.parent / "imports"
DEMOS = {"rest": 0, "seesaw": 0, "slopes": 0, "cradle": 0, "chain": 0, "bridge": 0, "pendulums": 0, "machine": 0, "glass": 0, "assortment": 12,
         "mix": 12, "terrain": 8, "shatter": 6, "compounds": 0, "solids": 0, "drive": 0, "ragdolls": 11, "turntable": 0, "thresholds": 0}
STEPS, HALF = 30, 10
SLOWEST = 10  # s of the processor: a busy machine makes no finding
BLOCKED = 30  # times that by the clock: it waits for something
MEMORY = lambda size: 200 * size + 200 * 2**20  # bytes; a limit of addresses, so generous for code and threads
CODE = 700 * 2**20

OBJ = """v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"""
STL = """solid a
facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet
facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet
facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet
facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n"""
ACTS = [{"step": 1, "grab": {"grip": 0, "body": 1, "anchor": [0, 0.1, 0], "target": [1, 2, 3]}},
        {"step": 2, "drag": {"grip": 0, "target": [1, 2.5, 3]}},
        {"step": 4, "add": {"shape": {"sphere": {"radius": 0.3}}, "position": [0, 2, 9], "velocity": [0, 3, -15]}},
        {"step": 5, "join": {"kind": {"ball": {}}, "a": 1, "b": 2, "anchor_a": [0, 0.5, 0], "anchor_b": [0, -0.5, 0]}},
        {"step": 9, "release": {"grip": 0}}, {"step": 12, "push": {"body": 1, "force": [500, 0, 0]}},
        {"step": 14, "explode": {"centre": [0, 0, 0], "radius": 5, "speed": 10}}, {"step": 15, "unjoin": {"joint": 0}},
        {"step": 16, "turn": {"gravity": [0, -1.6, 0], "substeps": 4, "friction_factor": 0.5, "least_restitution": 0.9, "sleeping": False}}]


def stl_bytes():
    corners = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
    faces = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *corners[a], *corners[b], *corners[c], 0) for a, b, c in faces)
    return b" " * 80 + struct.pack("<I", len(faces)) + body


def glb(text):
    body = text + b" " * (-len(text) % 4)
    return struct.pack("<5I", 0x46546C67, 2, 20 + len(body), len(body), 0x4E4F534A) + body


class Program:
    def __init__(self, path, devices):
        self.path, self.devices = str(path), devices

    def run(self, folder, *arguments, size=0, seconds=SLOWEST):
        def limits():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_DATA, (CODE + MEMORY(size),) * 2)
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        try:
            done = subprocess.run([self.path, *arguments], cwd=folder, capture_output=True, timeout=seconds * BLOCKED, preexec_fn=limits,
                                  stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            return None, b"", f"no end in {seconds * BLOCKED} s"
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return None, b"", f"no end in {seconds} s of the processor"
        return done.returncode, done.stdout, done.stderr.decode("utf-8", "replace")


def seeds(program, folder):
    """(name, bytes) of every kind of file."""
    found = []
    for demo, bodies in DEMOS.items():
        many = ["--bodies", str(bodies)] if bodies else []
        code, out, error = program.run(folder, "export", demo, *many, seconds=60)
        if code == 0:
            found.append(("scene.json", out))
    found += [("scene.json", file.read_bytes()) for file in sorted((HERE / "corpus").glob("*.json"))]
    for name, file in (("robot.xml", "quadruped.xml"), ("robot.xml", "everything.xml"), ("robot.urdf", "arm.urdf"), ("physics.gltf", "physics.gltf")):
        found.append((name, (IMPORTS / file).read_bytes()))
    for demo in ("bridge", "machine", "compounds"):
        code, _, error = program.run(folder, "export", demo, "-o", "set.usda", seconds=60)
        if code == 0:
            found.append(("set.usda", (folder / "set.usda").read_bytes()))
    found.append(("physics.glb", glb((IMPORTS / "physics.gltf").read_bytes())))
    found += [("mesh.obj", OBJ.encode()), ("mesh.stl", STL.encode()), ("binary.stl", stl_bytes())]
    recording = {"scree_input": 1, "scene": "rest", "bodies": 0, "seed": 1, "rate": 60, "substeps": 8, "sleeping": True, "steps": 20,
                 "acts": ACTS}
    found.append(("acts.input", json.dumps(recording).encode()))
    for demo in ("rest", "bridge", "glass"):
        code, _, error = program.run(folder, "run", demo, "--backend", "cpu", "--threads", "1", "--steps", "9", "--checkpoint", "c.checkpoint", "-q")
        if code in (0, 1):
            found.append(("run.checkpoint", (folder / "c.checkpoint").read_bytes()))
    return found


def mutant_of(random, name, data):
    if name.endswith((".json", ".gltf", ".input")):
        return mutation.json_mutant(random, data)
    if name.endswith(".glb"):
        return glb(mutation.json_mutant(random, data[20:])) if random.random() < 0.7 else mutation.byte_mutant(random, data)
    if name.endswith(".checkpoint") or name == "binary.stl":
        return mutation.byte_mutant(random, data)
    return mutation.text_mutant(random, data) if random.random() < 0.9 else mutation.byte_mutant(random, data)


def report_of(text):
    try:
        return json.loads(text)
    except ValueError:
        return None


def judged(program, folder, name, size, brief=False):
    """What is wrong with the program's ways with a file: (None or sentence, accepted)."""
    base = ["--backend", "cpu", "--threads", "1", "--report", "-", "-q", "--steps"]
    what = {"input": ["run", "--input", name, *base[:-1]], "checkpoint": ["run", "--resume", name, *base, str(STEPS)]}
    arguments = what.get(name.rsplit(".")[-1], ["run", name, *base, str(STEPS)])
    code, out, error = program.run(folder, *arguments, size=size)
    shown = " ".join(arguments)
    if code is None:
        return f"{error}: {shown}", True
    if code not in (0, 1, 2) or "Sanitizer" in error or "runtime error" in error:
        return f"ends with {code}: {shown}: {error[-2000:]}", False
    if code == 2:
        wrong = None if "scree: " in error and len(error) < 20000 and out == b"" else f"refused badly: {shown}: {error[:300]}"
        return wrong, False
    report = report_of(out)
    if code == 1 and report is None:
        return (None if "memory" in error else f"ends with 1 and no report: {shown}: {error[:300]}"), False
    if report is None:
        return f"no report: {shown}", True
    if report["not_finite"] and "not finite" not in error:
        return f"{report['not_finite']} bodies not finite, untold: {shown}", True
    if brief or name.endswith((".input", ".checkpoint")):
        return None, True
    # From a checkpoint in the middle.
    code, _, error = program.run(folder, "run", name, *base[:5], "half.json", "-q", "--steps", str(HALF), "--checkpoint", "half", size=size)
    code, out, error = program.run(folder, "run", "--resume", "half", *base, str(STEPS), size=size)
    again = report_of(out)
    if again is None or again["state_hash"] != report["state_hash"]:
        return f"resumed after {HALF} of {STEPS} steps it parts: {shown}: {error[:300]}", True
    ways = [["--flush-denormals"], []] if program.devices else [["--flush-denormals"]]
    for way in ways:
        code, out, error = program.run(folder, "compare", name, "--steps", str(HALF), "-q", *way, size=size + 2**23, seconds=60)
        if code not in (0, 2) or (code == 2 and not way and "denormals" not in error):
            return f"compare {' '.join(way)} --steps {HALF} ends with {code}: {out.decode()[-500:]}{error[-500:]}", True
    return None, True


def is_accepted(program, folder, name, data):
    (folder / "cube.obj").write_text(OBJ)
    (folder / name).write_bytes(data)
    wrong, accepted = judged(program, folder, name, len(data), brief=True)
    return accepted and not wrong


def one(program, corpus, seed, findings, only):
    rng = random.Random(seed)
    name, data = rng.choice([item for item in corpus if not only or item[0].endswith(only)])
    mutant = mutant_of(rng, name, data)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "cube.obj").write_text(OBJ)
        (folder / name).write_bytes(mutant)
        wrong, accepted = judged(program, folder, name, len(mutant))
        if not wrong:
            left = [file.name for file in folder.iterdir() if file.name not in (name, "cube.obj", "half", "half.json")]
            if left:
                wrong = f"left behind: {left}"
        if wrong:
            findings.mkdir(parents=True, exist_ok=True)
            (findings / f"{seed}_{name}").write_bytes(mutant)
            with (findings / "told.txt").open("a") as told:
                told.write(f"{seed}_{name}: {wrong}\n")
    return name.rsplit(".")[-1], accepted, wrong


def main():
    options = argparse.ArgumentParser(description="Mutated inputs through the program: scenes, recordings, checkpoints, MJCF, URDF, glTF, GLB, USD, OBJ and STL.")
    options.add_argument("program", type=pathlib.Path)
    options.add_argument("--seconds", type=float, default=600)
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--only", default="", help="ending of the files to mutate")
    options.add_argument("--devices", action="store_true", help="compare with the Vulkan device as well")
    options.add_argument("--findings", type=pathlib.Path, default=pathlib.Path("fuzz-findings"))
    asked = options.parse_args()
    program = Program(asked.program.resolve(), asked.devices)
    with tempfile.TemporaryDirectory() as folder:
        corpus = seeds(program, pathlib.Path(folder))
        if refused := [name for name, data in corpus if not is_accepted(program, pathlib.Path(folder), name, data)]:
            sys.exit(f"the program refuses seeds, so their mutants would try nothing: {refused}")
    end = time.monotonic() + asked.seconds
    tried, taken, wrongs, seed = {}, {}, [], asked.seed * 1000000
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        running = set()
        while time.monotonic() < end or running:
            while time.monotonic() < end and len(running) < asked.jobs:
                running.add(pool.submit(one, program, corpus, seed, asked.findings.resolve(), asked.only))
                seed += 1
            done, running = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
            for result in done:
                kind, accepted, wrong = result.result()
                tried[kind] = tried.get(kind, 0) + 1
                taken[kind] = taken.get(kind, 0) + accepted
                if wrong:
                    wrongs.append(wrong)
                    print(f"FOUND: {wrong}", flush=True)
    for kind in sorted(tried):
        print(f"{kind}: {tried[kind]} tried, {taken[kind]} accepted")
    print(f"{sum(tried.values())} inputs in {asked.seconds:.0f} s, {len(wrongs)} findings" + (f" in {asked.findings}" if wrongs else ""))
    return 1 if wrongs else 0


if __name__ == "__main__":
    sys.exit(main())
