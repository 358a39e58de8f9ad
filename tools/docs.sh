#!/usr/bin/env bash
# Builds the site into build/docs/html; any warning fails.
set -eu
cd "$(dirname "$0")/.."
mkdir -p build/docs
python3 tools/check_pages.py
doxygen docs/Doxyfile 2> build/docs/doxygen.log || true
if grep -q 'warning:' build/docs/doxygen.log; then head -40 build/docs/doxygen.log; echo "docs: doxygen warns"; exit 1; fi
python3 tools/make_reference.py
rm -rf build/docs/html  # no page outlives its source
sphinx-build -q -W --keep-going -b html -d build/docs/doctrees docs build/docs/html
echo "docs: build/docs/html/index.html, no warnings"
