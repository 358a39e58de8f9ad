#!/usr/bin/env bash
# The newcomer's first command: installs what is missing, builds, grows the cored cluster 27Sk21 from real sizes and shapes,
# and names the files to look at. Under 3 minutes on a fresh Debian 12 machine.
set -eu
cd "$(dirname "$0")/.."
tools/setup.sh build
echo "building..."
tools/build.sh release clast_cli > build-demo.log 2>&1 || { tail -30 build-demo.log; exit 1; }
rm -f build-demo.log
clast=build/release/clast
rm -rf demo
mkdir -p demo
echo "the coarse-ash shape:"
$clast mesh check data/scarlet/stl/27sk21_shape_coarse.stl
echo
echo "growing 27Sk21: 750 real grain sizes on a core of 270 um, 4 aggregates..."
$clast aggregate examples/27sk21.yaml -o demo/27sk21
echo
$clast render demo/27sk21 -o demo/27sk21.png --quiet
$clast report demo/27sk21 -o demo/report.html
echo
echo "look at:"
for file in demo/report.html demo/27sk21.png demo/27sk21/history.csv demo/27sk21/summary.json; do
    [ -s "$file" ] || { echo "demo: $file is missing" >&2; exit 1; }
    echo "  $file"
done
