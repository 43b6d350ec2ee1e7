#!/usr/bin/env python3
"""Picks a figure out of statistics, as `celltrace --stats -` prints them.

    cell.sh --spes 4 | figure.py cycles render

docs/statistics.md says which there are. Without a name it lists those that are here.
"""
import json
import sys


def names(value, before=""):
    if isinstance(value, dict):
        for name, part in value.items():
            yield from names(part, f"{before} {name}".strip())
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        yield from names(value[0], before + " 0")  # the others have the same
    else:
        yield before


def main():
    text = sys.stdin.read()
    if not text:
        sys.exit(1)  # the program has said why
    value = json.loads(text)
    if len(sys.argv) == 1:
        print(*names(value), sep="\n")
        return
    for part in sys.argv[1:]:
        value = value[int(part) if part.isdigit() else part]
    print(value)


if __name__ == "__main__":
    main()
