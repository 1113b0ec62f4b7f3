// Flags of triangles, instances and slots: what counts, against masks and against blobs without the rest.
import assert from 'node:assert';
import test from 'node:test';

import { lumpyBody, questions } from './support/questions.mjs';
import { espalier, throws } from './support/setup.mjs';
import { codesOf } from './support/words.mjs';

const { load, NO_TRIANGLE, pairs, Status } = espalier;
const library = await load();
const { origins, directions } = questions(100);
const body = await library.bake(lumpyBody());
const square = await library.bake({ positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], triangles: [0, 1, 2, 0, 2, 3] });

test('queries of a blob pass over triangles without a flag', () => {
    const rays = [origins, directions], all = body.raycast(...rays), { triangle } = all;
    const only = Uint8Array.from({ length: body.triangleCount }, () => 1);
    assert.deepStrictEqual(body.raycast(...rays, { only }), all);
    only.fill(200);
    assert.deepStrictEqual(body.raycast(...rays, { only }), all);
    for (const each of triangle) if (each !== NO_TRIANGLE) only[each] = 0;
    const behind = body.raycast(...rays, { only });
    assert.ok(behind.t.every((t, i) => all.status[i] !== Status.OK || t >= all.t[i]));
    assert.ok(behind.triangle.every((each) => each === NO_TRIANGLE || only[each] !== 0));
    assert.notDeepStrictEqual(behind.triangle, triangle);
    only.fill(0);
    assert.ok(!body.raycast(...rays, { only }).status.includes(Status.OK));
    assert.ok(!codesOf(body.occluded(...rays, { only })).includes(Status.OK));
    assert.strictEqual(body.closestHits(...rays, 3, { only }).items.t.length, 0);
    const moved = body.sweep({ kind: 'sphere', center: origins, radius: 0.5 }, directions, { only });
    assert.ok(!moved.status.includes(Status.OK));
});

test('flags of a blob may be booleans', () => {
    const ray = [[0.5, -0.5, 5, -0.5, 0.5, 5], [0, 0, -1]];
    const { triangle } = square.raycast(...ray);
    const only = [0, 1].map((number) => number === triangle[1]);
    assert.deepStrictEqual([...square.raycast(...ray, { only }).status], [Status.NOT_FOUND, Status.OK]);
    assert.deepStrictEqual(codesOf(square.occluded(...ray, { only })), [Status.NOT_FOUND, Status.OK]);
    for (const none of [null, undefined]) assert.deepStrictEqual([...square.raycast(...ray, { only: none }).status], [0, 0]);
});

test('flags of instances and slots are as masks', async () => {
    const places = { translation: origins.subarray(60, 180), scale: 0.5, mask: Array.from({ length: 40 }, (_, i) => i % 3 === 0 ? 2 : 1) };
    const moving = library.createMovingScene([body], 64);
    moving.insert(places);
    for (const scene of [await library.bakeScene([body], places), moving]) {
        const only = scene.instances().mask.map((mask) => Number(mask === 2)), flags = Uint8Array.from(only);
        const sphere = { kind: 'sphere', center: origins, radius: 0.5 };
        const calls = [
            (options) => scene.raycast(origins, directions, options), (options) => codesOf(scene.occluded(origins, directions, options)),
            (options) => scene.allHits(origins, directions, options), (options) => scene.sweep(sphere, directions, options),
            (options) => codesOf(scene.overlaps(sphere, options)), (options) => scene.overlappingTriangles(sphere, options),
        ];
        for (const call of calls) {
            const masked = call({ mask: 2 });
            assert.deepStrictEqual(call({ only: flags }), masked);
            assert.deepStrictEqual(call({ only: flags, mask: 2 }), masked);
            assert.deepStrictEqual(call({ only: flags.map(() => 1) }), call({}));
            assert.notDeepStrictEqual(masked, call({}));
            assert.deepStrictEqual(call({ only: flags.map(() => 1), mask: 2 }), masked);
        }
    }
});

test('wrong flags throw, and what takes none says so', async () => {
    const ray = [[0, 0, 9], [0, 0, -1]], scene = await library.bakeScene([square], { translation: [0, 0, 0, 5, 0, 0] });
    const moving = library.createMovingScene([square], 4);
    moving.insert({ translation: new Float32Array(9) });
    throws(() => square.raycast(...ray, { only: [0, 1] }), TypeError, /only must be flags.*new Uint8Array\(2\)/);
    for (const only of [new Uint32Array(2), 'all', 1, { 0: 1 }]) throws(() => square.occluded(...ray, { only }), TypeError, /only must be flags/);
    throws(() => square.raycast(...ray, { only: new Uint8Array(3) }), RangeError, /a flag for each of the 2 triangles, but has 3/);
    throws(() => square.sweep({ kind: 'sphere', center: [0, 0, 9], radius: 1 }, [0, 0, -9], { only: [true] }), RangeError, /2 triangles/);
    throws(() => square.closestHits(...ray, 2, { only: [] }), RangeError, /2 triangles/);
    throws(() => scene.raycast(...ray, { only: [true] }), RangeError, /each of the 2 instances, but has 1/);
    throws(() => moving.overlaps({ kind: 'sphere', center: [0, 0, 0], radius: 1 }, { only: [true] }), RangeError, /each of the 3 slots, but has 1/);
    for (const list of ['allHits', 'crossings']) throws(() => square[list](...ray, { only: [true, true] }), TypeError, /only is not for/);
    for (const each of [scene, moving]) throws(() => each.closestPoint([0, 0, 0], 1, { only: [true] }), TypeError, /only is not for/);
    const sphere = { kind: 'sphere', center: [0, 0, 0], radius: 1 }, point = [0, 0, 0], only = [true, true];
    const refused = [
        () => square.overlaps(sphere, { only }), () => square.overlappingTriangles(sphere, { only }), () => square.contacts(sphere, 4, 0, { only }),
        () => square.closestPoint(point, 1, { only }), () => square.signedDistance(point, 1, { only }), () => square.closestTriangles(point, 4, 1, { only }),
        () => square.contains(point, { only }), () => square.windingNumber(point, 64, { only }), () => pairs.overlaps(square, square, { only }),
        () => pairs.distance(square, square, { only }), () => moving.candidatePairs({ only }), () => moving.collidingPairs({ only, baked: scene }),
    ];
    for (const call of refused) throws(call, TypeError, /only is not for/);
});
