#!/usr/bin/python3
"""Packs a built package of Python as a wheel, with the files in its folder, without another builder of wheels.

    make_wheel.py <version> <platform> <folder of the package> <folder of licences> <folder for the wheel>

Prints the name of the file. The same files give the same bytes.
"""

import base64
import hashlib
import pathlib
import sys
import zipfile

METADATA = """Metadata-Version: 2.1
Name: dem2buildings
Version: {version}
Summary: Building footprints from the elevation raster of a city
License: MIT, with the libraries in dem2buildings-{version}.dist-info/licenses
Requires-Python: =={python}.*
Requires-Dist: numpy
Classifier: License :: OSI Approved :: MIT License
Classifier: Operating System :: POSIX :: Linux
Classifier: Programming Language :: C++
Classifier: Programming Language :: Python :: 3
Classifier: Topic :: Scientific/Engineering :: GIS
Classifier: Typing :: Typed
"""

WHEEL = """Wheel-Version: 1.0
Generator: make_wheel.py of dem2buildings
Root-Is-Purelib: false
Tag: {tag}
"""

EPOCH = (1980, 1, 1, 0, 0, 0)


def files_of(folder, place):
    """Each file below the folder, by its name in the wheel."""
    return {f"{place}/{path.relative_to(folder).as_posix()}": path.read_bytes()
            for path in sorted(folder.rglob("*")) if path.is_file() and "__pycache__" not in path.parts}


def main(version, platform, package, licences, target):
    short = f"{sys.version_info.major}{sys.version_info.minor}"
    tag = f"cp{short}-cp{short}-{platform}"
    info = f"dem2buildings-{version}.dist-info"
    files = files_of(pathlib.Path(package), "dem2buildings")
    files.update(files_of(pathlib.Path(licences), f"{info}/licenses"))
    files[f"{info}/METADATA"] = METADATA.format(version=version, python=f"{sys.version_info.major}.{sys.version_info.minor}").encode()
    files[f"{info}/WHEEL"] = WHEEL.format(tag=tag).encode()
    lines = []
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(content)}\n")
    files[f"{info}/RECORD"] = ("".join(lines) + f"{info}/RECORD,,\n").encode()
    path = pathlib.Path(target) / f"dem2buildings-{version}-{tag}.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as wheel:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            wheel.writestr(entry, content)
    print(path)


if __name__ == "__main__":
    main(*sys.argv[1:])
