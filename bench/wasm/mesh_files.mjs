// Reads meshes of .obj and .ply files: positions as float32, triangles as uint32. Polygons become fans.
import { readFile } from 'node:fs/promises';

export async function readMesh(file) {
    const bytes = await readFile(file);
    if (/\.obj$/i.test(file)) return readObj(bytes.toString('latin1'));
    if (/\.ply$/i.test(file)) return readPly(bytes);
    throw new Error(`${file} is no .obj or .ply file`);
}

function addFan(triangles, corners) {
    for (let i = 2; i < corners.length; ++i) triangles.push(corners[0], corners[i - 1], corners[i]);
}

function readObj(text) {
    const positions = [], triangles = [];
    for (const line of text.split('\n')) {
        const [kind, ...fields] = line.trim().split(/\s+/);
        if (kind === 'v') positions.push(...fields.slice(0, 3).map(Number));
        // Negative numbers count from the end.
        if (kind === 'f') addFan(triangles, fields.map((field) => parseInt(field, 10)).map((n) => n < 0 ? positions.length / 3 + n : n - 1));
    }
    return { positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles) };
}

const SIZES = { char: 1, int8: 1, uchar: 1, uint8: 1, short: 2, int16: 2, ushort: 2, uint16: 2, int: 4, int32: 4, uint: 4, uint32: 4, float: 4, float32: 4, double: 8, float64: 8 };
const GETTERS = { char: 'Int8', int8: 'Int8', uchar: 'Uint8', uint8: 'Uint8', short: 'Int16', int16: 'Int16', ushort: 'Uint16', uint16: 'Uint16', int: 'Int32', int32: 'Int32', uint: 'Uint32', uint32: 'Uint32', float: 'Float32', float32: 'Float32', double: 'Float64', float64: 'Float64' };

/// Returns a function that reads the next number of a type.
function numbersOf(bytes, start, format) {
    if (format === 'ascii') {
        const words = bytes.toString('latin1', start).split(/\s+/).filter(Boolean);
        let at = 0;
        return () => Number(words[at++]);
    }
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length), isLittle = format === 'binary_little_endian';
    let at = start;
    return (type) => {
        const number = view[`get${GETTERS[type]}`](at, isLittle);
        at += SIZES[type];
        return number;
    };
}

function readPly(bytes) {
    const end = bytes.indexOf('end_header'), header = bytes.toString('latin1', 0, end).split('\n').map((line) => line.trim().split(/\s+/));
    const elements = [];
    let format = '';
    for (const [word, ...rest] of header) {
        if (word === 'format') format = rest[0];
        if (word === 'element') elements.push({ name: rest[0], count: Number(rest[1]), properties: [] });
        if (word === 'property') elements.at(-1).properties.push(rest);
    }
    const next = numbersOf(bytes, bytes.indexOf('\n', end) + 1, format);
    const positions = [], triangles = [];
    for (const { name, count, properties } of elements)
        for (let i = 0; i < count; ++i) {
            const row = {};
            for (const property of properties) {
                if (property[0] !== 'list') row[property[1]] = next(property[0]);
                else row[property[3]] = Array.from({ length: next(property[1]) }, () => next(property[2]));
            }
            if (name === 'vertex') positions.push(row.x, row.y, row.z);
            if (name === 'face') addFan(triangles, row.vertex_indices ?? row.vertex_index);
        }
    return { positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles) };
}
