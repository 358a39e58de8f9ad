#!/usr/bin/env bash
# The shared library exports clast_* and nothing else; every CLAST_API declaration is exported.
set -eu
cd "$(dirname "$0")/.."
lib=${1:-build/release/libclast.so}
exported=$(nm -D --defined-only "$lib" | awk '$2 ~ /[TDBR]/ {print $3}' | sort)
stray=$(printf '%s\n' "$exported" | grep -v '^clast_' || true)
declared=$(grep -hozP 'CLAST_API[^;({]*?\b(clast_\w+)(?=\s*[\(\[;])' include/clast/*.h | tr '\0' '\n' | grep -oP 'clast_\w+$' | sort -u)
missing=$(comm -23 <(printf '%s\n' "$declared") <(printf '%s\n' "$exported"))
[ -z "$stray" ] || { echo "exported but not clast_*: $stray"; exit 1; }
[ -z "$missing" ] || { echo "declared CLAST_API but not exported: $missing"; exit 1; }
echo "symbols: $(printf '%s\n' "$exported" | wc -l) exported, all clast_*, all declared ones present"
