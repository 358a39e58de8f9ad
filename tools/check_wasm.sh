#!/usr/bin/env bash
# clast.wasm and clast-live.html of these sources, and all golden scenes equal to the native command's, under node and in headless Chromium.
# Where emscripten, or the sources of what it links, are not at hand, it says so and passes.
set -eu
cd "$(dirname "$0")/.."
for program in emcc em-config node chromium; do
    command -v "$program" >/dev/null || { echo "SKIPPED LOUDLY: $program is not installed (tools/setup.sh wasm): clast.wasm was neither built nor compared"; exit 0; }
done
[ -x build/release/clast ] || { echo "wasm: build/release/clast is not here; tools/build.sh release makes it" >&2; exit 1; }
code=0
tools/portable.sh wasm || code=$?
[ "$code" != 3 ] || { echo "SKIPPED LOUDLY: no sources of the libraries, and no way to fetch them: clast.wasm was neither built nor compared"; exit 0; }
[ "$code" = 0 ] || exit "$code"
tools/wasm.sh
ctest --test-dir build/release -L wasm --output-on-failure --no-tests=error
