// Arguments: batches against loops of single queries, broadcasting, strides, other types of numbers.
import assert from 'node:assert';
import test from 'node:test';

import { shapesOf } from './support/answers.mjs';
import { lumpyBody, questions } from './support/questions.mjs';
import { espalier, throws } from './support/setup.mjs';

const library = await espalier.load();
const mesh = lumpyBody(), asked = questions(100);
const { origins, directions, limits } = asked;
const blob = await library.bake(mesh, { originalIds: true });
const count = limits.length;
const of = (array, components, i) => array.subarray(components * i, components * (i + 1));

/// Returns the elements of all queries, each from a call of its own.
function loop(call) {
    const all = {};
    for (let i = 0; i < count; ++i)
        for (const [name, array] of Object.entries(call(i))) (all[name] ??= []).push(...array);
    return all;
}

const asArrays = (columns) => Object.fromEntries(Object.entries(columns).map(([name, array]) => [name, [...array]]));

test('answers that are neither take a value of the caller', () => {
    const answers = blob.contains([0, 0, 0, 9, 9, 9, NaN, 0, 0]);
    for (const otherwise of [false, true])
        assert.deepStrictEqual([0, 1, 2].map((i) => answers.valueOr(i, otherwise)), [true, false, otherwise]);
});

test('a winding number counts 64 directions by itself', () => {
    const inside = origins.filter((_, i) => Math.abs(origins[i]) < 2).slice(0, 60);
    assert.deepStrictEqual(blob.windingNumber(inside), blob.windingNumber(inside, 64));
    for (const directions of [-1, 1.5, 2 ** 32 + 64]) assert.throws(() => blob.windingNumber(inside, directions), RangeError);
});

test('a batch is a loop over its queries', () => {
    assert.deepStrictEqual(
        asArrays(blob.raycast(origins, directions, { tMax: limits })),
        loop((i) => blob.raycast(of(origins, 3, i), of(directions, 3, i), { tMax: limits[i] })));
    assert.deepStrictEqual(asArrays(blob.closestPoint(origins, 1)), loop((i) => blob.closestPoint(of(origins, 3, i), 1)));
    const { sphere } = shapesOf(asked);
    const lists = blob.overlappingTriangles(sphere);
    for (let i = 0; i < count; ++i) {
        const one = blob.overlappingTriangles({ kind: 'sphere', center: of(sphere.center, 3, i), radius: sphere.radius[i] });
        assert.deepStrictEqual([...one.items], [...lists.items.subarray(lists.begin(i), lists.end(i))]);
    }
});

test('one element serves all queries', () => {
    const repeated = Float32Array.from({ length: 3 * count }, (_, k) => [0, 0, 0.125][k % 3]);
    assert.deepStrictEqual(blob.raycast([0, 0, 0.125], directions), blob.raycast(repeated, directions));
    assert.deepStrictEqual(blob.windingNumber([0, 0, 0.125]).value.length, 1);
    assert.deepStrictEqual(blob.sweep({ kind: 'sphere', center: origins, radius: 0.1 }, [0, 0, 0.125]),
                           blob.sweep({ kind: 'sphere', center: origins, radius: new Float32Array(count).fill(0.1) }, repeated));
});

test('elements may lie apart', () => {
    const interleaved = new Float32Array(8 * count + 1);
    for (let i = 0; i < count; ++i) {
        interleaved.set(of(origins, 3, i), 8 * i + 1);
        interleaved.set(of(directions, 3, i), 8 * i + 5);
    }
    const part = (offset) => ({ array: interleaved, stride: 8, offset });
    assert.deepStrictEqual(blob.raycast(part(1), part(5)), blob.raycast(origins, directions));
    assert.deepStrictEqual(blob.overlaps({ kind: 'box', min: part(1), max: part(5) }),
                           blob.overlaps({ kind: 'box', min: origins, max: directions }));
    assert.deepStrictEqual(blob.closestPoint({ array: interleaved.subarray(0, 12), stride: 8, offset: 1 }).status.length, 2);
});

test('other numbers are rounded to float32', () => {
    const exact = { origins: Float64Array.from(origins), directions: [...directions] };
    assert.deepStrictEqual(blob.raycast(exact.origins, exact.directions), blob.raycast(origins, directions));
    assert.deepStrictEqual(blob.closestPoint(new Int8Array([1, 2, 3])), blob.closestPoint([1, 2, 3]));
    assert.deepStrictEqual(blob.closestPoint([0.1, 0.2, 0.3]), blob.closestPoint(Float32Array.of(0.1, 0.2, 0.3)));
});

test('no queries have no results', () => {
    assert.strictEqual(blob.raycast([], []).t.length, 0);
    assert.strictEqual(blob.raycast([], [0, 0, 1]).t.length, 0);
    assert.strictEqual(blob.allHits([], []).length, 0);
    assert.strictEqual(blob.closestHits([], [], 4).items.t.length, 0);
});

test('lists longer than the first guess are complete', () => {
    const everything = { kind: 'sphere', center: new Float32Array(3 * 50), radius: 100 };
    const lists = blob.overlappingTriangles(everything);
    assert.strictEqual(lists.items.length, 50 * blob.triangleCount);
    for (let i = 0; i < 50; ++i) assert.strictEqual(lists.items[lists.begin(i) + 7], 7);
    assert.strictEqual(lists.end(49), lists.items.length);
});

test('contacts have margins and a largest number', () => {
    const ball = { kind: 'sphere', center: [0, 0, 9, 0, 0, 9, 0, 0, 9], radius: 6.5 };
    const lists = blob.contacts(ball, 1000, [0, 1, NaN]);
    assert.deepStrictEqual([...lists.status], [0, 0, 17]);
    const [none, all] = [lists.end(0), lists.end(1)];
    assert.deepStrictEqual([none, lists.end(2)], [0, all]);
    const { distance, normal } = lists.items;
    for (let i = 0; i < all; ++i) assert.ok(distance[i] > 0 && distance[i] <= 1 && normal[3 * i + 2] > 0 && (i === 0 || distance[i] >= distance[i - 1]));
    const first = blob.contacts({ ...ball, center: [0, 0, 9] }, 2, 1);
    assert.deepStrictEqual([...first.status], [3]);
    assert.deepStrictEqual([...first.items.distance], [...distance.subarray(0, 2)]);
    assert.deepStrictEqual(blob.contacts({ ...ball, center: [0, 0, 7] }, 1).items.distance[0] < 0, true);
});

test('wrong arguments throw and name the argument', () => {
    throws(() => blob.raycast([0, 0], [0, 0, 1]), RangeError, /origins/);
    throws(() => blob.raycast(new Float32Array(6), new Float32Array(9)), RangeError, /directions has 3 elements, but another argument has 2/);
    throws(() => blob.raycast('rays', [0, 0, 1]), TypeError, /origins/);
    throws(() => blob.raycast([[0, 0, 0]], [0, 0, 1]), TypeError, /origins/);
    throws(() => blob.raycast(new BigInt64Array(3), [0, 0, 1]), TypeError, /origins/);
    throws(() => blob.raycast({ array: origins, stride: 2 }, [0, 0, 1]), RangeError, /stride of origins/);
    throws(() => blob.raycast({ array: [1], offset: 2 }, [0, 0, 1]), RangeError, /offset of origins/);
    throws(() => blob.raycast(origins, directions, { culling: 'both' }), RangeError, /culling must be one of none, back, front/);
    throws(() => blob.overlaps({ kind: 'cylinder' }), RangeError, /kind of a shape/);
    throws(() => blob.overlaps({ kind: 'sphere', center: [0, 0, 0] }), TypeError, /sphere.radius/);
    throws(() => blob.sweep({ kind: 'cone', apex: [0, 0, 0], axis: [0, 0, 1], radius: 1 }, [0, 0, 1]), RangeError, /kind of a shape/);
    throws(() => blob.contacts({ kind: 'box', min: [0, 0, 0], max: [1, 1, 1] }, 4), RangeError, /kind of a shape must be one of sphere, capsule, orientedBox/);
    throws(() => blob.contacts({ kind: 'sphere', center: [0, 0, 0], radius: 1 }), RangeError, /most must be/);
    throws(() => blob.closestPoint({ kind: 'sphere', center: [0, 0, 0], radius: 1 }), RangeError, /sphere/);
    throws(() => blob.closestHits(origins, directions, -1), RangeError, /most must be/);
    throws(() => blob.closestTriangles(origins, 1.5), RangeError, /most must be/);
    throws(() => blob.originalHits({ t: [0] }), TypeError, /hits.u/);
    throws(() => blob.materials([0.5]), TypeError, /triangles must be integers, not 0.5/);
});

test('lookups by triangle', () => {
    const all = Uint32Array.from({ length: blob.triangleCount }, (_, i) => i);
    const sources = blob.originalTriangles(all), { corners } = blob.corners(all);
    assert.deepStrictEqual({ ...sources, status: undefined }, { ...blob.remap, status: undefined });
    for (let i = 0; i < 40; ++i)
        for (let corner = 0; corner < 3; ++corner) {
            const vertex = mesh.triangles[3 * sources.triangle[i] + (corner + sources.firstCorner[i]) % 3];
            for (let k = 0; k < 3; ++k)
                assert.ok(Math.abs(mesh.positions[3 * vertex + k] - corners[9 * i + 3 * corner + k]) <= blob.maxError);
        }
    assert.deepStrictEqual([...blob.corners([-1, 2 ** 40, blob.triangleCount, 0]).status], [17, 17, 17, 0]);
    assert.deepStrictEqual([...blob.materials(5)], [0]);
});
