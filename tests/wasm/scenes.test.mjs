// Scenes: instances, masks, tiles, bytes and errors.
import assert from 'node:assert';
import test from 'node:test';

import { lumpyBody, questions } from './support/questions.mjs';
import { instancesOf } from './support/scene.mjs';
import { espalier, rejects, throws } from './support/setup.mjs';

const { BakeError, load, NO_TRIANGLE, OpenError, QueryError, Status, VerifyError } = espalier;
const library = await load();
const asked = questions(100), { origins, directions } = asked;
const body = await library.bake(lumpyBody());
const square = await library.bake({ positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], triangles: [0, 1, 2, 0, 2, 3] });
const squares = await library.bakeScene([square], { translation: [0, 0, 0, 5, 0, 0, 5, 0, 3], mask: [1, 2, 4], user: 9 });

const isNear = (number, expected) => assert.ok(Math.abs(number - expected) < 1e-4, `${number} is not ${expected}`);

test('a scene is its blobs at their places', () => {
    [-1, -1, 0, 6, 1, 3].forEach((bound, k) => isNear(squares.bounds[k], bound));
    const { t, instance, triangle, status } = squares.raycast([0, 0, 9, 5, 0, 9, 9, 9, 9], [0, 0, -1]);
    assert.deepStrictEqual([[...t], [...instance], [...status]], [[9, 6, Infinity], [0, 2, NO_TRIANGLE], [Status.OK, Status.OK, Status.NOT_FOUND]]);
    assert.strictEqual(triangle[2], NO_TRIANGLE);
    const all = squares.allHits([5.25, 0.5, 9], [0, 0, -1]);
    assert.deepStrictEqual([[...all.items.t], [...all.items.instance]], [[9, 6], [1, 2]]);
    assert.deepStrictEqual([...squares.closestPoint([5, 0, 2.5]).distance], [0.5]);
    isNear(squares.sweep({ kind: 'sphere', center: [5, 0, 9], radius: 1 }, [0, 0, -10]).t[0], 0.5);
    const touched = squares.overlappingTriangles({ kind: 'box', min: [4.5, -0.75, -1], max: [5.5, -0.25, 5] });
    assert.deepStrictEqual([...touched.items.instance], [1, 1, 2, 2]);
});

test('masks pass instances over', () => {
    const ray = [[5, 0, 9], [0, 0, -1]];
    assert.deepStrictEqual([2, 4, 3, 8].map((mask) => squares.raycast(...ray, { mask }).t[0]), [9, 6, 9, Infinity]);
    assert.deepStrictEqual([2, 8].map((mask) => squares.occluded(...ray, { mask }).yes(0)), [true, false]);
    assert.deepStrictEqual([1, 6].map((mask) => squares.allHits(...ray, { mask }).items.t.length > 0), [false, true]);
    assert.deepStrictEqual([2, 4].map((mask) => squares.closestPoint([5, 0, 3], Infinity, { mask }).distance[0]), [3, 0]);
    const ball = { kind: 'sphere', center: [0, 0, 0], radius: 0.5 };
    assert.deepStrictEqual([1, 2].map((mask) => squares.overlaps(ball, { mask }).yes(0)), [true, false]);
    assert.deepStrictEqual([1, 2].map((mask) => squares.overlappingTriangles(ball, { mask }).items.triangle.length), [2, 0]);
    [0.5, 1].forEach((t, k) => isNear(squares.sweep({ ...ball, center: [0, 0, 5] }, [0, 0, -9], { mask: k + 1 }).t[0], t));
    for (const mask of [-1, 2 ** 32, 0.5]) assert.throws(() => squares.raycast(...ray, { mask }), { name: 'RangeError', message: /mask/ });
});

test('instances are those that were baked', () => {
    const { translation, scale, mask, user, source, mesh, rotation } = squares.instances();
    assert.deepStrictEqual([squares.instanceCount, squares.meshCount], [3, 1]);
    const order = [...source];
    assert.deepStrictEqual([...order].sort(), [0, 1, 2]);
    assert.deepStrictEqual([...mask], order.map((i) => 1 << i));
    assert.deepStrictEqual([...translation], order.flatMap((i) => [[0, 0, 0], [5, 0, 0], [5, 0, 3]][i]));
    assert.deepStrictEqual([[...scale], [...user], [...mesh]], [[1, 1, 1], [9, 9, 9], [0, 0, 0]]);
    assert.deepStrictEqual([...rotation], [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
});

test('scenes are opened from bytes and are tiles of others', async () => {
    const again = library.openScene(squares.bytes());
    assert.deepStrictEqual(again.raycast(origins, directions), squares.raycast(origins, directions));
    const tiled = await library.bakeScene([square, again], { mesh: [1, 0, 1], translation: [0, 0, 0, 0, 0, 50, 100, 0, 0] });
    assert.deepStrictEqual([tiled.meshCount, tiled.instanceCount], [1, 3]);
    const { source } = tiled.instances(), { t, instance, inTile } = tiled.raycast([105, 0, 9, 0, 0, 60], [0, 0, -1]);
    assert.deepStrictEqual([...t], [6, 10]);
    assert.deepStrictEqual([source[instance[0]], source[instance[1]]], [2, 1]);
    assert.deepStrictEqual([again.instances().source[inTile[0]], inTile[1]], [2, NO_TRIANGLE]);
    await library.verifyScene(tiled);
    await library.verifyScene(tiled.bytes());
    await assert.rejects(library.verify(tiled), VerifyError);
    await assert.rejects(library.verifyScene(square), VerifyError);
});

test('a scene without instances is empty', async () => {
    const empty = await library.bakeScene([square], { translation: [] });
    assert.strictEqual(empty.instanceCount, 0);
    assert.deepStrictEqual([...empty.raycast(origins, directions).t], Array(100).fill(Infinity));
});

test('lists of scenes that are longer than the first guess are complete', async () => {
    const scene = await library.bakeScene([body], { scale: 0.5, translation: asked.origins.subarray(120, 240) });
    const lists = scene.overlappingTriangles({ kind: 'sphere', center: new Float32Array(3 * 20), radius: 100 });
    assert.strictEqual(lists.items.triangle.length, 20 * 40 * body.triangleCount);
    assert.strictEqual(lists.items.instance[lists.begin(7) + body.triangleCount], 1);
});

test('other bytes and arguments are refused', async () => {
    const bytes = squares.bytes();
    throws(() => library.openScene(square.bytes()), OpenError, /./);
    throws(() => library.openBlob(bytes), OpenError, /./);
    for (const length of [0, 10, 64, bytes.length - 1]) throws(() => library.openScene(bytes.subarray(0, length)), OpenError, /./);
    for (let at = 0; at < bytes.length; at += 13) {
        const damaged = Uint8Array.from(bytes);
        damaged[at] ^= 0x40;
        throws(() => library.openScene(damaged), OpenError, /./);
    }
    throws(() => library.openScene('bytes'), TypeError, /bytes/);
    await rejects(library.bakeScene([square], { mesh: 1 }), BakeError, /instance 0/);
    await rejects(library.bakeScene([new Uint8Array(100)], {}), BakeError, /instance 0/);
    await rejects(library.bakeScene([square], { scale: 0 }), BakeError, /instance 0/);
    await rejects(library.bakeScene([square], { translation: [0, 0] }), RangeError, /instances.translation/);
    await rejects(library.bakeScene([square], { mesh: [0, 0], mask: [1, 2, 3] }), RangeError, /mask has 3 elements/);
    await rejects(library.bakeScene([square], { user: -1 }), RangeError, /user/);
    await rejects(library.bakeScene([square], { mask: [0.5] }), RangeError, /mask/);
    await rejects(library.bakeScene([square], { mask: 'all' }), TypeError, /mask/);
    await rejects(library.bakeScene(['square'], {}), TypeError, /bytes/);
    throws(() => squares.overlaps({ kind: 'cylinder' }), RangeError, /kind of a shape/);
});

test('a freed scene throws, and its memory serves the next', async () => {
    const scene = await library.bakeScene([body, square], instancesOf(asked)), bytes = scene.bytes();
    scene.free();
    scene.free();
    assert.strictEqual(scene.isFreed, true);
    for (const call of [() => scene.raycast(origins, directions), () => scene.instanceCount, () => scene.bounds, () => scene.instances(), () => scene.bytes()])
        assert.throws(call, (error) => error instanceof QueryError && error.status === Status.NOT_OPEN);
    assert.deepStrictEqual(library.openScene(bytes).bytes(), bytes);
});
