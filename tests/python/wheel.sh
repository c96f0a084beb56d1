#!/bin/bash
# A wheel, in a fresh virtual environment with nothing but NumPy, renders a model from a file, and loads no library of this machine but
# those that every Linux has. Usage: wheel.sh REPOSITORY PYTHON
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/lfdsim wheel.XXXXXX")
trap 'rm -rf "$work"' EXIT

"$2" -m venv "$work/venv"
if ! "$work/venv/bin/pip" install --quiet numpy; then
    echo "SKIPPED: no package can be installed from here"
    exit 77
fi
"$1/python/wheel.sh" "$work/wheels" "$2"
"$work/venv/bin/pip" install --no-index "$work"/wheels/*.whl # NumPy is there already
cd "$work"
env -i HOME="$work" "$work/venv/bin/python" "$here/installed.py"
env -i HOME="$work" "$work/venv/bin/lfdsim" check "$1/displays/tablet-lenticular.toml" >check.txt
grep -q "is valid" check.txt
