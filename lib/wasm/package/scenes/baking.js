// Baking scenes: blobs and instances in the memory of an instance of the module that bakes once.
import { integer } from '../arguments.js';
import { errorOf, resultOf } from '../bake.js';
import { Batch } from '../memory/batch.js';
import { fieldsOfPlaces } from '../places.js';

const OK = 0, ALL = 0xFFFFFFFF;

/// Makes an argument of integers of 32 bits, one for each instance or one for all.
function column(given, name) {
    const array = typeof given === 'number' ? [given] : given;
    if (!Array.isArray(array) && !(ArrayBuffer.isView(array) && !(array instanceof DataView)))
        throw new TypeError(`${name} must be an integer or an array of integers`);
    const numbers = array instanceof Uint32Array ? array : Uint32Array.from(array, (number) => integer(number, name));
    return { name, array: numbers, count: numbers.length, stride: 1 };
}

function copied(batch, bytes) {
    const address = batch.allocate(bytes.length);
    batch.instance.array(Uint8Array, address, bytes.length).set(bytes);
    return { bytes: address, byteCount: bytes.length };
}

/// Checks the instances, and returns what bakes them with the bytes of blobs: a function of an instance of the module,
/// which serves once. It returns bytes, which lie in memory of that instance.
export function preparedScene(blobs, { mesh = 0, mask = ALL, user = 0, ...places } = {}) {
    const fields = {
        ...fieldsOfPlaces(places, 'instances'), mesh: column(mesh, 'mesh'), mask: column(mask, 'mask'),
        user: column(user, 'user'), source: column(0, 'source'),
    };
    const all = Object.values(fields);
    return (instance) => {
        const batch = new Batch(instance, 0, all), { bytes: size } = instance.records.bytes;
        const blobsAt = batch.allocateRecords('bytes', blobs.length);
        blobs.forEach((bytes, i) => instance.write('bytes', blobsAt + i * size, copied(batch, bytes)));
        const result = resultOf(instance, 'espalier_bake_scene', blobsAt, blobs.length, batch.placeRecords('instance', fields), batch.count);
        if (result.status !== OK) throw errorOf(instance, result);
        return instance.array(Uint8Array, result.bytes, result.byteCount);
    };
}
