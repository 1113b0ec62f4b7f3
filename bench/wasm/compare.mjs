// node --no-liftoff compare.mjs PACKAGE [--three FOLDER] [--profile NAME] [--queries COUNT] [--rounds COUNT]
// [MESH...]: times closest rays and closest points by the npm package in the folder PACKAGE, with SIMD128 and without, in
// turns, and compares the bits of the answers. With --three against three-mesh-bvh too, which FOLDER/node_modules has
// with three. A MESH is an .obj or .ply file; by default one is generated. Above 1 a ratio is in favour of SIMD128 or
// Espalier.
import { basename, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';

import { lumpyBody } from '../../tests/wasm/support/questions.mjs';
import { readMesh } from './mesh_files.mjs';
import { coherentRays, incoherentRays, points } from './queries.mjs';
import { loadPeer } from './three_mesh_bvh.mjs';

const QUERIES_OF_TURN = 512;

const { values, positionals: [packageFolder, ...files] } = parseArgs({
    allowPositionals: true,
    options: {
        three: { type: 'string' }, queries: { type: 'string', default: '4096' }, rounds: { type: 'string', default: '40' },
        profile: { type: 'string', default: 'balanced' },
    },
});
const queryCount = Number(values.queries), rounds = Number(values.rounds);

/// Returns what a blob answers by a call for some queries: the numbers to compare with the peer, and all bits.
function engineOf(blob) {
    const of = (array, first, count) => array.subarray(3 * first, 3 * (first + count));
    return {
        raycast: ({ origins, directions }, first, count) => blob.raycast(of(origins, first, count), of(directions, first, count)),
        closestPoint: ({ points }, first, count) => blob.closestPoint(of(points, first, count)),
    };
}

function time(engine, query, given, first, count) {
    const start = process.hrtime.bigint();
    engine[query](given, first, count);
    return Number(process.hrtime.bigint() - start);
}

/// Returns nanoseconds for a query by each engine: the shortest time of each turn, summed up, since other work on the
/// processor lengthens single turns.
function compare(engines, query, given, count) {
    const warm = Math.min(rounds, 5);
    for (const engine of engines) for (let i = 0; i < warm; ++i) engine[query](given, 0, count);
    const sums = engines.map(() => 0);
    for (let first = 0; first < count; first += QUERIES_OF_TURN) {
        const size = Math.min(QUERIES_OF_TURN, count - first), shortest = engines.map(() => Infinity);
        for (let round = 0; round < rounds; ++round)
            for (let k = 0; k < engines.length; ++k) {
                const which = (round + k) % engines.length;
                shortest[which] = Math.min(shortest[which], time(engines[which], query, given, first, size));
            }
        shortest.forEach((nanoseconds, which) => { sums[which] += nanoseconds / count; });
    }
    return sums;
}

const bits = (columns) => Object.values(columns).map((array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength));

/// Throws where two modules give other bits. Returns the share of answers that differ from the peer's by a hundredth of
/// the mesh, or in whether there is a hit.
function checkAnswers([simd128, scalar, peer], query, given, count, extent) {
    const ours = simd128[query](given, 0, count);
    if (Buffer.compare(Buffer.concat(bits(ours)), Buffer.concat(bits(scalar[query](given, 0, count)))) !== 0)
        throw new Error(`${query}: the answers of SIMD128 and scalar differ`);
    if (!peer) return null;
    const theirs = peer[query](given, 0, count), mine = ours.t ?? ours.distance;
    return theirs.reduce((sum, x, i) => sum + (x === mine[i] || Math.abs(x - mine[i]) <= extent / 100 ? 0 : 1), 0) / count;
}

const { load } = await import(pathToFileURL(resolve(packageFolder, 'index.js')));
const libraries = [await load(null, { simd: true }), await load(null, { simd: false })];
const peer = values.three === undefined ? null : await loadPeer(values.three);
console.log(`node ${process.version}, V8 ${process.versions.v8}, ${peer?.name ?? 'no peer'}`);
const titles = ['mesh', 'triangles', 'bytes', 'query', 'hit %', 'SIMD128 ns', 'scalar ns', 'scalar / SIMD128', 'peer ns', 'peer / SIMD128', 'peer bytes', 'bytes / peer', 'differ %'];
console.log(titles.join('\t'));
const meshes = files.length > 0 ? files : [null];
for (const file of meshes) {
    const mesh = file === null ? lumpyBody(queryCount < 1000 ? 8 : 64) : await readMesh(file);
    const baked = await libraries[0].bake(mesh, { profile: values.profile, dropBadTriangles: true });
    const bytes = baked.bytes(), bounds = baked.bounds, tree = peer?.build(mesh) ?? null;
    const engines = [...libraries.map((library) => engineOf(library.openBlob(bytes))), ...(tree ? [tree] : [])];
    const extent = Math.max(...[0, 1, 2].map((k) => bounds[3 + k] - bounds[k]));
    const sets = [
        ['closest ray, incoherent', 'raycast', incoherentRays(bounds, queryCount)],
        ['closest ray, coherent', 'raycast', coherentRays(bounds, queryCount)],
        ['closest point', 'closestPoint', { points: points(bounds, queryCount) }],
    ];
    for (const [name, query, given] of sets) {
        const count = Object.values(given)[0].length / 3;
        const differing = checkAnswers(engines, query, given, count, extent);
        const found = engines[0][query](given, 0, count).status.reduce((sum, status) => sum + (status === 0), 0) / count;
        const [simd128, scalar, theirs] = compare(engines, query, given, count);
        const row = [file === null ? 'generated' : basename(file), baked.triangleCount, bytes.length, name, (100 * found).toFixed(0),
            simd128.toFixed(0), scalar.toFixed(0), (scalar / simd128).toFixed(2)];
        if (tree) row.push(theirs.toFixed(0), (theirs / simd128).toFixed(2), tree.bytes, (bytes.length / tree.bytes).toFixed(3), (100 * differing).toFixed(2));
        console.log(row.join('\t'));
    }
}
