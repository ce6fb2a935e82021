# Runs the lessons of the book: the Python blocks of a page, put together, are its script, which asserts what the page claims.
"""lessons.py [NAME...] [--keep FOLDER] [--pictures]: each in a process and folder of its own. A lesson that fails ends it with status 1."""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import List

import book

FOLDER = book.TOP / book.BOOK / "lessons"
CHECK_SCENE = """
import sys, numpy, scree
scene = scree.load(sys.argv[1])
for text in sys.argv[2:]:
    assert scree.from_json(text).hash == scene.hash, "the scene on the page is not that of the script"
world = scree.World(scene, backend="cpu")
world.step(30)
assert numpy.isfinite(world.position).all()
"""


def names() -> List[str]:
    """In the order of the contents."""
    return [link[len("lessons/"):-3] for title, part in book.contents() if title == "Lessons" for _, link in part]


def blocks_of(name: str, language: str) -> List[str]:
    text = (FOLDER / f"{name}.md").read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def script_of(name: str) -> str:
    title = book.title_of((FOLDER / f"{name}.md").read_text(encoding="utf-8"))
    return f"# {title}: the code of this lesson, in one piece.\n" + "\n".join(blocks_of(name, "python"))


def to_jpeg(picture: Path, there: Path) -> None:
    there.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run(["ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-i", str(picture), "-q:v", "3", "-bitexact", str(there)], check=True)


# Relative folders of PYTHONPATH are those of the caller.
SURROUNDINGS = {**os.environ, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep))))}


def run(name: str, keep: "Path | None", pictures: bool) -> List[str]:
    """Runs one, and returns what is wrong with it."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / f"{name}.py"
        script.write_text(script_of(name), encoding="utf-8")
        begun = time.monotonic()
        done = subprocess.run([sys.executable, "-B", script.name], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False, timeout=300, env=SURROUNDINGS)
        print(f"{name}: {time.monotonic() - begun:.1f} s", flush=True)
        if done.returncode:
            return [f"{name}: {done.stdout}"]
        if os.environ.get("SCREE_TALK"):
            print(done.stdout)
        made = {ending: sorted(Path(folder).glob(f"*{ending}")) for ending in (".png", ".json")}
        if len(made[".png"]) != 1 or len(made[".json"]) > 1:
            return [f"{name}: makes {len(made['.png'])} pictures and {len(made['.json'])} scenes, should make one picture, at most one scene"]
        for scene in made[".json"]:
            checked = subprocess.run([sys.executable, "-B", "-c", CHECK_SCENE, str(scene), *blocks_of(name, "json")], stdout=subprocess.PIPE,
                                     stderr=subprocess.STDOUT, text=True, check=False, env=SURROUNDINGS)
            if checked.returncode:
                return [f"{name}: {scene.name}: {checked.stdout}"]
            if keep:
                keep.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(scene, keep / f"{name}.json")
        if keep:
            to_jpeg(made[".png"][0], keep / f"{name}.jpg")
        if pictures:
            to_jpeg(made[".png"][0], book.TOP / book.PICTURES / "lessons" / f"{name}.jpg")
    return []


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=[], help="by default all")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="keeps their pictures and scene files there")
    parser.add_argument("--pictures", action="store_true", help="writes their pictures into demos/pictures/lessons")
    given = parser.parse_args()
    unknown = [name for name in given.names if name not in names()]
    if unknown:
        parser.error(f"no lesson is named {unknown[0]}; known: {', '.join(names())}")
    faults = [fault for name in given.names or names() for fault in run(name, given.keep, given.pictures)]
    print("\n".join(faults), end="\n" if faults else "", file=sys.stderr)
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
