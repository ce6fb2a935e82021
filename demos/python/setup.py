# Builds the package scree with libscree, for pip and for wheels.
"""pip install --no-build-isolation --no-deps demos/python
pip wheel --no-build-isolation --no-deps -w dist demos/python     a wheel for any CPython from 3.9 on

Needs the packages that .ci/setup lists, and no network. The wheel holds libscree and the libraries that it needs, but for the C and
C++ libraries and the Vulkan loader, which are the machine's. Its name says which glibc it needs; pip refuses it where that is older.
Environment: SCREE_CMAKE_ARGS, further arguments of CMake, such as -DSCREE_VULKAN=OFF; SCREE_BUILD_FOLDER, a configured build of this
checkout to take the library from, in place of a build of its own; CMAKE_BUILD_PARALLEL_LEVEL, how many compilers run at once;
SCREE_WHEEL_PLATFORM=win_amd64, a wheel for Windows of the build that SCREE_BUILD_FOLDER names (tests/house/windows makes one).
"""
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.dist import Distribution
from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent
# A wheel for Windows is made on Linux, of a build for it.
FOR_WINDOWS = os.environ.get("SCREE_WHEEL_PLATFORM") == "win_amd64"
LIBRARY = "scree.dll" if FOR_WINDOWS else "libscree.0.dylib" if sys.platform == "darwin" else "libscree.so.0"
OF_THE_MACHINE = re.compile(r"^(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|stdc\+\+|gcc_s)|linux-vdso)\.so")


def version() -> str:
    found = re.search(r"project\(scree VERSION ([0-9.]+)", (TOP / "CMakeLists.txt").read_text())
    if not found:
        raise SystemExit("demos/python is built within a checkout of scree, where CMakeLists.txt names its version")
    return found.group(1)


def configured() -> Path:
    given = os.environ.get("SCREE_BUILD_FOLDER")
    if given:
        return Path(given)
    # Beside the other builds of the checkout, so that a second installation compiles what has changed.
    build = TOP / "build" / "pip-library"
    command = [
        "cmake", "-S", str(TOP), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DSCREE_PREFERS_CLANG=ON", "-DSCREE_PYTHON=OFF",
        "-DSCREE_TESTS=OFF", "-DSCREE_WINDOW=OFF", "-DSCREE_PROGRAM=ON", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=6"]
    if shutil.which("ninja"):
        command += ["-G", "Ninja"]
    subprocess.run(command + shlex.split(os.environ.get("SCREE_CMAKE_ARGS", "")), check=True)
    return build


def needed_by(library: Path) -> "list[Path]":
    """The libraries that it loads, and those that these load, but for the machine's."""
    if not LIBRARY.endswith(".so.0"):  # scree.dll needs none; delocate finds those of macOS
        return []
    told = subprocess.run(["ldd", str(library)], check=True, capture_output=True, text=True).stdout
    found = re.findall(r"^\s*(\S+) => (\S+)", told, flags=re.M)
    missing = [name for name, place in found if place == "not"]
    if missing:
        raise SystemExit(f"{library} needs {', '.join(missing)}, which this machine lacks")
    return [Path(place) for name, place in found if not OF_THE_MACHINE.match(name)]


def glibc_needed_by(libraries: "list[Path]") -> "tuple[int, int]":
    told = subprocess.run(["objdump", "-T", *map(str, libraries)], check=True, capture_output=True, text=True).stdout
    return max((int(first), int(second)) for first, second in re.findall(r"GLIBC_(\d+)\.(\d+)", told))


class WithLibrary(build_py):
    """The package's files, and the library with what it needs."""

    def run(self) -> None:
        folder = Path(self.build_lib) / "scree"
        shutil.rmtree(folder, ignore_errors=True)  # of a build before
        super().run()
        build = configured()
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "--build", str(build), "--target", "scree_c", "--parallel", jobs], check=True)
        library = build / "demos" / "c" / LIBRARY
        shutil.copy2(library.resolve(), folder / LIBRARY)
        for one in needed_by(library):
            shutil.copy2(one, folder / one.name)
        strip = ["x86_64-w64-mingw32-strip"] if FOR_WINDOWS else ["strip", "-x"] if sys.platform == "darwin" else ["strip", "--strip-unneeded"]
        for pattern in ("*.so*", "*.dll", "*.dylib"):
            for one in folder.glob(pattern):
                subprocess.run([*strip, str(one)], check=True)


class ForAnyPython(bdist_wheel):
    """Of one kind of machine, with the glibc that its libraries need or a later one (PEP 600), and of no version of Python."""

    def finalize_options(self) -> None:
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self) -> "tuple[str, str, str]":
        platform = super().get_tag()[2]
        libraries = sorted((Path(self.get_finalized_command("build_py").build_lib) / "scree").glob("*.so*"))
        if platform.startswith("linux_") and libraries:
            platform = "manylinux_{}_{}_".format(*glibc_needed_by(libraries)) + platform[len("linux_"):]
        return "py3", "none", "win_amd64" if FOR_WINDOWS else platform


class OfOneMachine(Distribution):
    def has_ext_modules(self) -> bool:
        return True


SCRATCH = TOP / "build" / "pip"
SCRATCH.mkdir(parents=True, exist_ok=True)

setup(
    version=version(),
    # Nothing is written beside the sources.
    options={"build": {"build_base": str(SCRATCH)}, "egg_info": {"egg_base": str(SCRATCH)}},
    packages=["scree"],
    package_data={"scree": ["py.typed"]},
    cmdclass={"build_py": WithLibrary, "bdist_wheel": ForAnyPython},
    distclass=OfOneMachine,
    zip_safe=False,
)
