// The arguments of a batch: arrays with some numbers for each query, or for all.

/// The largest number that the library takes for a triangle or a vertex; no blob has such a triangle.
const LARGEST = 0xFFFFFFFF;

/// A work limit that no query reaches.
const UNLIMITED = 0xFFFFFFFFFFFFFFFFn;

const CULLING = ['none', 'back', 'front'];

/// Returns the position of a name in a list of names.
export function choice(of, name, names) {
    const number = names.indexOf(name);
    if (number < 0) throw new RangeError(`${of} must be one of ${names.join(', ')}, not ${String(name)}`);
    return number;
}

/// Returns a number that the library takes as an integer: of 32 bits without a sign, unless other limits are given.
export function integer(number, name, lowest = 0, highest = LARGEST) {
    if (!Number.isInteger(number) || number < lowest || number > highest)
        throw new RangeError(`${name} must be an integer from ${lowest} to ${highest}, not ${String(number)}`);
    return number;
}

export const cullingNumber = (name) => choice('culling', name, CULLING);

/// Returns a typed array, or an array of numbers, as it is.
function numbers(array, name) {
    const isTyped = ArrayBuffer.isView(array) && !(array instanceof DataView) && !(array instanceof BigInt64Array || array instanceof BigUint64Array);
    if (!isTyped && !(Array.isArray(array) && array.every((x) => typeof x === 'number')))
        throw new TypeError(`${name} must be a typed array or an array of numbers`);
    return array;
}

/// An array with `components` numbers in a row for each element: packed, or { array, stride, offset }, which are counted in
/// numbers, as interleaved vertices have them.
export class Strided {
    constructor(given, components, name) {
        if (components === 1 && typeof given === 'number') given = [given];
        const isPacked = ArrayBuffer.isView(given) || Array.isArray(given);
        if (!isPacked && !given?.array) throw new TypeError(`${name} must be an array, or an object with an array and its stride`);
        const { array, stride = components, offset = 0 } = isPacked ? { array: given } : given;
        const all = numbers(array, name);
        if (!Number.isInteger(stride) || stride < components) throw new RangeError(`the stride of ${name} must be ${components} or more`);
        if (!Number.isInteger(offset) || offset < 0 || offset > all.length)
            throw new RangeError(`the offset of ${name} must be a number of elements of its array`);
        const length = all.length - offset;
        if (isPacked && length % components !== 0)
            throw new RangeError(`${name} must have ${components} numbers for each query, but has ${length} in all`);
        this.name = name;
        this.components = components;
        this.stride = stride;
        this.count = length < components ? 0 : Math.floor((length - components) / stride) + 1;
        const used = this.count === 0 ? 0 : (this.count - 1) * stride + components;
        this.array = used === all.length ? all : part(all, offset, used);
    }
}

/// Makes an argument of places, or of planes with four numbers, in the coordinates of the source.
export const places = (given, name, components = 3) => Object.assign(new Strided(given, components, name), { isOfPlaces: true });

/// An argument of one number for each query, in an array that was checked.
export const column = (array, name) => ({ name, array, count: array.length, stride: 1 });

const part = (array, offset, length) =>
    ArrayBuffer.isView(array) ? array.subarray(offset, offset + length) : array.slice(offset, offset + length);

/// Returns how many queries the arguments are for: one element serves all.
export function commonCount(all) {
    let count = 1;
    for (const each of all) {
        if (each.count === 1 || each.count === count) continue;
        if (count !== 1) throw new RangeError(`${each.name} has ${each.count} elements, but another argument has ${count}`);
        count = each.count;
    }
    return count;
}

/// Returns integers as the library takes them: those that 32 bits do not hold become the largest number, which no blob and
/// no mesh has. Arrays of uint16 stay so where they are allowed.
export function integers(given, name, allowUint16 = false) {
    if (given instanceof Uint32Array || (allowUint16 && given instanceof Uint16Array)) return given;
    const array = numbers(typeof given === 'number' ? [given] : given, name);
    if (array instanceof Float32Array || array instanceof Float64Array) throw new TypeError(`${name} must be integers`);
    return Uint32Array.from(array, (number) => {
        if (!Number.isInteger(number)) throw new TypeError(`${name} must be integers, not ${number}`);
        return number < 0 || number > LARGEST ? LARGEST : number;
    });
}

/// Makes an argument of integers of 32 bits: one for each element, or one that serves all.
export function integerColumn(given, name) {
    const array = numbers(typeof given === 'number' ? [given] : given, name);
    const column = array instanceof Uint32Array ? array : Uint32Array.from(array, (number) => integer(number, name));
    return { name, array: column, count: column.length, stride: 1 };
}

/// Returns how many pairs of nodes or leaves a query may visit, as the library takes it.
export function visits(limit) {
    if (limit === Infinity) return UNLIMITED;
    if (!Number.isSafeInteger(limit) || limit < 0) throw new RangeError(`workLimit must be an integer from 0 on, or Infinity, not ${String(limit)}`);
    return BigInt(limit);
}
