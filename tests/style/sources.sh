# shellcheck shell=bash
# sources PATTERN...: our own source files of these names, each ended by a zero byte. For the checks of this folder.
sources() {
    local pattern names=()
    for pattern in "$@"; do names+=(-o -name "$pattern"); done
    find . -type d \( -name .git -o -name build -o -name golden -o -name corpus -o -name __pycache__ \) -prune \
        -o -type f \( "${names[@]:1}" \) -print0
}
