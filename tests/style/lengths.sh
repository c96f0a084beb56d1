#!/bin/bash
# No source file is longer than 400 lines. Usage: lengths.sh, from the repository's root.
set -euo pipefail
. tests/style/sources.sh

sources CMakeLists.txt demo test '*.cmake' '*.sh' '*.h' '*.cpp' '*.cu' '*.py' '*.js' '*.css' '*.html' | xargs -0 awk '
    FNR == 401 { print FILENAME ": more than 400 lines"; bad = 1 }
    END {
        if (NR == 0) print "no source file found: nothing was checked"
        exit bad || NR == 0
    }'
