# shellcheck shell=bash
# Installs what packages.txt lists. Sourced by `demo` and `test` from the repository's root.

# install_packages USE...: installs the missing packages marked with one of the uses ("build", "test"), nothing if none is missing.
install_packages() {
    local use wanted missing log
    wanted=$(for use in "$@"; do sed -nE "s/^([^ #]+) +# $use: .*/\1/p" packages.txt; done)
    if ! command -v apt-get dpkg-query >/dev/null; then
        echo "error: this is not Debian: install what packages.txt lists, then see \"Building by hand\" in README.md" >&2
        return 1
    fi
    # shellcheck disable=SC2086  # one argument per package
    missing=$(comm -23 <(sort <<<"$wanted") \
        <(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $wanted 2>/dev/null | sed -n 's/ installed$//p' | sort -u) | xargs)
    [ -z "$missing" ] && return

    local root=()
    if [ "$(id -u)" != 0 ]; then
        root=(sudo)
        if [ -n "${CI:-}" ] || ! { : </dev/tty; } 2>/dev/null; then root+=(-n); fi # nobody there to type a password
        if ! "${root[@]}" true; then
            echo "error: no right to install packages; as root run: apt-get install --no-install-recommends $missing" >&2
            return 1
        fi
    fi
    echo "installing: $missing"
    log=$(mktemp)
    local apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qy -o DPkg::Lock::Timeout=300)
    # The package lists may be absent or old: fetch them only when the first try fails.
    # shellcheck disable=SC2086
    if ! "${apt[@]}" install --no-install-recommends $missing >"$log" 2>&1 </dev/null &&
        ! { "${apt[@]}" update >>"$log" 2>&1 </dev/null &&
            "${apt[@]}" install --no-install-recommends $missing >>"$log" 2>&1 </dev/null; }; then
        cat "$log" >&2
        echo "error: could not install: $missing" >&2
        return 1
    fi
    rm -f "$log"
}
