#!/usr/bin/env bash
# Builds the site into build/docs/html; any warning fails. Builds the command first: it says what the pages of the reference hold.
set -eu
cd "$(dirname "$0")/.."
mkdir -p build/docs
python3 tools/check_pages.py
doxygen docs/Doxyfile 2> build/docs/doxygen.log || true
if grep -q 'warning:' build/docs/doxygen.log; then head -40 build/docs/doxygen.log; echo "docs: doxygen warns"; exit 1; fi
tools/build.sh release clast_cli clast_view > build/docs/build.log 2>&1 || { tail -30 build/docs/build.log; exit 1; }
python3 tools/make_reference.py build/release/clast
python3 tools/make_gallery.py build/release/clast
rm -rf build/docs/html  # no page outlives its source
sphinx-build -q -W --keep-going -b html -d build/docs/doctrees docs build/docs/html
echo "docs: build/docs/html/index.html, no warnings"
