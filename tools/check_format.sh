#!/usr/bin/env bash
# Fails, naming the files, when a C file is not formatted: tools/check_format.sh [FILE...]
set -eu
cd "$(dirname "$0")/.."
files=()
[ $# -gt 0 ] || mapfile -d '' -t files < <(tools/list_files.sh '*.c' '*.h')
if ! clang-format-14 --dry-run -Werror "$@" "${files[@]}" > /dev/null 2>&1; then
    for file in "$@" "${files[@]}"; do
        clang-format-14 --dry-run -Werror "$file" > /dev/null 2>&1 || echo "not formatted (run make format): $file"
    done
    exit 1
fi
