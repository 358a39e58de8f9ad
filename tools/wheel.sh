#!/usr/bin/env bash
# build/packages/clast-VERSION-py3-none-manylinux_A_B_x86_64.whl: the Python package, the library and the command with everything inside but libc
# A.B, licences and list of parts. The same bytes from the same commit on the same Debian. docs/install.md
set -euo pipefail
. "$(dirname "$0")/package.sh"
build_bundled clast_bundled
build_bundled clast_bundled_cli
stage=$made/wheel
rm -rf "$stage" "$made"/clast-*.whl
info=$stage/clast-$version.dist-info
mkdir -p "$stage/clast" "$info" "$stage/clast-$version.data/scripts"
library=$stage/clast/libclast_view.so
install -m 755 "$bundle/libclast_view.so" "$library"
install -m 755 "$bundle/clast" "$stage/clast-$version.data/scripts/clast"
# One part, pixman, cannot be linked into a shared object (Debian's archive of it is for programs). It lies beside it, under a name of its
# own, so that that of another package in the same Python is not taken for it.
carried=()
for needed in $(needs "$library"); do
    file=$(realpath "$("${CC:-cc}" -print-file-name="$needed")")
    own=${needed%%.so*}-clast.so.${needed##*.so.}
    install -m 755 "$file" "$stage/clast/$own"
    patchelf --set-soname "$own" "$stage/clast/$own"
    patchelf --replace-needed "$needed" "$own" "$library"
    strip --strip-unneeded "$stage/clast/$own"
    carried+=("$(dirname "$file")/$needed")
    [ -z "$(needs "$stage/clast/$own")" ] || { echo "wheel: $needed needs more than libc: $(needs "$stage/clast/$own")" >&2; exit 1; }
done
patchelf --set-rpath '$ORIGIN' "$library"
libc=$(newest_libc "$stage"/clast/*.so* "$bundle/clast")
(cd "$stage" && "$OLDPWD/tools/sbom.py" "$info" clast/* "clast-$version.data/scripts/clast" --map "$bundle/clast_bundled.map" \
    "$bundle/clast_bundled_cli.map" --carried "${carried[@]}")
mkdir "$info/sboms" "$info/licenses"
mv "$info/sbom.spdx.json" "$info/sboms/clast.spdx.json" # where PEP 770 and PEP 639 look
mv "$info/LICENSE" "$info"/licences/* "$info/licenses/"
rmdir "$info/licences"
wheel=$(tools/wheel_backend.py pack "$made" "manylinux_${libc/./_}_x86_64" "$stage")
rm -rf "$stage"
echo "wheel: build/packages/$wheel, $(stat -c %s "$made/$wheel" | awk '{printf "%.1f", $1 / 1e6}') MB"
