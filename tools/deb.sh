#!/usr/bin/env bash
# build/packages/*.deb of the commit at hand by dpkg-buildpackage, as packaging/debian says, and lintian over them. docs/install.md
set -euo pipefail
. "$(dirname "$0")/package.sh"
given=$(sed -n '1s/^clast (\([0-9.]*\)-.*/\1/p' packaging/debian/changelog)
[ "$given" = "$version" ] || { echo "deb: packaging/debian/changelog is of $given, VERSION of $version" >&2; exit 1; }
work=$made/deb
rm -rf "$work"
mkdir -p "$work/clast-$version"
if [ -e .git ]; then git archive HEAD | tar -C "$work/clast-$version" -xf -; else tools/list_files.sh | tar --null -T - -cf - | tar -C "$work/clast-$version" -xf -; fi
cp -r "$work/clast-$version/packaging/debian" "$work/clast-$version/"
log=$work/log
! command -v ccache > /dev/null || export CCACHE_DIR="${CCACHE_DIR:-$(ccache --get-config cache_dir)}" # debhelper sets another HOME
(cd "$work/clast-$version" && DEB_BUILD_OPTIONS="noautodbgsym parallel=$(nproc)" dpkg-buildpackage -us -uc -b > "$log" 2>&1) ||
    { tail -40 "$log" >&2; echo "deb: dpkg-buildpackage failed (above)" >&2; exit 1; }
lintian --allow-root --fail-on error --suppress-tags initial-upload-closes-no-bugs "$work"/*.changes || { echo "deb: lintian found errors (above)" >&2; exit 1; }
rm -f "$made"/*.deb
mv "$work"/*.deb "$made/"
rm -rf "$work"
echo "deb: $(cd "$made" && ls -s --block-size=kB ./*.deb | awk '{sub("./", "", $2); printf "%s%s (%s)", sep, $2, $1; sep = ", "}') in build/packages"
