# Whether the recipes of package managers can be read, and name options and files that are: tests/house/recipes.py.
import ast
import json
import re
import sys
from pathlib import Path

import yaml

TOP = Path(__file__).resolve().parent.parent.parent
RECIPES = TOP / ".github" / "recipes"
faults = []


def filled(path: Path) -> str:
    """As a release fills it in."""
    return re.sub(r"@[A-Z0-9_]+@", "0", path.read_text())


ast.parse(filled(RECIPES / "conan" / "conanfile.py"))
manifest = json.loads(filled(RECIPES / "vcpkg" / "vcpkg.json"))
plain = re.sub(r"\{%.*?%\}", "", re.sub(r"\{\{.*?\}\}", "x", filled(RECIPES / "conda-forge" / "meta.yaml")))
recipe = yaml.safe_load(plain)
for workflow in sorted((TOP / ".github" / "workflows").glob("*.yml")):
    yaml.safe_load(workflow.read_text())

known = set(re.findall(r"(?:option\(|set\()(SCREE_[A-Z0-9_]+)", "".join(f.read_text() for f in TOP.glob("**/CMakeLists.txt")
                                                                      if "build" not in f.parts)))
known |= {"SCREE_FONT"} if "find_file(SCREE_FONT" in (TOP / "host" / "CMakeLists.txt").read_text() else set()
for path in RECIPES.glob("*/*"):
    for option in set(re.findall(r"SCREE_[A-Z_]+", path.read_text())) - {"SCREE_BUILD_FOLDER"}:
        if option not in known:
            faults.append(f"{path.relative_to(TOP)}: {option} is no option of scree")
if {manifest["name"], recipe["package"]["name"]} != {"scree"}:
    faults.append("a recipe is of another name")
for name in ("LICENSE", "demos/python/setup.py", recipe["about"]["license_file"]):
    if not (TOP / name).exists():
        faults.append(f"{name} is not there")
print("\n".join(faults) or "recipes: can be read, and their options are scree's")
sys.exit(bool(faults))
