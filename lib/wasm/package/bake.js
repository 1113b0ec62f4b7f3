// Baking meshes: their arrays and the options in the memory of an instance that bakes once.
import { choice, integer, integers, Strided } from './arguments.js';
import { PROFILES } from './blob.js';
import { BakeError } from './errors.js';
import { inSource, originOf } from './source.js';

const EFFORTS = ['fast', 'normal', 'best'];
const BUILDERS = ['binned_sah', 'sweep_sah', 'spatial_splits', 'agglomerative', 'linear', 'insertion'];
const BITS = 0, TOLERANCE = 1, STEP = 2;
const OK = 0, NO_MEMORY = 17, NO_TRIANGLE = 0xFFFFFFFF;

function resolutionOf({ bits, tolerance, stepExponent }) {
    const given = [[BITS, bits], [TOLERANCE, tolerance], [STEP, stepExponent]].filter(([, number]) => number != null);
    if (given.length > 1) throw new RangeError('give one of bits, tolerance and stepExponent');
    return given.length === 0 ? {} : { resolutionKind: given[0][0], resolution: given[0][1] };
}

/// Returns the fields of espalier_bake_options that differ from its defaults.
function fieldsOfOptions(options) {
    const fields = { withRemap: 1, ...resolutionOf(options) };
    const flag = (name, value) => { fields[name] = Number(Boolean(value)); };
    flag('originalIds', options.originalIds);
    flag('dropBadTriangles', options.dropBadTriangles);
    flag('allowEmpty', options.allowEmpty);
    flag('strict', options.strict);
    for (const bounds of ['orientedBox', 'sphere', 'kDop']) flag(bounds, options.bounds);
    for (const [name, names] of [['profile', PROFILES], ['effort', EFFORTS], ['builder', BUILDERS]])
        if (options[name] != null) fields[name] = choice(name, options[name], names);
    for (const name of ['maxDropped', 'duplicateBudget', 'bytePrice'])
        if (options[name] != null) fields[name] = options[name];
    if (options.maxLeafTriangles != null) fields.maxLeafTriangles = integer(options.maxLeafTriangles, 'maxLeafTriangles');
    if (options.flatAngle != null) {
        if (!(options.flatAngle >= 0)) throw new RangeError('flatAngle must be null, which stores no edges, or 0 or more degrees');
        fields.flatAngle = options.flatAngle;
    }
    return Object.assign(fields, fieldsOfOrigin(options));
}

/// Returns the fields of options of C that say what the bake of a blob or a scene subtracts from places.
export function fieldsOfOrigin({ origin = 'auto' }) {
    if (origin === 'auto') return { choosesOrigin: 1 };
    if (origin === null) return {};
    if (typeof origin === 'string' || origin.length !== 3) throw new RangeError("origin must be 'auto', null or 3 numbers");
    return { origin };
}

/// Checks the arrays of a mesh. Positions other than float32 become float64, indices other than uint16 become uint32.
function arraysOf(mesh, number, isOnlyOne) {
    const of = isOnlyOne ? '' : ` of mesh ${number}`;
    const positions = new Strided(mesh.positions, 3, `positions${of}`);
    const triangles = integers(mesh.triangles, `triangles${of}`, true);
    if (triangles.length % 3 !== 0) throw new RangeError(`triangles${of} must have 3 numbers for each triangle`);
    const materials = mesh.materials == null ? null : integers(mesh.materials, `materials${of}`);
    if (materials !== null && materials.length !== triangles.length / 3)
        throw new RangeError(`materials${of} must have one number for each triangle`);
    return { positions, triangles, materials, name: mesh.name ?? '', file: integer(mesh.file ?? 0, `file${of}`), mesh: integer(mesh.mesh ?? number, `mesh${of}`) };
}

/// Copies an array into memory of an instance and returns its address.
function place(instance, Type, array) {
    const address = instance.allocate(array.length * Type.BYTES_PER_ELEMENT);
    instance.array(Type, address, array.length).set(array);
    return address;
}

function writeMesh(instance, address, arrays) {
    const { positions, triangles, materials, name, file, mesh } = arrays;
    const Coordinate = positions.array instanceof Float32Array ? Float32Array : Float64Array;
    const Index = triangles instanceof Uint16Array ? Uint16Array : Uint32Array;
    instance.functions.espalier_init_mesh_view(address, instance.records.mesh_view.bytes);
    instance.write('mesh_view', address, {
        positions: place(instance, Coordinate, positions.array), positionCount: positions.count,
        positionStride: positions.stride * Coordinate.BYTES_PER_ELEMENT, coordinateType: Number(Coordinate === Float64Array),
        triangles: place(instance, Index, triangles), triangleCount: triangles.length / 3,
        triangleStride: 3 * Index.BYTES_PER_ELEMENT, indexType: Number(Index === Uint16Array),
        materials: materials === null ? 0 : place(instance, Uint32Array, materials),
        name: place(instance, Uint8Array, new TextEncoder().encode(`${name}\0`)), file, mesh,
    });
}

/// Returns the texts of the warnings of an espalier_bake_report, given its fields.
export function warningsOf(instance, { warnings, warningCount }) {
    const { bytes } = instance.records.bake_warning;
    return Array.from({ length: warningCount }, (_, i) => instance.text(instance.read('bake_warning', warnings + i * bytes).message));
}

/// Returns the report with findings such as { count, first }, and warnings as texts.
function readReport(instance, address) {
    const fields = instance.read('bake_report', address);
    const report = {};
    for (const [name, value] of Object.entries(fields)) {
        const [finding, field] = name.split('.');
        if (field === undefined) report[name] = value;
        else (report[finding] ??= {})[field] = field === 'first' ? instance.text(value) : value;
    }
    delete report.warningCount;
    report.warnings = warningsOf(instance, fields);
    report.isClosed = fields.isClosed !== 0;
    if (report.origin.some((x) => x !== 0))
        for (const corner of ['boundsMin', 'boundsMax']) report[corner] = [...inSource(report[corner], report.origin)];
    return report;
}

/// Returns the source of each triangle: file, mesh, triangle and firstCorner, each in an array.
function readRemap(instance, address, count) {
    const { bytes, fields } = instance.records.original_triangle;
    const column = instance.allocate(4 * count);
    const remap = {};
    for (const [name, { offset, Type }] of Object.entries(fields)) {
        instance.functions.wasm_copy_fields(address + offset, bytes, column, 4, 4, count);
        remap[name] = instance.array(Type, column, count).slice();
    }
    return remap;
}

/// Returns the error of a result that is not ok.
export function errorOf(instance, result) {
    const place = result['place.isKnown'] === 0 ? null : {
        file: result['place.file'], mesh: result['place.mesh'],
        triangle: result['place.triangle'] === NO_TRIANGLE ? null : result['place.triangle'],
    };
    return new BakeError(instance.text(result.message), result.status, place);
}

/// Calls a function of the baker and returns the fields of its espalier_bake_result.
export function resultOf(instance, name, ...rest) {
    // Read before the call, which may end the instance.
    const noMemory = instance.text(instance.functions.espalier_describe_bake_status(NO_MEMORY) >>> 0);
    try {
        return instance.read('bake_result', instance.functions[name](...rest) >>> 0);
    } catch (error) {
        // Memory that is used up ends the instance, where C++ would throw.
        if (!(error instanceof WebAssembly.RuntimeError)) throw error;
        throw new BakeError(noMemory, NO_MEMORY, null, { cause: error });
    }
}

/// Checks the arguments, and returns what joins the borders of blobs, given as bytes: a function of an instance, which serves
/// once. It returns the bytes of each, which lie in memory of the instance.
export function preparedJoin(blobs, translations) {
    if (translations.count !== 1 && translations.count !== blobs.length)
        throw new RangeError(`translations must have 3 numbers for each of the ${blobs.length} blobs`);
    return (instance) => {
        const { bytes: size } = instance.records.joined_blob, at = instance.allocate(size * blobs.length);
        const copies = blobs.map((bytes) => place(instance, Uint8Array, bytes));
        const origins = copies.map((address, i) => originOfCopy(instance, address, blobs[i].length));
        copies.forEach((address, i) => {
            const first = translations.count === 1 ? 0 : i * translations.stride;
            // The library moves what blobs count from their origins.
            const translation = Array.from(translations.array.slice(first, first + 3), (x, k) => x + (origins[i][k] - origins[0][k]));
            instance.write('joined_blob', at + i * size, { bytes: address, byteCount: blobs[i].length, translation });
        });
        const result = resultOf(instance, 'espalier_join_borders', at, blobs.length, 0);
        if (result.status !== OK) throw errorOf(instance, result);
        return blobs.map((bytes, i) => instance.array(Uint8Array, copies[i], bytes.length));
    };
}

/// Returns where 0 0 0 of a blob is in its source: of bytes that do not open, 0 0 0.
function originOfCopy(instance, address, length) {
    const blob = instance.allocate(instance.records.blob.bytes);
    return (instance.functions.espalier_open(address, length, blob) === OK ? originOf(instance, blob) : null) ?? [0, 0, 0];
}

/// Checks meshes and options, and returns what bakes them: a function of an instance, which serves once. It returns
/// bytes, which lie in memory of the instance, the report and the sources.
export function preparedBake(given, options = {}) {
    const meshes = Array.isArray(given) ? given : [given];
    const all = meshes.map((mesh, number) => arraysOf(mesh, number, meshes.length === 1));
    const fields = fieldsOfOptions(options);
    return (instance) => {
        const { mesh_view: view, bake_options: settings } = instance.records;
        const views = instance.allocate(view.bytes * all.length), optionsAt = instance.allocate(settings.bytes);
        all.forEach((arrays, i) => writeMesh(instance, views + i * view.bytes, arrays));
        instance.functions.espalier_init_bake_options(optionsAt, settings.bytes);
        instance.write('bake_options', optionsAt, fields);
        const result = resultOf(instance, 'espalier_bake', views, all.length, optionsAt);
        if (result.status !== OK) throw errorOf(instance, result);
        return {
            bytes: instance.array(Uint8Array, result.bytes, result.byteCount),
            report: readReport(instance, result.report),
            remap: readRemap(instance, result.remap, result.remapCount),
        };
    };
}
