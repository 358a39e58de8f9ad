#!/usr/bin/env bash
# The source release build/clast-VERSION.tar.gz of the commit at hand, which pip takes too (PKG-INFO): the same bytes from the same commit.
set -euo pipefail
cd "$(dirname "$0")/.."
[ -e .git ] || { echo "dist: this is no git clone; a release is made from a commit"; exit 1; }
version=$(cat VERSION)
[ -z "$(git status --porcelain --untracked-files=no)" ] || echo "dist: changes that are not committed are left out"
mkdir -p build
git archive --format=tar --prefix="clast-$version/" --add-virtual-file="clast-$version/PKG-INFO:$(tools/wheel_backend.py metadata)" HEAD | gzip -9n > "build/clast-$version.tar.gz"
echo "dist: build/clast-$version.tar.gz of commit $(git rev-parse --short HEAD)"
