// Hulls and volumes: against boxes, batches against loops, arguments.
import assert from 'node:assert';
import test from 'node:test';

import { lumpyBody, questions } from './support/questions.mjs';
import { espalier, throws } from './support/setup.mjs';
import { codesOf } from './support/words.mjs';

const { load, Status } = espalier;
const library = await load();
const body = await library.bake(lumpyBody());
const asked = questions(100), { directions, vertices, vertexOffsets, planes, planeOffsets } = asked;
const scene = await library.bakeScene([body], { scale: 0.5, translation: [0, 0, 0, 2, 0, 0] });
const corners = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) => [i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 4 : 3.5]);
const hull = { kind: 'convexHull', vertices: corners }, box = { kind: 'box', min: [-0.5, -0.5, 3.5], max: [0.5, 0.5, 4] };
const isNear = (number, expected) => assert.ok(Math.abs(number - expected) < 1e-4, `${number} is not ${expected}`);

test('a hull of the corners of a box moves as the box', () => {
    const ways = [0, 0, -5, 0, 0, 5, 0.1, 0.2, -3];
    for (const each of [body, scene]) {
        const ours = each.sweep(hull, ways), theirs = each.sweep(box, ways);
        assert.deepStrictEqual(ours.status, theirs.status);
        assert.ok(ours.status.includes(Status.OK) && ours.status.includes(Status.NOT_FOUND));
        ours.t.forEach((t, i) => isNear(t, theirs.t[i]));
    }
    const oriented = { kind: 'orientedBox', center: [0, 0, 3.75], halfAxes: [0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.25] };
    const ours = body.contacts(hull, 100, 2), theirs = body.contacts(oriented, 100, 2);
    assert.strictEqual(ours.items.distance.length, theirs.items.distance.length);
    isNear(ours.items.distance[0], theirs.items.distance[0]);
});

test('a volume of six planes touches as the box', () => {
    const planes = [1, 0, 0, 0.5, -1, 0, 0, 0.5, 0, 1, 0, 0.5, 0, -1, 0, 0.5, 0, 0, 1, 4, 0, 0, -1, 0];
    const ours = body.overlappingTriangles({ kind: 'convexVolume', planes });
    const theirs = body.overlappingTriangles({ kind: 'box', min: [-0.5, -0.5, 0], max: [0.5, 0.5, 4] });
    assert.ok(ours.items.length > 4);
    assert.deepStrictEqual(ours, theirs);
    assert.ok(body.overlaps({ kind: 'convexVolume', planes: [] }).yes(0));  // all of space
});

test('a batch of hulls or volumes is a loop over them', () => {
    const hits = body.sweep({ kind: 'convexHull', vertices, offsets: vertexOffsets }, directions);
    const touched = codesOf(body.overlaps({ kind: 'convexVolume', planes, offsets: [...planeOffsets] }));
    for (let i = 0; i < 100; ++i) {
        const one = vertices.subarray(3 * vertexOffsets[i], 3 * vertexOffsets[i + 1]);
        const hit = body.sweep({ kind: 'convexHull', vertices: one }, directions.subarray(3 * i, 3 * i + 3));
        assert.deepStrictEqual([hit.t[0], hit.status[0]], [hits.t[i], hits.status[i]]);
        const volume = { kind: 'convexVolume', planes: planes.subarray(4 * planeOffsets[i], 4 * planeOffsets[i + 1]) };
        assert.strictEqual(codesOf(body.overlaps(volume))[0], touched[i]);
    }
    assert.deepStrictEqual([hits.status[20], touched[21]], [Status.INVALID_ARGUMENT, Status.INVALID_ARGUMENT]);
});

test('one hull serves all queries, and vertices may lie apart', () => {
    const ways = [0, 0, -5, 0, 0, -4], expected = body.sweep(hull, ways);
    const interleaved = { array: corners.flatMap((x, i) => i % 3 === 2 ? [x, 7, 7] : [x]), stride: 5 };
    assert.deepStrictEqual(body.sweep({ kind: 'convexHull', vertices: interleaved }, ways), expected);
    const twice = { kind: 'convexHull', vertices: [9, 9, 9, ...corners, ...corners], offsets: [1, 9, 17] };
    assert.deepStrictEqual(body.sweep(twice, ways), expected);
    const empty = body.sweep({ kind: 'convexHull', vertices: corners, offsets: [0, 0, 8] }, [0, 0, -5]);
    assert.deepStrictEqual([...empty.status], [Status.NOT_FOUND, Status.OK]);
    assert.strictEqual(body.sweep({ kind: 'convexHull', vertices: corners, offsets: [0] }, [0, 0, -5]).t.length, 0);
    const margins = body.contacts(hull, 4, [0.1, 2]);
    assert.deepStrictEqual([margins.end(0), margins.end(1)], [0, 4]);
});

test('wrong hulls throw and name the argument', () => {
    const sweep = (shape) => body.sweep({ kind: 'convexHull', ...shape }, [0, 0, 1]);
    throws(() => sweep({}), TypeError, /convexHull.vertices/);
    throws(() => sweep({ vertices: [0, 0] }), RangeError, /convexHull.vertices/);
    for (const offsets of [[0, 9], [4, 2], [], [0, -1], [0, 2 ** 32]]) throws(() => sweep({ vertices: corners, offsets }), RangeError, /convexHull.offsets/);
    throws(() => sweep({ vertices: corners, offsets: [0, 0.5] }), TypeError, /convexHull.offsets/);
    throws(() => sweep({ vertices: corners, offsets: 'all' }), TypeError, /convexHull.offsets/);
    throws(() => body.sweep({ kind: 'convexHull', vertices: corners, offsets: [0, 4, 8] }, [0, 0, 1, 0, 0, 2, 0, 0, 3]), RangeError, /elements/);
    throws(() => body.overlaps(hull), RangeError, /kind of a shape must be one of .*convexVolume/);
    throws(() => body.overlaps({ kind: 'convexVolume', planes: [0, 0, 1] }), RangeError, /convexVolume.planes/);
    throws(() => body.sweep({ kind: 'convexVolume', planes: [0, 0, 1, 0] }, [0, 0, 1]), RangeError, /kind of a shape/);
    throws(() => scene.overlaps({ kind: 'convexVolume', planes: [0, 0, 1, 0] }), RangeError, /kind of a shape/);
});
