#!/bin/bash
# C++ files are laid out as .clang-format says (by the version named here: others differ). Usage: format.sh, from the repository's root.
set -euo pipefail
. tests/style/sources.sh

sources '*.h' '*.cpp' '*.cu' | xargs -0 clang-format-14 --dry-run -Werror
