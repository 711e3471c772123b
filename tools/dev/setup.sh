# For try.sh and test.sh, which read this file. Debian packages are installed where they are missing; on systems
# without apt-get, the installed packages have to do.

build_packages="g++ cmake make ninja-build libgdal-dev libgeos-dev libproj-dev libgeographiclib-dev libsqlite3-dev
    libboost-dev libboost-program-options-dev libeigen3-dev nlohmann-json3-dev pkgconf libcairo2-dev libpango1.0-dev"

# Packages to build dem2buildings_mesh; without them, all else is built.
mesh_packages="libcgal-dev"

# Packages to build -page.
page_packages="esbuild libjs-three"

# Packages to build and use the package for Python, and those of its tests and its page in docs/.
python_packages="python3-dev pybind11-dev python3-numpy"
python_test_packages="mypy python3-geopandas python3-matplotlib"

# Packages to build the site of docs/.
site_packages="mkdocs mkdocs-material mkdocstrings mkdocstrings-python-handlers doxygen"

# as_root command...: with sudo only where it is needed
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        echo "$0: to install packages, run this as root or install sudo" >&2
        return 1
    fi
}

# install_packages names...: does nothing, and asks for no rights, where all are there
install_packages() {
    command -v apt-get >/dev/null || return 0
    missing=""
    for package in "$@"; do
        case "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" in
            installed) ;;
            *) missing="$missing $package" ;;
        esac
    done
    [ -n "$missing" ] || return 0
    echo "Installing$missing"
    as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq
    # shellcheck disable=SC2086  # a list of words
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# configure cmake-options...: build/, Release unless it was configured by hand, with the options in D2B_CONFIGURE. Up to
# 16 sources of a folder are compiled as one, which takes a third of the time: most of it goes into the headers of the
# libraries.
configure() {
    # shellcheck disable=SC2086  # a list of words
    set -- "$@" ${D2B_CONFIGURE:-}
    if [ -e build/CMakeCache.txt ]; then
        cmake -S . -B build "$@"
    else
        cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
            -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 "$@"
    fi
}

build() {
    cmake --build build --parallel "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" "$@"
}
