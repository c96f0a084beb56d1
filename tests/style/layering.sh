#!/bin/bash
# A file under src/ includes its own floor and lower ones, written as "folder/file.h". Usage: layering.sh [ROOT]
set -euo pipefail
cd "${1:-.}"

grep -rnE '^ *# *include +"' src --include='*.h' --include='*.cpp' --include='*.cu' | awk -F: '
    BEGIN {
        count = split("base display geometry checks image 0|simd optics 1|engine content files interchange 2|inverse analysis 3|report lfdsim 4|cli view python 5", groups, "|")
        for (i = 1; i <= count; ++i) {
            n = split(groups[i], word, " ")
            for (j = 1; j < n; ++j) floor[word[j]] = word[n]
        }
    }
    {
        split($1, from, "/")
        split($3, quoted, "\"")
        to = quoted[2]; sub("/.*", "", to)
        place = $1 ":" $2 ": "
        if (!(from[2] in floor)) { print place "no floor is set for src/" from[2]; bad = 1 }
        else if (!(to in floor)) { print place "\"" quoted[2] "\" does not begin with a folder of src/"; bad = 1 }
        else if (floor[to] > floor[from[2]]) {
            print place from[2] " (floor " floor[from[2]] ") includes " to " (floor " floor[to] ")"; bad = 1
        }
    }
    END {
        if (NR == 0) { print "no #include found under src/: nothing was checked"; bad = 1 }
        exit bad
    }'
