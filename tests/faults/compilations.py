#!/usr/bin/env python3
# lavapipe compiles a shader once, not anew in each step: tests/faults/compilations.py SCREE
#
# Mesa's lavapipe specialises a shader for parameters that a branch tests alone, and does so again in each step. Counts the modules of
# LLVM that a run asks for (modules.c): a run of 12 steps may not ask for more than one of 4. Exit status 77, skipped: no lavapipe, or
# one that reaches LLVM in another way.
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SCENES = (["pile", "--bodies", "60"], ["bins", "--copies", "3"], ["drive"])


def modules(program, shim, scene, steps):
    run = subprocess.run([program, "run", *scene, "--steps", str(steps), "--backend", "vulkan", "--device", "llvmpipe"],
                         env={**os.environ, "LD_PRELOAD": str(shim)}, capture_output=True, text=True, timeout=200)
    if "no device" in run.stderr or "llvmpipe" in run.stderr and run.returncode:
        print(run.stderr)
        sys.exit(77)
    counted = re.search(r"^modules (\d+)$", run.stderr, re.MULTILINE)
    if not counted:
        sys.exit(f"{scene[0]}: the run does not say how many modules it made: {run.stderr}")
    return int(counted[1])


def main():
    program, faults = sys.argv[1], 0
    with tempfile.TemporaryDirectory() as folder:
        shim = pathlib.Path(folder) / "modules.so"
        subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-O1", str(HERE / "modules.c"), "-o", str(shim), "-ldl"], check=True)
        for scene in SCENES:
            few, many = (modules(program, shim, scene, steps) for steps in (4, 12))
            if few == 0:
                print("Mesa calls LLVM in another way")
                sys.exit(77)
            print(f"{scene[0]}: {few} modules in 4 steps, {many} in 12")
            faults += many > few
    if faults:
        sys.exit("a shader is compiled in each step: one of its branches tests parameters alone; write choose() in its place")


if __name__ == "__main__":
    main()
