"""Promises about layers in PostGIS."""

import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import tempfile
import time
import unittest

from postgis_case import SOURCE, TOOL, PostGisCase

PAGE = SOURCE / "docs/tasks/postgis.md"
TIMES = int(os.environ.get("D2B_KILLS", "10"))


class PostGis(PostGisCase):
    def expect_refused(self, expected, *options, status=1, **where):
        """Expects one sentence that holds the given text."""
        got, said = self.end(self.start(*options, **where))
        self.assertEqual(got, status, said)
        self.assertRegex(said, r"\AERROR: [^\n]+\.\n\Z")
        self.assertIn(expected, said)
        return said

    def content(self):
        return self.sql("SELECT count(*), sum(height) FROM buildings UNION ALL "
                        "SELECT count(*), sum(height) FROM contours")

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

    def test_new_layers_at_once_share_the_table_of_styles(self):
        self.sql("DROP TABLE layer_styles")
        for status, said in [self.end(run) for run in [self.start("-nln", f"town{i}") for i in range(4)]]:
            self.assertEqual((status, said), (0, ""))
        self.assertEqual(self.sql("SELECT count(*), count(DISTINCT f_table_name) FROM layer_styles WHERE useasdefault"),
                         "8|8")
        self.sql("DROP TABLE " + ", ".join(f"town{i}, town{i}_contours" for i in range(4)))

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

    def test_columns_say_what_they_hold_and_have_indices(self):
        for layer in self.once:
            silent = self.sql(f"SELECT attname FROM pg_attribute WHERE attrelid = '{layer}'::regclass AND attnum > 0 "
                              "AND NOT attisdropped AND col_description(attrelid, attnum) IS NULL")
            self.assertEqual(silent.split(), ["ogc_fid", "wkb_geometry"])
            indices = self.sql(f"SELECT indexdef FROM pg_indexes WHERE tablename = '{layer}'")
            self.assertRegex(indices, rf"CREATE UNIQUE INDEX \w+ ON public.{layer} USING btree \(id\)")
            self.assertIn("USING gist (wkb_geometry)", indices)
            self.assertEqual("USING btree (bldg_id)" in indices, layer == "contours")
        self.assertRegex(self.sql("SELECT col_description('buildings'::regclass, attnum) FROM pg_attribute WHERE "
                                  "attrelid = 'buildings'::regclass AND attname = 'area_m2'"), r"\(m2\): ")

    def test_names_of_other_programs_have_them_too(self):
        self.assertEqual(self.end(self.start("-overwrite", "-fields", "urock", "-layers", "buildings")), (0, ""))
        self.assertIn("CREATE UNIQUE INDEX", self.sql("SELECT indexdef FROM pg_indexes WHERE tablename = 'buildings'"))

    def test_names_that_are_laundered_are_replaced_and_added_to(self):
        expected = {"town-2026": "town_2026", "ort#1": "ort_1", "O'Hara": "o_hara", 'a "quote"': 'a "quote"',
                    "Town": "town", "b" * 54: "b" * 54, "c" * 60: "c" * 60, "d" * 80: None, "\u00e4" * 40: None,
                    "two words": "two words", "part (1)": "part _1_"}
        for name, table in expected.items():
            with self.subTest(name):
                before = set(self.sql("SELECT tablename FROM pg_tables WHERE schemaname = 'public'").split("\n"))
                counts = []
                for mode in ((), ("-overwrite",), ("-append",), ("-overwrite",)):
                    self.assertEqual(self.end(self.start(*mode, "-nln", name)), (0, ""))
                    made = sorted(set(self.sql("SELECT tablename FROM pg_tables WHERE schemaname = 'public'")
                                      .split("\n")) - before)
                    self.assertEqual(len(made), 2, made)
                    if table is not None:
                        self.assertIn(table, made)
                    counts.append([int(self.rows_and_ids('"' + one.replace('"', '""') + '"')[1]) for one in made])
                once = counts[0]
                self.assertEqual(sorted(once), sorted(self.once.values()))
                self.assertEqual(counts, [once, once, [2 * n for n in once], once])
                self.expect_refused("give -overwrite", "-nln", name, status=2)
                self.sql("DROP TABLE " + ", ".join('"' + one.replace('"', '""') + '"' for one in made))

    def test_what_cannot_be_is_refused_before_the_work(self):
        for database in ("plain", "closed"):
            self.sql(f"DROP DATABASE IF EXISTS {database}", database="postgres")
            self.sql(f"CREATE DATABASE {database}", database="postgres")
        self.sql("REVOKE CONNECT ON DATABASE closed FROM public", database="postgres")
        self.sql("DROP OWNED BY guest, guarded; DROP ROLE guest, guarded" if self.sql(
            "SELECT 1 FROM pg_roles WHERE rolname = 'guest'") else "SELECT 1")
        self.sql("CREATE ROLE guest LOGIN; CREATE ROLE guarded LOGIN PASSWORD 'right'")
        before = self.content()
        city = "dbname=city user="
        self.expect_refused('has a layer "buildings"; give -overwrite', status=2)
        self.expect_refused('its database cannot be reached (', words="dbname=nowhere user=planner")
        self.expect_refused('its database cannot be reached (', words="dbname=city user=planner port=1")
        self.expect_refused('its database cannot be reached (', words="dbname=closed user=guest")
        said = self.expect_refused('its database cannot be reached (', words=city + "guarded password=wrong")
        self.assertIn("password=...", said)
        self.assertNotIn("wrong", said)
        self.expect_refused("the database has no PostGIS", words="dbname=plain user=planner")
        self.expect_refused('there is no schema "nowhere" that its user may use',
                            words=city + "planner active_schema=nowhere")
        self.expect_refused("-lco SCHEMA: name the schema in the destination", "-lco", "SCHEMA=plans", status=2)
        self.expect_refused("-nln plans.mine: name the schema in the destination", "-nln", "plans.mine", status=2)
        self.expect_refused('its user "guest" may not make tables in schema "public"', "-nln", "mine",
                            words=city + "guest")
        self.expect_refused('its user "guest" may not replace layer "buildings"', "-overwrite", words=city + "guest")
        for granted in ("SELECT", "INSERT"):
            self.expect_refused('its user "guest" may not add to layer "buildings"', "-append", words=city + "guest")
            self.sql(f"GRANT {granted} ON buildings, contours TO guest")
        self.assertEqual(self.content(), before)

    def test_those_who_may_add_do(self):
        self.sql("DROP ROLE IF EXISTS adder")
        self.sql("CREATE ROLE adder LOGIN; GRANT SELECT, INSERT, UPDATE ON buildings, contours TO adder; "
                 "GRANT USAGE ON ALL SEQUENCES IN SCHEMA public TO adder")
        self.assertEqual(self.end(self.start("-append", words="dbname=city user=adder")), (0, ""))
        self.assertEqual(self.rows_and_ids("buildings"), [str(2 * self.once["buildings"])] * 2)
        self.sql("DROP OWNED BY adder; DROP ROLE adder")

    def test_a_lost_connection_changes_nothing(self):
        before = self.content()
        run = self.start("-overwrite", "-lod", "6")
        # Half way: its transaction has a number as soon as it has changed something.
        while self.sql("SELECT count(pg_terminate_backend(pid)) FROM pg_stat_activity WHERE application_name <> 'psql' "
                       "AND pid <> pg_backend_pid() AND backend_xid IS NOT NULL AND usename = 'planner'") == "0":
            self.assertIsNone(run.poll(), "it ended before it was cut off")
        status, said = self.end(run)
        self.assertEqual(status, 1)
        self.assertRegex(said, r"\AERROR: Cannot write [^\n]+\.\n\Z")
        self.assertEqual(self.content(), before)

    def test_files_that_do_not_fit_leave_the_layers(self):
        before = self.content()
        with tempfile.TemporaryDirectory() as folder:
            model = pathlib.Path(folder) / "city.glb"
            command = [TOOL, "-q", "-overwrite", "-lod", "6", "-surface", str(model), str(SOURCE / "sample_dems/town.tif"),
                       f"PG:host={self.folder} user=planner dbname=city"]
            run = subprocess.run(command, capture_output=True, text=True, preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_FSIZE, (20_000, 20_000)))
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertEqual(run.stderr, f'ERROR: Cannot write "{model}": File too large.\n')
            self.assertEqual(self.content(), before)
            self.assertEqual(os.listdir(folder), [])
            with open("/dev/full", "w") as full:
                run = subprocess.run([*command, "-json"], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertIn("Cannot write to stdout", run.stderr)
            self.assertEqual(self.content(), before)
            self.assertEqual(os.listdir(folder), [])
            self.assertEqual(subprocess.run(command).returncode, 0)
            self.assertNotEqual(self.content(), before)
            self.assertEqual(os.listdir(folder), ["city.glb"])

    def test_a_killed_run_leaves_the_old_content_or_the_new(self):
        old = self.content()
        start = time.monotonic()
        self.assertEqual(self.end(self.start("-overwrite", "-lod", "6")), (0, ""))
        seconds = time.monotonic() - start
        new = self.content()
        self.assertNotEqual(old, new)
        moments = random.Random(7)
        for i in range(TIMES):
            self.assertEqual(self.end(self.start("-overwrite")), (0, ""))
            run = self.start("-overwrite", "-lod", "6")
            time.sleep(seconds * moments.uniform(0.3, 1.05))
            run.send_signal(signal.SIGKILL)
            killed = run.wait() == -signal.SIGKILL
            run.stderr.close()
            self.assertIn(self.content(), (old, new) if killed else (new,))

    def test_the_commands_of_the_page(self):
        commands = re.findall(r"```sh postgis\n(.*?)```", PAGE.read_text(), re.S)
        self.assertGreater(len(commands), 5)
        subprocess.run([self.programs / "dropdb", "-h", self.folder, "-U", "planner", "--if-exists", "town"],
                       check=True)
        environment = {**os.environ, "PGHOST": str(self.folder), "PGUSER": "planner",
                       "PATH": f"{pathlib.Path(TOOL).parent}:{self.programs}:{os.environ['PATH']}"}
        for command in "".join(commands).splitlines():
            with self.subTest(command):
                done = subprocess.run(["sh", "-euc", command], cwd=SOURCE, env=environment, capture_output=True,
                                      text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
