// Bytes that were opened, in the memory of the module.
import { Batch } from './batch.js';
import { OpenError, QueryError } from '../errors.js';

const OK = 0, NOT_OPEN = 16;

// Releases what the program forgot. Engines without it keep that until free() is called.
const forgotten = typeof FinalizationRegistry === 'undefined'
    ? null : new FinalizationRegistry(({ instance, addresses }) => releaseAll(instance, addresses));

function releaseAll(instance, addresses) {
    for (const address of addresses) instance.release(address);
}

/// Bytes in the module's memory with the view of them that queries take, until free().
export class Opened {
    #instance;
    #view = 0;
    #bytes;

    /// Copies the bytes and calls open(view, address, length), which returns the library's status. The view has the number
    /// of bytes that sizeOfView(address, length) returns.
    constructor(instance, bytes, sizeOfView, open) {
        const { length } = bytes, addresses = [instance.allocate(length)];
        try {
            const [address] = addresses;
            instance.array(Uint8Array, address, length).set(bytes);
            const view = instance.allocate(sizeOfView(address, length));
            addresses.push(view);
            const status = open(view, address, length);
            if (status !== OK) throw new OpenError(instance.text(instance.functions.espalier_describe_open_status(status) >>> 0), status);
        } catch (error) {
            releaseAll(instance, addresses);
            throw error;
        }
        this.#instance = instance;
        this.#view = addresses[1];
        this.#bytes = { address: addresses[0], length };
        forgotten?.register(this, { instance, addresses }, this);
    }

    /// Releases the memory. All later queries throw. Freeing again does nothing.
    free() {
        if (this.#view === 0) return;
        forgotten?.unregister(this);
        releaseAll(this.#instance, [this.#bytes.address, this.#view]);
        this.#view = 0;
    }

    get isFreed() {
        return this.#view === 0;
    }

    /// Returns a copy of the bytes, for a file.
    bytes() {
        return this.use((instance) => instance.array(Uint8Array, this.#bytes.address, this.#bytes.length).slice());
    }

    /// Calls run(instance, view) with the address of the view. Throws after free().
    use(run) {
        if (this.#view === 0) throw new QueryError(this.#instance.describeQuery(NOT_OPEN), NOT_OPEN);
        return run(this.#instance, this.#view);
    }

    /// Returns the address of the view, for a call of an instance. Throws if the view is in the memory of another.
    viewIn(instance) {
        return this.use((own, view) => {
            if (own !== instance) throw new TypeError('all blobs of a call must come from one load()');
            return view;
        });
    }

    /// Calls run(batch) for a batch with these arguments, and releases its memory.
    batch(argumentsOfAll, run) {
        return this.use((instance, view) => {
            const batch = new Batch(instance, view, argumentsOfAll);
            try {
                return run(batch);
            } finally {
                batch.release();
            }
        });
    }

    /// Returns the fields of a structure that a function of C writes.
    structure(record, name) {
        return this.use((instance, view) => {
            const address = instance.allocate(instance.records[record].bytes);
            instance.functions[name](address, view);
            const fields = instance.read(record, address);
            instance.release(address);
            return fields;
        });
    }
}
