# The pages of the site: reads the repository's Markdown, and knows where each file goes and what a link means there.
"""Repository paths are written from the root, as demos/docs/guide/bodies.md; site paths from the site's, as guide/bodies.md."""
import posixpath
import re
from pathlib import Path
from typing import Callable, Dict, List, Optional, Tuple

TOP = Path(__file__).resolve().parent.parent.parent
BOOK = "demos/docs/"
PICTURES = "demos/pictures/"
FIXED = {
    "README.md": "index.md",
    BOOK + "README.md": "book.md",
    ".github/CHANGELOG.md": "project/changes.md",
    ".github/CONTRIBUTING.md": "project/contributing.md",
    ".github/SECURITY.md": "project/security.md",
    ".github/recipes/README.md": "project/recipes.md",
    "demos/c/scree.h": "api/c.md",
}
IMAGES = (".jpg", ".png", ".svg")


def public_headers() -> List[str]:
    lines = (TOP / "compute/public_headers.txt").read_text().splitlines()
    return [line for line in lines if line.endswith(".h")]


def header_page(header: str) -> str:
    """api/cpp/scene_file-events.md: headers of one name lie in several folders."""
    return "api/cpp/" + header[:-2].split("/", 1)[1].replace("/", "-") + ".md"


def site_path(path: str) -> str:
    """Where a file of the repository is on the site."""
    if path in FIXED:
        return FIXED[path]
    if path in public_headers():
        return header_page(path)
    if path.endswith(IMAGES):
        return "pictures/" + (path[len(PICTURES):] if path.startswith(PICTURES) else posixpath.basename(path))
    if path.startswith(BOOK) and path.endswith(".md"):
        return path[len(BOOK):]
    if path.endswith("/README.md"):
        return "project/" + path[:-len("/README.md")].replace("/", "-").lstrip(".") + ".md"
    return "sources/" + path.lstrip(".") + ".md"


def anchor_of(heading: str) -> str:
    """The anchor that code hosts give a heading, as tests/house/pages.cpp has it."""
    return "".join("-" if c == " " else c.lower() for c in heading if c.isalnum() or c in "_- ")


class Fences:
    """Tells lines of code blocks from others."""

    def __init__(self) -> None:
        self.inside = False

    def is_text(self, line: str) -> bool:
        if line.startswith("```"):
            self.inside = not self.inside
            return False
        return not self.inside


def anchors_of(text: str) -> List[str]:
    found: List[str] = []
    fences = Fences()
    for line in text.splitlines():
        heading = re.fullmatch(r"#+ (.*)", line) if fences.is_text(line) else None
        if heading:
            anchor = anchor_of(heading[1])
            before = sum(1 for one in found if re.fullmatch(re.escape(anchor) + r"(-\d+)?", one))
            found.append(f"{anchor}-{before}" if before else anchor)
    return found


LINK = re.compile(r"(\]\()([^)\s]+)(\))")


def with_links(line: str, changed: Callable[[str], str]) -> str:
    """A line of text with other links; inline code stays."""
    parts = re.split(r"(`[^`]+`)", line)
    for i in range(0, len(parts), 2):
        parts[i] = LINK.sub(lambda link: link[1] + changed(link[2]) + link[3], parts[i])
    return "".join(parts)


def _apart(line: str, before: str) -> bool:
    """Whether a blank line is missing: code hosts begin a list or a table without one, mkdocs does not."""
    if not before.strip() or not line.strip():
        return False
    item = re.compile(r"\s*([-*]|\d+\.) ")
    if item.match(line):
        return not item.match(before) and not before.startswith("  ")
    return line.startswith("|") != before.startswith("|")


class Page:
    """A page of the repository, as the site has it. Faults are links that lead nowhere."""

    def __init__(self, path: str, linked: Callable[[str], None]) -> None:
        self.path = path
        self.text = (TOP / path).read_text(encoding="utf-8")
        self.faults: List[str] = []
        self._linked = linked  # is told every file that the page needs

    def _target(self, link: str) -> str:
        if re.match(r"[a-z]+:", link):
            return link
        path, mark, anchor = link.partition("#")
        target = posixpath.normpath(posixpath.join(posixpath.dirname(self.path), path)) if path else self.path
        if not (TOP / target).is_file():
            self.faults.append(f"{self.path}: {link}: there is no file {target}")
            return link
        if anchor and target.endswith(".md") and anchor not in anchors_of((TOP / target).read_text(encoding="utf-8")):
            self.faults.append(f"{self.path}: {link}: {target} has no such heading")
        if target != self.path:
            self._linked(target)
        there = posixpath.relpath(site_path(target), posixpath.dirname(site_path(self.path)) or ".")
        return (there if path else "") + mark + anchor

    def on_site(self) -> str:
        """Its Markdown for mkdocs: links of the site, anchors as code hosts have them, blank lines about lists and tables."""
        made: List[str] = []
        anchors = iter(anchors_of(self.text))
        fences = Fences()
        for line in self.text.splitlines():
            if fences.is_text(line):
                if made and _apart(line, made[-1]):
                    made.append("")
                line = with_links(line, self._target)
                if re.match(r"#+ ", line):
                    line += f" {{ #{next(anchors)} }}"
            made.append(line)
        return "\n".join(made) + "\n"


def title_of(text: str) -> str:
    for line in text.splitlines():
        if line.startswith("# "):
            return re.sub(r"[`*]", "", re.sub(r" \{ #.* \}$", "", line[2:]))
    return ""


def contents() -> List[Tuple[str, List[Tuple[str, str]]]]:
    """The parts of the book and their pages, (title, site path), in the order of its contents; the first part has no title."""
    parts: List[Tuple[str, List[Tuple[str, str]]]] = [("", [])]
    for line in (TOP / BOOK / "README.md").read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            parts.append((line[3:], []))
        for title, link in re.findall(r"\[([^\]]+)\]\(([^)\s#]+\.md)\)", line):
            if not link.startswith(".."):
                parts[-1][1].append((title, link))
    return parts


LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".py": "python", ".json": "json", ".yml": "yaml", ".cmake": "cmake"}


def source_page(path: str) -> str:
    """A file that is no page, as one."""
    text = (TOP / path).read_text(encoding="utf-8")
    language = LANGUAGES.get(posixpath.splitext(path)[1], "sh" if text.startswith("#!") else "text")
    return f"# {path}\n\n````{language}\n{text.rstrip()}\n````\n"


def place_of_image(path: str, taken: Dict[str, str]) -> Optional[str]:
    """Its site path, or None if another picture has it."""
    there = site_path(path)
    return there if taken.setdefault(there, path) == path else None
