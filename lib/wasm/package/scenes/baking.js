// Baking scenes: blobs and instances in the memory of an instance of the module that bakes once.
import { errorOf, resultOf } from '../bake.js';
import { Batch } from '../memory/batch.js';
import { fieldsOfInstances } from './instances.js';

const OK = 0;

function copied(batch, bytes) {
    const address = batch.allocate(bytes.length);
    batch.instance.array(Uint8Array, address, bytes.length).set(bytes);
    return { bytes: address, byteCount: bytes.length };
}

/// Checks the instances, and returns what bakes them with the bytes of blobs: a function of an instance of the module,
/// which serves once. It returns bytes, which lie in memory of that instance.
export function preparedScene(blobs, instances) {
    const fields = fieldsOfInstances(instances), all = Object.values(fields);
    return (instance) => {
        const batch = new Batch(instance, 0, all), { bytes: size } = instance.records.bytes;
        const blobsAt = batch.allocateRecords('bytes', blobs.length);
        blobs.forEach((bytes, i) => instance.write('bytes', blobsAt + i * size, copied(batch, bytes)));
        const result = resultOf(instance, 'espalier_bake_scene', blobsAt, blobs.length, batch.placeRecords('instance', fields), batch.count);
        if (result.status !== OK) throw errorOf(instance, result);
        return instance.array(Uint8Array, result.bytes, result.byteCount);
    };
}
