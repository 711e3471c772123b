"""One run of the program in a folder of its own, with limits of time and memory."""
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

RESULT = "out.gpkg"
MEMORY_KB = 4 << 20
SECONDS = 60
SECONDS_TO_STOP = 2  # after SIGTERM


@dataclass
class Run:
    name: str
    status: int  # below 0: the signal that ended it
    out: str
    err: str
    folder: Path
    seconds: float = 0
    too_long: bool = False  # it was asked to stop
    hangs: bool = False  # and did not
    left: list = field(default_factory=list)  # names of all that it left in its folder


def environment(base):
    """Files may name servers: none is waited for. Messages are those of a user, not of a developer."""
    impatient = {"GDAL_HTTP_CONNECTTIMEOUT": "1", "GDAL_HTTP_TIMEOUT": "1", "GDAL_HTTP_MAX_RETRY": "0"}
    return {**base, **impatient, "LC_ALL": "C"}


def wait(process, run):
    start = time.monotonic()
    try:
        run.out, run.err = process.communicate(timeout=SECONDS)
    except subprocess.TimeoutExpired:
        run.too_long = True
        process.send_signal(signal.SIGTERM)
        try:
            run.out, run.err = process.communicate(timeout=SECONDS_TO_STOP)
        except subprocess.TimeoutExpired:
            run.hangs = True
            process.kill()
            run.out, run.err = process.communicate()
    run.status = process.returncode
    run.seconds = time.monotonic() - start


def run_tool(tool, name, arguments, scratch, base_environment):
    """@return the run; its folder is there until the caller removes it"""
    folder = Path(tempfile.mkdtemp(dir=scratch))
    limited = ["sh", "-c", f'ulimit -v {MEMORY_KB}; ulimit -c 0; exec "$@"', "sh"]
    process = subprocess.Popen([*limited, str(tool), "-json", *map(str, arguments), RESULT], cwd=folder,
                               env=environment(base_environment), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True, errors="replace")
    run = Run(name, 0, "", "", folder)
    wait(process, run)
    run.left = sorted(path.name for path in folder.iterdir())
    return run
