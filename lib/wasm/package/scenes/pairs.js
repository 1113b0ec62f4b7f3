// The pairs of instances of a moving scene, with itself or with a baked scene.
const OUTPUT_FULL = 3, LARGEST = 0xFFFFFFFF, FIRST_ROOM = 1024;

/// Checks where a query begins: the numbers of a pair. Without any, it is the first one.
function startOf(start, names) {
    if (start == null) return names.map(() => 0);
    const numbers = Array.from(start);
    if (numbers.length !== names.length || !numbers.every((number) => Number.isInteger(number) && number >= 0 && number <= LARGEST))
        throw new RangeError(`start must be ${names.length} integers from 0 to ${LARGEST}, as next of the call before`);
    return numbers;
}

/// Returns the pairs of one kind, 'instance_pair' or 'baked_pair', and whether they are all. call(filled, room, filter,
/// from) writes those from a pair on.
export function collectPairs(batch, kind, { onlyMoved = false, start } = {}, call) {
    const { bytes, fields } = batch.instance.records[kind], names = Object.keys(fields);
    const numbers = startOf(start, names);
    const from = batch.allocateStructure(kind, Object.fromEntries(names.map((name, i) => [name, numbers[i]])));
    const filter = batch.allocateStructure('pair_filter', { onlyMoved: Number(Boolean(onlyMoved)) });
    const filledRecord = `filled_${kind}s`, filledAt = batch.allocateStructure(filledRecord);
    let capacity = FIRST_ROOM, pairs = batch.instance.allocate(bytes * capacity);
    try {
        while (true) {
            call(filledAt, { pairs, capacity }, filter, from);
            const filled = batch.instance.read(filledRecord, filledAt);
            if (filled.status !== OUTPUT_FULL)
                return { items: batch.columns(kind, pairs, filled.count), status: filled.status, next: names.map((name) => filled[name]) };
            // A first page with room for all takes one walk of the tree, every other one a walk from each slot.
            capacity *= 4;
            pairs = batch.instance.reallocate(pairs, bytes * capacity);
        }
    } finally {
        batch.instance.release(pairs);
    }
}
