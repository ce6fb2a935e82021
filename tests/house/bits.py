#!/usr/bin/env python3
# State hashes of every demo and trial, beside those on record.
"""The bits of every demo and trial on the CPU path, beside those on record (demos/records/hashes.txt):
tests/house/bits.py PROGRAM [--keep] [--row "SYSTEM | COMPILER"].

Exit status 1 where a hash differs from the one on record. --keep puts PROGRAM's hashes on record: after a change that is meant to
change bits. --row writes what was found into the table of demos/docs/evidence/platforms.md, with the digest of the record.
"""
import argparse
import hashlib
import json
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parents[2]
record = root / "demos/records/hashes.txt"
page = root / "demos/docs/evidence/platforms.md"
steps = 12  # of each scene
bodies = 300  # of scenes whose number of bodies is an option


def scenes_of(program):
    listed = subprocess.run([program, "list"], capture_output=True, text=True, check=True).stdout
    for line in listed.splitlines():
        words = line.split()
        if len(words) > 1 and words[0] not in ("demo", "trial"):
            yield words[0], ["--bodies", str(bodies)] if "--bodies" in words else []


def report_of(program, scene, options):
    done = subprocess.run([program, "run", scene, *options, "--backend", "cpu", "--threads", "2", "--steps", str(steps), "--quiet",
                           "--report", "-"], capture_output=True, text=True)
    try:
        return json.loads(done.stdout)
    except ValueError:
        said = done.stderr.strip().splitlines()
        return {"state_hash": f"no hash (exit status {done.returncode}{': ' + said[-1] if said else ''})"}


def on_record():
    lines = record.read_text().splitlines()
    return dict(line.split() for line in lines if line and not line.startswith("#"))


def digest():
    return hashlib.sha256(record.read_bytes()).hexdigest()[:8]


def keep(found):
    head = f"# State hashes of every demo and trial after {steps} steps, {bodies} bodies where that is an option: tests/house/bits.py.\n"
    record.write_text(head + "".join(f"{scene} {value}\n" for scene, value in found.items()))


# Takes the place of the row of the same system, compiler and lanes, or follows the last one.
def write_row(name, text):
    lines = page.read_text().splitlines()
    row = f"| {name} | {text} |"
    cells = lambda line: [cell.strip() for cell in line.strip("|").split("|")][:3]
    table = [k for k, line in enumerate(lines) if line.startswith("|")]
    for k in table:
        if cells(lines[k]) == cells(row):
            lines[k] = row
            break
    else:
        lines.insert(table[-1] + 1, row)
    page.write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--row")
    given = parser.parse_args()
    program = str(pathlib.Path(given.program).resolve())
    reports = {scene: report_of(program, scene, options) for scene, options in scenes_of(program)}
    found = {scene: report["state_hash"] for scene, report in reports.items()}
    if given.keep:
        if wrong := [f"{scene}: {value}" for scene, value in found.items() if not re.fullmatch("[0-9a-f]{16}", value)]:
            sys.exit("bits: nothing is kept: " + "; ".join(wrong))
        keep(found)
    known = on_record()
    wrong = [scene for scene, value in found.items() if known.get(scene) != value]
    for scene in wrong:
        print(f"{scene}: {found[scene]}; on record: {known.get(scene, 'none')}")
    if gone := [scene for scene in known if scene not in found]:
        print("on record alone: " + ", ".join(gone))
    print(f"{len(found) - len(wrong)} of {len(found)} scenes have the bits on record")
    if given.row:
        lanes = max(report.get("lanes", 0) for report in reports.values())
        agreed = f"{len(found) - len(wrong)} of {len(found)}" + (f" (not {', '.join(wrong)})" if wrong else "")
        write_row(f"{given.row} | {lanes}", f"{agreed} | {digest()}")
    sys.exit(1 if wrong or gone or not found else 0)


if __name__ == "__main__":
    main()
