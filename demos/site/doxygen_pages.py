# Pages of the C++ and C reference, from the XML that doxygen makes of the headers.
"""A page for each header: its opening comment, then what it declares, in its order, with links between types."""
import html
import posixpath
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Dict, List, Tuple

import book

Anchors = Dict[str, Tuple[str, str]]  # doxygen's name of a thing: its page and its anchor there


class Reference:
    """All that doxygen found."""

    def __init__(self, folder: Path) -> None:
        self.compounds: Dict[str, ET.Element] = {}
        self.anchors: Anchors = {}
        for file in sorted(folder.glob("*.xml")):
            found = ET.parse(file).getroot().find("compounddef")
            if found is not None:
                self.compounds[found.get("id", "")] = found
        self.headers: Dict[str, List[ET.Element]] = {}  # what each declares, in its order
        for compound in self.compounds.values():
            kind = compound.get("kind")
            if kind in ("class", "struct", "union") and self._is_whole(compound):
                self._place(compound)
            if kind in ("namespace", "file"):
                for member in compound.findall("sectiondef/memberdef"):
                    if member.get("kind") != "define" or "SCREE_INIT" in (member.findtext("name") or ""):
                        self._place(member)
        for declared in self.headers.values():
            declared.sort(key=lambda one: line_of(one))
        self._name_all()

    @staticmethod
    def _is_whole(compound: ET.Element) -> bool:
        """Without specialisations, and without what is declared alone."""
        location = compound.find("location")
        return location is not None and "<" not in (compound.findtext("compoundname") or "")

    def _place(self, thing: ET.Element) -> None:
        location = thing.find("location")
        declared = self.headers.setdefault(location.get("file", "") if location is not None else "", [])
        if all(one.get("id") != thing.get("id") for one in declared):
            declared.append(thing)

    def _name_all(self) -> None:
        for header, declared in self.headers.items():
            page = book.site_path(header)
            for thing in declared:
                name = name_of(thing)
                self.anchors[thing.get("id", "")] = (page, anchor(name))
                for member in thing.findall("sectiondef/memberdef"):
                    own = member.get("kind") in ("function", "enum")
                    self.anchors[member.get("id", "")] = (page, anchor(f"{name}::{member.findtext('name')}" if own else name))
                for value in (*thing.findall("enumvalue"), *thing.findall("sectiondef/memberdef/enumvalue")):
                    self.anchors[value.get("id", "")] = (page, anchor(name))


def line_of(thing: ET.Element) -> int:
    location = thing.find("location")
    return int(location.get("line", "0")) if location is not None else 0


def anchor(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9_]+", "-", name).strip("-") or "operator"


def escaped(text: str) -> str:
    """Plain text as Markdown."""
    return re.sub(r"([*\[\]<>~])", r"\\\1", text)


def name_of(thing: ET.Element) -> str:
    full = thing.findtext("compoundname") or thing.findtext("qualifiedname") or thing.findtext("name") or ""
    return re.sub(r"^scree::", "", full)


class HeaderPage:
    """The page of one header."""

    def __init__(self, reference: Reference, header: str) -> None:
        self.reference = reference
        self.header = header
        self.here = book.site_path(header)
        self.things = reference.headers.get(header, [])
        self.lines: List[str] = []
        self.headings: Dict[str, int] = {}

    # ---- text
    def link(self, refid: str, text: str) -> str:
        page, mark = self.reference.anchors.get(refid, ("", ""))
        if not page or mark == "operator":
            return text
        there = "" if page == self.here else posixpath.relpath(page, posixpath.dirname(self.here))[:-3] + ".html"
        return f'<a href="{there}#{mark}">{text}</a>'

    def inline(self, node: ET.Element) -> str:
        """A piece of text as HTML, with links."""
        made = html.escape(node.text or "", quote=False)
        for child in node:
            inner = self.inline(child)
            if child.tag == "ref":
                inner = self.link(child.get("refid", ""), inner)
            elif child.tag in ("computeroutput", "verbatim", "programlisting"):
                inner = f"<code>{inner}</code>"
            elif child.tag == "sp":
                inner = " "
            elif child.tag == "itemizedlist":
                inner = "<ul>" + "".join(f"<li>{self.inline(item)}</li>" for item in child) + "</ul>"
            made += inner + html.escape(child.tail or "", quote=False)
        return made.strip() if node.tag == "para" else made

    def described(self, thing: ET.Element) -> List[str]:
        """Its paragraphs, as HTML."""
        brief, more = ([text for text in map(self.inline, thing.findall(f"{tag}/para")) if text]
                       for tag in ("briefdescription", "detaileddescription"))
        if brief and more:  # doxygen cuts the first sentence off
            return [f"{brief[0]} {more[0]}", *brief[1:], *more[1:]]
        return brief + more

    def cell(self, thing: ET.Element) -> str:
        return " ".join(self.described(thing))

    def type_of(self, thing: ET.Element) -> str:
        node = thing.find("type")
        return re.sub(r"\s+", " ", self.inline(node)).strip() if node is not None else ""

    def heading(self, level: int, text: str, mark: str) -> None:
        """Overloads share one heading."""
        if mark in self.headings:
            return
        self.headings[mark] = level
        self.lines += ["", f"{'#' * level} {escaped(text)} {{ #{mark} }}", ""]

    def code(self, text: str) -> None:
        self.lines += ["", f'<pre class="signature"><code>{text}</code></pre>', ""]

    def prose(self, thing: ET.Element) -> None:
        for text in self.described(thing):
            self.lines += [f"<p>{text}</p>"]

    # ---- declarations
    def function(self, thing: ET.Element, level: int, owner: str) -> None:
        name = thing.findtext("name") or ""
        full = f"{owner}::{name}" if owner else name_of(thing)
        self.heading(level, name, anchor(full))
        parameters = []
        for parameter in thing.findall("param"):
            given = self.type_of(parameter)
            named = parameter.findtext("declname") or ""
            array = parameter.findtext("array") or ""
            default = parameter.find("defval")
            text = given.replace("(*)", f"(*{named})") if "(*)" in given else f"{given} {named}".strip()
            parameters.append(text + html.escape(array) + (f" = {self.inline(default)}" if default is not None else ""))
        head = f"{'static ' if thing.get('static') == 'yes' and owner else ''}{self.type_of(thing)} {html.escape(name)}".strip()
        template = thing.find("templateparamlist")
        if template is not None:
            names = ", ".join(f"{self.type_of(one)} {one.findtext('declname') or ''}".strip() for one in template.findall("param"))
            head = f"template &lt;{names}&gt;\n{head}"
        tail = " const" if thing.get("const") == "yes" else ""
        tail += " = 0" if thing.get("virt") == "pure-virtual" else ""
        joined = ", ".join(parameters)
        plain = re.sub(r"<[^>]+>", "", head + joined)
        inside = "\n    " + ",\n    ".join(parameters) if len(plain) > 90 and len(parameters) > 1 else joined
        self.code(f"{head}({inside}){tail};")
        self.prose(thing)

    def enum(self, thing: ET.Element, level: int, owner: str) -> None:
        name = thing.findtext("name") or ""
        if name:
            self.heading(level, f"enum {name}", anchor(f"{owner}::{name}" if owner else name_of(thing)))
        self.prose(thing)
        rows = [f"<tr><td><code>{value.findtext('name')}</code></td><td>{self.cell(value)}</td></tr>" for value in thing.findall("enumvalue")]
        self.lines += ["", "<table><thead><tr><th>value</th><th>meaning</th></tr></thead><tbody>", *rows, "</tbody></table>", ""]

    def fields(self, members: List[ET.Element]) -> None:
        rows = []
        defaults = any((member.findtext("initializer") or "= {}") != "= {}" for member in members)
        for member in members:
            start = member.find("initializer")
            value = re.sub(r"\s+", " ", self.inline(start)).strip() if start is not None else ""
            value = re.sub(r"^= ?", "", value)
            array = html.escape(member.findtext("argsstring") or "")
            rows.append(f"<tr><td><code>{member.findtext('name')}{array}</code></td><td><code>{self.type_of(member)}</code></td>"
                        + (f"<td>{f'<code>{value}</code>' if value and value != '{}' else ''}</td>" if defaults else "")
                        + f"<td>{self.cell(member)}</td></tr>")
        if rows:
            self.lines += ["", "<table><thead><tr><th>member</th><th>type</th>" + "<th>default</th>" * defaults +
                           "<th>meaning</th></tr></thead><tbody>", *rows, "</tbody></table>", ""]

    def compound(self, thing: ET.Element, level: int) -> None:
        name = name_of(thing)
        self.heading(level, f"{thing.get('kind')} {name}", anchor(name))
        bases = [self.link(base.get("refid", ""), html.escape(base.text or "")) for base in thing.findall("basecompoundref")]
        if bases:
            self.lines += [f"<p>Derives from {', '.join(bases)}.</p>"]
        self.prose(thing)
        members = [member for member in thing.findall("sectiondef/memberdef") if member.get("prot") != "private"]
        members.sort(key=line_of)
        self.fields([member for member in members if member.get("kind") == "variable"])
        for member in members:
            if member.get("kind") == "enum":
                self.enum(member, level + 1, name)
            if member.get("kind") == "function" and not (member.findtext("name") or "").startswith("operator"):
                self.function(member, level + 1, name)

    def other(self, thing: ET.Element, level: int) -> None:
        """A type's other name, a constant, a macro."""
        name = thing.findtext("name") or ""
        kind = re.sub("<[^>]*>", "", self.type_of(thing))
        if re.fullmatch(rf"(struct|enum) {name}", kind) and any(name_of(one) == name for one in self.things if one is not thing):
            return  # C's other name of what has a heading
        self.heading(level, name, anchor(name_of(thing)))
        if thing.get("kind") == "typedef":
            definition = thing.findtext("definition") or ""
            array = html.escape(thing.findtext("argsstring") or "")
            self.code(f"using {name} = {self.type_of(thing)};" if definition.startswith("using") else
                      f"typedef {self.type_of(thing)} {name}{array};" if "(*" not in self.type_of(thing) else
                      f"typedef {self.type_of(thing)}{name}{array};")
        elif thing.get("kind") == "variable":
            self.code(f"{self.type_of(thing)} {name} {html.escape(thing.findtext('initializer') or '')};")
        self.prose(thing)

    def text(self) -> str:
        language = "c" if self.header.endswith("scree.h") else "cpp"
        title = self.header.split("/")[-1] if language == "c" else self.header
        include = "scree.h" if language == "c" else f"scree/{self.header}"
        self.lines = [f"# {title}", "", *opening(self.header), "", f"```{language}", f"#include <{include}>", "```", ""]
        sections = sections_of(self.header)
        level = 3 if sections else 2
        for thing in self.things:
            while sections and line_of(thing) > sections[0][0]:
                self.heading(2, sections[0][1], "section-" + anchor(sections[0][1]).lower())
                sections.pop(0)
            if thing.tag == "compounddef":
                self.compound(thing, level)
            elif thing.get("kind") == "function":
                if not (thing.findtext("name") or "").startswith("operator"):
                    self.function(thing, level, "")
            elif thing.get("kind") == "enum":
                self.enum(thing, level, "")
            else:
                self.other(thing, level)
        return "\n".join(self.lines) + "\n"


def sections_of(header: str) -> List[Tuple[int, str]]:
    """Lines and titles of the parts into which comments divide scree.h."""
    lines = (book.TOP / header).read_text(encoding="utf-8").splitlines()
    return [(i, line[8:-3].strip()) for i, line in enumerate(lines, 1) if line.startswith("/* ---- ")]


def opening(header: str) -> List[str]:
    """The comment at the top of a header, as Markdown: its indented lines are code."""
    text = (book.TOP / header).read_text(encoding="utf-8")
    if text.startswith("/*"):
        lines = [re.sub(r"^ ?\*? ?", "", line) for line in text[2:text.index("*/")].splitlines()]
    else:
        lines = []
        for line in text.splitlines():
            if not line.startswith("//"):
                break
            lines.append(line[3:])
    made: List[str] = []
    code = False
    for line in lines:
        indented = line.startswith("    ") or (code and not line.strip())
        if indented != code:
            made += ["", "```cpp"] if indented else ["```", ""]
            code = indented
        made.append(line[4:] if code else html.escape(line, quote=False))
    return [*made, "```"] if code else made


def first_sentence(header: str) -> str:
    """Of its opening comment, as Markdown for a table."""
    words = " ".join(opening(header)).split("```")[0]
    return re.sub(r"\|", r"\\|", re.split(r"(?<=[.:]) ", words.strip() + " ")[0].strip().rstrip(":"))
