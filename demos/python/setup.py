# Builds the package scree with CMake, for pip.
"""pip install --no-build-isolation --no-deps demos/python

Needs the packages that .ci/setup lists, and no network. Environment: SCREE_CMAKE_ARGS, further arguments of CMake, such as
-DSCREE_VULKAN=OFF; SCREE_BUILD_FOLDER, a configured build of this checkout to take the module from, in place of a build of
its own; CMAKE_BUILD_PARALLEL_LEVEL, how many compilers run at once.
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent


def version() -> str:
    found = re.search(r"project\(scree VERSION ([0-9.]+)", (TOP / "CMakeLists.txt").read_text())
    if not found:
        raise SystemExit("demos/python is built within a checkout of scree, where CMakeLists.txt names its version")
    return found.group(1)


class CMakeBuild(build_ext):
    """Configures and builds the target scree_python, and takes what it made."""

    def configure(self, build: Path) -> None:
        command = [
            "cmake", "-S", str(TOP), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DSCREE_PREFERS_CLANG=ON",
            "-DSCREE_PYTHON=ON", "-DSCREE_TESTS=OFF", "-DSCREE_WINDOW=OFF", "-DSCREE_PROGRAM=ON", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=6",
            f"-DSCREE_PYTHON_EXECUTABLE={sys.executable}"]
        if shutil.which("ninja"):
            command += ["-G", "Ninja"]
        subprocess.run(command + shlex.split(os.environ.get("SCREE_CMAKE_ARGS", "")), check=True)

    def build_extension(self, ext: Extension) -> None:
        # Beside the other builds of the checkout, so that a second installation compiles what has changed.
        build = TOP / "build" / f"pip-{sys.implementation.cache_tag}"
        if given := os.environ.get("SCREE_BUILD_FOLDER"):
            build = Path(given)
        else:
            self.configure(build)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "--build", str(build), "--target", "scree_python", "--parallel", jobs], check=True)
        made = next((build / "python" / "scree").glob("_native*.so"))
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(made, target)


SCRATCH = TOP / "build" / "pip"
SCRATCH.mkdir(parents=True, exist_ok=True)

setup(
    version=version(),
    # Nothing is written beside the sources.
    options={"build": {"build_base": str(SCRATCH)}, "egg_info": {"egg_base": str(SCRATCH)}},
    packages=["scree"],
    package_data={"scree": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("scree._native", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
)
