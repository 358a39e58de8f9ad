#!/usr/bin/env bash
# The project's files, NUL after each: those git knows in a clone, all but what was built in an unpacked release:
# tools/list_files.sh [PATTERN...], a pattern as '*.c' or 'data/*'.
set -eu
cd "$(dirname "$0")/.."
if [ -e .git ]; then
    git ls-files -z -- "$@"
else
    find * .clang-* .ci .git* -type f ! -path 'build/*' ! -path 'demo/*' ! -path '*/__pycache__/*' ! -path 'docs/reference/*' ! -path 'web/node_modules/*' -print0 2>/dev/null | sort -z |
        while IFS= read -r -d '' file; do
            [ $# -gt 0 ] || { printf '%s\0' "$file"; continue; }
            for pattern in "$@"; do
                # shellcheck disable=SC2053
                [[ $file != $pattern ]] || { printf '%s\0' "$file"; break; }
            done
        done
fi
