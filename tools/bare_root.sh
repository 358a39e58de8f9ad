# Sourced, with the caller's words: a minimal Debian 12 root (BARE_SOURCES="deb URL SUITE COMPONENT...": another), in a mount namespace of its
# own, that goes when the script ends. Needs root, mount and chroot, and a package mirror; where one is missing the script ends with one line and exit
# code 0. What it gives: skip, fail, say, within (as root in the new root), user (as nobody there), $work, $root, $mirror.
what=$(basename "$0" .sh | sed 's/^check_//')
skip() { echo "SKIPPED: the $what machine was not tried: $1"; exit 0; }
fail() { echo "$what: $1" >&2; [ ! -s "${work:-}/log" ] || tail -30 "$work/log" >&2; exit 1; }
if [ "${CLAST_IN_BARE:-}" != "$$" ]; then
    [ "$(id -u)" -eq 0 ] || skip "root is needed for mmdebstrap, mount and chroot"
    unshare --mount mount -t tmpfs tmpfs /mnt 2>/dev/null || skip "mount is not allowed here"
    chroot --userspec=65534:65534 / true 2>/dev/null || skip "chroot to another user is not allowed here"
    CLAST_IN_BARE=$$ exec unshare --mount "tools/$(basename "$0")" "$@" # what is mounted below is seen by nobody else and ends with it
fi
suite=bookworm
sources=$(grep -lE '^(deb |URIs:)' /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list 2>/dev/null | head -1 || true) # one may hold a comment alone
mirror=$(grep -ohE 'https?://[^ ]+/debian/?( |$)' ${sources:+"$sources"} /dev/null | head -1 | sed 's,/* *$,,')
if [ -n "${BARE_SOURCES:-}" ]; then
    sources=$BARE_SOURCES
    read -r mirror suite <<< "$(sed -E 's/.* (https?:[^ ]+) +([^ ]+) .*/\1 \2/' <<< "$BARE_SOURCES")"
fi
work=$(mktemp -d "${TMPDIR:-/tmp}/clast-$what.XXXXXX")
root=$work/root
cleanup() {
    for at in dev/pts proc; do ! mountpoint -q "$root/$at" || umount -l "$root/$at"; done
    rm -rf --one-file-system "$work"
}
trap cleanup EXIT
/usr/lib/apt/apt-helper download-file "${mirror:=http://deb.debian.org/debian}/dists/$suite/InRelease" "$work/InRelease" \
    >/dev/null 2>&1 || skip "$mirror does not answer"
tools/setup.sh bare
began=$SECONDS
say() { printf '%s: %s (%d s)\n' "$what" "$1" "$((SECONDS - began))"; }

mmdebstrap --quiet --variant=minbase --include=apt "$suite" "$root" ${sources:+"$sources"} > "$work/log" 2>&1 || fail "no minimal root could be made"
mount -t proc proc "$root/proc" || fail "proc"
mount -t devpts devpts "$root/dev/pts" 2>/dev/null || true
within() { chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} bash -c "$1"; }
user() { chroot --userspec=65534:65534 "$root" env -i HOME=/tmp PATH=/usr/bin:/bin bash -c "$1"; }
say "a minimal root of $suite is made"
