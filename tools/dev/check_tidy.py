"""Runs clang-tidy over the library and the tools, a folder at a time: check_tidy.py <configured build folder>.

One source includes all sources of a folder, because most of the time goes into templates of the standard library, which
are otherwise checked again in each source. The analyzer, which takes as long as all other checks, is left to the preset
`tidy`.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

CHECKS = "-clang-analyzer-*,-bugprone-suspicious-include"  # the latter finds nothing but that .cpp files are included


def folders(root, entries):
    """Returns the entries of compile_commands.json per folder of lib/ and tools/."""
    found = {}
    for entry in entries:
        source = pathlib.Path(entry["directory"], entry["file"]).resolve()
        for top in (root / "lib", root / "tools"):
            if source.is_relative_to(top):
                found.setdefault(source.relative_to(root).parts[:2], []).append((source, entry))
    return found


def joined_command(entries, source):
    """Returns a command that compiles `source` with the definitions and include folders of all entries."""
    words = shlex.split(entries[0][1]["command"])
    for _, entry in entries[1:]:
        others = shlex.split(entry["command"])
        for i, word in enumerate(others):
            flag = ["-isystem", others[i + 1]] if word == "-isystem" else [word] if word[:2] in ("-I", "-D") else []
            if flag and flag[-1] not in words:
                words[1:1] = flag
    words[words.index("-c") + 1] = str(source)
    return shlex.join(words)


def main(build):
    build = pathlib.Path(build).resolve()
    root = pathlib.Path(__file__).resolve().parents[2]
    out = build / "tidy"
    out.mkdir(exist_ok=True)
    commands = []
    for name, entries in folders(root, json.loads((build / "compile_commands.json").read_text())).items():
        source = out / ("_".join(name) + ".cpp")
        source.write_text("".join(f'#include "{path}"\n' for path, _ in sorted(entries)))
        commands.append({"directory": entries[0][1]["directory"], "file": str(source),
                         "command": joined_command(entries, source), "size": sum(p.stat().st_size for p, _ in entries)})
    (out / "compile_commands.json").write_text(json.dumps(commands))

    def check(command):
        return command["file"], subprocess.run(
            ["clang-tidy", "-p", str(out), "--quiet", "--checks=" + CHECKS, command["file"]],
            capture_output=True, text=True)

    failed = False
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for file, result in pool.map(check, sorted(commands, key=lambda c: -c["size"])):
            if result.returncode != 0:
                failed = True
                print(f"{pathlib.Path(file).stem}:\n{result.stdout}{result.stderr}", flush=True)
    return 1 if failed or not commands else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
