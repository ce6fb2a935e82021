# Checks a built site: every link of every page leads to a file and an anchor of the site, and nothing is loaded from elsewhere.
"""check.py SITE: tells what is wrong, and ends with status 1 if anything is."""
import posixpath
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Dict, List, Set, Tuple
from urllib.parse import unquote

LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("video", "src"), ("audio", "src")}


class Seen(HTMLParser):
    """Anchors and links of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.anchors: Set[str] = {""}
        self.links: List[Tuple[str, bool]] = []  # and whether it is loaded with the page

    def handle_starttag(self, tag: str, attrs: "List[Tuple[str, str | None]]") -> None:
        given = {name: value or "" for name, value in attrs}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        for name, value in given.items():
            if (tag, name) in LOADED and given.get("rel") != "canonical":
                self.links.append((value, True))
            elif (tag, name) == ("a", "href"):
                self.links.append((value, False))


def faults_of(site: Path) -> List[str]:
    pages: Dict[str, Seen] = {}
    faults: List[str] = []
    for file in sorted(site.rglob("*.html")):
        name = file.relative_to(site).as_posix()
        if name.startswith("recordings/"):
            pages[name] = Seen()  # pages of their own
            continue
        text = file.read_text(encoding="utf-8")
        pages[name] = Seen()
        pages[name].feed(text)
    for name, page in pages.items():
        for link, loaded in page.links:
            if re.match(r"(https?:)?//", link):
                if loaded:
                    faults.append(f"{name}: loads {link}")
                continue
            if re.match(r"[a-z]+:", link) or (name == "404.html" and link.startswith("/")):
                continue
            path, _, anchor = link.partition("#")
            path, _, query = path.partition("?")
            target = posixpath.normpath(posixpath.join(posixpath.dirname(name), unquote(path))) if path else name
            if target in (".", ""):
                target = "index.html"
            scene = re.match(r"scene=([^&]*)", query)
            if not (site / target).is_file():
                faults.append(f"{name}: {link}: there is no {target}")
            elif scene and not (site / posixpath.dirname(target) / unquote(scene[1])).is_file():
                faults.append(f"{name}: {link}: there is no scene {scene[1]} beside {target}")
            elif target in pages and unquote(anchor) not in pages[target].anchors and not target.startswith("recordings/"):
                faults.append(f"{name}: {link}: {target} has no such anchor")
    for file in sorted(site.rglob("*.css")):
        if re.search(r"url\([\"']?(https?:)?//|@import", file.read_text(encoding="utf-8")):
            faults.append(f"{file.relative_to(site)}: loads from elsewhere")
    if len(pages) < 50:
        faults.append(f"the site has {len(pages)} pages alone")
    return faults


if __name__ == "__main__":
    found = faults_of(Path(sys.argv[1]))
    print("\n".join(found), end="\n" if found else "", file=sys.stderr)
    sys.exit(bool(found))
