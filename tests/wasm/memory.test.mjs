// The memory of the module: what is released, what survives growth, what is refused.
import assert from 'node:assert';
import { readFile } from 'node:fs/promises';
import { freemem } from 'node:os';
import test from 'node:test';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';

import { lumpyBody, questions } from './support/questions.mjs';
import { espalier, folder } from './support/setup.mjs';

const { BakeError, MemoryError, OpenError, pairs, QueryError, Status } = espalier;

/// Loads a module whose memories the test sees.
async function loadWatched() {
    const memories = [], { instantiate } = WebAssembly;
    const watched = await WebAssembly.compile(await readFile(`${folder}/node_modules/espalier/espalier.wasm`));
    WebAssembly.instantiate = async (module, imports) => {
        const result = await instantiate(module, imports);
        // Node has modules of its own.
        if (module === watched) memories.push(result.exports.memory);
        return result;
    };
    const library = await espalier.load(watched);
    return { library, sizes: () => memories.map((memory) => memory.buffer.byteLength) };
}

const { library, sizes } = await loadWatched();
const mesh = lumpyBody(), { origins, directions } = questions(200);
const body = await library.bake(mesh), baked = body.bytes();
const scene = (await library.bakeScene([body], { translation: origins.subarray(60, 120) })).bytes();

// First: later tests leave room in which any number of blobs fits.
test('forgotten blobs are released', async () => {
    setFlagsFromString('--expose-gc');
    const collect = runInNewContext('gc');
    const [before] = sizes();
    for (let round = 0; round < 20; ++round) {
        for (let i = 0; i < 50; ++i) library.openBlob(baked);
        collect();
        await new Promise((resolve) => setTimeout(resolve, 1));
    }
    assert.ok(sizes()[0] - before < 400 * baked.length, `grown by ${sizes()[0] - before} bytes`);
});

/// Requires that memory is as large after many uses of a library as after one.
async function leavesMemory(times, use) {
    const { library, sizes } = await loadWatched();  // other tests leave room in which much fits
    use(library);
    const [before] = sizes();
    for (let i = 0; i < times; ++i) use(library);
    assert.strictEqual(sizes()[0], before);
}

test('freed blobs and finished calls leave memory for the next', async () => {
    await leavesMemory(1000, (library) => {
        const blob = library.openBlob(baked);
        blob.raycast(origins, directions);
        blob.allHits(origins, directions);
        blob.closestTriangles(origins, 4);
        blob.sweep({ kind: 'capsule', from: origins, to: directions, radius: 0.1 }, directions);
        assert.throws(() => blob.raycast(origins, [0, 0]), RangeError);
        assert.throws(() => library.openBlob(baked.subarray(0, 5000)), OpenError);
        blob.free();
    });
});

test('freed scenes and calls of two blobs leave memory for the next', async () => {
    const few = origins.subarray(60, 90), rays = [few, directions.subarray(60, 90)], places = { translation: [1, 0, 0, 9, 0, 0] };
    await leavesMemory(500, (library) => {
        const a = library.openBlob(baked), b = library.openBlob(baked), all = library.openScene(scene);
        pairs.contacts(a, { blob: b, ...places }, { workLimit: 500 });
        pairs.distance(a, { blob: b, ...places }, { workLimit: 500 });
        a.contacts({ kind: 'sphere', center: few, radius: 0.1 }, 4, 0.1);
        all.raycast(...rays);
        all.allHits(...rays);
        all.overlaps({ kind: 'box', min: few, max: few });
        assert.throws(() => pairs.overlaps(a, b, { workLimit: -1 }), RangeError);
        assert.throws(() => library.openScene(scene.subarray(0, 5000)), OpenError);
        for (const each of [b, all]) each.free();
        assert.throws(() => pairs.overlaps(a, b), QueryError);
        a.free();
    });
});

test('freed moving scenes, hulls and flags leave memory for the next', async () => {
    const few = origins.subarray(60, 90), rays = [few, directions.subarray(60, 90)];
    await leavesMemory(300, (library) => {
        const blob = library.openBlob(baked), tile = library.openScene(scene), moving = library.createMovingScene([blob, blob], 100, { tiles: [tile] });
        const handles = moving.insert({ translation: few, mesh: [0, 1, 2, 0, 1, 2, 0, 1, 2, 3] });
        moving.move(handles, { translation: rays[1] });
        moving.remove({ slot: handles.slot.subarray(0, 2), generation: handles.generation.subarray(0, 2) });
        const pose = library.openBlob(baked);
        moving.setMesh(1, pose);
        moving.allHits(...rays, { only: new Uint8Array(moving.slotEnd).fill(1) });
        moving.candidatePairs();
        const continued = library.openMovingScene(moving.snapshot(), [blob, blob], { tiles: [tile] });
        blob.raycast(...rays, { only: new Uint8Array(blob.triangleCount) });
        blob.sweep({ kind: 'convexHull', vertices: few, offsets: [0, 4, 10] }, [0, 0, 1]);
        assert.throws(() => library.openMovingScene(moving.snapshot(), [blob], { tiles: [tile] }), OpenError);
        assert.throws(() => library.createMovingScene([blob], 100, { tiles: [blob] }), TypeError);
        assert.throws(() => moving.move(handles, { translation: [0, 0] }), RangeError);
        for (const each of [blob, tile, pose, moving, continued]) each.free();
    });
});

const needed = 8e9, skip = freemem() < needed && `less than ${needed} bytes of memory are free`;
test('a bake that needs more than there is throws with the text of the library', { skip }, async () => {
    const mesh = { positions: new Float32Array(300_000_000), triangles: [0, 1, 2] };
    await assert.rejects(library.bake(mesh), (error) => error instanceof BakeError && error.status === 17 && /memory/.test(error.message));
});

test('a bake has memory of its own', async () => {
    const [before] = sizes();
    (await library.bake(lumpyBody(40))).free();
    assert.ok(sizes()[0] - before < 2 ** 20);
    assert.ok(sizes().at(-1) > before);
});

test('blobs answer alike after memory has grown', () => {
    const blob = library.openBlob(baked), before = blob.raycast(origins, directions), [size] = sizes();
    assert.ok(blob.closestHits(origins, directions, 10_000).length > 0);
    assert.ok(sizes()[0] > size);
    assert.deepStrictEqual(blob.raycast(origins, directions), before);
    blob.free();
});

test('a freed blob throws with the text of the library', () => {
    const blob = library.openBlob(baked);
    assert.strictEqual(blob.isFreed, false);
    blob.free();
    blob.free();
    assert.strictEqual(blob.isFreed, true);
    for (const call of [() => blob.raycast(origins, directions), () => blob.triangleCount, () => blob.bytes(), () => blob.info()])
        assert.throws(call, (error) => error instanceof QueryError && error.status === Status.NOT_OPEN && /not open/.test(error.message));
});

test('a call that needs more than there is throws and leaves the rest as it was', () => {
    const blob = library.openBlob(baked), before = blob.raycast(origins, directions);
    assert.throws(() => blob.closestHits(origins, directions, 1_000_000), MemoryError);
    assert.deepStrictEqual(blob.raycast(origins, directions), before);
    blob.free();
});
