# For .ci: an empty Debian in a folder, with the package sources of this machine. Read this file, as root.

# make_root suite folder
make_root() {
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | head -1)
    debootstrap --variant=minbase "$1" "$2" "$mirror" >/dev/null
    # mktemp -d keeps all others out, and in there are others: apt's user, that of PostgreSQL.
    chmod 755 "$2"
    # How packages are reached from here: proxies, certificates; not the settings that a package brings.
    for file in /etc/apt/apt.conf.d/*; do
        dpkg-query -S "$file" >/dev/null 2>&1 || cp "$file" "$2/etc/apt/apt.conf.d/"
    done
    cp /etc/resolv.conf "$2/etc/resolv.conf"
    for folder in /usr/local/share/ca-certificates /etc/ssl/certs; do
        if [ -d "$folder" ]; then
            mkdir -p "$2$folder"
            cp -rL "$folder/." "$2$folder/"
        fi
    done
    mount -t proc proc "$2/proc" || true
    mount -t devpts -o newinstance,ptmxmode=0666 devpts "$2/dev/pts" || true
}

# drop_root folder: other mounts there stay, because they are those of this machine
drop_root() {
    umount "$1/dev/pts" "$1/proc" 2>/dev/null || true
    rm -rf --one-file-system "$1"
}

# copy_source folder: the tracked files of this checkout, into /source there
copy_source() {
    mkdir "$1/source"
    git ls-files -z | xargs -0 cp --parents -t "$1/source"
}

# require_in_readme command: fails if the README does not have it, because users do only its commands
require_in_readme() {
    grep -qxE " *$1" README.md || { echo "README.md does not have the line: $1" >&2; exit 1; }
}
