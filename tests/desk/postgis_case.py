"""A server of PostGIS of its own, on a socket in a temporary folder, and the program that writes to it."""

import glob
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
TOOL = os.environ.get("D2B_TOOL", str(SOURCE / "build/tools/dem2buildings"))
TOWN = SOURCE / "sample_dems/town.tif"


class PostGisCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.programs = pathlib.Path(sorted(glob.glob("/usr/lib/postgresql/*/bin"))[-1])
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="d2b_postgis_"))
        # A server does not run as root.
        cls.user = "postgres" if os.geteuid() == 0 else None
        if cls.user:
            shutil.chown(cls.folder, cls.user)
        cls.serve("initdb", "-A", "trust", "-U", "planner", "-D", f"{cls.folder}/data")
        rules = cls.folder / "data/pg_hba.conf"
        rules.write_text("local all guarded scram-sha-256\n" + rules.read_text())
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

    def start(self, *options, words="user=planner dbname=city", environment=None):
        """@param words of the destination, beside the server's folder"""
        return subprocess.Popen([TOOL, "-q", *options, str(TOWN), f"PG:host={self.folder} {words}"],
                                stderr=subprocess.PIPE, text=True, env={**os.environ, **(environment or {})})

    def end(self, run):
        """The status and the messages."""
        said = run.communicate(timeout=120)[1]
        return run.returncode, said
