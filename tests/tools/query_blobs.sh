# Blobs for tests of `espalier query`, besides those of meshes.sh: sourced with the path of espalier as $1.
# shellcheck shell=bash
# shellcheck source=meshes.sh
. "$(dirname "${BASH_SOURCE[0]}")/meshes.sh"

# Beams through a crowd of small triangles: what spatial splits are for.
awk 'function unit() { s = (s * 1103 + 12345) % 65536; return s / 65536 }
    function add(x, y, z, dx, dy, dz) { printf "v %g %g %g\nv %g %g %g\nv %g %g %g\nf -3 -2 -1\n",
        x, y, z, x + dx, y + dy, z + dz, x + dx + 0.01, y + dy, z + dz + 0.01 }
    BEGIN { for (i = 0; i < 60; ++i) add(unit(), 0, unit(), unit() - 0.5, 1, unit() - 0.5)
        for (i = 0; i < 600; ++i) add(unit(), unit(), unit(), 0.01, 0.02, 0) }' >beams.obj
"$espalier" bake box.obj -o full.espl -q --ids --flat-angle 5 --bounds obb,sphere,kdop || fail "no box with everything"
"$espalier" bake beams.obj -o split.espl -q --profile fast --builder spatial_splits --duplicate-budget 1 || fail "no splits"
