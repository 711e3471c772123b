#!/bin/sh
# From a mesh on terrain to flow: OpenFOAM's own tools make cells of 5 m, refined once, and run 100 iterations.
#   wind_case.sh <mesh.stl of dem2buildings_mesh -ground> <case folder> <half width> <half depth> <z of the lowest terrain> <height>
# The surface is in metres around its origin; the flow fills the box above the terrain.
set -eu
export WM_PROJECT_DIR=/usr/share/openfoam
stl=$1
case=$2
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$case"
cp -r "$here/wind_case" "$case"
mkdir -p "$case/constant/triSurface"
cp "$stl" "$case/constant/triSurface/city.stl"
awk -v w="$3" -v d="$4" -v z="$5" -v h="$6" '
    {gsub(/ X0;/, " " (-w) ";"); gsub(/ X1;/, " " w ";"); gsub(/ Y0;/, " " (-d) ";"); gsub(/ Y1;/, " " d ";")
     gsub(/ Z0;/, " " (z - 5) ";"); gsub(/ Z1;/, " " (z - 5 + h) ";")
     sub(/\(NX NY NZ\)/, "(" int(2 * w / 5) " " int(2 * d / 5) " " int(h / 5) ")")
     sub(/\(INX INY INZ\)/, "(" (-w + 1.3) " " (-d + 1.7) " " (z - 5 + h - 1.1) ")")
     print > FILENAME ".new"}' "$case/system/blockMeshDict" "$case/system/snappyHexMeshDict"
for dict in blockMeshDict snappyHexMeshDict; do mv "$case/system/$dict.new" "$case/system/$dict"; done
cd "$case"
surfaceCheck constant/triSurface/city.stl > surfaceCheck.log 2>&1
blockMesh > blockMesh.log 2>&1
snappyHexMesh -overwrite > snappyHexMesh.log 2>&1
checkMesh > checkMesh.log 2>&1
grep "^Mesh OK" checkMesh.log
simpleFoam > simpleFoam.log 2>&1
grep "^End" simpleFoam.log
