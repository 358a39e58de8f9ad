#!/usr/bin/env bash
# Is web/dist/view.js the bundle of web/view.js, web/view/ and their lock? tools/check_web.sh [--update]
# Digests always; where npm (tools/setup.sh web) and the registry are at hand it is also built anew and compared. --update builds and renews.
set -eu
cd "$(dirname "$0")/../web"
files="view.js $(echo view/*.js) package.json package-lock.json dist/view.js dist/LICENSE-three.txt"
build() { # into the folder $1
    cp -r view.js view package.json package-lock.json "$1"
    (cd "$1" && npm ci --silent --no-audit --no-fund >/dev/null 2>&1 && npm run --silent build >/dev/null 2>&1)
}
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
if [ "${1:-}" = --update ]; then
    build "$made" || { echo "web: cannot build; node, npm and the registry are needed"; exit 1; }
    mkdir -p dist
    cp "$made/dist/view.js" dist/view.js
    cp "$made/node_modules/three/LICENSE" dist/LICENSE-three.txt
    sha256sum $files > dist/SHA256SUMS
fi
sha256sum --check --quiet dist/SHA256SUMS || { echo "web: sources and bundle do not belong together; run tools/check_web.sh --update"; exit 1; }
size=$(wc -c < dist/view.js)
[ "$size" -lt 800000 ] || { echo "web: dist/view.js has $size bytes, more than 800000"; exit 1; }
if grep -qiE '</script|<!--' dist/view.js; then echo "web: dist/view.js would end the page's script element"; exit 1; fi
if command -v npm >/dev/null && build "$made"; then
    cmp "$made/dist/view.js" dist/view.js || { echo "web: dist/view.js is not what web/view.js builds to; run tools/check_web.sh --update"; exit 1; }
    echo "web: bundle of $size bytes is that of its sources, built anew"
else
    echo "web: digests agree; not built anew (no npm: tools/setup.sh web; or no registry)"
fi
