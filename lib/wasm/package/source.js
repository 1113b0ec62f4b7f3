// Places in the coordinates of the source. Those of a blob count from its origin, which float32 may not hold.

/// Returns where 0 0 0 of an open blob is in its source, or that of a view of a moving scene in its world: three numbers,
/// or null where it is there.
export function originOf(instance, view, name = 'espalier_blob_source_origin') {
    const at = instance.allocate(instance.records.vec3d.bytes);
    instance.functions[name](at, view);
    const { x, y, z } = instance.read('vec3d', at);
    instance.release(at);
    return x === 0 && y === 0 && z === 0 ? null : [x, y, z];
}

/// Returns the numbers of an argument as they are from an origin, in double: places, or planes of four numbers.
export function seenFrom([x, y, z], { array, stride, count, components }) {
    const seen = new Float64Array(array);
    for (let i = 0, at = 0; i < count; ++i, at += stride) {
        if (components === 4) {
            seen[at + 3] -= seen[at] * x + seen[at + 1] * y + seen[at + 2] * z;
        } else {
            seen[at] -= x;
            seen[at + 1] -= y;
            seen[at + 2] -= z;
        }
    }
    return seen;
}

/// Returns places in the coordinates of the source: a Float64Array, or without an origin a Float32Array.
export function inSource(places, origin) {
    if (origin !== null) return Float64Array.from(places, (x, i) => x + origin[i % 3]);
    return places instanceof Float32Array ? places : Float32Array.from(places);
}
