#!/usr/bin/env python3
# The binary interface of libscree: functions, structs and constants of scree.h, compared with those that are kept in abi.txt.
#
# abi.py CC LIBRARY          exit status 1 if one that is kept changed or went, if one is not kept, or if the library lacks one
# abi.py CC LIBRARY --keep   writes abi.txt, if what is kept there still is so
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
HEADER = HERE.parents[1] / "demos/c/scree.h"
KEPT = HERE / "abi.txt"
# Callers have these in arrays without a stride.
NEVER_GROW = ("scree_column", "scree_output", "scree_array", "scree_body")


def described():
    """Functions by name with their signature, structs with the names and types of their members, names of constants."""
    text = re.sub(r"/\*.*?\*/", " ", HEADER.read_text(), flags=re.S)
    constants = re.findall(r"^#define (SCREE_[A-Z_]+) \(", text, flags=re.M)
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.M)
    functions = {match[2]: " ".join(match[0].split()) for match in
                 re.findall(r"SCREE_API\s+(([^;]*?)\b(scree_\w+)\(.*?\));", text, flags=re.S)}
    structs = {}
    for body, name in re.findall(r"typedef struct \w+\s*\{(.*?)\}\s*(\w+);", text, flags=re.S):
        members = structs.setdefault(name, {})
        for declaration in filter(None, (" ".join(one.split()) for one in body.split(";"))):
            kind, names = re.fullmatch(r"((?:const )?\w+)\s*(.*)", declaration).groups()
            for one in names.split(","):
                stars, member, extents = re.fullmatch(r"\s*(\**)\s*(\w+)((?:\[\w+\])*)\s*", one).groups()
                members[member] = kind + stars + extents
    for body in re.findall(r"typedef enum \w+\s*\{(.*?)\}", text, flags=re.S):
        constants += re.findall(r"\b(SCREE_\w+)\s*=", body)
    callbacks = {name: " ".join(whole.split()) for whole, name in re.findall(r"typedef (\w+ \(\*(\w+)\)\(.*?\));", text, flags=re.S)}
    return functions, structs, constants, callbacks


def lines_of(compiler):
    functions, structs, constants, callbacks = described()
    lines = [f"function {text}" for text in functions.values()] + [f"callback {text}" for text in callbacks.values()]
    program = ['#include <stdio.h>\n#include "scree.h"\nint main(void) {']
    for name in constants:
        program.append(f'printf("constant {name} %lld\\n", (long long)(intptr_t)({name}));')
    for name, members in structs.items():
        program.append(f'printf("struct {name} %zu\\n", sizeof({name}));')
        for member, kind in members.items():
            program.append(f'printf("member {name}.{member} {kind} %zu\\n", offsetof({name}, {member}));')
    program.append("return 0; }")
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "abi.c"
        source.write_text("\n".join(program))
        subprocess.run([compiler, "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-I", str(HEADER.parent), str(source), "-o",
                        folder + "/abi"], check=True)
        lines += subprocess.run([folder + "/abi"], check=True, capture_output=True, text=True).stdout.splitlines()
    return sorted(lines), list(functions)


def changed(kept, now):
    """What callers of before would miss."""
    sizes = dict(line.split()[1:] for line in now if line.startswith("struct "))
    for line in kept:
        if line in now:
            continue
        words = line.split()
        if words[0] == "struct" and words[1] not in NEVER_GROW and int(sizes.get(words[1], 0)) > int(words[2]):
            continue
        yield line
    # A program of before leaves what was padding unset.
    before = dict(line.split()[1:] for line in kept if line.startswith("struct "))
    for line in now:
        if line.startswith("member ") and line not in kept:
            name = line.split()[1].split(".")[0]
            if int(line.split()[-1]) < int(before.get(name, 0)):
                yield line


def main():
    compiler, library, keep = sys.argv[1], sys.argv[2], "--keep" in sys.argv
    now, functions = lines_of(compiler)
    kept = [line for line in KEPT.read_text().splitlines() if not line.startswith("#")] if KEPT.exists() else []
    faults = [f"changed or gone, which breaks programs (raise SOVERSION, empty abi.txt): {line}" for line in changed(kept, now)]
    symbols = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    exported = {line.split()[-1] for line in symbols.splitlines()}
    faults += [f"declared, but not in the library: {name}" for name in sorted(set(functions) - exported)]
    faults += [f"in the library, but not declared: {name}" for name in sorted(exported - set(functions))]
    if keep and not faults:
        KEPT.write_text("# The binary interface of libscree, kept by abi.py: offsets and sizes of 64-bit processors.\n" + "\n".join(now) + "\n")
    elif not keep:
        faults += [f"not kept yet, run tests/c/abi.py {compiler} {library} --keep: {line}" for line in now if line not in kept]
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
