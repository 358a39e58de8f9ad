#!/usr/bin/env bash
# Builds the site into build/docs/html; any warning fails.
set -eu
cd "$(dirname "$0")/.."
mkdir -p build/docs docs/api
python3 tools/check_pages.py
doxygen docs/Doxyfile 2> build/docs/doxygen.log || true
if grep -q 'warning:' build/docs/doxygen.log; then head -40 build/docs/doxygen.log; echo "docs: doxygen warns"; exit 1; fi
{
    echo "# C interface"; echo; echo "Every public header, one section each."; echo
    for header in include/clast/*.h; do
        name=$(basename "$header"); [ "$name" = clast.h ] && continue
        printf '## %s\n\n```{doxygenfile} %s\n```\n\n' "$name" "$name"
    done
} > docs/api/index.md.new
cmp -s docs/api/index.md.new docs/api/index.md && rm docs/api/index.md.new || mv docs/api/index.md.new docs/api/index.md
sphinx-build -q -W --keep-going -b html -d build/docs/doctrees docs build/docs/html
echo "docs: build/docs/html/index.html, no warnings"
