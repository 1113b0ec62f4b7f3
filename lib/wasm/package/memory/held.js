// What a program holds in the module's memory until it frees it.
import { QueryError } from '../errors.js';
import { Batch } from './batch.js';

const NOT_OPEN = 16;

/// Memory that several may hold, such as the bytes of a blob and a moving scene that places it. The last one that lets it
/// go releases it.
export class Memory {
    #instance;
    #addresses;
    #holders = 1;

    constructor(instance, addresses) {
        this.#instance = instance;
        this.#addresses = addresses;
    }

    hold() {
        ++this.#holders;
        return this;
    }

    letGo() {
        if (--this.#holders === 0) releaseAll(this.#instance, this.#addresses);
    }
}

export function releaseAll(instance, addresses) {
    for (const address of addresses) instance.release(address);
}

const letGoOf = (memories) => memories.forEach((memory) => memory.letGo());

// Releases what the program forgot. Engines without it keep that until free() is called.
const forgotten = typeof FinalizationRegistry === 'undefined' ? null : new FinalizationRegistry(letGoOf);

/// A view that queries take, and the memory that it needs, until free().
export class Held {
    #instance;
    #view;
    #memories;

    /// Takes over the memory: an array whose first element holds the view. A subclass may replace others.
    constructor(instance, view, memories) {
        this.#instance = instance;
        this.#view = view;
        this.#memories = memories;
        forgotten?.register(this, memories, this);
    }

    /// Releases the memory. All later queries throw. Freeing again does nothing.
    free() {
        if (this.#view === 0) return;
        forgotten?.unregister(this);
        letGoOf(this.#memories);
        this.#view = 0;
    }

    get isFreed() {
        return this.#view === 0;
    }

    /// Calls run(instance, view) with the address of the view. Throws after free().
    use(run) {
        if (this.#view === 0) throw new QueryError(this.#instance.describeQuery(NOT_OPEN), NOT_OPEN);
        return run(this.#instance, this.#view);
    }

    /// Returns the address of the view, for a call of an instance. Throws if the view is in the memory of another.
    viewIn(instance) {
        return this.use((own, view) => {
            if (own !== instance) throw new TypeError('all blobs and scenes of a call must come from one load()');
            return view;
        });
    }

    /// Returns the memory with the view, for one more that holds it.
    shared() {
        return this.use(() => this.#memories[0].hold());
    }

    /// Where 0 0 0 of the view is in the coordinates of the source, of which arguments are: three numbers, or null.
    get sourceOrigin() {
        return null;
    }

    /// Calls run(batch) for a batch with these arguments, and releases its memory.
    batch(argumentsOfAll, run) {
        return this.use((instance, view) => {
            const batch = new Batch(instance, view, argumentsOfAll, this.sourceOrigin);
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
