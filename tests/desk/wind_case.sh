#!/bin/sh
# From a mesh on terrain to flow: OpenFOAM's own tools make cells of 5 m, refined once, and run 100 iterations.
#   wind_case.sh <mesh.stl of dem2buildings_mesh -ground> <case folder>
# The surface is in metres around its origin. The flow fills a box 10 m inside of the terrain's sides; above the highest
# roof its cells grow to 15 m.
set -eu
export WM_PROJECT_DIR=/usr/share/openfoam
stl=$1
case=$2
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$case"
cp -r "$here/wind_case" "$case"
mkdir -p "$case/constant/triSurface"
# OpenFOAM takes the whole line for the name, with the origin in it.
sed 's/^solid \([^ ]*\) .*/solid \1/' "$stl" > "$case/constant/triSurface/city.stl"
# West, east, south and north of the terrain, its lowest and the highest z of all.
extent=$(awk '$1 == "solid" {terrain = $2 == "terrain"}
    $1 == "vertex" {
        if (!some++) top = $4
        if ($4 > top) top = $4
        if (!terrain) next
        if (!land++) {west = east = $2; south = north = $3; low = $4}
        if ($2 < west) west = $2
        if ($2 > east) east = $2
        if ($3 < south) south = $3
        if ($3 > north) north = $3
        if ($4 < low) low = $4
    }
    END {print west, east, south, north, low, top}' "$stl")
# Cells of 5 m up to 5 m above the highest roof; six above them that grow by 3 to the power of 1/5 each are 55.7 m.
awk -v extent="$extent" '
    BEGIN {
        split(extent, e, " ")
        x0 = e[1] + 10; x1 = e[2] - 10; y0 = e[3] + 10; y1 = e[4] - 10; z0 = e[5] - 5
        even = int((e[6] + 5 - z0) / 5) + 1; z1 = z0 + 5 * even + 55.7
        cells = int((x1 - x0) / 5) " " int((y1 - y0) / 5) " " even + 6
        share = 5 * even / (z1 - z0)
    }
    {
        gsub(/ X0;/, " " x0 ";"); gsub(/ X1;/, " " x1 ";"); gsub(/ Y0;/, " " y0 ";"); gsub(/ Y1;/, " " y1 ";")
        gsub(/ Z0;/, " " z0 ";"); gsub(/ Z1;/, " " z1 ";")
        sub(/\(NX NY NZ\)/, "(" cells ")")
        sub(/GRADING/, "((" share " " even " 1) (" 1 - share " 6 3))")
        sub(/\(INX INY INZ\)/, "(" x0 + 1.3 " " y0 + 1.7 " " z1 - 1.1 ")")
        print > FILENAME ".new"
    }' "$case/system/blockMeshDict" "$case/system/snappyHexMeshDict"
for dict in blockMeshDict snappyHexMeshDict; do mv "$case/system/$dict.new" "$case/system/$dict"; done
cd "$case"
surfaceCheck constant/triSurface/city.stl > surfaceCheck.log 2>&1
blockMesh > blockMesh.log 2>&1
snappyHexMesh -overwrite > snappyHexMesh.log 2>&1
renumberMesh -overwrite > renumberMesh.log 2>&1
checkMesh > checkMesh.log 2>&1
grep "^Mesh OK" checkMesh.log
simpleFoam > simpleFoam.log 2>&1
grep "^End" simpleFoam.log
