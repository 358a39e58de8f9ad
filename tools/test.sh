#!/usr/bin/env bash
# What `make test` and CI run: set-up, format, spelling, layers, headers, tidy, all tests, those of memory under sanitizers, exported symbols,
# and then side by side: tests of numbers, Python and ranks, WebAssembly, 32 bits, packages, documents, short fuzzing.
# FUZZ_SECONDS (default 5) and SKIP ("tidy mpich docs wasm i386 packages fuzz site") shorten it by hand; `tools/test.sh JOB` runs one of the side by side;
# ALSO=bare, as in CI, adds the new machine to them.
set -euo pipefail
cd "$(dirname "$0")/.."
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 # what another clone of this machine has compiled is taken from there
began=$SECONDS
say() { printf '\n== %s (%d s)\n' "$1" "$((SECONDS - began))"; }
skip() { case " ${SKIP:-} " in *" $1 "*) echo "skipped by SKIP: $1"; return 0 ;; esac; return 1; }

tests() { ctest --test-dir build/release -L "$1" --output-on-failure --no-tests=error; }
job() { # what needs the release build
    case $1 in
    numbers | python | mpi) tests "$1" ;;
    mpich) tools/check_mpich.sh ;;
    docs) python3 tools/check_docs_commands.py build/release/clast ;;
    wasm) tools/check_wasm.sh ;;
    i386) TEST_JOBS=1 tools/test_i386.sh or-skip ;;
    packages)
        [ "$(uname -m)" = x86_64 ] || { echo "SKIPPED: packages are made on x86-64"; return; }
        tools/tarball.sh; tools/wheel.sh; tools/deb.sh; tools/check_packages.sh tarball wheel deb
        ;;
    fuzz) FUZZ_JOBS=1 tools/fuzz.sh "${FUZZ_SECONDS:-5}" ;;
    bare) tools/check_bare.sh ;;
    site) tools/check_web.sh; tools/docs.sh; python3 tools/check_site.py --sample; python3 tools/check_view.py ;;
    *) echo "test: $1 is none of numbers, python, mpi, mpich, docs, wasm, i386, packages, fuzz, site, bare" >&2; return 2 ;;
    esac
}
if [ "${1:-}" = logged ]; then # JOB: prints when it ends, as a whole; 255 keeps the next from beginning
    log=build/job-$2.log
    status=0; tools/test.sh "$2" > "$log" 2>&1 || status=$?
    times > "$log.cpu" # not in a pipe, whose shell has children of its own
    cpu=$(awk 'END {gsub("s", ""); split($1, u, "m"); split($2, k, "m"); printf "%d", 60 * (u[1] + k[1]) + u[2] + k[2]}' "$log.cpu")
    said=$([ "$status" = 0 ] && echo passed || echo "FAILED, exit code $status")
    { printf '\n-- %s: %s (%d s, %d s of CPU)\n' "$2" "$said" "$SECONDS" "$cpu"; grep -v '^ *Start ' "$log"; } || true
    [ "$status" = 0 ] || exit 255
    exit 0
elif [ $# -gt 0 ]; then job "$1"; exit; fi

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
ctest --test-dir build/dev -LE numbers -j"$(nproc)" --output-on-failure --no-tests=error | tee build/ctest.log | grep -v '^ *Start '
say "clang-tidy"; skip tidy || tools/check_tidy.sh
say "release build and exported symbols"
tools/build.sh release installed numbers_tests mpi_tests > build-release.log 2>&1 || { tail -30 build-release.log; exit 1; }
rm -f build-release.log
tools/check_symbols.sh
tools/check_install.sh
say "side by side, the longest first; one more than cores, since ranks wait much of their time"
jobs=()
for name in mpi packages ${ALSO:-} i386 wasm docs fuzz python numbers site mpich; do skip "$name" || jobs+=("$name"); done
printf '%s\n' "${jobs[@]}" | xargs -P "$(($(nproc) + 1))" -I{} tools/test.sh logged {} | tee -a build/ctest.log
say "reports in a browser, nothing beside them: their first picture is timed"; skip site || python3 tools/check_report.py
say "done"
awk '/tests passed, .* tests failed out of/ {passed += $NF - $4; failed += $4}
     END {print passed " passed, " failed + 0 " failed"}' build/ctest.log
