// One call of a batch: its memory, its arguments and its results.
import { commonCount, places, Strided } from '../arguments.js';
import { QueryError } from '../errors.js';
import { Lists } from '../results.js';
import { inSource, seenFrom } from '../source.js';

const REFUSED = 16, OUTPUT_FULL = 3;
/// The fields of results that are places.
const PLACES = {
    closest_point_result: ['point', 'onShape'], sweep_hit: ['point'], contact: ['point'], triangle_result: ['value'],
    scene_closest_point_result: ['point', 'onShape'], scene_sweep_hit: ['point'], scene_contact: ['point'],
    instance: ['translation'], box_result: ['min', 'max'],
};
/// A field of three numbers that is a place.
export const PLACE = 'place';

/// A call of some queries of a blob or another view. Its memory is released by release(), which Held.batch() calls.
export class Batch {
    #memory = [];

    /// `origin`: where 0 0 0 of the view is in the coordinates of arguments and results, or null.
    constructor(instance, view, argumentsOfAll, origin = null) {
        this.instance = instance;
        this.functions = instance.functions;
        this.view = view;
        this.origin = origin;
        this.count = commonCount(argumentsOfAll);
    }

    allocate(bytes) {
        const address = this.instance.allocate(bytes);
        this.#memory.push(address);
        return address;
    }

    allocateRecords(record, count = this.count) {
        return this.allocate(this.instance.records[record].bytes * count);
    }

    /// Allocates a structure and writes fields of it; the others are 0.
    allocateStructure(record, fields = {}) {
        const address = this.allocateRecords(record, 1);
        this.instance.array(Uint8Array, address, this.instance.records[record].bytes).fill(0);
        this.instance.write(record, address, fields);
        return address;
    }

    /// Copies an argument into memory and returns where its first element is, and the bytes to the next.
    place(argument, Type = Float32Array) {
        const { stride, count } = argument;
        const array = this.origin !== null && argument.isOfPlaces ? seenFrom(this.origin, argument) : argument.array;
        const first = this.allocate(array.length * Type.BYTES_PER_ELEMENT);
        this.instance.array(Type, first, array.length).set(array);
        return { first, stride: count === 1 ? 0 : stride * Type.BYTES_PER_ELEMENT };
    }

    /// Copies an argument into memory, and returns the address of an espalier_strided_vec3 or another strided array of it.
    placeStrided(argument, Type = Float32Array) {
        return this.allocateStructure('strided_vec3', this.place(argument, Type));
    }

    /// Copies an argument into memory, packed and one element for each query, and returns its address.
    placePacked(argument, components) {
        const { first, stride } = this.place(argument);
        return this.#packed(first, stride, components, this.count);
    }

    /// Copies all elements of an argument into memory, packed, and returns the address.
    placeAll(argument, components) {
        return this.#packed(this.place(argument).first, 4 * argument.stride, components, argument.count);
    }

    #packed(first, stride, components, count) {
        const bytes = 4 * components;
        if (stride === bytes) return first;
        const packed = this.allocate(bytes * count);
        this.functions.wasm_copy_fields(first, stride, packed, bytes, bytes, count);
        return packed;
    }

    /// Returns the address of structures, one for each query, whose fields are the arguments of those names.
    placeRecords(record, argumentOf) {
        const { bytes, fields } = this.instance.records[record];
        const records = this.allocate(bytes * this.count);
        for (const [name, { offset, count, Type }] of Object.entries(fields)) {
            const { first, stride } = this.place(argumentOf[name], Type);
            this.functions.wasm_copy_fields(first, stride, records + offset, bytes, count * Type.BYTES_PER_ELEMENT, this.count);
        }
        return records;
    }

    /// Returns the fields of records, each in an array of its own; places in the coordinates of the source.
    columns(record, records, count = this.count) {
        const { bytes, fields } = this.instance.records[record];
        const column = this.allocate(bytes * count);
        const result = {};
        for (const [name, field] of Object.entries(fields)) {
            const width = field.count * field.Type.BYTES_PER_ELEMENT;
            this.functions.wasm_copy_fields(records + field.offset, bytes, column, width, width, count);
            const copy = this.copy(field.Type, column, field.count * count);
            result[name.replace('value.', '')] = PLACES[record]?.includes(name) ? inSource(copy, this.origin) : copy;
        }
        return result;
    }

    copy(Type, address, length = this.count) {
        return this.instance.array(Type, address, length).slice();
    }

    /// Calls a function that writes an espalier_filled first. Throws if it refuses the batch as a whole.
    fill(name, ...rest) {
        const filled = this.allocateStructure('filled');
        this.functions[name](filled, this.view, ...rest);
        this.check(this.instance.read('filled', filled).status);
    }

    check(status) {
        if (status >= REFUSED) throw new QueryError(this.instance.describeQuery(status), status);
    }

    /// Calls a function that writes an espalier_filled_lists, until all lists are there. call(filled, done, to) makes the
    /// call for the queries from `done` on. Returns the lists; itemsOf(address, count) makes their elements.
    collect(itemBytes, call, itemsOf) {
        const { count } = this;
        const filledAt = this.allocateStructure('filled_lists');
        const to = { statuses: this.allocate(count), offsets: this.allocate(4 * (count + 1)), capacity: 2 * count + 64 };
        let items = this.instance.allocate(itemBytes * to.capacity);
        try {
            const offsets = new Uint32Array(count + 1);
            let done = 0, found = 0;
            do {
                call(filledAt, done, {
                    statuses: to.statuses + done, offsets: to.offsets, count: count - done,
                    items: items + found * itemBytes, capacity: to.capacity - found,
                });
                const filled = this.instance.read('filled_lists', filledAt);
                this.check(filled.status);
                const written = this.instance.array(Uint32Array, to.offsets, filled.lists + 1);
                for (let i = 0; i <= filled.lists; ++i) offsets[done + i] = found + written[i];
                done += filled.lists;
                found += filled.count;
                if (filled.status !== OUTPUT_FULL) break;
                to.capacity = Math.max(2 * to.capacity, found + filled.needed);
                items = this.instance.reallocate(items, itemBytes * to.capacity);
            } while (true);
            return new Lists(offsets, itemsOf(items, found), this.copy(Uint8Array, to.statuses));
        } finally {
            this.instance.release(items);
        }
    }

    /// Makes lists of records of which `places` were reserved for each query, and the first of which are filled.
    pack(record, records, places, found) {
        const { bytes } = this.instance.records[record];
        const offsets = this.allocate(4 * (this.count + 1)), statuses = this.allocate(this.count);
        this.functions.wasm_pack_lists(records, bytes, places, found, offsets, statuses, this.count);
        const all = this.copy(Uint32Array, offsets, this.count + 1);
        return new Lists(all, this.columns(record, records, all[this.count]), this.copy(Uint8Array, statuses));
    }

    release() {
        for (const address of this.#memory) this.instance.release(address);
        this.#memory = [];
    }
}

/// Makes the arguments of shapes: { center: PLACE, radius: 1 } states how many numbers the fields have.
export function fieldsOf(given, components, name) {
    const fields = {};
    for (const [field, count] of Object.entries(components))
        fields[field] = count === PLACE ? places(given[field], `${name}.${field}`) : new Strided(given[field], count, `${name}.${field}`);
    return fields;
}
