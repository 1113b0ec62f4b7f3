// Baking: options, types of arrays, reports, sources and errors.
import assert from 'node:assert';
import { readFile } from 'node:fs/promises';
import test from 'node:test';

import { lumpyBody } from './support/questions.mjs';
import { espalier, rejects } from './support/setup.mjs';

const { BakeError, OpenError, VerifyError, load } = espalier;
const library = await load();
const mesh = lumpyBody();
const bytesOf = async (given, options) => {
    const blob = await library.bake(given, options), bytes = Buffer.from(blob.bytes());
    blob.free();
    return bytes;
};

test('the cube of the documents has the bytes that they list', async () => {
    const document = await readFile(new URL('../../docs/format_cube.md', import.meta.url), 'utf8');
    const [, source] = document.match(/```obj\n([^`]*)```/), [, dump] = document.match(/```dump\n([^`]*)```/);
    const rows = (letter) => source.split('\n').filter((line) => line.startsWith(`${letter} `))
        .flatMap((line) => line.slice(2).split(' ').map(Number));
    const positions = rows('v'), quads = rows('f').map((number) => number - 1), triangles = [];
    for (let i = 0; i < quads.length; i += 4) triangles.push(quads[i], quads[i + 1], quads[i + 2], quads[i], quads[i + 2], quads[i + 3]);
    const listed = dump.split('\n').flatMap((line) => /^[0-9a-f]{8}  /.test(line) ? line.slice(10).match(/^(?:[0-9a-f]{2} ?)+/)[0].trim().split(' ') : []);
    const bytes = await bytesOf({ positions, triangles }, { bits: 8, originalIds: true, profile: 'fast' });
    assert.strictEqual(bytes.toString('hex'), listed.join(''));
});

test('types and strides of arrays do not change the bytes', async () => {
    const { positions, triangles } = mesh, expected = await bytesOf(mesh);
    assert.deepStrictEqual(await bytesOf({ positions: Float64Array.from(positions), triangles: Uint16Array.from(triangles) }), expected);
    assert.deepStrictEqual(await bytesOf({ positions: [...positions], triangles: [...triangles] }), expected);
    const interleaved = new Float32Array(5 * positions.length / 3);
    for (let i = 0; i < positions.length / 3; ++i) interleaved.set(positions.subarray(3 * i, 3 * i + 3), 5 * i + 2);
    assert.deepStrictEqual(await bytesOf({ positions: { array: interleaved, stride: 5, offset: 2 }, triangles }), expected);
});

test('an origin is subtracted in double', async () => {
    const far = Float64Array.from(mesh.positions, (x) => x + 2 ** 22);
    const blob = await library.bake({ positions: far, triangles: mesh.triangles }, { origin: [2 ** 22, 2 ** 22, 2 ** 22] });
    const near = await library.bake(mesh);
    assert.deepStrictEqual([...blob.origin], [2 ** 22, 2 ** 22, 2 ** 22]);
    assert.deepStrictEqual(blob.triangles().map((x) => x - 2 ** 22), Float64Array.from(near.triangles()));
});

test('options reach the baker', async () => {
    const blob = await library.bake(
        { ...mesh, materials: new Uint8Array(mesh.triangles.length / 3).fill(7), name: 'body', file: 3, mesh: 4 },
        { bits: 11, profile: 'fast', effort: 'best', builder: 'sweep_sah', originalIds: true, flatAngle: 10, bounds: true });
    const info = blob.info();
    assert.deepStrictEqual([info.profile, info.hasOriginalIds, info.hasMaterials, info.hasEdgeFlags, info.isClosed], ['fast', true, true, true, true]);
    assert.deepStrictEqual([...blob.materials([0, 1])], [7, 7]);
    const { file, mesh: number } = blob.originalTriangles(0);
    assert.deepStrictEqual([file[0], number[0]], [3, 4]);
    const { report } = blob;
    assert.deepStrictEqual([report.bits, report.triangles, report.bytes, report.warnings], [11, blob.triangleCount, info.size, []]);
    assert.deepStrictEqual([info.depth, info.vertexCount, info.duplicateReferenceCount], [report.depth, report.vertices, report.duplicateReferences]);
    assert.ok(report.sphereVolume > 0 && report.seconds >= 0 && report.isClosed === true);
    const coarse = await library.bake(mesh, { tolerance: 0.1 });
    assert.ok(coarse.maxError <= 0.1 && coarse.maxError > blob.maxError);
    assert.strictEqual((await library.bake(mesh, { stepExponent: -6 })).info().latticeStepExponent, -6);
});

test('each option changes the bytes', async () => {
    const larger = lumpyBody(16);
    const bytes = async (options) => Buffer.from((await library.bake(larger, { profile: 'fast', ...options })).bytes());
    const plain = await bytes({});
    for (const options of [{ effort: 'best' }, { builder: 'linear' }, { maxLeafTriangles: 2 }])
        assert.ok(Buffer.compare(await bytes(options), plain) !== 0, JSON.stringify(options));
    const differ = async (one, other) => Buffer.compare(await bytes(one), await bytes(other)) !== 0;
    assert.ok(await differ({ builder: 'spatial_splits', duplicateBudget: 0 }, { builder: 'spatial_splits', duplicateBudget: 1 }));
    assert.ok(await differ({ profile: 'small', bytePrice: 0 }, { profile: 'small', bytePrice: 1000 }));
    for (const options of [{ maxLeafTriangles: 2 ** 32 + 4 }, { maxLeafTriangles: 4.5 }])
        await assert.rejects(library.bake(mesh, options), RangeError);
    for (const numbers of [{ file: 2 ** 33 }, { mesh: -1 }]) await assert.rejects(library.bake({ ...mesh, ...numbers }), RangeError);
});

test('several meshes become one blob', async () => {
    const away = { positions: mesh.positions.map((x) => x + 10), triangles: mesh.triangles };
    const blob = await library.bake([mesh, away], { originalIds: true });
    assert.strictEqual(blob.report.sourceTriangles, 2 * mesh.triangles.length / 3);
    const all = Uint32Array.from({ length: blob.triangleCount }, (_, i) => i);
    assert.deepStrictEqual([...new Set(blob.originalTriangles(all).mesh)].sort(), [0, 1]);
});

test('dropped triangles are in the report', async () => {
    const triangles = Uint32Array.from([...mesh.triangles, 0, 1, 1_000_000]);
    const place = { file: 0, mesh: 0, triangle: mesh.triangles.length / 3 };
    await assert.rejects(library.bake({ ...mesh, triangles }), (error) => {
        assert.ok(error instanceof BakeError && error instanceof espalier.EspalierError);
        assert.deepStrictEqual([error.name, error.status, error.place], ['BakeError', 2, place]);
        assert.match(error.message, /triangle/);
        return true;
    });
    const blob = await library.bake({ ...mesh, triangles, name: 'walls' }, { dropBadTriangles: true });
    assert.strictEqual(blob.report.indexOutOfRange.count, 1);
    assert.match(blob.report.indexOutOfRange.first, /walls/);
});

test('warnings are texts', async () => {
    const blob = await library.bake({ positions: mesh.positions.map((x) => x + 1000), triangles: mesh.triangles }, { bits: 24 });
    assert.ok(blob.report.warnings.length > 0 && blob.report.warnings.every((text) => /\.$/.test(text)));
});

test('wrong arguments throw and name the argument', async () => {
    await rejects(library.bake({ positions: [0, 1], triangles: [] }, {}), RangeError, /positions/);
    await rejects(library.bake({ positions: [], triangles: [0, 1] }, {}), RangeError, /triangles/);
    await rejects(library.bake({ positions: [], triangles: new Float32Array(3) }, {}), TypeError, /triangles must be integers/);
    await rejects(library.bake({ ...mesh, materials: [1] }, {}), RangeError, /materials/);
    await rejects(library.bake([mesh, { positions: [0], triangles: [] }], {}), RangeError, /positions of mesh 1/);
    await rejects(library.bake(mesh, { bits: 8, tolerance: 1 }), RangeError, /one of bits, tolerance and stepExponent/);
    await rejects(library.bake(mesh, { profile: 'huge' }), RangeError, /profile must be one of fast/);
    await rejects(library.bake(mesh, { flatAngle: -1 }), RangeError, /flatAngle/);
    await rejects(library.bake(mesh, { origin: [1] }), RangeError, /origin/);
    await rejects(library.bake(mesh, { bits: 99 }), BakeError, /bits/);
    await rejects(library.bake({ positions: mesh.positions, triangles: [0, 1, -5] }, {}), BakeError, /triangle 0/);
});

test('other bytes are refused', async () => {
    const bytes = await bytesOf(mesh);
    await library.verify(bytes);
    await library.verify(library.openBlob(bytes));
    const throwsOpenError = (given) => assert.throws(() => library.openBlob(given), (error) => error instanceof OpenError && error.status > 0 && error.message.length > 10);
    throwsOpenError(new Uint8Array(0));
    throwsOpenError(bytes.subarray(0, 100));
    for (let at = 0; at < 200; at += 7) {
        const damaged = Uint8Array.from(bytes);
        damaged[at] ^= 0x40;
        throwsOpenError(damaged);
        await assert.rejects(library.verify(damaged), VerifyError);
    }
    assert.throws(() => library.openBlob('bytes'), TypeError);
});

test('joined borders carry a ball over the seam', async () => {
    const ground = (x) => ({ positions: [x, -4, 0, x + 4, -4, 0, x + 4, 4, 0, x, 4, 0], triangles: [0, 1, 2, 0, 2, 3] });
    const options = { stepExponent: -8, flatAngle: 5 };
    const tiles = [await library.bake(ground(-4), options), await library.bake(ground(8), options)], translations = [0, 0, 0, -8, 0, 0];
    const leaning = ([left, right]) => [...left.contacts({ kind: 'sphere', center: [0.1, 0, 0.24], radius: 0.25 }, 4, 0.05).items.normal.filter((_, i) => i % 3 === 0),
        ...right.contacts({ kind: 'sphere', center: [8.1, 0, 0.24], radius: 0.25 }, 4, 0.05).items.normal.filter((_, i) => i % 3 === 0)].some((x) => x !== 0);
    assert.ok(leaning(tiles));
    assert.ok(!leaning(await library.joinBorders(tiles, translations)));
    await rejects(library.joinBorders(tiles, [0, 0, 0, 0.001, 0, 0]), BakeError, /blob 1 does not lie/);
    await rejects(library.joinBorders(tiles, [0, 0, 0, 1, 0, 0, 2, 0, 0]), RangeError, /2 blobs/);
});
