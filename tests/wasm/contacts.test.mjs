// Edges, contacts that are reduced, how far rounding moves queries, bounds, poses, and instances near boxes.
import assert from 'node:assert';
import test from 'node:test';

import { lumpyBody, questions } from './support/questions.mjs';
import { espalier, throws } from './support/setup.mjs';
import { codesOf } from './support/words.mjs';

const { EdgeKind, Feature, load, pairs, QueryError, Status } = espalier;
const library = await load();
const body = await library.bake(lumpyBody(), { flatAngle: 5, bounds: true });
const { origins, directions } = questions(200);
const near = Float32Array.from({ length: 600 }, (_, i) => Math.sin(i * 12.9898) * 3);

test('edges have kinds and correct normals', () => {
    const all = Uint32Array.from({ length: body.triangleCount + 1 }, (_, i) => i);
    const kinds = body.edgeKinds(all);
    assert.deepStrictEqual([...new Set(kinds.ab.subarray(0, body.triangleCount))].every((kind) => kind <= EdgeKind.BOUNDARY), true);
    assert.deepStrictEqual([kinds.status[0], kinds.status.at(-1)], [Status.OK, Status.INVALID_ARGUMENT]);
    assert.deepStrictEqual([...body.fixInternalEdgeNormals(0, Feature.FACE, [1, 2, 3, 4, 5, 6])], [1, 2, 3, 4, 5, 6]);
    throws(() => body.fixInternalEdgeNormals(0, 7, [0, 0, 1]), RangeError, /features/);
});

test('planes hold a capsule back, and their solution keeps off them', () => {
    const capsule = { kind: 'capsule', from: near, to: near, radius: 0.5 }, planes = body.planes(capsule, 8, 1);
    const ways = library.solvePlanes(planes, [0, 0, -1], 0.01);
    assert.ok(planes.items.distance.length > 100 && ways.status.filter((status) => status === Status.OK).length > 100);
    for (let i = 0; i < planes.length; ++i)
        for (let k = planes.begin(i); k < planes.end(i) && ways.status[i] === Status.OK; ++k) {
            const along = [0, 1, 2].reduce((sum, axis) => sum + planes.items.normal[3 * k + axis] * ways.value[3 * i + axis], 0);
            assert.ok(planes.items.distance[k] + along > 0.01 - 1e-4);
        }
    assert.deepStrictEqual([...library.solvePlanes(body.planes({ ...capsule, from: [0, 0, 99], to: [0, 0, 99] }, 8, 1), [1, 2, 3], 0).value], [1, 2, 3]);
    assert.deepStrictEqual([...body.planes(capsule, 1, 9).status].includes(Status.OUTPUT_FULL), true);
    throws(() => library.solvePlanes(body.closestTriangles(near, 2), [0, 0, 1], 0), TypeError, /lists/);
    throws(() => library.solvePlanes(planes, [0, 0, 1, 0, 0, 1], 0), RangeError, /200/);
    planes.offsets[1] = 4e9;
    throws(() => library.solvePlanes(planes, [0, 0, 1], 0), RangeError, /offsets/);
    throws(() => body.planes({ kind: 'sphere', center: near, radius: 1 }, 8, 1), RangeError, /capsule/);
});

test('reduced contacts are some of those that were given, the deepest first', () => {
    const contacts = body.contacts({ kind: 'sphere', center: near, radius: 1.5 }, 32), kept = library.reduceContacts(contacts);
    let most = 0;
    for (let i = 0; i < kept.length; ++i) {
        const count = kept.end(i) - kept.begin(i), given = contacts.end(i) - contacts.begin(i);
        most = Math.max(most, count);
        assert.ok(count <= Math.min(4, given) && (count > 0) === (given > 0));
        const triangles = new Set(contacts.items.triangle.subarray(contacts.begin(i), contacts.end(i)));
        assert.ok(kept.items.triangle.subarray(kept.begin(i), kept.end(i)).every((triangle) => triangles.has(triangle)));
        if (count > 0) assert.strictEqual(kept.items.distance[kept.begin(i)], Math.min(...kept.items.distance.subarray(kept.begin(i), kept.end(i))));
    }
    assert.ok(most > 1);
    const touches = pairs.touches(body, { blob: body, translation: [0.5, 0, 0] }), points = pairs.touchContacts(touches);
    assert.strictEqual(points.items.distance.length, touches.items.count.reduce((sum, count) => sum + count, 0));
    assert.ok(library.reduceContacts(points).end(0) <= 4);
    throws(() => library.reduceContacts(body.closestTriangles(near, 2)), TypeError, /lists/);
});

test('rounding moves queries by little, and sweeps by more', () => {
    const sphere = { kind: 'sphere', center: near, radius: 0.5 };
    const points = body.roundingError(near), spheres = body.roundingError(sphere), swept = body.roundingError(sphere, [0, 0, -1]);
    const rays = body.roundingError({ kind: 'ray', origin: near, direction: [0, 0, -1] });
    for (const { value, status } of [points, spheres, swept, rays]) {
        assert.ok(status.every((each) => each === Status.OK) && value.every((error) => error > 0 && error < 1e-3));
        assert.strictEqual(value.length, 200);
    }
    assert.ok(swept.value[0] >= spheres.value[0]);
    throws(() => body.roundingError({ kind: 'convexHull', vertices: near }), RangeError, /kind of a shape/);
});

test('accuracies lose no yes', () => {
    const exact = codesOf(body.occluded(origins, directions)), coarse = codesOf(body.occluded(origins, directions, { accuracy: 0.5 }));
    exact.forEach((code, i) => assert.ok(code !== Status.OK || coarse[i] === Status.OK));
    const sphere = { kind: 'sphere', center: near, radius: 0.1 };
    const touches = codesOf(body.overlaps(sphere)), nearly = codesOf(body.overlaps(sphere, { accuracy: 1 }));
    touches.forEach((code, i) => assert.ok(code !== Status.OK || nearly[i] === Status.OK));
    const { distance } = body.closestPoint(near), { lower, upper } = body.distanceBounds(near, 0.5);
    distance.forEach((each, i) => assert.ok(lower[i] <= each * 1.000001 && each <= upper[i] * 1.000001));
});

test('stored bounds hold all corners', async () => {
    const corners = body.triangles(), { center, radius } = body.boundingSphere(), { directions: ways, low, high } = body.kDopBounds();
    for (let i = 0; i < corners.length; i += 3) {
        const [x, y, z] = corners.subarray(i, i + 3);
        assert.ok(Math.hypot(x - center[0], y - center[1], z - center[2]) <= radius * 1.000001);
        for (let k = 0; k < 13; ++k) {
            const along = x * ways[3 * k] + y * ways[3 * k + 1] + z * ways[3 * k + 2];
            assert.ok(low[k] <= along && along <= high[k]);
        }
    }
    assert.strictEqual(body.orientedBounds().halfAxes.length, 9);
    const plain = await library.bake(lumpyBody());
    throws(() => plain.boundingSphere(), QueryError, /./);
});

test('candidates and boxes of instances', async () => {
    const places = { translation: Float32Array.from({ length: 30 }, (_, i) => (i % 3 === 0 ? 10 * i : 0)) };
    const moving = library.createMovingScene([body], 16), handles = moving.insert(places);
    const scene = await library.bakeScene([body], places), box = { kind: 'box', min: [29, -1, -1, 500, 0, 0], max: [31, 1, 1, 501, 1, 1] };
    for (const each of [scene, moving]) {
        const found = each.candidates(box);
        assert.ok(found.items.instance.subarray(0, found.end(0)).length >= 1);
        assert.strictEqual(found.end(1) - found.begin(1), 0);
    }
    const { min, max, status } = moving.boxes(handles);
    assert.ok(status.every((each) => each === Status.OK) && min[0] < max[0]);
    assert.strictEqual(scene.isOnCommonLattice().length, 10);
    assert.match(library.describe(Status.NOT_CLOSED), /closed/);
});
