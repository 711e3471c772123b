"""Requirements, and whether they are met."""
from dataclasses import dataclass
from typing import Callable

from contenders import SMALL


@dataclass
class Row:
    """A figure: ours beside one contender or the sum of several. None is asked for where it is only told."""
    what: str
    ours: object
    beside: list
    asked: float | None
    figure: Callable  # of the row
    at_least: bool = False
    unit: str = ""
    times: float = 1  # so many times as many points as beside

    def met(self):
        if self.asked is None:
            return None
        value = self.figure(self)
        return value >= self.asked if self.at_least else value <= self.asked

    def beside_seconds(self):
        return sum(contender.median() for contender in self.beside)


def processor_ratio(row):
    """The same by the processor's time, which other work on the machine disturbs less."""
    return row.ours.median_processor() / sum(contender.median_processor() for contender in row.beside) / row.times


def ratio(row):
    return row.ours.median() / row.beside_seconds() / row.times


def peak(row):
    return row.ours.peak() / 1024


def gain(row):
    return row.beside_seconds() / row.ours.median()


def peer_rows(bench):
    return [Row("thesis, 25 M : peer", bench.ours("thesis", 25), [bench.peer(25)], 0.28, ratio)]


def floor_rows(bench):
    return [Row(f"{preset}, 25 M : floor (read + write)", bench.ours(preset, 25),
                [bench.read(25), bench.write(preset, 25)], asked, ratio)
            for preset, asked in (("thesis", 1.2), ("default", 3.5))]


def linear_rows(bench):
    return [Row(f"{preset}, per point at 100 M : at 25 M", bench.ours(preset, 100), [bench.ours(preset, 25)], 1.15, ratio,
                times=4)
            for preset in ("thesis", "default")]


def memory_rows(bench, sizes=(25, 100)):
    return [Row(f"{preset}, {size} M, peak memory", bench.ours(preset, size), [], 2, peak, unit=" GiB")
            for size in sizes for preset in ("thesis", "default")]


def huge_rows(bench):
    return memory_rows(bench, [1000])


def thread_rows(bench):
    if not bench.has_threads():
        return []
    return [Row(f"{preset}, 25 M, 1 thread : 2 threads, next to nothing written", bench.unwritten(preset, 25, 2),
                [bench.unwritten(preset, 25, 1)], asked, gain, at_least=True)
            for preset, asked in (("thesis", 1.8), ("default", 1.85))]


def small_rows(bench):
    return [Row(f"{preset}, 242 x 249 : copy of the result", bench.ours(preset, SMALL),
                [bench.write(preset, SMALL)], 1.5, ratio)
            for preset in ("thesis", "default")]


EXTRAS = {"-surface city.obj": ["-surface", "{out}.obj"],
          "-surface city.obj -surface_of contours": ["-surface", "{out}.obj", "-surface_of", "contours"],
          "-page city.html": ["-page", "{out}.html"],
          "-preview city.png": ["-preview", "{out}.png"],
          "-write_ground g.tif -write_height h.tif": ["-write_ground", "{out}.g.tif", "-write_height", "{out}.h.tif"],
          "-layers buildings": ["-layers", "buildings"]}


def extra_rows(bench):
    """Rows of files beside the two layers, and of one layer alone."""
    plain = bench.ours("default", 25)
    return [Row(f"default with {words}, 25 M : without", bench.ours_with(words, options, 25), [plain], None, ratio)
            for words, options in EXTRAS.items()]


def city_rows(bench):
    """Real cities, where a folder of them is given."""
    return [Row(f"default, {city} : floor (read + write)", bench.ours("default", city),
                [bench.read(city), bench.write("default", city)], None, ratio)
            for city in bench.real]


ROWS = {"peer": peer_rows, "floor": floor_rows, "linear": linear_rows, "memory": memory_rows,
        "threads": thread_rows, "small": small_rows, "extras": extra_rows, "cities": city_rows}
