#!/bin/bash
# The kernel is compiled once per instruction set into one program. A weak symbol that two of the objects share would let the
# linker run AVX-512 code on a machine without it; so each weak symbol of kernel_ISA must sit in a namespace called ISA.
# Usage: symbols.sh BUILD_DIRECTORY
set -euo pipefail

objects=$(find "$1" -name 'kernel_*.o')
if [ -z "$objects" ]; then
    echo "SKIPPED: no kernel_*.o in $1"
    exit 77
fi
bad=0
while read -r object; do
    isa=$(basename "$object" | sed -E 's/kernel_([a-z0-9]+).*/\1/')
    # DW.ref.* are the exception tables' references: data, the same on every instruction set.
    foreign=$(nm -C "$object" | sed -nE 's/^[0-9a-f ]{16} [WVuvw] //p' | grep -v -e "::$isa::" -e '^DW\.ref\.' || true)
    if [ -n "$foreign" ]; then
        printf '%s: weak symbols outside ::%s::\n%s\n' "$object" "$isa" "$foreign"
        bad=1
    fi
done <<<"$objects"
exit $bad
