"""Changes of the site that mkdocs.yml cannot make.

- Pages outside docs/ that a page links to (CONTRIBUTING.md, ...) become pages in project/, other files are copied there.
- The marks of blocks that tests read, such as ```sh page, are those of languages.
- Nested lists are indented as Python-Markdown wants them.
- The interfaces of Python and C++ get a page each.
- Names of options are not broken at their hyphen, which happens on phones.
"""

import os
import pathlib
import posixpath
import re
import subprocess
import sys
import tempfile

from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import python_interface  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
OPTION = re.compile(r"<code>(--?[a-z0-9_]+)((?: [^<]*)?)</code>")
LINK = re.compile(r"(\]\()([A-Za-z0-9_./-]+)((?:#[^)\s]*)?\))")
PROJECT = "project/"
WORK = None  # a folder for files that are made, as long as the site is built


def in_repository(page):
    """Path below ROOT of a page of the site; "" for one that is made."""
    if page.startswith(PROJECT):
        return page[len(PROJECT):]
    return f"docs/{page}" if (ROOT / "docs" / page).exists() else ""


def in_site(path):
    """Place in the site of a path below ROOT."""
    if path.startswith("docs/"):
        return path[len("docs/"):]
    return PROJECT + (path if path.endswith(".md") else path + ".txt")


def linked(path):
    """The paths below ROOT that a Markdown file links to."""
    for _, target, _ in LINK.findall((ROOT / path).read_text(encoding="utf-8")):
        yield posixpath.normpath(posixpath.join(posixpath.dirname(path), target))


def outside(pages):
    """Files outside of docs/ that pages link to, directly or by one of them."""
    found = {"CHANGELOG.md"}
    seen = set()
    to_see = [*pages, *found]
    while to_see:
        page = to_see.pop()
        seen.add(page)
        for path in linked(page):
            if not path.startswith(("docs/", "..")) and path != "docs" and (ROOT / path).is_file():
                found.add(path)
                if path.endswith(".md") and path not in seen:
                    to_see.append(path)
    return found


def on_pre_build(config):
    global WORK
    WORK = tempfile.TemporaryDirectory()


def add(files, config, folder, path):
    files.append(File(path, str(folder), config["site_dir"], config["use_directory_urls"]))


def add_text(files, config, path, text):
    place = pathlib.Path(WORK.name) / "made" / path
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(text, encoding="utf-8")
    add(files, config, pathlib.Path(WORK.name) / "made", path)


def cpp_interface():
    """Runs Doxygen on the public headers. @return the folder that holds the folder cpp, and whether it ran"""
    folder = pathlib.Path(WORK.name) / "doxygen"
    folder.mkdir()
    settings = (pathlib.Path(__file__).parent / "Doxyfile").read_text(encoding="utf-8")
    settings += f"\nOUTPUT_DIRECTORY = {folder}\n"
    try:
        subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    except FileNotFoundError:
        return folder, False
    return folder, True


def on_files(files, config):
    pages = [f"docs/{file.src_uri}" for file in files.documentation_pages()]
    for path in sorted(outside(pages)):
        add_text(files, config, in_site(path), (ROOT / path).read_text(encoding="utf-8"))

    build = pathlib.Path(os.environ.get("D2B_BUILD", ROOT / "build"))
    stub = build / "tools/python/dem2buildings/__init__.pyi"
    if stub.exists():
        text = python_interface.PAGE
        source = pathlib.Path(WORK.name) / "python/dem2buildings/__init__.py"
        source.parent.mkdir(parents=True)
        source.write_text(python_interface.with_google_docstrings(stub.read_text(encoding="utf-8")), encoding="utf-8")
        config["plugins"]["mkdocstrings"].config["handlers"]["python"]["paths"] = [str(source.parents[1])]
    else:
        text = "# Interface of Python\n\nIt was not built: configure with `-D D2B_BUILD_PYTHON=ON`, build, and make the site again.\n"
    add_text(files, config, "reference/python_interface.md", text)

    folder, ran = cpp_interface()
    if ran:
        for path in sorted((folder / "cpp").rglob("*")):
            if path.is_file():
                add(files, config, folder, path.relative_to(folder).as_posix())
        text = ("# Interface of C++\n\n[Your own program on the C++ library](library.md) shows how it is used. Doxygen's pages:\n\n"
                "- [classes](../cpp/annotated.html)\n- [functions and types](../cpp/namespaced2b.html)\n"
                "- [headers](../cpp/files.html)\n")
    else:
        text = "# Interface of C++\n\nIt was not made: install Doxygen, and make the site again.\n"
    add_text(files, config, "reference/cpp_interface.md", text)
    add(files, config, pathlib.Path(__file__).parent, "site.css")
    return files


def indent_lists(text):
    """Indents the lines of an item of a list by four blanks, whatever the width of its mark."""
    lines = []
    width = 0
    fenced = False
    for line in text.split("\n"):
        if line.startswith("```"):
            fenced = not fenced
        mark = re.match(r"(?:[-*]|\d+\.) +", line)
        if mark and not fenced:
            width = len(mark.group())
        elif line.strip() and not line.startswith(" "):
            width = 0
        elif width and not fenced and line.startswith(" " * width):
            line = "    " + line[width:]
        lines.append(line)
    return "\n".join(lines)


def on_page_markdown(markdown, page, config, files):
    path = in_repository(page.file.src_uri)
    if not path:
        return markdown
    here = posixpath.dirname(page.file.src_uri)

    def link(match):
        target = posixpath.normpath(posixpath.join(posixpath.dirname(path), match.group(2)))
        if (ROOT / target).is_dir():
            if not (ROOT / target / "README.md").exists():
                return match.group(1) + "#" + ")"
            target += "/README.md"
        return match.group(1) + posixpath.relpath(in_site(target), here or ".") + match.group(3)

    markdown = LINK.sub(link, markdown)
    markdown = re.sub(r"\[([^]]*)\]\(#\)", r"\1", markdown)
    markdown = re.sub(r"^```output$", "```text", markdown, flags=re.M)
    markdown = re.sub(r"^```sh .*$", "```sh", markdown, flags=re.M)
    return indent_lists(markdown)


def on_page_content(html, page, config, files):
    return OPTION.sub(r'<code><span class="option">\1</span>\2</code>', html)


def on_post_build(config):
    WORK.cleanup()
