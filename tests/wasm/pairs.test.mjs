// Pairs of blobs: batches against loops, places, arguments, what pairs of small blobs are.
import assert from 'node:assert';
import test from 'node:test';

import { placesOf } from './support/pairs.mjs';
import { lumpyBody, questions } from './support/questions.mjs';
import { espalier, throws } from './support/setup.mjs';
import { codesOf } from './support/words.mjs';

const { load, pairs, QueryError, Status } = espalier;
const library = await load();
const body = await library.bake(lumpyBody());
const triangle = await library.bake({ positions: [-1, -1, 0, 1, -1, 0, 0, 1, 0], triangles: [0, 1, 2] });
const turned = [0, Math.SQRT1_2, 0, Math.SQRT1_2];  // by 90 degrees around y
const upright = { blob: triangle, rotation: turned };

test('places move, turn and scale blobs', () => {
    const apart = pairs.distance(triangle, { blob: triangle, translation: [0, 0, 1, 0, 0, 3], scale: [1, 2] });
    assert.deepStrictEqual([...apart.distance], [1, 3]);
    const below = { blob: triangle, translation: [0, -2.5, 0] };
    assert.deepStrictEqual([...pairs.distance({ blob: triangle, scale: [1, 0.25] }, below).distance], [0.5, 1.25]);
    const corners = pairs.overlaps(triangle, { blob: triangle, scale: 2 ** -6, translation: [0.9, -0.9, 0, 0.9, 0.9, 0] });
    assert.deepStrictEqual(codesOf(corners), [Status.OK, Status.NOT_FOUND]);
    assert.deepStrictEqual([...corners.status], [Status.OK, Status.OK]);  // a plain no is an answer
    assert.deepStrictEqual(codesOf(pairs.overlaps(triangle, { ...upright, translation: [0, 0, 0, 0, 0, 5] })), [Status.OK, Status.NOT_FOUND]);
    const inside = pairs.overlaps(body, { blob: triangle, scale: 0.1 }), crossing = pairs.overlaps(body, { blob: triangle, scale: 10 });
    assert.deepStrictEqual([inside.no(0), crossing.yes(0)], [true, true]);
});

test('a distance has the points of both surfaces', () => {
    const { distance, onA, onB, a, b, status } = pairs.distance(triangle, { blob: triangle, translation: [0, 2.5, 0.5] }, { maxDistance: [9, 0.1] });
    assert.deepStrictEqual([...status], [Status.OK, Status.NOT_FOUND]);
    assert.strictEqual(distance[0], Math.fround(Math.hypot(0.5, 0.5)));
    assert.strictEqual(distance[1], Infinity);
    assert.deepStrictEqual([...onA.subarray(0, 3), ...onB.subarray(0, 3)], [0, 1, 0, 0, 1.5, 0.5]);
    assert.deepStrictEqual([a[0], b[0], a[1], b[1]], [0, 0, espalier.NO_TRIANGLE, espalier.NO_TRIANGLE]);
    const far = { blob: triangle, translation: [0, 0, 1] };
    assert.deepStrictEqual(codesOf(pairs.withinDistance(triangle, far, [1, 0.99, NaN])), [Status.OK, Status.NOT_FOUND, Status.INVALID_ARGUMENT]);
});

test('a touch has its points and its way out', () => {
    const { items, status } = pairs.touches(triangle, { ...upright, translation: [0.25, 0, -0.5] });
    assert.deepStrictEqual([...status], [Status.OK]);
    assert.deepStrictEqual([items.a.length, items.a[0], items.b[0], items.count[0]], [1, 0, 0, 2]);
    for (let i = 0; i < items.count[0]; ++i) assert.ok(Math.abs(items.points[3 * i] - 0.25) < 1e-6 && Math.abs(items.points[3 * i + 2]) < 1e-6);
    assert.ok(Math.abs(Math.hypot(...items.normal) - 1) < 1e-6 && items.depth[0] > 0);
    // Once b has gone along the normal, the triangles are apart.
    const moved = [0.25, 0, -0.5].map((x, k) => x + items.normal[k] * items.depth[0] * 1.001);
    assert.ok(pairs.overlaps(triangle, { ...upright, translation: moved }).no(0));
});

test('a batch of pairs is a loop over its places', () => {
    const asked = questions(60), { rotation, translation, scale } = placesOf(asked);
    const place = (i) => ({ blob: body, rotation: rotation.subarray(4 * i, 4 * i + 4), translation: translation.subarray(3 * i, 3 * i + 3), scale: scale[i] });
    const all = pairs.contacts(body, { blob: body, rotation, translation, scale });
    const swapped = pairs.distance({ blob: body, rotation, translation, scale }, body);
    assert.ok(all.items.a.length > 1000);
    for (let i = 0; i < all.length; ++i) {
        const one = pairs.contacts(body, place(i));
        assert.deepStrictEqual([...one.items.a], [...all.items.a.subarray(all.begin(i), all.end(i))]);
        assert.deepStrictEqual([...one.items.b], [...all.items.b.subarray(all.begin(i), all.end(i))]);
        assert.deepStrictEqual([pairs.distance(place(i), body).distance[0]], [swapped.distance[i]]);
    }
});

test('a work limit is neither yes nor no', () => {
    const crossing = { blob: body, translation: [1.5, 0, 0] };
    const limited = pairs.overlaps(body, crossing, { workLimit: 1 });
    assert.deepStrictEqual([...limited.status], [Status.WORK_LIMIT]);
    assert.deepStrictEqual([limited.yes(0), limited.no(0)], [false, false]);
    assert.ok(pairs.overlaps(body, crossing, { workLimit: 2 ** 53 - 1 }).yes(0));
    const all = pairs.contacts(body, crossing), some = pairs.contacts(body, crossing, { workLimit: 200 });
    assert.ok(some.status[0] === Status.WORK_LIMIT && some.items.a.length < all.items.a.length);
    for (const workLimit of [-1, 0.5, NaN, 2 ** 53, '5', 5n]) assert.throws(() => pairs.overlaps(body, body, { workLimit }), RangeError);
});

test('wrong arguments of pairs throw and name the argument', async () => {
    throws(() => pairs.overlaps(body), TypeError, /b must be a blob/);
    throws(() => pairs.overlaps({ translation: [0, 0, 0] }, body), TypeError, /a must be a blob/);
    throws(() => pairs.contacts(body, { blob: body, translation: [0, 0] }), RangeError, /b.translation/);
    throws(() => pairs.contacts(body, { blob: body, rotation: [0, 0, 1] }), RangeError, /b.rotation/);
    throws(() => pairs.distance({ blob: body, scale: [1, 2, 3] }, { blob: body, scale: [1, 2] }), RangeError, /b.scale has 2 elements/);
    throws(() => pairs.withinDistance(body, body), TypeError, /distance/);
    const other = await load(), elsewhere = other.openBlob(body.bytes());
    throws(() => pairs.overlaps(body, elsewhere), TypeError, /one load/);
    elsewhere.free();
    throws(() => pairs.overlaps(body, elsewhere), QueryError, /not open/);
    throws(() => pairs.overlaps(elsewhere, body), QueryError, /not open/);
    assert.deepStrictEqual([...pairs.overlaps(body, { blob: body, scale: [0, NaN, -1] }).status], [17, 17, 17]);
});
