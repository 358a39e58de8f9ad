#!/usr/bin/env bash
# The Python package, which finds libclast_view in the environment's lib.
set -eux
info=$SP_DIR/clast-$PKG_VERSION.dist-info
mkdir -p "$SP_DIR/clast" "$info"
cp python/clast/*.py python/clast/py.typed "$SP_DIR/clast/"
"$PYTHON" tools/wheel_backend.py metadata > "$info/METADATA"
echo conda > "$info/INSTALLER"
