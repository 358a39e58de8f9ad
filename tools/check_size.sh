#!/usr/bin/env bash
# Fails when a C file is longer than 800 lines, a file larger than 2 MB, or data/ larger than 10 MB: check_size.sh [FILE...]
set -eu
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || mapfile -d '' -t -O 1 files < <(tools/list_files.sh)
status=0
for file in "$@" "${files[@]:-}"; do
    [ -f "$file" ] || continue
    case "$file" in
        *.c | *.h) lines=$(wc -l < "$file"); [ "$lines" -le 800 ] || { echo "$file: $lines lines, at most 800"; status=1; } ;;
    esac
    bytes=$(stat -c %s "$file")
    [ "$bytes" -le 2097152 ] || { echo "$file: $bytes bytes, at most 2 MB"; status=1; }
done
kb=$(tools/list_files.sh 'data/*' | du -ck --apparent-size --files0-from=- | tail -1 | cut -f1)
[ "$kb" -le 10240 ] || { echo "data/: $kb kB, at most 10 MB"; status=1; }
exit $status
