#!/usr/bin/env bash
# build/packages/clast-VERSION-linux-x86_64.tar.gz: the command with everything inside but libc, its manual page and completions, licences
# and list of parts. Unpacked anywhere it runs. The same bytes from the same commit on the same Debian. docs/install.md
set -euo pipefail
. "$(dirname "$0")/package.sh"
name=clast-$version-linux-x86_64
build_bundled clast_bundled_cli
rm -rf "$made/tarball"
top=$made/tarball/$name
mkdir -p "$top/bin" "$top/share/man/man1" "$top/share/bash-completion/completions" "$top/share/zsh/site-functions" "$top/share/doc/clast"
install -m 755 "$bundle/clast" "$top/bin/clast"
[ -z "$(needs "$top/bin/clast")" ] || { echo "tarball: the command needs more than libc: $(needs "$top/bin/clast")" >&2; exit 1; }
"$top/bin/clast" man > "$top/share/man/man1/clast.1"
"$top/bin/clast" completion > "$top/share/bash-completion/completions/clast"
"$top/bin/clast" completion --shell zsh > "$top/share/zsh/site-functions/_clast"
cp README.md CHANGELOG.md CITATION.cff "$top/share/doc/clast/"
(cd "$top" && "$OLDPWD/tools/sbom.py" share/doc/clast bin/clast --map "$bundle/clast_bundled_cli.map")
tar -C "$made/tarball" --sort=name --owner=0 --group=0 --numeric-owner --mode='u=rwX,go=rX' --mtime="@$SOURCE_DATE_EPOCH" -cf - "$name" |
    gzip -9n > "$made/$name.tar.gz"
rm -rf "$made/tarball"
echo "tarball: build/packages/$name.tar.gz, $(stat -c %s "$made/$name.tar.gz" | awk '{printf "%.1f", $1 / 1e6}') MB," \
    "for Linux x86-64 with libc $(newest_libc "$bundle/clast") or newer"
