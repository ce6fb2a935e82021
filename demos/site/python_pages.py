# Pages of the Python reference, from the sources of the package: signatures, types, and what the docstrings say.
"""Reads the sources without importing them, so that nothing needs to be built."""
import ast
import html
import re
from typing import Dict, List, Optional, Tuple, Union

import book

PACKAGE = "demos/python/scree/"
MODULES = ("scene", "shapes", "joints", "world", "measures", "camera", "recording", "errors")
TITLES = {"scene": "Scenes", "shapes": "Shapes", "joints": "Joints", "world": "Worlds", "measures": "Measures",
          "camera": "Cameras and pictures", "recording": "Recordings", "errors": "Errors"}
Function = Union[ast.FunctionDef, ast.AsyncFunctionDef]


def offered() -> List[str]:
    """The names in __all__."""
    for node in ast.parse((book.TOP / PACKAGE / "__init__.py").read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__":
            return list(ast.literal_eval(node.value))
    raise ValueError(f"{PACKAGE}__init__.py has no __all__")


def plain(node: Optional[ast.AST]) -> str:
    return ast.unparse(node).replace("'_native.", "'").strip("'\"") if node is not None else ""


class ModulePage:
    """The page of one module."""

    def __init__(self, module: str, known: Dict[str, str]) -> None:
        self.module = module
        self.known = known  # the page of each class
        self.tree = ast.parse((book.TOP / PACKAGE / source_of(module)).read_text(encoding="utf-8"))
        self.lines: List[str] = []
        self.base_fields: Dict[str, List[Tuple[str, str, str]]] = {}

    def linked(self, code: str) -> str:
        """Code as HTML, with links to classes."""
        def link(word: "re.Match[str]") -> str:
            page = self.known.get(word[0])
            there = "" if page == self.module else f"{page}.html"
            return f'<a href="{there}#{word[0]}">{word[0]}</a>' if page else word[0]
        return re.sub(r"(?<![\w.\"])[A-Z]\w+", link, html.escape(code, quote=False))

    def signature(self, code: str) -> None:
        self.lines += ["", f'<pre class="signature"><code>{self.linked(code)}</code></pre>', ""]

    def prose(self, text: Optional[str]) -> None:
        """A docstring: what it says of parameters becomes a list."""
        if not text:
            return
        listed = False
        for line in text.splitlines():
            entry = re.match(r"([a-z_]+(?: \([^)]*\))?(?:, [a-z_]+(?: \([^)]*\))?)*): (?=\S)", line)
            if line.startswith("    "):
                if self.lines[-1].strip() and not self.lines[-1].startswith("    "):
                    self.lines.append("")
                self.lines.append(line)
            elif entry:
                if not listed:
                    self.lines.append("")
                self.lines.append(f"- {in_code(entry[1])}: {escaped(line[entry.end():])}")
                listed = True
            else:
                listed = listed and bool(line.strip())
                self.lines.append(("  " if listed else "") + escaped(line))
        self.lines.append("")

    def function(self, node: Function, level: int, owner: str) -> None:
        decorators = [plain(one) for one in node.decorator_list]
        if any(one.endswith(".setter") for one in decorators):
            return
        mark = f"{owner}.{node.name}" if owner else node.name
        arguments = ast.unparse(node.args)
        arguments = re.sub(r"^self(, )?", "", re.sub(r"^cls(, )?", "", arguments))
        returns = plain(node.returns)
        self.lines += ["", f"{'#' * level} {mark} {{ #{mark.replace('.', '-')} }}"]
        if "property" in decorators:
            settable = any(isinstance(one, ast.FunctionDef) and f"{node.name}.setter" in map(plain, one.decorator_list) for one in self.siblings)
            self.signature(f"{mark}: {returns}" + ("    # can be set" if settable else ""))
        else:
            prefix = owner + "." if owner else "scree."
            self.signature(wrapped(f"{prefix}{node.name}", node, arguments) + (f" -> {returns}" if returns else ""))
        self.prose(ast.get_docstring(node))

    def class_(self, node: ast.ClassDef) -> None:
        self.lines += ["", f"## {node.name} {{ #{node.name} }}"]
        own = [(one.target.id, plain(one.annotation), plain(one.value)) for one in node.body
               if isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name)]
        fields = [*(field for base in node.bases for field in self.base_fields.get(plain(base), [])), *own]
        self.base_fields[node.name] = fields
        self.siblings = node.body
        start = next((one for one in node.body if isinstance(one, ast.FunctionDef) and one.name == "__init__"), None)
        bases = [plain(base) for base in node.bases if plain(base) in self.known]
        if start is not None and "_native" not in ast.unparse(start.args):  # what users make
            arguments = re.sub(r"^self(, )?", "", ast.unparse(start.args))
            self.signature(wrapped(f"scree.{node.name}", start, arguments))
        elif fields:
            inside = ", ".join(f"{name}: {kind}" + (f" = {value}" if value and "field(" not in value else "") for name, kind, value in fields)
            self.signature(f"scree.{node.name}({inside})")
        if bases:
            self.lines += [f"<p>A {self.linked(', '.join(bases))}.</p>", ""]
        self.prose(ast.get_docstring(node))
        values = [one for one in node.body if isinstance(one, ast.Assign) and "IntEnum" in map(plain, node.bases)]
        if values:
            text = (book.TOP / PACKAGE / source_of(self.module)).read_text(encoding="utf-8").splitlines()
            rows = ["", "| value | meaning |", "|---|---|"]
            rows += [f"| `{plain(value.targets[0])}` | {text[value.lineno - 1].partition('# ')[2]} |" for value in values]
            self.lines += [*rows, ""]
        for one in node.body:
            if isinstance(one, ast.FunctionDef) and not one.name.startswith("_"):
                self.function(one, 3, node.name)

    def text(self) -> str:
        self.lines = [f"# scree: {TITLES[self.module].lower()}", ""]
        self.prose(ast.get_docstring(self.tree))
        names = offered()
        for node in self.tree.body:
            if isinstance(node, ast.ClassDef):
                if node.name in names:
                    self.class_(node)
                else:  # its fields are those of what derives from it
                    self.base_fields[node.name] = [(one.target.id, plain(one.annotation), plain(one.value)) for one in node.body
                                                   if isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name)]
            elif isinstance(node, ast.FunctionDef) and node.name in names:
                self.siblings = []
                self.function(node, 2, "")
        return "\n".join(self.lines) + "\n"


def escaped(line: str) -> str:
    """Text of a docstring as Markdown."""
    parts = re.split(r"(`[^`]+`)", line)
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(r"([*_\[\]<>])", r"\\\1", parts[i])
    return "".join(parts)


def wrapped(head: str, node: Function, arguments: str) -> str:
    """A long signature has a line for each argument."""
    if len(head) + len(arguments) < 90:
        return f"{head}({arguments})"
    pieces, depth, start = [], 0, 0
    for i, c in enumerate(arguments):
        depth += c in "([{"
        depth -= c in ")]}"
        if c == "," and depth == 0:
            pieces.append(arguments[start:i].strip())
            start = i + 1
    pieces.append(arguments[start:].strip())
    return f"{head}(\n    " + ",\n    ".join(pieces) + ")"


def source_of(module: str) -> str:
    return ("_" if module == "errors" else "") + module + ".py"


def pages() -> Dict[str, str]:
    """The text of each module's page, by module."""
    names = offered()
    known = {}
    for module in MODULES:
        for node in ast.parse((book.TOP / PACKAGE / source_of(module)).read_text(encoding="utf-8")).body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name in names:
                known[node.name] = module
    missing = [name for name in names if name not in known and name != "__version__"]
    if missing:
        raise ValueError(f"offered by scree, and on no page: {', '.join(missing)}")
    return {module: ModulePage(module, known).text() for module in MODULES}


def names_of(module: str) -> List[str]:
    """The names that a module offers."""
    tree = ast.parse((book.TOP / PACKAGE / source_of(module)).read_text(encoding="utf-8"))
    return [node.name for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name in offered()]


def in_code(names: str) -> str:
    """Names as code, their units as they are: `density` (kg/m^3), `friction`."""
    return re.sub(r"(?<![(\w])([a-z_]+)(?=,| \(|$)", r"`\1`", names)
