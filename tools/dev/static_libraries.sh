#!/usr/bin/env bash
# Builds GDAL, PROJ, GEOS and their dependencies as static libraries from Debian's own source packages, with the formats of
# docs/install.md and no others: for the program for Windows, and for a wheel and an image that need no libraries of
# the system. On Debian 12, as root or with sudo.
#   static_libraries.sh windows|linux <folder>
# <folder>/sources gets the sources, <folder>/<system>/root the libraries. Existing parts are not built again.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/dev/setup.sh

system=$1
mkdir -p "$2/sources" "$2/$system/build" "$2/$system/root/lib"
folder=$(cd "$2" && pwd)
sources=$folder/sources
work=$folder/$system/build
root=$folder/$system/root
toolchain=$PWD/tools/dev/mingw.cmake
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
# A linker of the environment need not know Windows.
unset LDFLAGS

# shellcheck disable=SC2086  # a list of words
install_packages $build_packages dpkg-dev sqlite3 tcl xz-utils
# Coordinates do not depend on the processor: no fused multiply-add.
flags="-O2 -DNDEBUG -ffp-contract=off"
case $system in
    windows)
        install_packages gcc-mingw-w64-x86-64-posix g++-mingw-w64-x86-64-posix
        export ROOT_WINDOWS=$root
        c_compiler=x86_64-w64-mingw32-gcc-posix
        cxx_compiler=x86_64-w64-mingw32-g++-posix
        archiver=x86_64-w64-mingw32-ar
        # mingw-w64 lacks the library of these checks.
        flags="$flags -U_FORTIFY_SOURCE"
        target="-DCMAKE_TOOLCHAIN_FILE=$toolchain"
        ;;
    linux)
        c_compiler=gcc
        cxx_compiler=g++
        archiver="ar"
        # They are linked into a module of Python.
        flags="$flags -fPIC"
        target="-DCMAKE_FIND_ROOT_PATH=$root -DCMAKE_POSITION_INDEPENDENT_CODE=ON"
        ;;
    *)
        echo "$0: the system is windows or linux" >&2
        exit 2
        ;;
esac

# get_sources package...: unpacks source packages of Debian 12, with a list of sources of its own, because few systems have
# one for sources and theirs stays as it is.
get_sources() {
    local mirror suite options
    # shellcheck disable=SC2016  # a variable of apt-get
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | head -1)
    mkdir -p "$sources/apt/lists/partial"
    # Those of bookworm-security are missing on mirrors without its archive; point releases have the same patches.
    for suite in bookworm bookworm-updates; do
        echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main"
    done >"$sources/apt/sources.list"
    options=(-qq -o Dir::Etc::SourceList="$sources/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
        -o Dir::State::Lists="$sources/apt/lists" -o APT::Sandbox::User=root)
    apt-get "${options[@]}" update
    cd "$sources"
    apt-get "${options[@]}" source --download-only "$@"
    cd - >/dev/null
}

# unpack package: prints the folder
unpack() {
    local description=("$sources/$1"_*.dsc)
    test -e "$sources/$1" || dpkg-source --extract "${description[0]}" "$sources/$1" >/dev/null
    echo "$sources/$1"
}

# configure_library name folder options...
configure_library() {
    local name=$1 from=$2
    shift 2
    # shellcheck disable=SC2086  # options of CMake
    cmake -S "$from" -B "$work/$name" -G Ninja $target -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$root" \
        -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_PREFIX_PATH="$root" -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
        -DCMAKE_C_FLAGS_RELEASE="$flags" -DCMAKE_CXX_FLAGS_RELEASE="$flags" "$@"
}

# cmake_library name folder options...: configures, builds and installs
cmake_library() {
    configure_library "$@"
    cmake --build "$work/$1" --parallel "$jobs"
    cmake --install "$work/$1"
}

# compile_library name compiler options... -- sources...: for libraries of a few files, whose own builds ask for more
compile_library() {
    local name=$1 options=()
    shift
    while [ "$1" != -- ]; do
        options+=("$1")
        shift
    done
    shift
    mkdir -p "$work/$name"
    cd "$work/$name"
    # shellcheck disable=SC2016,SC2086  # $0 and the flags are words
    printf '%s\n' "$@" | xargs -P "$jobs" -I {} ${CMAKE_C_COMPILER_LAUNCHER:-} "${options[@]}" $flags -c {}
    "$archiver" rcs "$root/lib/lib$name.a" ./*.o
    cd - >/dev/null
}

build_zlib() {
    local from
    from=$(unpack zlib)
    compile_library z "$c_compiler" -D_LARGEFILE64_SOURCE=1 -DHAVE_UNISTD_H -- "$from"/{adler32,compress,crc32,deflate}.c \
        "$from"/{gzclose,gzlib,gzread,gzwrite,infback,inffast,inflate,inftrees,trees,uncompr,zutil}.c
    cp "$from/zlib.h" "$from/zconf.h" "$root/include/"
}

build_zstd() {
    cmake_library zstd "$(unpack libzstd)/build/cmake" -DZSTD_BUILD_PROGRAMS=OFF -DZSTD_BUILD_SHARED=OFF \
        -DZSTD_MULTITHREAD_SUPPORT=OFF -DZSTD_LEGACY_SUPPORT=OFF
}

build_expat() {
    # Debian's patches ask if XML_DTD is 1, while expat's own CMake defines it as nothing.
    flags="$flags -DXML_DTD=1" cmake_library expat "$(unpack expat)/expat" -DEXPAT_DTD=OFF -DEXPAT_SHARED_LIBS=OFF \
        -DEXPAT_BUILD_TOOLS=OFF -DEXPAT_BUILD_EXAMPLES=OFF -DEXPAT_BUILD_TESTS=OFF -DEXPAT_BUILD_DOCS=OFF
}

build_sqlite() {
    local from
    from=$(unpack sqlite3)
    mkdir -p "$work/sqlite"
    cd "$work/sqlite"
    "$from/configure" --disable-tcl --disable-readline >/dev/null
    make sqlite3.c sqlite3.h >/dev/null
    cd - >/dev/null
    # Compiles SQLite as Debian does in features that results can show, because existing GeoPackages may use them.
    compile_library sqlite3 "$c_compiler" -DSQLITE_THREADSAFE=1 -DSQLITE_ENABLE_RTREE -DSQLITE_ENABLE_COLUMN_METADATA \
        -DSQLITE_ENABLE_MATH_FUNCTIONS -DSQLITE_ENABLE_FTS3 -DSQLITE_ENABLE_FTS3_PARENTHESIS -DSQLITE_ENABLE_FTS3_TOKENIZER \
        -DSQLITE_ENABLE_FTS4 -DSQLITE_ENABLE_FTS5 -DSQLITE_SECURE_DELETE -DSQLITE_USE_URI -DSQLITE_MAX_VARIABLE_NUMBER=250000 \
        -- "$work/sqlite/sqlite3.c"
    cp "$work/sqlite/sqlite3.h" "$from/src/sqlite3ext.h" "$root/include/"
}

build_geographiclib() {
    local from
    from=$(unpack geographiclib)
    # Leaves out its 20 programs, because there is no switch for them.
    configure_library geographiclib "$from" -DBUILD_BOTH_LIBS=OFF -DBUILD_DOCUMENTATION=OFF
    cmake --build "$work/geographiclib" --parallel "$jobs" --target GeographicLib_STATIC
    find "$work/geographiclib" -name libGeographicLib.a -exec cp '{}' "$root/lib/" ';'
    mkdir -p "$root/include/GeographicLib"
    cp "$from"/include/GeographicLib/*.hpp "$work/geographiclib/include/GeographicLib/Config.h" "$root/include/GeographicLib/"
}

# compile_batch sources...: as one, which takes a fifth of the time; each alone where their names clash. The rest is in
# the environment: the compiler with its flags, and the folder of the objects.
compile_batch() {
    local source batch
    batch=$(printf '%s' "$1" | sha256sum | cut -c 1-12)
    printf '#include "%s"\n' "$@" >"$objects/$batch.cpp"
    # shellcheck disable=SC2086  # a command with its arguments
    $compile -c "$objects/$batch.cpp" -o "$objects/$batch.o" 2>/dev/null && return
    rm -f "$objects/$batch.o"
    for source; do
        # shellcheck disable=SC2086  # as above
        $compile -c "$source" -o "$objects/$batch.$(basename "$source").o" || return 1
    done
}

build_geos() {
    local from source
    from=$(unpack geos)
    configure_library geos "$from" -DBUILD_GEOSOP=OFF -DBUILD_BENCHMARKS=OFF -DBUILD_DOCUMENTATION=OFF
    export compile="${CMAKE_CXX_COMPILER_LAUNCHER:-} $cxx_compiler $flags -std=c++11 -DUSE_UNSTABLE_GEOS_CPP_API"
    compile="$compile -I $from/include -I $work/geos/include -I $work/geos/capi -I $from/src/deps"
    export objects=$work/geos/objects
    export -f compile_batch
    mkdir -p "$objects" "$work/geos/lib"
    find "$from/src" -name '*.cpp' | sort | xargs -P "$jobs" -n 10 bash -euc 'compile_batch "$@"' _
    # shellcheck disable=SC2086  # words
    $c_compiler $flags -c "$from/src/deps/ryu/d2s.c" -I "$from/src/deps" -o "$objects/d2s.o"
    "$archiver" rcs "$work/geos/lib/libgeos.a" "$objects"/*.o
    for source in geos_c geos_ts_c; do
        # shellcheck disable=SC2086  # words
        $compile -c "$from/capi/$source.cpp" -o "$work/geos/$source.o"
    done
    "$archiver" rcs "$work/geos/lib/libgeos_c.a" "$work"/geos/geos*_c.o
    cmake --install "$work/geos"
}

build_proj() {
    # Optimises less to compile faster, because the program waits for little of PROJ but its database.
    flags="${flags/-O2/-O1}" cmake_library proj "$(unpack proj)" -DENABLE_CURL=OFF -DENABLE_TIFF=OFF -DBUILD_APPS=OFF -DBUILD_PROJSYNC=OFF \
        -DSQLITE3_INCLUDE_DIR="$root/include" -DSQLITE3_LIBRARY="$root/lib/libsqlite3.a" -DEXE_SQLITE3=/usr/bin/sqlite3
}

build_gdal() {
    local driver drivers=()
    for driver in GDAL_ENABLE_DRIVER_AAIGRID GDAL_ENABLE_DRIVER_JPEG OGR_ENABLE_DRIVER_GPKG OGR_ENABLE_DRIVER_SQLITE \
        OGR_ENABLE_DRIVER_FLATGEOBUF OGR_ENABLE_DRIVER_CSV OGR_ENABLE_DRIVER_DXF; do
        drivers+=("-D$driver=ON")
    done
    for library in TIFF GEOTIFF JPEG JSONC LERC; do
        drivers+=("-DGDAL_USE_${library}_INTERNAL=ON")
    done
    for library in ZLIB ZSTD EXPAT SQLITE3 GEOS; do
        drivers+=("-DGDAL_USE_$library=ON")
    done
    # Several files as one, in those targets of GDAL where names do not clash if CPL_CVSID is empty.
    cat >"$work/gdal_unity.cmake" <<'END'
cmake_language(DEFER DIRECTORY ${CMAKE_SOURCE_DIR} CALL set_target_properties cpl gcore gcore_mdreader alg ogr ogrsf_generic
    appslib gdal_vrt gdal_GTIFF ogr_GeoPackage ogr_SQLite ogr_FlatGeobuf ogr_geojson ogr_KML ogr_CSV ogr_TAB ogr_VRT
    ogr_MEM ogr_Shape gdal_HFA PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
cmake_language(DEFER DIRECTORY ${CMAKE_SOURCE_DIR} CALL set_source_files_properties ${CMAKE_SOURCE_DIR}/gcore/gdal_misc.cpp
    ${CMAKE_SOURCE_DIR}/gcore/gdaldefaultoverviews.cpp ${CMAKE_SOURCE_DIR}/ogr/ogrlinestring.cpp TARGET_DIRECTORY gcore ogr PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
END
    flags="$flags -DDISABLE_CVSID" cmake_library gdal "$(unpack gdal)" -DCMAKE_PROJECT_INCLUDE="$work/gdal_unity.cmake" -DBUILD_APPS=OFF -DBUILD_PYTHON_BINDINGS=OFF -DBUILD_JAVA_BINDINGS=OFF \
        -DBUILD_CSHARP_BINDINGS=OFF -DENABLE_GNM=OFF -DGDAL_USE_EXTERNAL_LIBS=OFF -DGDAL_USE_INTERNAL_LIBS=OFF \
        -DGDAL_BUILD_OPTIONAL_DRIVERS=OFF -DOGR_BUILD_OPTIONAL_DRIVERS=OFF "${drivers[@]}" \
        -DZLIB_INCLUDE_DIR="$root/include" -DZLIB_LIBRARY="$root/lib/libz.a" \
        -DSQLite3_INCLUDE_DIR="$root/include" -DSQLite3_LIBRARY="$root/lib/libsqlite3.a" \
        -DACCEPT_MISSING_SQLITE3_RTREE=ON -DACCEPT_MISSING_SQLITE3_MUTEX_ALLOC=ON \
        -DPROJ_DIR="$root/lib/cmake/proj" -DPROJ_INCLUDE_DIR="$root/include"
    # Adds it, because find_package() of the static GDAL ends with an unknown command otherwise.
    sed -i '1i include(CMakePushCheckState)' "$root/lib/cmake/gdal/packages/FindSQLite3.cmake"
}

build_boost() {
    local archive
    archive=("$sources"/boost1.74_*.orig.tar.xz)
    # One of its libraries, of 150.
    mkdir -p "$sources/boost1.74"
    tar -xf "${archive[0]}" -C "$sources/boost1.74" --strip-components 1 --wildcards '*/libs/program_options/src'
    ln -sfn /usr/include/boost "$root/include/boost"
    compile_library boost_program_options "$cxx_compiler" -I "$root/include" -- \
        "$sources"/boost1.74/libs/program_options/src/{cmdline,config_file,convert,options_description,parsers}.cpp \
        "$sources"/boost1.74/libs/program_options/src/{positional_options,split,utf8_codecvt_facet,value_semantic,variables_map}.cpp
    # That of the system names its own libraries.
    mkdir -p "$root/lib/cmake/Boost"
    cat >"$root/lib/cmake/Boost/BoostConfig.cmake" <<'END'
if(NOT TARGET Boost::headers)
  get_filename_component(boost_root "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
  add_library(Boost::headers INTERFACE IMPORTED)
  target_include_directories(Boost::headers INTERFACE "${boost_root}/include")
  add_library(Boost::program_options STATIC IMPORTED)
  set_target_properties(Boost::program_options PROPERTIES
    IMPORTED_LOCATION "${boost_root}/lib/libboost_program_options.a" INTERFACE_LINK_LIBRARIES Boost::headers)
endif()
END
    echo 'set(PACKAGE_VERSION 1.74.0)
set(PACKAGE_VERSION_COMPATIBLE TRUE)' >"$root/lib/cmake/Boost/BoostConfigVersion.cmake"
}

# Headers that are the same on all systems.
build_headers() {
    local config
    ln -sfn /usr/include/eigen3 "$root/include/eigen3"
    ln -sfn /usr/include/nlohmann "$root/include/nlohmann"
    mkdir -p "$root/share/cmake"
    cp -r /usr/share/eigen3 "$root/share/"
    for config in /usr/share/cmake/nlohmann_json /usr/lib/cmake/nlohmann_json; do
        if [ -d "$config" ]; then cp -r "$config" "$root/share/cmake/"; fi
    done
    if [ "$system" = linux ]; then return; fi
    # Pictures are drawn by libraries that are loaded on first use, of which only the headers are needed.
    mkdir -p "$root/lib/pkgconfig" "$root/include/glib"
    sed 's/\blong\b/long long/' "/usr/lib/$(gcc -print-multiarch)/glib-2.0/include/glibconfig.h" >"$root/include/glib/glibconfig.h"
    cat >"$root/lib/pkgconfig/pangocairo.pc" <<END
Name: pangocairo
Description: headers of Cairo and Pango
Version: $(pkg-config --modversion pangocairo)
Cflags: -I/usr/include/pango-1.0 -I/usr/include/cairo -I/usr/include/glib-2.0 -I/usr/include/harfbuzz -I$root/include/glib
Libs:
END
}

# Who passes the libraries on passes on these, in <root>/licences.
copy_licences() {
    local package licences=$root/licences
    mkdir -p "$licences"
    for package in zlib libzstd expat sqlite3 geographiclib geos proj gdal; do
        cp "$(unpack "$package")/debian/copyright" "$licences/$package.txt"
    done
    cp "$(unpack gdal)/third_party/LercLib/LICENSE" "$licences/lerc.txt"
    for package in libboost1.74-dev libeigen3-dev nlohmann-json3-dev; do
        cp "/usr/share/doc/$package/copyright" "$licences/$package.txt"
    done
    # That of GEOS.
    cp /usr/share/common-licenses/LGPL-2.1 "$licences/"
    if [ "$system" = windows ]; then
        cp /usr/share/doc/gcc-mingw-w64-base/copyright "$licences/gcc.txt"
        cp /usr/share/doc/mingw-w64-x86-64-dev/copyright "$licences/mingw-w64.txt"
    fi
}

# build_once libraries...: does nothing where they were built. The log is printed if one fails.
build_once() {
    local library
    for library in "$@"; do
        if [ ! -e "$root/built/$library" ]; then
            echo "Building $library for $system"
            # Runs in the background, because Bash goes on after errors in a command that || follows.
            "build_$library" >"$work/$library.log" 2>&1 &
            wait $! || { tail -30 "$work/$library.log" >&2; exit 1; }
            touch "$root/built/$library"
        fi
    done
}

mkdir -p "$root/include" "$root/built"
if ! ls "$sources"/gdal_*.dsc "$sources"/boost1.74_*.dsc >/dev/null 2>&1; then
    get_sources zlib libzstd expat sqlite3 geographiclib geos proj gdal boost1.74
fi
# SQLite is one file, which takes one processor for minutes.
build_once sqlite &
sqlite=$!
build_once headers zlib zstd expat geographiclib boost geos
wait $sqlite
build_once proj gdal
copy_licences
