// Filters: which triangles, instances or slots count, as an array of flags.

/// Returns flags as bytes, one for each of the `count` triangles, instances or slots; null for all.
export function flagsOf(only, count, name) {
    if (only == null) return null;
    const flags = Array.isArray(only) && only.every((flag) => typeof flag === 'boolean') ? Uint8Array.from(only) : only;
    if (!(flags instanceof Uint8Array))
        throw new TypeError(`only must be flags, a Uint8Array or an array of booleans; from numbers: flags = new Uint8Array(${count}), flags[number] = 1`);
    if (flags.length !== count) throw new RangeError(`only must have a flag for each of the ${count} ${name}, but has ${flags.length}`);
    return flags;
}

/// Throws for a query that has no filter, rather than pass over the flags in its options.
export function refuseFilter(options, name) {
    if (options?.only != null) throw new TypeError(`only is not for ${name}: flags are for queries that have a filter`);
}

/// Copies flags into memory of a batch and returns the address of an espalier_flags; 0 for all.
export function placeFlags(batch, flags) {
    if (flags === null) return 0;
    const first = batch.allocate(flags.length);
    batch.instance.array(Uint8Array, first, flags.length).set(flags);
    return batch.allocateStructure('flags', { first, count: flags.length });
}
