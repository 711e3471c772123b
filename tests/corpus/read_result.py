"""Content of a GeoPackage of ours, read without our own code: sqlite3 and ogrinfo (GEOS by way of SpatiaLite)."""
import math
import sqlite3
import struct
import subprocess
from dataclasses import dataclass

# SQLite keeps NaN as NULL, which is also "not known": fields that are always known may not be NULL. In the preset thesis there
# is no ground where nothing lies beside a building.
KNOWN = {"buildings": ["id", "roof", "n_points", "n_cells", "area_m2", "perim_m", "status"],
         "contours": ["id", "level", "threshold", "n_points", "elev_mean", "area_m2", "perim_m", "status"]}
KNOWN_BY_DEFAULT = ["ground", "height", "volume_m3"]


@dataclass
class Result:
    features: dict  # a layer's name: how many
    highest: float  # building in metres; 0 where there is none
    faults: list


def not_finite(value):
    return isinstance(value, float) and not math.isfinite(value)


def envelope_of(blob):
    """The box in the header of a geometry: 8 bytes, then minimum and maximum of x and y."""
    return struct.unpack_from("<4d" if blob[3] & 1 else ">4d", blob, 8)


def faults_of_rows(layer, columns, rows, preset):
    known = KNOWN.get(layer, []) + (KNOWN_BY_DEFAULT if (layer, preset) == ("buildings", "buildings") else [])
    faults = []
    for row in rows:
        feature = dict(zip(columns, row))
        where = f"{layer} {feature['id']}"
        faults += [f"{where}: {name} is {value}" for name, value in feature.items() if not_finite(value)]
        faults += [f"{where}: {name} is NULL" for name in known if feature.get(name) is None]
        if not feature["area_m2"] or feature["area_m2"] <= 0:
            faults.append(f"{where} has no area")
        if not all(map(math.isfinite, envelope_of(feature["geom"]))):
            faults.append(f"{where}: its box is not finite")
    return faults


def invalid(path, layer):
    """@return how many of a layer's polygons GEOS does not call valid"""
    statement = f'SELECT count(*) AS n FROM "{layer}" WHERE ST_IsValid(geom) IS NOT 1'
    listed = subprocess.run(["ogrinfo", "-q", "-nomd", "-ro", path, "-dialect", "SQLite", "-sql", statement], text=True,
                            capture_output=True, check=True).stdout
    return int(listed.rsplit("n (Integer) = ", 1)[1])


def read_result(path, preset):
    result = Result({}, 0, [])
    with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as file:
        for (layer,) in file.execute("SELECT table_name FROM gpkg_contents WHERE data_type = 'features'").fetchall():
            cursor = file.execute(f'SELECT * FROM "{layer}"')
            columns = [column[0] for column in cursor.description]
            rows = cursor.fetchall()
            result.features[layer] = len(rows)
            result.faults += faults_of_rows(layer, columns, rows, preset)
            if rows and (count := invalid(path, layer)):
                result.faults.append(f"{layer}: {count} polygons are not valid")
        (highest,) = file.execute("SELECT max(height) FROM buildings").fetchone()
        result.highest = highest or 0
    return result
