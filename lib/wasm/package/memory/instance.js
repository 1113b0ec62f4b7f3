// One instance of a module: its functions, its memory, and the layouts of its structures.
import { MemoryError } from '../errors.js';
import { importsOf } from './imports.js';

const NO_MEMORY = 17;
/// All that a memory of 32-bit addresses may hold, but for the smallest module.
const LARGEST_ALLOCATION = 0xFFFF0000;
const WORDS_OF_FIELD = 4, WORDS_OF_RECORD = 4;

/// The arrays of numbers of each kind of layouts.cpp.
const ARRAYS = {
    b: Uint8Array, h: Uint16Array, w: Uint32Array, i: Int32Array, q: BigUint64Array, f: Float32Array, d: Float64Array,
};
const SET = { b: 'setUint8', h: 'setUint16', w: 'setUint32', i: 'setInt32', q: 'setBigUint64', f: 'setFloat32', d: 'setFloat64' };
const GET = { b: 'getUint8', h: 'getUint16', w: 'getUint32', i: 'getInt32', q: 'getBigUint64', f: 'getFloat32', d: 'getFloat64' };

/// first_corner: firstCorner
const camelCase = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());

export class Instance {
    /// Makes an instance. Each has memory of its own.
    static async create(module) {
        let exports = null;
        const instance = await WebAssembly.instantiate(module, importsOf(() => exports.memory.buffer));
        exports = instance.exports;
        return new Instance(exports);
    }

    constructor(exports) {
        this.functions = exports;
        exports._initialize();
        this.records = this.#readRecords();
    }

    /// Returns a view of memory, which is valid until memory grows.
    array(Type, address, length) {
        return new Type(this.functions.memory.buffer, address, length);
    }

    /// Returns the address of memory that begins at a multiple of 64 bytes.
    allocate(bytes) {
        if (bytes > LARGEST_ALLOCATION) return this.#checked(0, bytes);
        return this.#checked(this.functions.aligned_alloc(64, Math.ceil(Math.max(bytes, 1) / 64) * 64), bytes);
    }

    /// Returns the address of memory with the content of that at `address`, which it releases.
    reallocate(address, bytes) {
        if (bytes > LARGEST_ALLOCATION) return this.#checked(0, bytes);
        return this.#checked(this.functions.realloc(address, bytes), bytes);
    }

    release(address) {
        this.functions.free(address);
    }

    /// Returns the zero-terminated text at an address.
    text(address) {
        const bytes = this.array(Uint8Array, address);
        return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
    }

    describeQuery(status) {
        return this.text(this.functions.espalier_describe_query_status(status) >>> 0);
    }

    /// Writes fields of a structure: numbers, each under its name.
    write(record, address, fields) {
        const view = new DataView(this.functions.memory.buffer, address, this.records[record].bytes);
        for (const [name, value] of Object.entries(fields)) {
            const { offset, kind, count } = this.records[record].fields[name];
            const values = count === 1 ? [value] : value;
            for (let i = 0; i < count; ++i) view[SET[kind]](offset + i * ARRAYS[kind].BYTES_PER_ELEMENT, values[i], true);
        }
    }

    /// Returns the fields of a structure, each under its name; several numbers in a row are an array.
    read(record, address) {
        const view = new DataView(this.functions.memory.buffer, address, this.records[record].bytes);
        const result = {};
        for (const [name, { offset, kind, count }] of Object.entries(this.records[record].fields)) {
            const at = (i) => Number(view[GET[kind]](offset + i * ARRAYS[kind].BYTES_PER_ELEMENT, true));
            result[name] = count === 1 ? at(0) : Array.from({ length: count }, (_, i) => at(i));
        }
        return result;
    }

    #checked(address, bytes) {
        if (address === 0) throw new MemoryError(`there is no memory for ${bytes} bytes`, NO_MEMORY);
        return address >>> 0;
    }

    #readRecords() {
        const records = {};
        const buffer = this.functions.memory.buffer;
        for (let at = this.functions.wasm_records() >>> 0;; at += 4 * WORDS_OF_RECORD) {
            const [name, bytes, fieldCount, fields] = new Uint32Array(buffer, at, WORDS_OF_RECORD);
            if (name === 0) return records;
            const record = { bytes, fields: {} };
            for (let i = 0; i < fieldCount; ++i) {
                const [fieldName, offset, kind, count] = new Uint32Array(buffer, fields + 4 * WORDS_OF_FIELD * i, WORDS_OF_FIELD);
                record.fields[camelCase(this.text(fieldName))] = {
                    offset, kind: String.fromCharCode(kind), count,
                    Type: ARRAYS[String.fromCharCode(kind)],
                };
            }
            records[this.text(name)] = record;
        }
    }
}
