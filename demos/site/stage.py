# Makes the folder of which mkdocs builds the site: stage.py FOLDER, with the pages, pictures, the reference and the configuration.
"""Every link of every page is checked on the way; one that leads nowhere ends it with status 1, and nothing is left behind."""
import argparse
import json
import re
import shutil
import sys
from pathlib import Path
from typing import Any, Dict, List, Optional, Set

import book
import doxygen_pages
import lessons
import python_pages


class Stage:
    """The folder, and what is in it."""

    def __init__(self, folder: Path) -> None:
        self.docs = folder / "docs"
        self.faults: List[str] = []
        self.taken: Dict[str, str] = {}
        self.sources: List[str] = []
        self.rooms: List[str] = []

    def write(self, there: str, text: str) -> None:
        target = self.docs / there
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")

    def copy(self, path: Path, there: str) -> None:
        target = self.docs / there
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)

    def add_pages(self) -> None:
        """Those of the book, and all that they name."""
        wanted = ["README.md", *(path for path in book.FIXED if path.endswith(".md"))]
        wanted += [book.BOOK + link for _, part in book.contents() for _, link in part]
        seen: Set[str] = set()
        made_elsewhere = {*book.public_headers(), "demos/c/scree.h"}
        while wanted:
            path = wanted.pop(0)
            if path in seen or path in made_elsewhere:
                continue
            seen.add(path)
            there = book.site_path(path)
            if path.endswith(book.IMAGES):
                if book.place_of_image(path, self.taken) is None:
                    self.faults.append(f"{path}: {self.taken[there]} is a picture of the same name")
                self.copy(book.TOP / path, there)
            elif path.endswith(".md"):
                page = book.Page(path, wanted.append)
                self.write(there, page.on_site())
                self.faults += page.faults
                if there.startswith("project/") and path not in book.FIXED:
                    self.rooms.append(path)
            else:
                self.write(there, book.source_page(path))
                self.sources.append(there)

    def add_reference(self, xml: Path) -> None:
        reference = doxygen_pages.Reference(xml)
        for header in [*book.public_headers(), "demos/c/scree.h"]:
            self.write(book.site_path(header), doxygen_pages.HeaderPage(reference, header).text())
        for module, text in python_pages.pages().items():
            self.write(f"api/python/{module}.md", text)
        lines = ["# API reference", "", "Made from the sources. Lengths are in m, times in s, masses in kg, angles in rad; y is up.", ""]
        lines += ["## Python", "", "The [guide](../guide/python.md) has an overview.", "", "| page | has |", "|---|---|"]
        lines += [f"| [{title}](python/{module}.md) | {', '.join(f'`{name}`' for name in python_pages.names_of(module))} |"
                  for module, title in python_pages.TITLES.items()]
        lines += ["", "## C", "", "[scree.h](c.md); the [guide](../guide/c.md) says how to use it.", "", "## C++", ""]
        lines += ["`compute/world.h` is where to begin.", "", "| header | has |", "|---|---|"]
        lines += [f"| [{header}](cpp/{book.header_page(header)[8:]}) | {doxygen_pages.first_sentence(header)} |" for header in book.public_headers()]
        self.write("api/index.md", "\n".join(lines) + "\n")

    def add_playground(self, folder: Optional[Path]) -> None:
        """Its files as they are; its page of the guide opens it."""
        if not folder:
            return
        shutil.copytree(folder, self.docs / "playground")
        page = self.docs / "guide" / "playground.md"
        title, rest = page.read_text(encoding="utf-8").split("\n", 1)
        page.write_text(f"{title}\n\n**[Open the playground](../playground/index.html)**\n{rest}", encoding="utf-8")

    def add_lessons(self, folder: Optional[Path], recordings: Optional[Path], has_playground: bool) -> None:
        """Each lesson's script, of a folder where they were run their pictures and scene files, and recordings of these.
        Scene files are beside the playground, too, which opens no others."""
        for name in lessons.names():
            self.write(f"lessons/{name}.py", lessons.script_of(name))
            scene = folder / f"{name}.json" if folder else None
            files = [f"[the script]({name}.py)"]
            if folder:
                self.copy(folder / f"{name}.jpg", f"pictures/lessons/{name}.jpg")
            if scene and scene.exists():
                self.copy(scene, f"lessons/{name}.json")
                files.append(f"[the scene as a file]({name}.json)")
                if has_playground:
                    self.copy(scene, f"playground/{name}.json")
            if recordings and (recordings / f"lesson-{name}.html").exists():
                self.copy(recordings / f"lesson-{name}.html", f"recordings/lesson-{name}.html")
                files.append(f"[the scene as a recording](../recordings/lesson-{name}.html), to be turned and paused")
            page = self.docs / "lessons" / f"{name}.md"
            text = page.read_text(encoding="utf-8")
            if scene and scene.exists() and has_playground:
                text += f"\n**[Open in the playground](../playground/index.html?scene={name}.json)**: the scene of this lesson, in your browser.\n"
            page.write_text(text + f"\nDownload: {', '.join(files)}.\n", encoding="utf-8")

    def add_recordings(self, folder: Optional[Path], has_playground: bool) -> None:
        """The pictures of the gallery open the recordings of their demos, the names below the playground."""
        page = self.docs / "guide" / "gallery.md"
        text = page.read_text(encoding="utf-8")
        for recording in sorted(folder.glob("*.html")) if folder else ():
            if recording.name.startswith("lesson-"):
                continue
            picture = f"![](../pictures/{recording.stem}.jpg)"
            if picture not in text:
                self.faults.append(f"{recording.name}: the gallery has no picture of that demo")
            self.copy(recording, f"recordings/{recording.name}")
            text = text.replace(picture, f"[{picture}](../recordings/{recording.name} \"{recording.stem}: watch its recording\")")
        told = ["A picture opens the recording of its run, to be turned and paused."] if folder else []
        if has_playground:
            text = re.sub(r"(\.jpg\)\S* (?:\"[^\"]*\"\) )?)`(\w+)`", r"\1[`\2`](../playground/index.html?demo=\2)", text)
            told.append("A name opens the demo in [the playground](playground.md).")
        if told:
            text = text.replace("\n| | | |\n", f"\n{' '.join(told)}\n\n| | | |\n", 1)
        page.write_text(text, encoding="utf-8")

    def navigation(self) -> List[Any]:
        parts = {title: [{name: link} for name, link in pages] for title, pages in book.contents()}
        lead = parts.pop("")
        gallery = [entry for entry in parts["Guide"] if "Gallery" in entry]
        made: List[Any] = [{"Home": [{"scree": "index.md"}, *lead[:1], {"The book": "book.md"}, *lead[1:]]}]
        made.append({"Lessons": parts.pop("Lessons")})
        made += [{title: [entry for entry in pages if entry not in gallery]} for title, pages in parts.items()]
        made += gallery
        cpp = [{re.sub("^compute/", "", header): book.header_page(header)} for header in book.public_headers()]
        python = [{title: f"api/python/{module}.md"} for module, title in python_pages.TITLES.items()]
        made.append({"API": [{"Overview": "api/index.md"}, {"Python": python}, {"C": "api/c.md"}, {"C++": cpp}]})
        rooms = [{path[:-len("/README.md")] + "/": book.site_path(path)} for path in sorted(self.rooms)]
        fixed = [{"Changes": "project/changes.md"}, {"Contributing": "project/contributing.md"}, {"Security": "project/security.md"},
                 {"Recipes": "project/recipes.md"}]
        made.append({"Project": [*fixed, {"Rooms": rooms}, {"Files": [{path[8:-3]: path} for path in sorted(self.sources)]}]})
        return made


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--reference", type=Path, required=True, help="the XML of doxygen")
    parser.add_argument("--lessons", type=Path, help="pictures and scene files of lessons that were run")
    parser.add_argument("--recordings", type=Path, help="NAME.html of demos")
    parser.add_argument("--playground", type=Path, help="the playground, as demos/playground/build makes it")
    given = parser.parse_args()
    stage = Stage(given.folder)
    stage.add_pages()
    stage.add_reference(given.reference)
    stage.add_playground(given.playground)
    stage.add_lessons(given.lessons, given.recordings, bool(given.playground))
    stage.add_recordings(given.recordings, bool(given.playground))
    for name in ("style.css", "scree.svg", "worker.js"):
        stage.copy(Path(__file__).parent / name, f"assets/{name}")
    configuration = (Path(__file__).parent / "mkdocs.yml").read_text(encoding="utf-8")
    version = re.search(r"^project\(scree VERSION ([\d.]+)", (book.TOP / "CMakeLists.txt").read_text(), re.MULTILINE)
    configuration = configuration.replace("@VERSION@", version[1] if version else "").replace("@HERE@", str(Path(__file__).parent))
    (given.folder / "mkdocs.yml").write_text(f"{configuration}nav: {json.dumps(stage.navigation())}\n", encoding="utf-8")
    if stage.faults:
        print("\n".join(stage.faults), file=sys.stderr)
        shutil.rmtree(given.folder)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
