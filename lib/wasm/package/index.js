// Espalier: baked collision meshes, queried straight from their bytes.
import { Strided } from './arguments.js';
import { preparedBake, preparedJoin, resultOf } from './bake.js';
import { Blob } from './blob.js';
import { reduced, solved } from './contacts.js';
import { VerifyError } from './errors.js';
import { compiled, hasSimd, moduleBeside } from './load.js';
import { Instance } from './memory/instance.js';
import { Opened } from './memory/opened.js';
import { preparedScene } from './scenes/baking.js';
import { MovingScene } from './scenes/moving_scene.js';
import { Scene } from './scenes/scene.js';

export { Blob } from './blob.js';
export { BakeError, EspalierError, MemoryError, OpenError, QueryError, VerifyError } from './errors.js';
export { hasSimd } from './load.js';
export * as pairs from './pairs.js';
export { EdgeKind, Feature, Lists, NO_TRIANGLE, Side, Status, YesNo } from './results.js';
export { MovingScene } from './scenes/moving_scene.js';
export { Scene } from './scenes/scene.js';

const OK = 0;

/// The library, loaded. Blobs lie in the memory of one instance. Each bake has an instance of its own, since a WebAssembly
/// memory never shrinks.
class Espalier {
    #module;
    #instance;

    constructor(module, instance) {
        this.#module = module;
        this.#instance = instance;
    }

    get version() {
        return this.#instance.text(this.#instance.functions.espalier_version() >>> 0);
    }

    /// Returns one English sentence of a status.
    describe(status) {
        return this.#instance.describeQuery(status);
    }

    reduceContacts(lists) {
        return reduced(this.#instance, lists);
    }

    solvePlanes(lists, wishes, skins) {
        return solved(this.#instance, lists, wishes, skins);
    }

    async bake(meshes, options) {
        const run = preparedBake(meshes, options);
        const { bytes, ...facts } = run(await Instance.create(this.#module));
        return new Blob(this.#instance, bytes, facts);
    }

    openBlob(source) {
        return new Blob(this.#instance, bytesOf(source));
    }

    async joinBorders(blobs, translations = [0, 0, 0]) {
        const run = preparedJoin(blobs.map(bytesOf), new Strided(translations, 3, 'translations'));
        return run(await Instance.create(this.#module)).map((bytes) => new Blob(this.#instance, bytes));
    }

    async bakeScene(blobs, instances, options) {
        const run = preparedScene(blobs.map(bytesOf), instances, options);
        const { bytes, report } = run(await Instance.create(this.#module));
        return new Scene(this.#instance, bytes, report);
    }

    openScene(source) {
        return new Scene(this.#instance, bytesOf(source));
    }

    createMovingScene(blobs, capacity, options) {
        return MovingScene.create(this.#instance, blobs, capacity, options);
    }

    openMovingScene(snapshot, blobs, options) {
        return MovingScene.open(this.#instance, bytesOf(snapshot), blobs, options);
    }

    async verify(source) {
        await this.#check('espalier_verify', source);
    }

    async verifyScene(source) {
        await this.#check('espalier_verify_scene', source);
    }

    async #check(name, source) {
        const bytes = bytesOf(source);
        const instance = await Instance.create(this.#module);
        const address = instance.allocate(bytes.length);
        instance.array(Uint8Array, address, bytes.length).set(bytes);
        const result = resultOf(instance, name, address, bytes.length);
        if (result.status !== OK) throw new VerifyError(instance.text(result.message), result.status);
    }
}

function bytesOf(source) {
    if (source instanceof Opened) return source.bytes();
    if (source instanceof Uint8Array) return source;
    if (ArrayBuffer.isView(source)) return new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
    if (source instanceof ArrayBuffer) return new Uint8Array(source);
    throw new TypeError('the bytes of a blob or a scene must be an ArrayBuffer or a view of one');
}

export async function load(source, { simd = hasSimd() } = {}) {
    const module = await compiled(source ?? moduleBeside(simd));
    return new Espalier(module, await Instance.create(module));
}
