# What the claims about espalier_add_blob share: sourced with the path of espalier, the source folder, cmake and a generator.
# shellcheck shell=bash
espalier_sources=$(realpath "${2:?the source folder}") # before the next leaves this folder
# shellcheck source=../tools/claims.sh
. "$(dirname "${BASH_SOURCE[0]}")/../tools/claims.sh"
cmake=${3:?cmake}
generator=${4:?a generator}

# A command that is espalier, and writes down which verbs it was asked for.
verbs=$folder/verbs.txt
counting=$folder/counting/espalier
mkdir "$folder/counting"
cat >"$counting" <<SCRIPT
#!/bin/sh
case \$1 in --*) ;; *) echo "\$1" >>'$verbs' ;; esac
exec '$espalier' "\$@"
SCRIPT
chmod +x "$counting"

# A corner of a box, with materials in a file of their own.
write_level() { # FOLDER
    mkdir -p "$1"
    printf 'newmtl stone\nKd 1 1 1\n' >"$1/level.mtl"
    printf 'mtllib level.mtl\nusemtl stone\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\n' >"$1/level.obj"
}
# Writes its blob to stdout, byte for byte.
write_main() { # FOLDER
    cat >"$1/main.c" <<'C'
#include <stdio.h>
#include "level.h"
int main(void) { return fwrite(level, 1, level_size, stdout) == sizeof level ? 0 : 1; }
C
}
# The head of a CMakeLists.txt: how Espalier comes in as a subdirectory of which only the function is used.
write_head() { # FOLDER LANGUAGES
    cat >"$1/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.16)
project(consumer LANGUAGES $2)
set(ESPALIER_BAKER OFF)
add_subdirectory("$espalier_sources" espalier EXCLUDE_FROM_ALL)
CMAKE
}
# has_generator NAME: says what is missing where it cannot be used
has_generator() {
    local tool=make
    [ "$1" != Ninja ] || tool=ninja
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed (tools/dev test installs it)" && false; }
}
# configure SOURCE BUILD OPTION...: may fail; what is said is left in ./log
configure() {
    local source=$1 build=$2
    shift 2
    "$cmake" -S "$source" -B "$build" -G "$generator" -DCMAKE_BUILD_TYPE=Release "$@" >log 2>&1
}
# A build that may fail; what is said is left in ./log
build() { "$cmake" --build "$@" >log 2>&1; }
# What everything after it rests on: the script ends where it fails.
must() {
    "$@" && return
    fail "'$*' failed: $(tail -n 30 log)"
    exit 1
}
must_not() { ! "$@" || fail "'$*' did not fail"; }
log_has() { local words; for words in "$@"; do grep -qF -- "$words" log || fail "the log lacks '$words': $(tail -n 30 log)"; done; }
fails_with() { must_not "${@:2}"; log_has "$1"; } # WORDS COMMAND...
# The verbs since they were last asked for are these.
verbs_are() {
    local seen
    seen=$(sort "$verbs" 2>/dev/null | tr '\n' ' ')
    [ "$seen" = "${1:+$1 }" ] || fail "the build asked for '$seen' and not for '$1'"
    rm -f "$verbs"
}
