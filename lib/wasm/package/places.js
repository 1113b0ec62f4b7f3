// Places in the world: rotations, translations and uniform scales, each for one query or for all.
import { commonCount, Strided } from './arguments.js';
import { fieldsOf, PLACE } from './memory/batch.js';

const COMPONENTS = { rotation: 4, translation: PLACE, scale: 1 };
const ORIGIN = { rotation: [0, 0, 0, 1], translation: [0, 0, 0], scale: 1 };

/// Makes the arguments of places. What is not given is that of the origin.
export function fieldsOfPlaces(given, name) {
    const fields = {};
    for (const field of Object.keys(ORIGIN)) fields[field] = given[field] ?? ORIGIN[field];
    return fieldsOf(fields, COMPONENTS, name);
}

/// Returns the fields of two blobs' places as the library takes them, for what blobs count from their origins, and where its
/// world is in that of the caller: three numbers for each query, or null if they are the same. Both blobs are moved near 0
/// together, in double.
export function movedTogether(blobs, fieldsOfBlobs) {
    const [first, second] = fieldsOfBlobs, origins = blobs.map(({ sourceOrigin }) => sourceOrigin);
    if (origins.every((origin) => origin === null)) return { fields: fieldsOfBlobs, world: null };
    const count = commonCount([...Object.values(first), ...Object.values(second)]);
    const world = new Float64Array(3 * count), way = new Float64Array(3 * count);
    for (let i = 0; i < count; ++i) {
        const [from, to] = fieldsOfBlobs.map((fields, k) => placeOfOrigin(fields, origins[k] ?? [0, 0, 0], i));
        world.set(from, 3 * i);
        way.set(to.map((x, k) => x - from[k]), 3 * i);
    }
    const moved = (fields, translation) => ({ ...fields, translation: new Strided(translation, 3, 'translation') });
    return { fields: [moved(first, [0, 0, 0]), moved(second, way)], world };
}

/// Returns where the transform of a query moves a point.
function placeOfOrigin(fields, point, query) {
    const [rotation, translation, [scale]] = Object.keys(ORIGIN).map((name) => {
        const { array, count, stride, components } = fields[name], at = count === 1 ? 0 : query * stride;
        return Array.from(array.slice(at, at + components));
    });
    const [x, y, z, w] = rotation, scaled = point.map((coordinate) => scale * coordinate);
    const turned = cross([x, y, z], scaled), twice = cross([x, y, z], turned), square = x * x + y * y + z * z + w * w;
    return translation.map((offset, k) => offset + scaled[k] + 2 * (w * turned[k] + twice[k]) / square);
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
