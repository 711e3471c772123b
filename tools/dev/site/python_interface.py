"""Makes Google-style docstrings, which mkdocstrings shows as tables, of those of the stub of the package for Python."""

import ast
import re

PAGE = """# Interface of Python

[From Python](../tasks/python.md) shows how to use it. `import dem2buildings` has these:

::: dem2buildings
"""

PARAMETER = re.compile(r"([a-z_]+(?:, [a-z_]+)*): ")


def described(block, section):
    """The lines of `name, name: text` as a section of Google's style, an entry per name."""
    entries = []
    for line in block:
        match = PARAMETER.match(line)
        if match:
            entries.append((match.group(1).split(", "), [line[match.end():]]))
        else:
            entries[-1][1].append("    " + line.strip())
    lines = [section]
    for names, text in entries:
        for name in names:
            lines.append(f"    {name}: {text[0]}")
            lines += ["    " + line for line in text[1:]]
    return lines


def options(block):
    """The lines below `Options:`, a name and a type and then the text, as Google's `name: text`. The signature has the type."""
    lines = ["Other Parameters:"]
    for line in block:
        match = re.match(r"    ([a-z_0-9]+): (.*)$", line)
        if match:
            lines.append(f"    {match.group(1)}:")
        elif re.match(r"    \w+:$", lines[-1]):
            lines[-1] += " " + line.strip()
        else:
            lines.append(line)
    return lines


def google(docstring, section):
    """A docstring without indentation in Google's style."""
    docstring = re.sub(r"(__\w+__)", r"`\1`", docstring)
    made = []
    for block in re.split(r"\n\s*\n", docstring.strip("\n")):
        lines = block.split("\n")
        if PARAMETER.match(lines[0]):
            lines = described(lines, section)
        elif lines[0].startswith("Options:"):
            lines = options(lines[1:])
        elif lines[0].startswith(">>>"):
            lines = ["Examples:", *("    " + line for line in lines)]
        made.append("\n".join(lines))
    return "\n\n".join(made)


def documented(stub):
    """Functions and classes with a docstring, from the last to the first."""
    found = [node for node in ast.walk(ast.parse(stub)) if isinstance(node, (ast.FunctionDef, ast.ClassDef))]
    return sorted((node for node in found if ast.get_docstring(node)), key=lambda node: -node.lineno)


def with_google_docstrings(stub):
    """The text of the stub with its docstrings in Google's style."""
    lines = stub.split("\n")
    for node in documented(stub):
        text = node.body[0]
        section = "Attributes:" if isinstance(node, ast.ClassDef) else "Args:"
        indent = " " * text.col_offset
        made = google(ast.get_docstring(node), section).split("\n")
        made = [indent + line if line else line for line in ['"""' + made[0], *made[1:], '"""']]
        lines[text.lineno - 1:text.end_lineno] = made
    return "\n".join(lines)
