# Mutants of files that scree reads: JSON by its structure, XML and text by values and lines, bytes by bits.

import copy
import json
import re
import struct

NUMBERS = [0, -0.0, 1, -1, 0.5, 2, 1e-3, 1e-7, 1e-12, 1e-30, 1e-45, 1e3, 1e5, 1e7, 1e12, 1e30, 3.4e38, 1e308, -1e6, 2**31, 2**32 - 1,
           2**53 + 1, 2**63, 2**64 - 1, 255, 65536, 0.1, 3.14159265, 1e-4]
WORDS = ["0", "-1", "1e30", "1e-30", "nan", "inf", "-inf", "1e400", "", "9999999999999999999", "0 0 0", "1 2 3 4 5 6 7 8 9", "true",
         "../../etc/passwd", "/dev/zero", "plane", "free", "main", "\x00", "\ud7ff", "0x7fffffff", "-0"]


def places(value, path=()):
    """All paths of a JSON value."""
    yield path
    if isinstance(value, dict):
        for key in value:
            yield from places(value[key], path + (key,))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from places(item, path + (index,))


def at(value, path):
    for key in path:
        value = value[key]
    return value


def other_number(random, old):
    kind = random.randrange(6)
    if kind == 0:
        return random.choice(NUMBERS)
    if kind == 1:
        return -old
    if kind == 2:
        return old * random.choice([1e-6, 1e-3, 0.1, 0.5, 2, 10, 1e3, 1e6])
    if kind == 3:
        return old + random.choice([-1, 1, 1e-6])
    if kind == 4:
        return random.uniform(-10, 10)
    return int(old) if abs(old) < 1e15 else 0


def other_value(random, value, root):
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        return other_number(random, value)
    if isinstance(value, str):
        return random.choice(WORDS + [value + "x", value[:-1]])
    if isinstance(value, list) and value:
        value = copy.deepcopy(value)
        kind = random.randrange(4)
        if kind == 0:
            value.pop(random.randrange(len(value)))
        elif kind == 1:
            value.insert(random.randrange(len(value) + 1), copy.deepcopy(random.choice(value)))
        elif kind == 2:
            random.shuffle(value)
        elif len(value) < 30:
            value = value * random.choice([2, 3])
        return value
    if isinstance(value, dict) and value:
        value = copy.deepcopy(value)
        key = random.choice(list(value))
        if random.random() < 0.5:
            del value[key]
        else:
            value[key] = copy.deepcopy(at(root, random.choice(list(places(root)))))
        return value
    return random.choice([None, 0, "", [], {}])


def json_mutant(random, text, changes=None):
    """Some values of a JSON text changed: mostly numbers, so that most mutants are still scenes."""
    root = json.loads(text)
    for _ in range(changes or random.choice([1, 1, 2, 3, 5])):
        paths = list(places(root))
        numbers = [path for path in paths if isinstance(at(root, path), (int, float)) and not isinstance(at(root, path), bool)]
        path = random.choice(numbers if numbers and random.random() < 0.75 else paths)
        if not path:
            continue
        parent = at(root, path[:-1])
        if random.random() < 0.1:  # the same kind of thing from elsewhere
            twins = [twin for twin in paths if twin and twin[-1] == path[-1]]
            parent[path[-1]] = copy.deepcopy(at(root, random.choice(twins)))
        else:
            parent[path[-1]] = other_value(random, parent[path[-1]], root)
    return json.dumps(root).encode("utf-8", "surrogatepass")


def text_mutant(random, data):
    """Values between quotes or blanks replaced, lines repeated, moved or cut."""
    text = data.decode("latin-1")
    for _ in range(random.choice([1, 1, 2, 4])):
        kind = random.randrange(6)
        values = [m.span() for m in re.finditer(r'(?<=["\s/])-?[0-9][0-9.eE+-]*(?=["\s/])', text)]
        if kind <= 2 and values:
            low, high = random.choice(values)
            try:
                new = repr(other_number(random, float(text[low:high])))
            except (ValueError, OverflowError):
                new = "1"
            text = text[:low] + random.choice([new, new, random.choice(WORDS)]) + text[high:]
        elif kind == 3:
            quoted = [m.span(1) for m in re.finditer(r'"([^"]*)"', text)]
            if quoted:
                (low, high), (from_, to) = random.choice(quoted), random.choice(quoted)
                text = text[:low] + random.choice([text[from_:to], random.choice(WORDS)]) + text[high:]
        else:
            lines = text.split("\n")
            place = random.randrange(len(lines))
            if kind == 4:
                lines[place:place + 1] = [lines[place]] * random.choice([0, 2, 3])
            else:
                lines.insert(place, random.choice(lines))
            text = "\n".join(lines)
    return text.encode("latin-1", "replace")


def byte_mutant(random, data):
    data = bytearray(data)
    for _ in range(random.choice([1, 1, 2, 4, 8])):
        if not data:
            break
        place = random.randrange(len(data))
        kind = random.randrange(6)
        if kind == 0:
            data[place] ^= 1 << random.randrange(8)
        elif kind == 1:
            data[place] = random.randrange(256)
        elif kind == 2:
            del data[place:place + random.randrange(1, 64)]
        elif kind == 3:
            data[place:place] = data[random.randrange(len(data)):][:random.randrange(1, 64)]
        elif kind == 4:
            place -= place % 4
            data[place:place + 4] = struct.pack("<I", random.choice([0, 1, 0x7F800000, 0x7FC00000, 0xFFFFFFFF, 0x80000000, 65536]))
        else:
            del data[place:]
    return bytes(data)

