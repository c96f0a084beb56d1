#!/bin/bash
# Runs every command of the blocks marked ```sh in files of the source, in order, as a reader would, but in an empty folder that has
# only displays/, examples/ and build/release. Usage: readme.sh SOURCE_DIRECTORY BUILD_DIRECTORY FILE...
set -euo pipefail
source=$1 build=$2
shift 2
work=$(mktemp -d "${TMPDIR:-/tmp}/lfdsim readme.XXXXXX")
trap 'rm -rf "$work"' EXIT
cp -r "$source/displays" "$source/examples" "$work"
mkdir "$work/build"
ln -s "$build" "$work/build/release"

# shellcheck disable=SC2068  # patterns of the source's files
commands=$(cd "$source" && awk '/^```/ { inside = $0 == "```sh"; next } inside' $@)
[ -n "$commands" ] || { echo "no commands found" && exit 1; }
cd "$work"
bash -evc "$commands" </dev/null
