#!/bin/bash
# Runs every command of the blocks marked ```sh in README.md and docs/, in order, as a reader would, but in an empty folder that has
# only displays/, examples/ and build/release. Usage: readme.sh SOURCE_DIRECTORY BUILD_DIRECTORY
set -euo pipefail
source=$1 build=$2
work=$(mktemp -d "${TMPDIR:-/tmp}/lfdsim readme.XXXXXX")
trap 'rm -rf "$work"' EXIT
cp -r "$source/displays" "$source/examples" "$work"
mkdir "$work/build"
ln -s "$build" "$work/build/release"

commands=$(awk '/^```/ { inside = $0 == "```sh"; next } inside' "$source/README.md" "$source"/docs/*.md)
[ -n "$commands" ] || { echo "no commands found" && exit 1; }
cd "$work"
bash -evc "$commands" </dev/null
