// What is made of lists of contacts and of planes, without a blob.
import { column, Strided } from './arguments.js';
import { Batch, fieldsOf, PLACE } from './memory/batch.js';
import { Lists } from './results.js';

const CONTACT = { point: PLACE, normal: 3, distance: 1, triangle: 1, feature: 1, side: 1 };
const CONTACT_PLANE = { normal: 3, distance: 1, triangle: 1 };

/// Returns of each list of contacts those that support its body best.
export function reduced(instance, lists) {
    const { offsets, items, status } = checked(lists, CONTACT, 'contacts');
    return within([instance, 0, [column(items.distance, 'contacts')], originOf(items.point)], (batch) => {
        // The contacts take their own numbers for those of triangles, which play no part.
        const triangle = column(Uint32Array.from({ length: batch.count }, (_, i) => i), 'contacts');
        const contacts = batch.placeRecords('contact', { ...fieldsOf(items, CONTACT, 'contacts'), triangle });
        const at = placeOffsets(batch, offsets);
        batch.functions.wasm_reduce_contacts(contacts, at, lists.length);
        const ends = batch.copy(Uint32Array, at, offsets.length);
        const { triangle: kept } = batch.columns('contact', contacts, ends.at(-1));
        return new Lists(ends, picked(items, kept, batch.count), status);
    });
}

/// Returns the way along each list of planes.
export function solved(instance, lists, wishes, skins) {
    const { offsets, items } = checked(lists, CONTACT_PLANE, 'planes');
    const wish = new Strided(wishes, 3, 'wishes'), skin = new Strided(skins, 1, 'skins');
    return within([instance, 0, [column(items.distance, 'planes')]], (all) => {
        const planes = all.placeRecords('contact_plane', fieldsOf(items, CONTACT_PLANE, 'planes'));
        return within([instance, 0, [{ name: 'planes', count: lists.length }, wish, skin]], (batch) => {
            if (batch.count !== lists.length) throw new RangeError(`there are ${lists.length} lists of planes, but another argument has ${batch.count}`);
            const ways = batch.allocateRecords('vec3_result');
            batch.functions.wasm_solve_planes(ways, planes, placeOffsets(batch, offsets), batch.placePacked(wish, 3),
                                              batch.placePacked(skin, 1), batch.count);
            return batch.columns('vec3_result', ways);
        });
    });
}

/// Throws TypeError for lists of other items, and RangeError where they were changed.
function checked(lists, fields, name) {
    if (!(lists instanceof Lists) || Object.keys(fields).some((field) => lists.items[field] === undefined))
        throw new TypeError(`${name} must be lists that ${name}() returned`);
    const { offsets, items } = lists, count = items.distance.length;
    const areOffsets = offsets.length === lists.length + 1 && offsets.every((offset, i) => i === 0 || offset >= offsets[i - 1]) && offsets.at(-1) <= count;
    const areItems = Object.entries(fields).every(([field, width]) => items[field].length === (width === PLACE ? 3 : width) * count);
    if (!areOffsets || !areItems) throw new RangeError(`${name} are not the lists that ${name}() returned: offsets and items do not match`);
    return lists;
}

/// Where the points of contacts with a blob that has an origin count from here: where the first one is.
const originOf = (point) => (point instanceof Float64Array && point.length > 0 ? [...point.subarray(0, 3)] : null);

function within(argumentsOfBatch, use) {
    const batch = new Batch(...argumentsOfBatch);
    try {
        return use(batch);
    } finally {
        batch.release();
    }
}

function placeOffsets(batch, offsets) {
    const at = batch.allocate(4 * offsets.length);
    batch.instance.array(Uint32Array, at, offsets.length).set(offsets);
    return at;
}

/// Returns the fields of some of `count` items, by number.
function picked(items, numbers, count) {
    const result = {};
    for (const [name, array] of Object.entries(items)) {
        const width = count === 0 ? 1 : array.length / count, kept = new array.constructor(width * numbers.length);
        numbers.forEach((number, i) => kept.set(array.subarray(width * number, width * (number + 1)), width * i));
        result[name] = kept;
    }
    return result;
}
