#!/bin/bash
# Installs a build into an empty folder, builds another project against it and runs that. The folder's name has a space in it.
# Usage: install.sh BUILD_DIRECTORY CXX_COMPILER
set -euo pipefail
here=$(dirname "$0")
work=$(mktemp -d "${TMPDIR:-/tmp}/lfdsim install.XXXXXX")
trap 'rm -rf "$work"' EXIT

cmake --install "$1" --prefix "$work/prefix" >/dev/null

# What is installed is what <lfdsim/lfdsim.h> includes, and no more.
(
    cd "$work/prefix/include"
    diff <(find lfdsim -name '*.h' | sort) \
        <("$2" -std=c++20 -M -I. -Ilfdsim -x c++ lfdsim/lfdsim.h | tr -s ' \\' '\n' | grep '^lfdsim/' | sort -u)
)

cmake -S "$here" -B "$work/build" -G Ninja -D CMAKE_CXX_COMPILER="$2" -D CMAKE_PREFIX_PATH="$work/prefix"
cmake --build "$work/build"
"$work/build/consumer"
"$work/build/minimal" "$work/prefix/share/lfdsim/displays/hexagon.toml" "$work/view.png" | grep -q "SSIM"

# The installed program finds its model reader, and its displays are where the README says.
"$work/prefix/bin/lfdsim" eia "$work/prefix/share/lfdsim/displays/desktop-ideal.toml" --set 'panel.pixels=[64,36]' \
    --model /usr/share/assimp/models/BLEND/Suzanne_248.blend -o "$work/eia.png"
