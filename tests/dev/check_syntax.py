"""Has the compiler read every source of a configured build folder, without making anything of it: check_syntax.py <build folder>.

Many times quicker than a build, and it finds names and types that another version of a library has changed.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys


def check(entry):
    words = shlex.split(entry["command"])
    words[words.index("-o") + 1] = os.devnull
    return subprocess.run([*words, "-fsyntax-only"], cwd=entry["directory"], capture_output=True, text=True)


def main(folder):
    entries = json.loads((pathlib.Path(folder) / "compile_commands.json").read_text())
    # Leaves out sources that a build would make, and those of tests/headers, because all others include their headers.
    entries = [entry for entry in entries
               if pathlib.Path(entry["file"]).exists() and "/tests/headers/" not in entry["file"]]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for entry, result in zip(entries, pool.map(check, entries)):
            sys.stdout.write(result.stderr)
            if result.returncode != 0:
                failed += 1
                print(f"FAILED: {entry['file']}", flush=True)
    print(f"{len(entries)} sources were read, {failed} of them with errors")
    return 1 if failed or not entries else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
