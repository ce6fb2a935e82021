#!/usr/bin/env python3
# Public API: compares the declarations of the public headers with the kept list, so that a change raises the version.
#
# public_api.py          exit status 1 if the headers and public_api.txt differ, or a public header includes a private one
# public_api.py --keep   writes public_api.txt, if compute/version.h was raised by what the change asks for
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
KEPT = pathlib.Path(__file__).with_suffix(".txt")


def public_headers():
    lines = (ROOT / "compute/public_headers.txt").read_text().splitlines()
    return [line for line in lines if line.endswith(".h")]


def without_comments(text):
    return re.sub(r'//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\])*")', lambda m: m.group(1) or " ", text, flags=re.S)


def closing(text, start):
    """The place behind the brace that closes the one at `start`."""
    depth = 0
    for i in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return i + 1
    raise ValueError("a brace is not closed")


def declarations(text):
    """One line each, with the scopes around it; bodies of functions and what is private are left out."""
    text = re.sub(r"(#define SCREE_VERSION_\w+) \d+", r"\1", without_comments(text))  # raising it changes no declaration
    found = [" ".join(line.split()) for line in re.findall(r"^#define (?:[^\n]*\\\n)*[^\n]*", text, flags=re.M)]
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.M)
    scopes, statement, parentheses, hidden, i = [], "", 0, [False], 0

    def tell():
        nonlocal statement
        words = " ".join(statement.split())
        if words and not hidden[-1]:
            found.append("::".join(scopes + [""]) + words)
        statement = ""

    while i < len(text):
        c = text[i]
        parentheses += {"(": 1, ")": -1}.get(c, 0)
        scope = re.match(r"\s*(?:template\s*<[^{;]*>\s*)?(namespace|struct|class|union)\b\s*(\[\[.*?\]\]\s*)?([\w:]*)[^(=]*$", statement)
        label = re.fullmatch(r"\s*(public|private|protected)\s*", statement)
        if c == ":" and label:
            hidden[-1] = hidden[-2] or label.group(1) == "private"
            statement = ""
        elif parentheses == 0 and c == "{" and scope:
            name = scope.group(3)
            if scope.group(1) != "namespace":
                tell()
            statement = ""
            scopes.append(name)
            hidden.append(hidden[-1])
        elif parentheses == 0 and c == "{" and "(" in statement and not re.search(r"=\s*$", statement):
            i = closing(text, i)  # a function
            statement = re.sub(r"\)\s*:[^:].*$", ")", statement, flags=re.S)
            tell()
            continue
        elif c == "{":
            end = closing(text, i)
            statement += text[i:end]
            i = end
            continue
        elif parentheses == 0 and c == "}":
            tell()
            scopes.pop()
            hidden.pop()
        elif parentheses == 0 and c == ";":
            tell()
        else:
            statement += c
        i += 1
    return found


def listed():
    lines = []
    for header in public_headers():
        lines += ["", header] + ["    " + one for one in declarations((ROOT / header).read_text())]
    return lines


def version():
    numbers = re.findall(r"#define SCREE_VERSION_\w+ (\d+)", (ROOT / "compute/version.h").read_text())
    return tuple(int(one) for one in numbers)


def faults_of_includes():
    headers = set(public_headers())
    for header in sorted(headers):
        for included in re.findall(r'#include "([^"]+)"', (ROOT / header).read_text()):
            if included not in headers:
                yield f"{header} includes {included}, which is not in compute/public_headers.txt"


def main():
    text = lambda number: ".".join(str(one) for one in number)
    faults = list(faults_of_includes())
    if f"project(scree VERSION {text(version())} " not in (ROOT / "CMakeLists.txt").read_text():
        faults.append(f"CMakeLists.txt has another version than compute/version.h, {text(version())}")
    now = listed()
    kept_lines = KEPT.read_text().splitlines() if KEPT.exists() else ["version 0.1.0"]
    kept_version = tuple(int(one) for one in kept_lines[0].split()[-1].split("."))
    kept = [re.sub(r"(#define SCREE_VERSION_\w+) \d+", r"\1", line) for line in kept_lines[1:]]
    gone = [one for one in kept if one not in set(now)]
    added = [one for one in now if one not in set(kept)]
    moved = not gone and not added and kept != now
    needed = kept_version
    if gone or moved:
        needed = (kept_version[0], kept_version[1] + 1, 0) if kept_version[0] == 0 else (kept_version[0] + 1, 0, 0)
    elif added:
        needed = (*kept_version[:2], kept_version[2] + 1) if kept_version[0] == 0 else (kept_version[0], kept_version[1] + 1, 0)
    if version() < needed:
        faults.append(f"the public API has changed since version {text(kept_version)}: raise compute/version.h from "
                      f"{text(version())} to {text(needed)}, then run tests/house/public_api.py --keep")
        faults += [f"  gone: {one.strip()}" for one in gone] + [f"  new: {one.strip()}" for one in added]
    if not faults and sys.argv[1:] == ["--keep"]:
        KEPT.write_text("\n".join([f"# The declarations of the public headers, kept by public_api.py: version {text(version())}"] + now) + "\n")
    elif not faults and (kept != now or kept_version != version()):
        faults.append("tests/house/public_api.txt is older than the headers: run tests/house/public_api.py --keep")
        faults += [f"  gone: {one.strip()}" for one in gone] + [f"  new: {one.strip()}" for one in added]
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
