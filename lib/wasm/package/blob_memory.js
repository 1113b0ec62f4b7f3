// The memory of a blob within the module.
import { Batch } from './batch.js';
import { OpenError, QueryError } from './errors.js';

const OK = 0, NOT_OPEN = 16;

// Releases blobs that the program forgot. Engines without it keep them until free() is called.
const forgotten = typeof FinalizationRegistry === 'undefined'
    ? null : new FinalizationRegistry(({ instance, address }) => instance.release(address));

/// Bytes in the module's memory with the view of them that queries take, until free().
export class BlobMemory {
    #instance;
    #address = 0;
    #bytes;

    constructor(instance, bytes) {
        // A view is aligned to 16 bytes; the bytes of the blob follow it at a multiple of 64.
        const room = Math.ceil(instance.records.blob.bytes / 64) * 64;
        const address = instance.allocate(room + bytes.length);
        instance.array(Uint8Array, address + room, bytes.length).set(bytes);
        const status = instance.functions.espalier_open(address + room, bytes.length, address);
        if (status !== OK) {
            instance.release(address);
            throw new OpenError(instance.text(instance.functions.espalier_describe_open_status(status) >>> 0), status);
        }
        this.#instance = instance;
        this.#address = address;
        this.#bytes = { address: address + room, length: bytes.length };
        forgotten?.register(this, { instance, address }, this);
    }

    /// Releases the memory. All later queries throw. Freeing again does nothing.
    free() {
        if (this.#address === 0) return;
        forgotten?.unregister(this);
        this.#instance.release(this.#address);
        this.#address = 0;
    }

    get isFreed() {
        return this.#address === 0;
    }

    /// Returns a copy of the bytes, for a file.
    bytes() {
        return this.use((instance) => instance.array(Uint8Array, this.#bytes.address, this.#bytes.length).slice());
    }

    /// Calls run(instance, blob) with the address of the view. Throws after free().
    use(run) {
        if (this.#address === 0) throw new QueryError(this.#instance.describeQuery(NOT_OPEN), NOT_OPEN);
        return run(this.#instance, this.#address);
    }

    /// Calls run(batch) for a batch with these arguments, and releases its memory.
    batch(argumentsOfAll, run) {
        return this.use((instance, blob) => {
            const batch = new Batch(instance, blob, argumentsOfAll);
            try {
                return run(batch);
            } finally {
                batch.release();
            }
        });
    }
}
