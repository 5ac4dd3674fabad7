# shellcheck shell=bash
# Bare roots of Debian, made by debootstrap from the mirror of this machine's own apt sources. To be sourced.
place=$(mktemp -d /tmp/echoloop-root.XXXXXX)
root=

say() { printf '%s\n' "$*"; }

fail() {
    say "FAILED: $*" >&2
    exit 1
}

need() {
    [ "$(id -u)" = 0 ] || fail "debootstrap needs root"
    for tool in "$@"; do
        command -v "$tool" >/dev/null || fail "$tool is missing; apt-get install debootstrap python3-venv systemd-container"
    done
}

mirror() {
    # shellcheck disable=SC2016  # of apt, not of the shell
    apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | sort -u | head -1
}

# make_root SUITE [MORE,PACKAGES]: sets $root.
make_root() {
    root=$place/$1
    local from
    from=$(mirror)
    [ -n "$from" ] || fail "no mirror of Debian in the apt sources of this machine; run apt-get update"
    debootstrap --variant=minbase ${2:+--include="$2"} "$1" "$root" "$from" >"$place/debootstrap.log" 2>&1 ||
        { tail -5 "$place/debootstrap.log"; fail "debootstrap $1"; }
    cp /etc/resolv.conf "$root/etc/resolv.conf"
}

remove_roots() { rm -rf --one-file-system "$place"; }
