#!/usr/bin/env bash
# run_wine.sh PREFIX PROGRAM ARGUMENT...: runs a program of Windows by Wine, without a display. PREFIX is Wine's own folder, which
# is made when it is missing. Without a PROGRAM it makes PREFIX and runs a program of Wine's own.
# Exit status: that of the program; 77, with a reason, where Wine is missing or runs no program at all.
set -euo pipefail

prefix=$1
shift
wine=
for name in wine64 wine64-stable /usr/lib/wine/wine64 wine; do
    if command -v "$name" >/dev/null; then wine=$name && break; fi
done
if [[ -z $wine ]]; then
    echo "skipped: wine64 is not installed (tools/dev prove installs it)"
    exit 77
fi
unset DISPLAY WAYLAND_DISPLAY WINEARCH
# Without mscoree and mshtml nothing asks for Mono and Gecko; menus and file types of the user stay as they are.
export WINEPREFIX=$prefix WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml=;winemenubuilder.exe="

mkdir -p "$prefix"
# A program that starts while the server ends loses its connection, so the server stays for ten minutes after the last one.
for server in wineserver /usr/lib/wine/wineserver64 /usr/lib/wine/wineserver; do
    if command -v "$server" >/dev/null; then
        # It fails where it runs already. Wine's own programs stay as long, so the first of all must not keep our streams.
        if "$server" -p600 </dev/null >/dev/null 2>&1; then "$wine" cmd /c exit </dev/null >/dev/null 2>&1 || true; fi
        break
    fi
done
if [[ ! -e $prefix/runs ]]; then
    status=0
    timeout 300 "$wine" cmd /c exit 7 </dev/null >"$prefix/probe.log" 2>&1 || status=$?
    if [[ $status -ne 7 ]]; then
        echo "skipped: $wine runs no program here (status $status): $(tail -n 1 "$prefix/probe.log")"
        exit 77
    fi
    touch "$prefix/runs"
fi
if [[ $# -gt 0 ]]; then exec "$wine" "$@"; fi
