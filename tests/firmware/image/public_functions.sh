#!/bin/sh
# public_functions.sh NM LIBRARY OUTPUT: a linker script that makes every function of the public API a root, less those that
# count work (<espalier/statistics.hpp>), which are no part of <espalier/espalier.hpp>.
set -eu
"$1" --defined-only --extern-only "$2" |
    awk '$2 == "T" && $3 ~ /^_ZNK?8espalier/ && $3 !~ /6detail|_counted/ { print "EXTERN(" $3 ")" }' | sort -u >"$3"
