// Pairs of blobs, each at one place in the world or at many.
import { Strided, visits } from './arguments.js';
import { Blob } from './blob.js';
import { refuseFilter } from './filters.js';
import { fieldsOfPlaces, movedTogether } from './places.js';
import { Lists, YesNo } from './results.js';

/// The fields of results that are places.
const PLACES = ['points', 'onA', 'onB'];

export function overlaps(a, b, options) {
    return answers('wasm_pair_overlaps', a, b, {}, options);
}

export function withinDistance(a, b, distance, options) {
    return answers('wasm_pair_within_distance', a, b, { distance }, options);
}

export function firstContact(a, b, options) {
    return records('pair_contact', 'wasm_pair_first_contact', a, b, {}, options);
}

export function distance(a, b, { maxDistance = Infinity, ...options } = {}) {
    return records('blob_distance', 'wasm_pair_distance', a, b, { maxDistance }, options);
}

export function contacts(a, b, options) {
    return lists('pair_contact', 'wasm_pair_contacts', a, b, options);
}

export function touches(a, b, options) {
    return lists('pair_touch', 'wasm_pair_touches', a, b, options);
}

/// Returns the points of touches() as contacts of body b with the surface a, for reduceContacts().
export function touchContacts({ offsets, items, status }) {
    const before = new Uint32Array(items.count.length + 1);
    items.count.forEach((count, i) => { before[i + 1] = before[i] + count; });
    const total = before.at(-1);
    const contacts = {
        point: new items.points.constructor(3 * total), normal: new Float32Array(3 * total), distance: new Float32Array(total),
        triangle: new Uint32Array(total), feature: new Uint8Array(total), side: new Uint8Array(total),
    };
    items.count.forEach((count, i) => {
        for (let k = 0; k < count; ++k) {
            const at = before[i] + k;
            contacts.point.set(items.points.subarray(18 * i + 3 * k, 18 * i + 3 * k + 3), 3 * at);
            contacts.normal.set(items.normal.subarray(3 * i, 3 * i + 3), 3 * at);
            contacts.distance[at] = -items.depth[i];
            contacts.triangle[at] = items.a[i];
        }
    });
    return new Lists(offsets.map((offset) => before[offset]), contacts, status);
}

function answers(name, a, b, numbers, options) {
    return ofPair(a, b, numbers, options, (batch, pair, limit, others) => {
        const statuses = batch.allocate(batch.count);
        batch.functions[name](statuses, ...pair(0), batch.count, limit, ...others);
        return new YesNo(batch.copy(Uint8Array, statuses));
    });
}

function records(record, name, a, b, numbers, options) {
    return ofPair(a, b, numbers, options, (batch, pair, limit, others, inWorld) => {
        const results = batch.allocateRecords(record);
        batch.functions[name](results, ...pair(0), batch.count, limit, ...others);
        return inWorld(batch.columns(record, results));
    });
}

function lists(record, name, a, b, options) {
    return ofPair(a, b, {}, options, (batch, pair, limit, others, inWorld) => {
        const all = batch.collect(batch.instance.records[record].bytes, (filled, done, to) => batch.functions[name](
            filled, ...pair(done), to.statuses, to.offsets, to.count, to.items, to.capacity, limit),
        (items, count) => batch.columns(record, items, count));
        return new Lists(all.offsets, inWorld(all.items, all.offsets), all.status);
    });
}

/// Calls use(batch, pair, limit, others, inWorld), where pair(n) has both blobs and their places from n on, others are the
/// addresses of the numbers, and inWorld(items, offsets) moves results into the caller's world.
function ofPair(a, b, numbers, { workLimit = Infinity, ...rest } = {}, use) {
    refuseFilter(rest, 'a query of two blobs');
    const first = placed(a, 'a'), second = placed(b, 'b'), limit = visits(workLimit);
    const others = Object.entries(numbers).map(([name, given]) => new Strided(given, 1, name));
    const { fields: fieldsOfBoth, world } = movedTogether([first.blob, second.blob], [first.fields, second.fields]);
    const all = [...fieldsOfBoth.flatMap((fields) => Object.values(fields)), ...others];
    const inWorld = (items, offsets) => (world === null ? items : moved(items, world, offsets));
    return first.blob.batch(all, (batch) => {
        const blobs = [batch.view, second.blob.viewIn(batch.instance)];
        const places = fieldsOfBoth.map((fields) => batch.placeRecords('transform', fields));
        const { bytes } = batch.instance.records.transform;
        const pair = (done) => [...blobs, ...places.map((address) => address + done * bytes)];
        return use(batch, pair, limit, others.map((each) => batch.placePacked(each, 1)), inWorld);
    });
}

/// Returns results whose places are moved, each by the three numbers of its query. `offsets`: those of lists.
function moved(items, world, offsets) {
    const count = items.a.length, queries = Uint32Array.from({ length: count }, (_, i) => i), result = { ...items };
    for (let query = 0; offsets !== undefined && query + 1 < offsets.length; ++query) queries.fill(query, offsets[query], offsets[query + 1]);
    if (world.length === 3) queries.fill(0);
    for (const name of PLACES.filter((place) => place in items)) {
        const width = items[name].length / count;
        result[name] = Float64Array.from(items[name], (x, i) => x + world[3 * queries[Math.floor(i / width)] + i % 3]);
    }
    return result;
}

function placed(given, name) {
    const { blob, ...places } = given instanceof Blob ? { blob: given } : given ?? {};
    if (!(blob instanceof Blob)) throw new TypeError(`${name} must be a blob, or an object with a blob and its places`);
    return { blob, fields: fieldsOfPlaces(places, name) };
}
