#!/usr/bin/env python3
"""Measures how the sources of a folder read: measure_source.py [folder] (default: lib)

Prints the number of files and lines, the share of include, pragma and namespace lines, how often some words occur per
1,000 words of `//` comments, and the share of `///` comments in headers whose first word begins a clause.
"""

import collections
import pathlib
import re
import sys

SCAFFOLD = ("#include", "#pragma", "namespace ", "}  // namespace")
WORDS = ("what", "where", "of", "one", "because", "otherwise")
CLAUSE_WORDS = frozenset("what whether where of how that which as whose from to for in with".split())
COMMENT = re.compile(r"(?<!:)//[/!]?<?(.*)")
DOC_LINE = re.compile(r"\s*///(?!<)(.*)")
TRAILING_DOC = re.compile(r"///<(.*)")


def words_of(text):
    return [word.lower() for word in re.findall(r"[A-Za-z']+", text)]


def doc_beginnings(lines):
    """The first line of each `///` block, and each trailing `///<` comment, without a leading @param or @return."""
    inside = False
    for line in lines:
        doc, trailing = DOC_LINE.match(line), TRAILING_DOC.search(line)
        if doc and not inside or trailing:
            yield re.sub(r"^\s*@\w+\s*", "", (trailing or doc).group(1))
        inside = bool(doc)


def measure(folder):
    """A dict of figures, in the order in which they are printed."""
    texts = {path: path.read_text().splitlines() for path in sorted(folder.rglob("*")) if path.suffix in (".cpp", ".hpp")}
    lines = [line for text in texts.values() for line in text]
    comments = [comment.group(1) for comment in map(COMMENT.search, lines) if comment]
    counts = collections.Counter(word for comment in comments for word in words_of(comment))
    total = sum(counts.values())
    beginnings = [words_of(beginning) for path, text in texts.items() if path.suffix == ".hpp"
                  for beginning in doc_beginnings(text)]
    clauses = sum(1 for words in beginnings if words and words[0] in CLAUSE_WORDS)
    figures = {
        "files": len(texts),
        "lines": len(lines),
        "lines per file": round(len(lines) / max(1, len(texts)), 1),
        "include, pragma and namespace lines, %":
            round(100 * sum(line.strip().startswith(SCAFFOLD) for line in lines) / max(1, len(lines)), 1),
        "words of comments": total,
    }
    figures |= {f'"{word}" per 1,000 words': round(1000 * counts[word] / max(1, total), 1) for word in WORDS}
    figures["doc comments that begin with a clause, %"] = round(100 * clauses / max(1, len(beginnings)), 1)
    return figures


if __name__ == "__main__":
    for name, value in measure(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "lib")).items():
        print(f"{value:>8}  {name}")
