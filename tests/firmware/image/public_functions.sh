#!/bin/sh
# public_functions.sh NM LIBRARY OUTPUT: a linker script that makes every function of the public API a root, and what its
# templates call: inner functions of a Blob. Less those that count work (<espalier/advanced/statistics.hpp>), which are no part of
# <espalier/espalier.hpp>.
set -eu
"$1" --defined-only --extern-only "$2" |
    awk '$2 == "T" && $3 !~ /RNS_[0-9]+[A-Z][a-z]+Counters/ &&
        ($3 ~ /^_ZNK?8espalier/ && $3 !~ /6detail/ || $3 ~ /^_ZN8espalier6detail[0-9]+[a-z_]+ERKNS_4BlobE/) { print "EXTERN(" $3 ")" }' | sort -u >"$3"
