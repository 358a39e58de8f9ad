#!/usr/bin/env bash
# What `make test` and CI run: set-up, format, spelling, layers, headers, tidy, all tests under sanitizers, exported symbols,
# WebAssembly, 32 bits, packages, short fuzzing, documents. FUZZ_SECONDS (default 20) and SKIP ("tidy wasm i386 packages fuzz docs") shorten it
# by hand.
set -euo pipefail
cd "$(dirname "$0")/.."
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 # what another clone of this machine has compiled is taken from there
began=$SECONDS
say() { printf '\n== %s (%d s)\n' "$1" "$((SECONDS - began))"; }
skip() { case " ${SKIP:-} " in *" $1 "*) echo "skipped by SKIP: $1"; return 0 ;; esac; return 1; }

say "set-up"; tools/setup.sh test
say "format"
tools/check_format.sh
say "spelling"
tools/list_files.sh '*.c' '*.h' '*.md' '*.py' '*.sh' | xargs -0 codespell --ignore-words=tools/spelling.txt
say "layers, sizes, changelog"; python3 tools/check_layers.py; tools/check_size.sh; python3 tools/check_changelog.py; python3 tools/check_interface.py
python3 tools/check_recipes.py
say "pages of the theory"; python3 tools/check_pages.py; python3 tools/pooled.py
say "headers in C and C++"; tools/check_headers.sh
say "build and tests under AddressSanitizer and UndefinedBehaviorSanitizer"
tools/build.sh dev > build-dev.log 2>&1 || { grep -E 'error|warning' build-dev.log | head -40; exit 1; }
rm -f build-dev.log
ctest --test-dir build/dev -j"$(nproc)" --output-on-failure --no-tests=error | tee build/ctest.log | grep -v '^ *Start '
say "clang-tidy"; skip tidy || tools/check_tidy.sh
say "release build and exported symbols"
tools/build.sh release installed mpi_tests > build-release.log 2>&1 || { tail -30 build-release.log; exit 1; }
rm -f build-release.log
tools/check_symbols.sh
tools/check_install.sh
say "commands of the documents, Python, ranks, bundle of the 3-D view; beside them WebAssembly, packages and 32 bits"
one_core() { # tests that take one core each; what they print comes after the other core's
    python3 tools/check_docs_commands.py build/release/clast
    ctest --test-dir build/release -L python --output-on-failure --no-tests=error
    ctest --test-dir build/release -L mpi --output-on-failure --no-tests=error
    tools/check_mpich.sh
    tools/check_web.sh
}
beside() { # COMMAND LOG: on the other core; `other` waits for it and prints what it said
    (set -e; "$1") > "$2" 2>&1 &
    other_pid=$! other_log=$2
    trap 'kill "$other_pid" 2>/dev/null || true' EXIT
}
other() {
    local status=0
    wait "$other_pid" || status=$?
    trap - EXIT
    tee -a build/ctest.log < "$other_log" | grep -v '^ *Start ' || true
    [ "$status" = 0 ]
}
beside one_core build/one-core.log
skip wasm || tools/check_wasm.sh | tee -a build/ctest.log | grep -v '^ *Start '
if skip packages; then :; elif [ "$(uname -m)" != x86_64 ]; then echo "SKIPPED: packages are made on x86-64"; else
    tools/tarball.sh; tools/wheel.sh; tools/deb.sh; tools/check_packages.sh tarball wheel deb
fi
skip i386 || TEST_JOBS=1 tools/test_i386.sh or-skip | tee -a build/ctest.log | grep -v '^ *Start '
say "the other core's"; other
say "fuzzing; beside it documents and views in a browser"
documents() { skip docs || { tools/docs.sh; python3 tools/check_site.py --sample; python3 tools/check_view.py; }; }
beside documents build/documents.log
skip fuzz || FUZZ_JOBS=$(($(nproc) / 2 + $(nproc) % 2)) tools/fuzz.sh "${FUZZ_SECONDS:-20}"
say "the other core's"; other
say "reports in a browser, nothing beside them: their first picture is timed"; skip docs || python3 tools/check_report.py
say "done"
awk '/tests passed, .* tests failed out of/ {passed += $NF - $4; failed += $4}
     END {print passed " passed, " failed + 0 " failed"}' build/ctest.log
