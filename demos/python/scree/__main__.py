# python -m scree: the program's commands.
"""python -m scree run wall --frames out: the commands of the program scree, without its window."""
import ctypes
import os
import sys

from scree._library import LIBRARY


def main() -> int:
    words = [b"scree", *(os.fsencode(word) for word in sys.argv[1:])]
    return int(LIBRARY.scree_command(len(words), (ctypes.c_char_p * len(words))(*words)))


if __name__ == "__main__":
    sys.exit(main())
