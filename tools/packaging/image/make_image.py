#!/usr/bin/python3
"""Packs a folder as an image for containers: a tar of the OCI image layout, without a daemon.

    make_image.py <version> <root folder> <image.tar>

Docker 25 or later and podman load it. The same files give the same bytes.
"""

import gzip
import hashlib
import io
import json
import pathlib
import sys
import tarfile

BIN = "/opt/dem2buildings/bin"


def entry(name, size=0, mode=0o644, kind=tarfile.REGTYPE):
    info = tarfile.TarInfo(name)
    info.size, info.mode, info.type = size, mode, kind
    return info


def layer_of(root):
    """The folder as a tar, which belongs to root and has no times."""
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w", format=tarfile.GNU_FORMAT) as tar:
        for path in sorted(root.rglob("*")):
            name = path.relative_to(root).as_posix()
            mode = path.lstat().st_mode & 0o7777
            if path.is_symlink():
                link = entry(name, mode=0o777, kind=tarfile.SYMTYPE)
                link.linkname = str(path.readlink())
                tar.addfile(link)
            elif path.is_dir():
                tar.addfile(entry(name, mode=mode, kind=tarfile.DIRTYPE))
            else:
                content = path.read_bytes()
                tar.addfile(entry(name, len(content), mode), io.BytesIO(content))
    return data.getvalue()


def main(version, root, target):
    blobs = {}

    def blob(content, media_type):
        digest = hashlib.sha256(content).hexdigest()
        blobs[digest] = content
        return {"mediaType": media_type, "digest": f"sha256:{digest}", "size": len(content)}

    def document(value, media_type):
        return blob(json.dumps(value, sort_keys=True).encode(), media_type)

    layer = layer_of(pathlib.Path(root))
    packed = blob(gzip.compress(layer, mtime=0), "application/vnd.oci.image.layer.v1.tar+gzip")
    config = document({"architecture": "amd64", "os": "linux",
                       "config": {"Entrypoint": [f"{BIN}/dem2buildings"], "WorkingDir": "/data", "Env": [f"PATH={BIN}"]},
                       "rootfs": {"type": "layers", "diff_ids": [f"sha256:{hashlib.sha256(layer).hexdigest()}"]}},
                      "application/vnd.oci.image.config.v1+json")
    manifest = document({"schemaVersion": 2, "mediaType": "application/vnd.oci.image.manifest.v1+json",
                         "config": config, "layers": [packed]}, "application/vnd.oci.image.manifest.v1+json")
    manifest["annotations"] = {"io.containerd.image.name": f"docker.io/library/dem2buildings:{version}",
                               "org.opencontainers.image.ref.name": version}
    place = "blobs/sha256/"
    files = {f"{place}{digest}": content for digest, content in blobs.items()}
    files["index.json"] = json.dumps({"schemaVersion": 2, "manifests": [manifest]}, sort_keys=True).encode()
    files["oci-layout"] = b'{"imageLayoutVersion": "1.0.0"}'
    # The manifest for Docker, because it does not take the name from the index.
    files["manifest.json"] = json.dumps([{"Config": place + config["digest"][7:], "RepoTags": [f"dem2buildings:{version}"],
                                          "Layers": [place + packed["digest"][7:]]}]).encode()
    with tarfile.open(target, "w", format=tarfile.GNU_FORMAT) as tar:
        for name in ("blobs", "blobs/sha256"):
            tar.addfile(entry(name, mode=0o755, kind=tarfile.DIRTYPE))
        for name, content in sorted(files.items()):
            tar.addfile(entry(name, len(content)), io.BytesIO(content))


if __name__ == "__main__":
    main(*sys.argv[1:])
