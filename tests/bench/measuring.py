"""Runs whole processes by turns and keeps the time and memory of each."""
import json
import os
import statistics
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Contender:
    """A command that is measured; {out} in it is a file that is new each time."""
    name: str
    command: list
    out: Path
    repeats: int
    seconds: list = field(default_factory=list)
    processor: list = field(default_factory=list)  # seconds of all threads, which other work disturbs less
    mebibytes: list = field(default_factory=list)  # peak resident
    reports: list = field(default_factory=list)  # of `-json`

    def words(self):
        return [str(word).replace("{out}", str(self.out)) for word in self.command]

    def run(self):
        """Runs once, unmeasured. @return its output"""
        self.forget()
        done = subprocess.run(self.words(), stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(self.words())}\nfailed: {done.stderr or done.stdout}")
        return done.stdout

    def measure(self):
        """Runs once. Time is the wall clock's around the process, memory is the kernel's figure at its end, which
        /usr/bin/time -v prints as its maximum resident set size."""
        self.forget()
        log = self.out.with_suffix(".log")
        streams = [(os.POSIX_SPAWN_OPEN, 0, os.devnull, os.O_RDONLY, 0),
                   (os.POSIX_SPAWN_OPEN, 1, str(log), os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)]
        words = self.words()
        start = time.perf_counter()
        process = os.posix_spawnp(words[0], words, os.environ, file_actions=streams)
        _, status, usage = os.wait4(process, 0)
        self.seconds.append(time.perf_counter() - start)
        self.processor.append(usage.ru_utime + usage.ru_stime)
        self.mebibytes.append(usage.ru_maxrss / 1024)
        if status != 0:
            raise RuntimeError(f"{' '.join(words)} failed; see above.")
        text = log.read_text()
        if text.startswith("{"):
            self.reports.append(json.loads(text))
        log.unlink()
        self.forget()

    def forget(self):
        """Removes results, because data still to be written must not cost another's time."""
        self.out.unlink(missing_ok=True)
        for beside in self.out.parent.glob(self.out.name + ".*"):
            beside.unlink()

    def median(self):
        return statistics.median(self.seconds)

    def median_processor(self):
        return statistics.median(self.processor)

    def peak(self):
        return max(self.mebibytes)

    def stage(self, name):
        """Median seconds of a stage, of all threads together, by the contender's own report."""
        return statistics.median(report["stages"][name]["seconds"] for report in self.reports)


def run_alternating(contenders, say):
    """Every contender once a round, until each has had its repeats."""
    for turn in range(max((c.repeats for c in contenders), default=0)):
        for contender in contenders:
            if turn < contender.repeats:
                contender.measure()
                say(f"{turn + 1}/{contender.repeats} {contender.name}: {contender.seconds[-1]:.3f} s, "
                    f"{contender.mebibytes[-1]:.0f} MiB")
