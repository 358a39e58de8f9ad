#!/usr/bin/env bash
# The shared libraries export clast_* and nothing else; every CLAST_API declaration is exported by its own.
set -eu
cd "$(dirname "$0")/.."
lib=${1:-build/release/libclast.so}
headers=$(ls include/clast/*.h | grep -v '/mpi\.h$')
case $lib in *libclast_mpi*) headers=include/clast/mpi.h ;; esac
exported=$(nm -D --defined-only "$lib" | awk '$2 ~ /[TDBR]/ {print $3}' | sort)
stray=$(printf '%s\n' "$exported" | grep -v '^clast_' || true)
declared=$(grep -hozP 'CLAST_API[^;({]*?\b(clast_\w+)(?=\s*[\(\[;])' $headers | tr '\0' '\n' | grep -oP 'clast_\w+$' | sort -u)
missing=$(comm -23 <(printf '%s\n' "$declared") <(printf '%s\n' "$exported"))
[ -z "$stray" ] || { echo "exported but not clast_*: $stray"; exit 1; }
[ -z "$missing" ] || { echo "declared CLAST_API but not exported: $missing"; exit 1; }
echo "symbols of $(basename "$lib"): $(printf '%s\n' "$exported" | wc -l) exported, all clast_*, all declared ones present"
case $lib in *libclast.so) mpi=${lib%.so}_mpi.so; [ ! -e "$mpi" ] || tools/check_symbols.sh "$mpi" ;; esac
