"""measure_source_test.py <tools/dev/measure_source.py>: figures of two small files, counted by hand."""

import pathlib
import subprocess
import sys
import tempfile

HEADER = """#pragma once
#include <vector>
namespace d2b {
/// What is kept.
/// where it lies
struct Kept {
    int row;  ///< Row of the first cell, because "http://a" is not a comment.
};
/// @return the sum
int sum();
}  // namespace d2b
"""
SOURCE = """#include "kept.hpp"
int sum() { return 1; }  // one where
"""

with tempfile.TemporaryDirectory() as folder:
    pathlib.Path(folder, "kept.hpp").write_text(HEADER)
    pathlib.Path(folder, "sum.cpp").write_text(SOURCE)
    pathlib.Path(folder, "notes.txt").write_text("// what what\n")
    printed = subprocess.run([sys.executable, sys.argv[1], folder], check=True, capture_output=True, text=True).stdout
figures = dict(reversed(line.split(maxsplit=1)) for line in printed.splitlines())

# Comments: "What is kept" 3, "where it lies" 3, "Row of the first cell because http a is not a comment" 12,
# "return the sum" 3, "namespace d b" 3, "one where" 2.
expected = {
    "files": "2",
    "lines": "13",
    "lines per file": "6.5",
    "include, pragma and namespace lines, %": "38.5",
    "words of comments": "26",
    '"what" per 1,000 words': "38.5",
    '"where" per 1,000 words': "76.9",
    '"of" per 1,000 words': "38.5",
    '"one" per 1,000 words': "38.5",
    '"because" per 1,000 words': "38.5",
    '"otherwise" per 1,000 words': "0.0",
    "doc comments that begin with a clause, %": "33.3",
}
wrong = {name: (figures.get(name), value) for name, value in expected.items() if figures.get(name) != value}
sys.exit(f"printed and expected: {wrong}" if wrong else 0)
