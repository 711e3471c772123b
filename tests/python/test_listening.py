"""While a run works: progress, Ctrl-C, warnings, and other threads of Python."""

import os
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

import numpy

import dem2buildings
from python_case import PLACE, SAMPLES, PythonCase, block, sample

TOWN = {"transform": (391000, 1, 0, 5821000, 0, -1), "crs": "EPSG:25833"}


def large():
    """Nine towns: some seconds of work."""
    return numpy.tile(sample("town"), (3, 3))


class Listening(PythonCase):
    def test_progress(self):
        shares = []
        threads = set()

        def listen(share):
            shares.append(share)
            threads.add(threading.get_ident())

        dem2buildings.extract(SAMPLES / "town.tif", progress=listen)
        self.assertEqual(shares, sorted(shares))
        self.assertGreater(len(shares), 2)
        self.assertGreaterEqual(shares[0], 0)
        self.assertEqual(shares[-1], 1)
        self.assertEqual(threads, {threading.get_ident()})

    def test_false_ends_the_run(self):
        begin = time.monotonic()
        with self.assertRaisesRegex(dem2buildings.Cancelled, "Cancelled"):
            dem2buildings.extract(large(), progress=lambda share: False, **TOWN)
        self.assertLess(time.monotonic() - begin, 5)

    def test_what_is_false_ends_the_run(self):
        shares = []
        for answer in (numpy.float32(0.5) < numpy.float32(0.2), numpy.array(False), 0):
            with self.subTest(answer=repr(answer)), self.assertRaises(dem2buildings.Cancelled):
                dem2buildings.extract(large(), progress=lambda share, answer=answer: shares.append(share) or answer, **TOWN)
        self.assertEqual(len(shares), 3)

    def test_who_ended_the_run_is_not_asked_again(self):
        shares = []

        def end_late(share):
            shares.append(share)
            time.sleep(0.3)
            return False

        with self.assertRaises(dem2buildings.Cancelled):
            dem2buildings.extract(large(), progress=end_late, **TOWN)
        self.assertEqual(len(shares), 1)

    def test_what_is_true_or_nothing_goes_on(self):
        for answer in (None, True, numpy.True_, 1, "on"):
            with self.subTest(answer=repr(answer)):
                dem2buildings.extract(block(), progress=lambda share, answer=answer: answer, **PLACE)

    def test_what_is_neither_true_nor_false_ends_the_run(self):
        with self.assertRaisesRegex(ValueError, "ambiguous"):
            dem2buildings.extract(block(), progress=lambda share: numpy.array([True, False]), **PLACE)

    def test_what_progress_raises_ends_the_run(self):
        calls = []

        def fail(share):
            calls.append(share)
            raise RuntimeError("no more")

        with self.assertRaisesRegex(RuntimeError, "no more"):
            dem2buildings.extract(large(), progress=fail, **TOWN)
        self.assertEqual(len(calls), 1)

    def test_control_c(self):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            dem2buildings.extract(large(), **TOWN)
        self.assertLess(time.monotonic() - begin, 5)
        timer.join()

    def test_others_go_on(self):
        counted = 0
        done = threading.Event()

        def count():
            nonlocal counted
            while not done.wait(0.001):
                counted += 1

        other = threading.Thread(target=count)
        other.start()
        try:
            dem2buildings.extract(SAMPLES / "town.tif", threads=1)
        finally:
            done.set()
            other.join()
        self.assertGreater(counted, 20)

    def test_two_at_a_time(self):
        alone = dem2buildings.extract(block(), **PLACE)
        results = [None] * 4

        def work(i):
            results[i] = dem2buildings.extract(block(), **PLACE)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            self.assertEqual(result.contours.wkb.tolist(), alone.contours.wkb.tolist())
            self.assertEqual(result.report["warnings"], [])

    def test_warnings_are_where_the_call_is(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found = dem2buildings.extract(numpy.zeros((20, 20)), **PLACE)
        self.assertEqual([str(warning.message) for warning in caught], found.report["warnings"])
        self.assertEqual(len(caught), 1)
        self.assertEqual(caught[0].filename, __file__)
        self.assertIs(caught[0].category, UserWarning)

    def test_a_warning_may_be_an_error(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaisesRegex(UserWarning, "same elevation"):
                dem2buildings.extract(numpy.zeros((20, 20)), **PLACE)

    def test_nothing_is_printed(self):
        program = "import dem2buildings, sys; dem2buildings.extract(sys.argv[1])"
        done = subprocess.run([sys.executable, "-c", program, str(SAMPLES / "town.tif")], capture_output=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))

    def test_errors(self):
        with self.assertRaisesRegex(dem2buildings.InputError, "nowhere.tif") as caught:
            dem2buildings.extract("nowhere.tif")
        self.assertIsInstance(caught.exception, dem2buildings.Error)
        self.assertEqual(type(caught.exception).__module__, "dem2buildings")
        with self.assertRaisesRegex(dem2buildings.OptionError, "^crs= EPSG:1 is not a coordinate reference system"):
            dem2buildings.extract(block(), crs="EPSG:1", transform=PLACE["transform"])


if __name__ == "__main__":
    unittest.main()
