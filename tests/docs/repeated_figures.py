#!/usr/bin/python3
"""Whether README.md repeats the counts of docs/accuracy.md: the places, and the buildings found in fine and in coarse cells.

    repeated_figures.py <source folder>

Prints each phrase that README.md lacks and ends with status 1. Needs nothing but Python.
"""

import pathlib
import re
import sys

FINE_M = 1


def rows(page):
    """The largest cell, the number of buildings found, and of all, in each row of the pooled table."""
    table = re.search(r"<!-- table pooled -->\n(.*?)<!-- end -->", page, re.S)[1]
    for line in table.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        size, counts = re.match(r"(?:[\d.]+ to )?([\d.]+) m ", cells[0]), re.match(r"([\d,]+) of ([\d,]+)", cells[2] if len(cells) > 2 else "")
        if size:
            yield float(size[1]), *(int(count.replace(",", "")) for count in counts.groups())


def phrases(page):
    """Words that README.md has to have."""
    yield re.search(r"\*\*all\*\* \((\w+ places)\)", page)[1].replace(" ", " real ")
    for fine in (True, False):
        some = [counts for size, *counts in rows(page) if (size <= FINE_M) == fine]
        found, all_of_them = map(sum, zip(*some))
        yield f"finds {100 * found / all_of_them:.0f} %"
        yield f"({found:,} of {all_of_them:,})"


def main(source):
    readme = " ".join((source / "README.md").read_text(encoding="utf-8").split())
    missing = [phrase for phrase in phrases((source / "docs/accuracy.md").read_text(encoding="utf-8")) if phrase not in readme]
    for phrase in missing:
        print(f"README.md does not have \"{phrase}\", which docs/accuracy.md counts")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
