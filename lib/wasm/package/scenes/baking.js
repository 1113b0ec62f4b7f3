// Baking scenes: blobs and instances in the memory of an instance of the module that bakes once.
import { errorOf, fieldsOfOrigin, resultOf, warningsOf } from '../bake.js';
import { Batch } from '../memory/batch.js';
import { fieldsOfInstances } from './instances.js';

const OK = 0;

function copied(batch, bytes) {
    const address = batch.allocate(bytes.length);
    batch.instance.array(Uint8Array, address, bytes.length).set(bytes);
    return { bytes: address, byteCount: bytes.length };
}

/// Returns the address of the translations of all instances, in double; of float32, which transforms hold, 0.
function placeTranslations(batch, argument) {
    if (argument.array instanceof Float32Array) return 0;
    const { first, stride } = batch.place(argument, Float64Array), { bytes } = batch.instance.records.vec3d;
    const packed = batch.allocateRecords('vec3d');
    batch.functions.wasm_copy_fields(first, stride, packed, bytes, bytes, batch.count);
    return packed;
}

/// Checks the instances, and returns what bakes them with the bytes of blobs: a function of an instance of the module,
/// which serves once. It returns bytes, which lie in memory of that instance, and the report.
export function preparedScene(blobs, instances, options = {}) {
    if (blobs.length > 1 && instances?.mesh == null)
        throw new RangeError(`mesh must have the number of the blob of each instance, as there are ${blobs.length} blobs`);
    const fields = fieldsOfInstances(instances), all = Object.values(fields), origin = fieldsOfOrigin(options);
    return (instance) => {
        const batch = new Batch(instance, 0, all), { bytes: size } = instance.records.bytes;
        const blobsAt = batch.allocateRecords('bytes', blobs.length);
        blobs.forEach((bytes, i) => instance.write('bytes', blobsAt + i * size, copied(batch, bytes)));
        const optionsAt = batch.allocateRecords('scene_bake_options', 1);
        instance.functions.espalier_init_scene_bake_options(optionsAt, instance.records.scene_bake_options.bytes);
        instance.write('scene_bake_options', optionsAt, { translations: placeTranslations(batch, fields.translation), ...origin });
        const instancesAt = batch.placeRecords('instance', fields);
        const result = resultOf(instance, 'espalier_bake_scene', blobsAt, blobs.length, instancesAt, batch.count, optionsAt);
        if (result.status !== OK) throw errorOf(instance, result);
        return {
            bytes: instance.array(Uint8Array, result.bytes, result.byteCount),
            report: { warnings: warningsOf(instance, instance.read('bake_report', result.report)) },
        };
    };
}
