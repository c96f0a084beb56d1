#!/bin/bash
# Makes FOLDER/lfdsim-*.whl, which holds all it needs: other machines install it with nothing but Python. The libraries of
# packages.txt are needed here; the tools come from PyPI. Usage: python/wheel.sh FOLDER [PYTHON]
set -euo pipefail
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"${2:-python3}" -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet build
"$work/tools/bin/python" -m build --wheel --outdir "$folder" .
