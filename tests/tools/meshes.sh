# Small meshes and their blobs, for tests of the command: sourced with the path of espalier as $1. Leaves the script in a
# new folder that contains them.
# shellcheck shell=bash
# shellcheck source=claims.sh
. "$(dirname "${BASH_SOURCE[0]}")/claims.sh"

# dumps_all BLOB: `espalier dump` shows every byte once and in order
dumps_all() {
    "$espalier" dump "$1" | grep -v '^--' | cut -c 11-57 | tr -d ' \n' >dumped
    od -A n -v -t x1 "$1" | tr -d ' \n' >expected
    same dumped expected
}
# The bounds that stderr names, up to what the lattice may move them.
bounds_near() {
    sed -n 's/^bounds: \(.*\) to \(.*\), extent.*/\1 \2/p' err | awk -v expected="$*" '
        { n = split(expected, e, " "); for (i = 1; i <= 6; ++i) { size = e[i + 3] - e[i]; if (i > 3) size = e[i] - e[i - 3]
            d = $i - e[i]; if (d < 0) d = -d; if (d > 1e-3 * size) bad = 1 } } END { exit bad || NR != 1 }' ||
        fail "not near the bounds $*: $(grep bounds err)"
}
# nothing but the given files
only() { [ "$(ls -A "$1" | tr '\n' ' ')" = "$2" ] || fail "$1 holds $(ls -A "$1" | tr '\n' ' ')"; }

# ---- meshes ---------------------------------------------------------------------------------------------------------
# The box of claims.sh in other formats.
write_box_ply() {
    printf 'ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element face 12\nproperty list uchar int vertex_indices\nend_header\n'
    printf '%s\n' "${corners[@]}"
    printf '3 %s\n' "${faces[@]}"
}
write_box_stl() {
    echo "solid box"
    for face in "${faces[@]}"; do
        echo "facet normal 0 0 0"
        echo "outer loop"
        for index in $face; do echo "vertex ${corners[$index]}"; done
        echo "endloop"
        echo "endfacet"
    done
    echo "endsolid box"
}
# The box in Collada, under a node with the given transform elements, unit in metres, up axis.
write_box_collada() { # TRANSFORM METRES UP
    local indices=${faces[*]} positions=${corners[*]}
    cat <<COLLADA
<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><created>2020-01-01T00:00:00Z</created><modified>2020-01-01T00:00:00Z</modified>
  <unit meter="$2" name="unit"/><up_axis>$3</up_axis></asset>
 <library_geometries><geometry id="box" name="box"><mesh>
  <source id="p"><float_array id="pa" count="24">$positions</float_array><technique_common>
   <accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
   <param name="Z" type="float"/></accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>$indices</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n">$1<instance_geometry url="#box"/></node>
 </visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
COLLADA
}
write_box_obj 0 >box.obj
write_box_obj 10 >far_box.obj
write_box_ply >box.ply
write_box_stl >box.stl
# A bumpy sheet, large enough for a tree of several levels, of material 1.
write_sheet 40 '3 * sin(i / 5) * cos(j / 7)' | sed '0,/^f/s/^f/usemtl stone\nf/' >sheet.obj
"$espalier" bake box.obj -o box.espl -q || fail "the box cannot be baked"
"$espalier" bake sheet.obj -o sheet.espl -q --ids --materials || fail "the sheet cannot be baked"
"$espalier" bake box.obj far_box.obj -o two.espl -q --ids --materials || fail "the boxes cannot be baked"
# Sources and blobs that are broken, or empty.
printf 'v 0 0 0\nv 1 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n' >not_finite.obj
printf 'v 0 0 0\nv 1 0 0\np 1\nl 1 2\n' >points.obj
{ printf '\177ELF\002\001\001' && head -c 5000 /dev/zero; } >junk.glb # fixed bytes: any program's own may look like an OBJ
cp junk.glb junk.unknown
head -c 20 sheet.espl >stub.espl
{ head -c 200 sheet.espl; printf '\377\377'; tail -c +203 sheet.espl; } >changed.espl
"$espalier" bake points.obj -o empty.espl -q --allow-empty || fail "points cannot be baked"
