#!/usr/bin/env python3
# Faults put into runs of the program: SIGKILL at random moments, failing writes, failing allocations, devices that are lost or lack memory.
#
#     tests/faults/faults.py PROGRAM [--kills 200] [--writes 100] [--allocations 300] [--losses 60] [--device-calls 120] [--seed 1]
#
# A run writes frames, a report, a recording of poses, a scene and checkpoints (and a video where ffmpeg is). What must hold: every
# output is whole or not there; a run resumed from what is left reaches the same final hash; after it no left-over is in the folder;
# a failing write or allocation ends with a message, exit status 1 or 2, and no file that is cut short. A device that is lost, in any
# submission or wait, ends with a message and exit status 1.

import argparse
import json
import os
import pathlib
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zipfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
RUN = ["run", "bins", "--backend", "cpu", "--threads", "1", "--steps", "90", "-q"]
DEVICE_STEPS = "20"
DEVICE_RUN = ["run", "rest", "--backend", "vulkan", "--steps", DEVICE_STEPS, "-q"]
DEVICE_PICTURES = ["--frames", "frames", "--size", "96x64", "--fps", "10", "--canvas", "vulkan"]
PICTURES = ["--frames", "frames", "--size", "96x64", "--fps", "30", "--canvas", "gl"]


def wrong_png(data):
    if not data.startswith(b"\x89PNG\r\n\x1a\n"):
        return "no PNG"
    place = 8
    while place < len(data):
        if place + 12 > len(data):
            return "cut"
        length, kind = struct.unpack_from(">I4s", data, place)
        body = data[place + 4:place + 8 + length]
        if len(data) < place + 12 + length or zlib.crc32(body) != struct.unpack_from(">I", data, place + 8 + length)[0]:
            return "chunk damaged"
        place += 12 + length
        if kind == b"IEND":
            return None if place == len(data) else "bytes behind the end"
    return "no end"


def wrong_file(path):
    """What is wrong with an output, or None."""
    data = path.read_bytes()
    if path.suffix == ".png":
        return wrong_png(data)
    if path.suffix == ".json":
        try:
            json.loads(data)
        except ValueError as error:
            return f"no JSON: {error}"
        return None
    if path.suffix == ".npz":
        return None if zipfile.ZipFile(path).testzip() is None else "damaged"
    if path.suffix == ".mp4":
        return None if b"moov" in data and b"mdat" in data else "no index"
    if path.suffix == ".glb":
        return None if len(data) >= 12 and struct.unpack_from("<I", data, 8)[0] == len(data) else "cut"
    return None  # checkpoints have hashes: resuming tells


def wrongs_in(folder, left_overs):
    found = []
    for path in folder.rglob("*"):
        if path.is_dir():
            continue
        if ".part-scree-" in path.name:
            if not left_overs:
                found.append(f"left over: {path.name}")
        elif path.name.startswith(".scree-"):
            found.append(f"left over: {path.name}")
        elif wrong := wrong_file(path):
            found.append(f"{path.name}: {wrong}")
    return found


class Faults:
    def __init__(self, program, seed):
        self.program, self.random, self.findings = str(program), random.Random(seed), []
        self.outputs = ["--report", "report.json", "--trajectory", "run.npz", "--save", "end.json", "--export", "end.glb"]
        if shutil.which("ffmpeg"):
            self.outputs += ["--video", "film.mp4"]
        with tempfile.TemporaryDirectory() as folder:
            start = time.monotonic()
            done = subprocess.run([self.program, *RUN, *PICTURES, *self.outputs], cwd=folder, capture_output=True)
            if done.returncode not in (0, 1):  # no canvas here
                PICTURES.clear()
                self.outputs = [word for word in self.outputs if word not in ("--video", "film.mp4")]
                start = time.monotonic()
                done = subprocess.run([self.program, *RUN, *self.outputs], cwd=folder, capture_output=True)
            self.duration = time.monotonic() - start
            self.hash = json.loads((pathlib.Path(folder) / "report.json").read_text())["state_hash"]
            for wrong in wrongs_in(pathlib.Path(folder), False):
                self.find(f"without faults: {wrong}")

    def find(self, what):
        self.findings.append(what)
        print(f"FOUND: {what}", flush=True)

    def kill(self):
        """A run killed at a random moment, then what is left resumed."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            everything = [self.program, *RUN, *PICTURES, *self.outputs, "--checkpoint", "run.checkpoint", "--every", "0.1"]
            start = time.monotonic()
            process = subprocess.Popen(everything, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            moment = self.random.uniform(0, 1.3 * self.duration)
            try:
                process.wait(moment)
                ended = True
                self.duration = time.monotonic() - start  # machines are busier at times
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
                ended = False
            time.sleep(0.05)  # ffmpeg sees its pipe end
            for wrong in wrongs_in(folder, not ended):
                self.find(f"killed after {moment:.3f} s: {wrong}")
            shutil.rmtree(folder / "frames", ignore_errors=True)
            later = [self.program, "run", "--resume", "run.checkpoint"] if (folder / "run.checkpoint").exists() else [self.program, *RUN[:2]]
            later += [*RUN[2:], *self.outputs, "--checkpoint", "run.checkpoint"]
            done = subprocess.run(later, cwd=folder, capture_output=True, text=True)
            report = folder / "report.json"
            if done.returncode not in (0, 1) or not report.exists():
                self.find(f"killed after {moment:.3f} s, and resumed: {done.returncode} {done.stderr[:300]}")
            elif json.loads(report.read_text())["state_hash"] != self.hash:
                self.find(f"killed after {moment:.3f} s, and resumed: another hash")
            for wrong in wrongs_in(folder, False):
                self.find(f"killed after {moment:.3f} s, and resumed: {wrong}")
            return not ended

    def failing(self, shim, **environment):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            told = {**os.environ, "LD_PRELOAD": str(shim), "SCREE_FAIL_FOLDER": name, **environment}
            words = [self.program, *RUN, *self.outputs, "--checkpoint", "run.checkpoint", "--every", "0.5"]
            words = [word for word in words if word not in ("--video", "film.mp4")]
            try:
                done = subprocess.run(words, cwd=folder, capture_output=True, text=True, env=told, timeout=60)
            except subprocess.TimeoutExpired:
                self.find(f"{environment}: no end in 60 s")
                return 0, ""
            what = " ".join(f"{key}={value}" for key, value in environment.items())
            if done.returncode not in (0, 1, 2):
                self.find(f"{what}: ends with {done.returncode}: {done.stderr[-300:]}")
            if done.returncode == 1 and "scree: " not in done.stderr:
                self.find(f"{what}: ends with 1 and says nothing")
            for wrong in wrongs_in(folder, done.returncode < 0):
                self.find(f"{what}: {wrong}")
            return done.returncode, done.stderr


    def on_device(self, layer, **environment):
        """A run on a Vulkan device whose calls fail (failing_layer.cpp), then what is left resumed on the processor."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            told = {**os.environ, "VK_LAYER_PATH": str(layer), "VK_INSTANCE_LAYERS": "VK_LAYER_SCREE_faults", **environment}
            outputs = [word for word in self.outputs if word not in ("--video", "film.mp4")]
            try:
                done = subprocess.run([self.program, *DEVICE_RUN, *DEVICE_PICTURES, *outputs, "--checkpoint", "run.checkpoint", "--every", "0.1"],
                                      cwd=folder, capture_output=True, text=True, env=told, timeout=120)
            except subprocess.TimeoutExpired:
                self.find(f"{environment}: no end in 120 s")
                return 0, ""
            what = " ".join(f"{key}={value}" for key, value in environment.items())
            if done.returncode not in (0, 1, 2):
                self.find(f"{what}: ends with {done.returncode}: {done.stderr[-300:]}")
            if done.returncode > 0 and "scree: " not in done.stderr:
                self.find(f"{what}: ends with {done.returncode} and says nothing")
            if "SCREE_LOSE_DEVICE" in environment and done.returncode != 0 and (done.returncode != 1 or "VK_ERROR_DEVICE_LOST" not in done.stderr):
                self.find(f"{what}: a lost device ends with {done.returncode}: {done.stderr[-300:]}")
            for wrong in wrongs_in(folder, done.returncode < 0):
                self.find(f"{what}: {wrong}")
            if (folder / "run.checkpoint").exists():
                words = ["run", "--resume", "run.checkpoint", "--backend", "cpu", "--threads", "1", "--steps", DEVICE_STEPS, "-q", "--report", "again.json"]
                again = subprocess.run([self.program, *words], cwd=folder, capture_output=True, text=True)
                if again.returncode not in (0, 1) or json.loads((folder / "again.json").read_text())["state_hash"] != self.device_hash:
                    self.find(f"{what}, and resumed: {again.returncode}, or another hash: {again.stderr[:300]}")
            return done.returncode, done.stderr

    def lose_devices(self, folder, losses, calls):
        layer = build_layer(folder)
        if layer is None:
            print("no Vulkan headers or device: no device is lost")
            return
        with tempfile.TemporaryDirectory() as name:
            subprocess.run([self.program, "run", DEVICE_RUN[1], "--backend", "cpu", "--threads", "1", "--steps", DEVICE_STEPS, "-q", "--report", "report.json"],
                           cwd=name, capture_output=True)
            self.device_hash = json.loads((pathlib.Path(name) / "report.json").read_text())["state_hash"]
        code, said = self.on_device(layer, SCREE_COUNT="1")
        counts = re.search(r"vulkan calls (\d+) submissions and waits (\d+)", said)
        if code not in (0, 1) or not counts:
            self.find(f"without faults, on a device: {code} {said[-300:]}")
            return
        most_calls, most_waits = int(counts[1]), int(counts[2])
        print(f"a run on a device has {most_calls} calls that may lack memory, {most_waits} submissions and waits", flush=True)
        ends = [self.on_device(layer, SCREE_LOSE_DEVICE=str(at))[0] for at in spread(most_waits, losses)]
        print(f"{len(ends)} runs whose device is lost: {ends.count(1)} told, {ends.count(0)} had ended", flush=True)
        ends = []
        for i, at in enumerate(spread(most_calls, calls)):
            rest = {"SCREE_FAIL_REST": "1"} if i % 3 == 0 else {}
            ends.append(self.on_device(layer, SCREE_FAIL_VULKAN=str(at), **rest)[0])
        print(f"{len(ends)} runs in which a Vulkan call lacks memory: {ends.count(1) + ends.count(2)} told, {ends.count(0)} did without")


def spread(most, count):
    """At most so many numbers below `most`, with the first and the last."""
    return sorted({i * (most - 1) // max(1, count - 1) for i in range(count)}) if count < most else range(most)


def build_layer(folder):
    """The folder of the layer that fails, None where it cannot be built."""
    words = [os.environ.get("CXX", "c++"), "-std=c++20", "-shared", "-fPIC", "-fvisibility=hidden", "-O1", str(HERE / "failing_layer.cpp"), "-o",
             str(folder / "failing_layer.so")]
    if subprocess.run(words, capture_output=True).returncode != 0:
        return None
    manifest = {"name": "VK_LAYER_SCREE_faults", "type": "GLOBAL", "library_path": "./failing_layer.so", "api_version": "1.3.0",
                "implementation_version": "1", "description": "calls that fail"}
    (folder / "failing_layer.json").write_text(json.dumps({"file_format_version": "1.1.2", "layer": manifest}))
    return folder


def main():
    options = argparse.ArgumentParser(description="Faults put into runs of the program: SIGKILL at random moments, failing writes, failing allocations, lost devices.")
    options.add_argument("program", type=pathlib.Path)
    options.add_argument("--kills", type=int, default=200)
    options.add_argument("--writes", type=int, default=100)
    options.add_argument("--allocations", type=int, default=300)
    options.add_argument("--losses", type=int, default=60)
    options.add_argument("--device-calls", type=int, default=120)
    options.add_argument("--seed", type=int, default=1)
    asked = options.parse_args()
    faults = Faults(asked.program.resolve(), asked.seed)
    killed, runs = 0, 0
    while killed < asked.kills and runs < 3 * asked.kills:
        killed, runs = killed + faults.kill(), runs + 1
    print(f"{runs} runs, {killed} of them killed before they ended, resumed", flush=True)
    with tempfile.TemporaryDirectory() as name:
        shim = pathlib.Path(name) / "failing.so"
        subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-O1", str(HERE / "failing.c"), "-o", str(shim), "-ldl"], check=True)
        _, said = faults.failing(shim, SCREE_COUNT="1")
        words = said.split()
        allocations, written = int(words[words.index("allocations") + 1]), int(words[words.index("written") + 1])
        print(f"a run has {allocations} allocations and writes {written} bytes", flush=True)
        ends = [faults.failing(shim, SCREE_FAIL_BYTE=str(faults.random.randrange(written)))[0] for _ in range(asked.writes)]
        print(f"{asked.writes} runs whose writes fail from some byte on: {ends.count(1) + ends.count(2)} told, {ends.count(0)} had no use for it")
        ends = []
        for i in range(asked.allocations):
            rest = {"SCREE_FAIL_REST": "1"} if i % 3 == 0 else {}
            # The first are those of static objects; then as often in the first thousands, where readers and set-up are, as later.
            at = i + 1 if i < 8 else faults.random.randrange(min(allocations, 5000) if i % 2 else allocations)
            ends.append(faults.failing(shim, SCREE_FAIL_ALLOCATION=str(at), **rest)[0])
        print(f"{asked.allocations} runs in which an allocation fails: {ends.count(1) + ends.count(2)} told, {ends.count(0)} did without", flush=True)
        if asked.losses + asked.device_calls > 0:
            faults.lose_devices(pathlib.Path(name), asked.losses, asked.device_calls)
    print(f"{len(faults.findings)} findings")
    return 1 if faults.findings else 0


if __name__ == "__main__":
    sys.exit(main())
