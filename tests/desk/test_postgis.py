"""Several runs that write to one PostGIS, a server of its own on a socket in a temporary folder."""

import glob
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
TOOL = os.environ.get("D2B_TOOL", str(SOURCE / "build/tools/dem2buildings"))
TOWN = SOURCE / "sample_dems/town.tif"


class PostGis(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.programs = pathlib.Path(sorted(glob.glob("/usr/lib/postgresql/*/bin"))[-1])
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="d2b_postgis_"))
        # A server does not run as root.
        cls.user = "postgres" if os.geteuid() == 0 else None
        if cls.user:
            shutil.chown(cls.folder, cls.user)
        cls.serve("initdb", "-A", "trust", "-U", "planner", "-D", f"{cls.folder}/data")
        cls.serve("pg_ctl", "-w", "-D", f"{cls.folder}/data", "-l", f"{cls.folder}/log", "-o",
                  f"-c listen_addresses='' -c unix_socket_directories={cls.folder} -c fsync=off", "start")
        cls.sql("CREATE DATABASE city", database="postgres")
        cls.sql("CREATE EXTENSION postgis")

    @classmethod
    def tearDownClass(cls):
        cls.serve("pg_ctl", "-w", "-m", "fast", "-D", f"{cls.folder}/data", "stop")
        shutil.rmtree(cls.folder)

    @classmethod
    def serve(cls, program, *arguments):
        subprocess.run([cls.programs / program, *arguments], check=True, user=cls.user, cwd=cls.folder,
                       stdout=subprocess.DEVNULL)

    @classmethod
    def psql(cls, database="city"):
        return [cls.programs / "psql", "-h", cls.folder, "-U", "planner", "-d", database, "-X", "-q", "-A", "-t",
                "-v", "ON_ERROR_STOP=1"]

    @classmethod
    def sql(cls, statement, database="city"):
        return subprocess.run([*cls.psql(database), "-c", statement], check=True, capture_output=True,
                              text=True).stdout.strip()

    def start(self, mode):
        return subprocess.Popen([TOOL, "-q", "-f", "PostgreSQL", mode, str(TOWN),
                                 f"PG:host={self.folder} user=planner dbname=city"],
                                stderr=subprocess.PIPE, text=True)

    def end(self, run):
        """The status and what was said."""
        said = run.communicate(timeout=120)[1]
        return run.returncode, said

    def rows_and_ids(self, layer):
        return self.sql(f"SELECT count(*), count(DISTINCT id) FROM {layer}").split("|")

    def setUp(self):
        self.sql("DROP TABLE IF EXISTS buildings, contours CASCADE")
        self.assertEqual(self.end(self.start("-overwrite")), (0, ""))
        self.once = {layer: int(self.rows_and_ids(layer)[0]) for layer in ("buildings", "contours")}
        self.assertGreater(self.once["buildings"], 3)

    def test_appends_at_once_take_turns(self):
        for status, said in [self.end(run) for run in [self.start("-append") for _ in range(4)]]:
            self.assertEqual((status, said), (0, ""))
        for layer, once in self.once.items():
            self.assertEqual(self.rows_and_ids(layer), [str(5 * once)] * 2)
        self.assertEqual(self.sql("SELECT count(*) FROM contours WHERE bldg_id NOT IN (SELECT id FROM buildings)"),
                         "0")

    def test_another_who_writes_is_waited_for(self):
        other = subprocess.Popen([*self.psql(), "-c",
                                  "BEGIN; DELETE FROM buildings WHERE id = 1; SELECT pg_sleep(4); COMMIT"],
                                 stdout=subprocess.DEVNULL)
        time.sleep(1)
        start = time.monotonic()
        self.assertEqual(self.end(self.start("-append")), (0, ""))
        self.assertGreater(time.monotonic() - start, 2)
        self.assertEqual(other.wait(), 0)
        self.assertEqual(self.rows_and_ids("buildings"), [str(2 * self.once["buildings"] - 1)] * 2)

    def test_what_replacing_would_take_along_is_named(self):
        made = {"view": ("CREATE VIEW tall AS SELECT * FROM buildings WHERE height > 5", "DROP VIEW tall"),
                "trigger": ("CREATE TRIGGER tall BEFORE UPDATE ON buildings FOR EACH ROW EXECUTE FUNCTION "
                            "suppress_redundant_updates_trigger()", "DROP TRIGGER tall ON buildings"),
                "foreign key": ("CREATE TABLE owners (fid integer CONSTRAINT tall REFERENCES buildings (ogc_fid))",
                                "DROP TABLE owners")}
        for kind, (make, drop) in made.items():
            with self.subTest(kind):
                self.sql(make)
                status, said = self.end(self.start("-overwrite"))
                self.assertEqual(status, 2)
                self.assertIn(f'has a {kind} "tall" on layer "buildings", which -overwrite would break', said)
                self.assertEqual(said.count("\n"), 1)
                self.assertEqual(self.rows_and_ids("buildings"), [str(self.once["buildings"])] * 2)
                self.assertEqual(self.end(self.start("-append")), (0, ""))
                self.sql(drop)
                self.assertEqual(self.end(self.start("-overwrite")), (0, ""))


if __name__ == "__main__":
    unittest.main()
