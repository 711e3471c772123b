#!/usr/bin/python3
"""Whether pages for users are short enough: at most 6,000 bytes each, and at most 5 % of all sentences over 30 words.

    page_limits.py <source folder> [--list]

Users' pages are README.md (at most 5,000 bytes) and those of docs/, except docs/research, docs/design, docs/reference and
docs/developers. Code, tables and headings are not counted as sentences. --list prints the figures of each page and its long
sentences. Needs nothing but Python.
"""

import pathlib
import re
import sys

LARGEST = 6000
LARGEST_README = 5000
LONG = 30
SHARE = 0.05
OTHERS = ("research", "design", "reference", "developers")


def users_pages(source):
    docs = source / "docs"
    found = sorted(page for page in docs.rglob("*.md") if page.relative_to(docs).parts[0] not in OTHERS)
    return [source / "README.md", *found]


def paragraphs(text):
    """The running text of a page: paragraphs and items of lists, without marks."""
    text = re.sub(r"^```.*?^```$", "\n", text, flags=re.M | re.S)
    text = re.sub(r"<!--.*?-->", "\n", text, flags=re.S)
    text = re.sub(r"!\[[^]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)
    block = []
    for line in [*text.split("\n"), ""]:
        begins = re.match(r"\s*(?:[-*]|\d+\.) ", line)
        ends = not line.strip() or line.startswith(("#", "|", "    "))
        if (begins or ends) and block:
            yield " ".join(block)
            block = []
        if not ends:
            block.append(line[begins.end():] if begins else line.strip())


def sentences(text):
    for paragraph in paragraphs(text):
        # A full stop within a number, a name of a file or an abbreviation such as "Pingel et al." ends nothing.
        yield from re.split(r"(?<=[.!?])[*)\"]*\s+(?=[\"*(`]*[A-Z0-9`])", paragraph)


def words(sentence):
    return [word for word in sentence.split() if re.search(r"\w", word)]


def main(source, listed):
    faults = []
    count = 0
    long_ones = []
    for page in users_pages(source):
        text = page.read_text(encoding="utf-8")
        name = page.relative_to(source)
        size = len(text.encode())
        most = LARGEST_README if name.name == "README.md" and len(name.parts) == 1 else LARGEST
        if size > most:
            faults.append(f"{name} has {size} bytes; at most {most} are allowed: move a part to docs/reference or docs/research")
        here = list(sentences(text))
        long_here = [sentence for sentence in here if len(words(sentence)) > LONG]
        count += len(here)
        long_ones += [(name, sentence) for sentence in long_here]
        if listed:
            print(f"{size:6} bytes, {len(long_here):2} of {len(here):3} sentences over {LONG} words: {name}")
    print(f"{len(long_ones)} of {count} sentences have more than {LONG} words ({100 * len(long_ones) / count:.1f} %)")
    if listed:
        for name, sentence in long_ones:
            print(f"{name}: {len(words(sentence))} words: {sentence}")
    if len(long_ones) > SHARE * count:
        faults.append(f"more than {100 * SHARE:.0f} % of the sentences are long; --list shows them")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), "--list" in sys.argv[2:]))
