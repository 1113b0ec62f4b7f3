// Meshes far from 0, whose coordinates float32 does not hold: all places are in the coordinates of the source.
import assert from 'node:assert';
import test from 'node:test';

import { espalier, rejects } from './support/setup.mjs';

const { BakeError, pairs, Status } = espalier;
const library = await espalier.load();

const PLACE = [500123.4567, 5400321.123, 612.3];  // UTM, where float32 has steps of half a metre
const NEAR = 0.002;                               // the tolerance of the bakes is half of it

/// Returns three numbers, or more, from the place.
const at = (...local) => local.map((x, i) => x + PLACE[i % 3]);

function cube(middle) {
    const positions = [];
    for (const x of [-2, 2]) for (const y of [-2, 2]) for (const z of [-2, 2]) positions.push(x + middle[0], y + middle[1], z + middle[2]);
    return {
        positions, triangles: [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3],
    };
}
const bake = (middle, options = {}) => library.bake(cube(middle), { tolerance: 0.001, bounds: true, flatAngle: 5, ...options });

/// Requires that places are in double and near others.
function close(places, expected) {
    assert.ok(places instanceof Float64Array && places.length === expected.length, `${places.constructor.name} of ${places.length}`);
    places.forEach((x, i) => assert.ok(Math.abs(x - expected[i]) < NEAR, `${x} is not ${expected[i]}`));
}
const near = (number, expected) => assert.ok(Math.abs(number - expected) < NEAR, `${number} is not ${expected}`);

const far = await bake(PLACE), plain = await bake([0, 0, 0]);

test('an origin is chosen and kept', async () => {
    assert.ok(far.origin instanceof Float64Array && far.origin.every((x, i) => x !== 0 && Math.abs(x - PLACE[i]) < 16));
    assert.deepStrictEqual(far.report.origin, [...far.origin]);
    assert.deepStrictEqual(far.report.warnings, []);
    const again = library.openBlob(far.bytes());
    assert.deepStrictEqual([again.origin, again.info().origin], [far.origin, far.origin]);
    assert.deepStrictEqual(again.closestPoint(at(0, 0, 3)), far.closestPoint(at(0, 0, 3)));
    await library.verify(far);
    const byHand = await bake(PLACE, { origin: at(-100, 0, 3) });
    assert.deepStrictEqual([...byHand.origin], at(-100, 0, 3));
    close(byHand.closestPoint(at(0, 0, 3)).point, at(0, 0, 2));
    await rejects(bake(PLACE, { origin: null }), BakeError, /choose an origin/);
    await rejects(library.bake([]), BakeError, /no triangle is left/);
    await rejects(bake(PLACE, { origin: 'middle' }), RangeError, /origin must be/);
});

test('without an origin all is as before', async () => {
    assert.deepStrictEqual((await bake([0, 0, 0], { origin: null })).bytes(), plain.bytes());
    assert.deepStrictEqual([...plain.origin], [0, 0, 0]);
    const ball = { kind: 'sphere', center: [0, 0, 2.2], radius: 0.25 };
    for (const places of [plain.bounds, plain.triangles(), plain.boundingSphere().center, plain.kDopBounds().low, plain.info().latticeOrigin,
        plain.closestPoint([0, 0, 3]).point, plain.sweep(ball, [0, 0, -1]).point, plain.contacts(ball, 4).items.point,
        pairs.distance(plain, plain).onA, pairs.touches(plain, plain).items.points]) assert.ok(places instanceof Float32Array);
});

test('rays', () => {
    const hits = far.raycast(at(0.3, 0.4, 9, -1, 1.5, 9), [0, 0, -1]);
    assert.deepStrictEqual([...hits.status], [0, 0]);
    hits.t.forEach((t) => near(t, 7));
    assert.ok(far.occluded(at(0.3, 0.4, 9), [0, 0, -1]).yes(0) && far.occluded(at(0.3, 0.4, 9), [0, 0, 1]).no(0));
    assert.ok(far.occluded(at(0.3, 0.4, 9), [0, 0, -1], { accuracy: 0.01 }).yes(0));
    assert.deepStrictEqual(Array.from(far.allHits(at(0.3, 0.4, 9), [0, 0, -1]).items.t, Math.round).sort((a, b) => a - b), [7, 11]);
    near(far.closestHits(at(0.3, 0.4, 9), [0, 0, -1], 1).items.t[0], 7);
    assert.ok(far.raycast([0.3, 0.4, 9], [0, 0, -1]).status[0] !== Status.OK);
    const interleaved = { array: [7, ...at(0.3, 0.4, 9), 7, ...at(0, 1, 5)], stride: 4, offset: 1 };
    assert.deepStrictEqual(Array.from(far.raycast(interleaved, [0, 0, -1]).t, (t) => Math.round(t)), [7, 3]);
    assert.ok(far.roundingError({ kind: 'ray', origin: at(0, 0, 9), direction: [0, 0, -1] }).value[0] < 0.001);
});

test('points', () => {
    for (const found of [far.closestPoint(at(0.5, 0, 3, 4, 1, 0)), far.signedDistance(at(0.5, 0, 3, 4, 1, 0)), far.closestTriangles(at(0.5, 0, 3, 4, 1, 0), 1).items]) {
        close(found.point, at(0.5, 0, 2, 2, 1, 0));
        close(found.onShape, at(0.5, 0, 3, 4, 1, 0));
        assert.ok(found.faceNormal instanceof Float32Array && Math.abs(found.distance[1] - 2) < NEAR);
    }
    close(far.closestPoint({ kind: 'segment', from: at(0.5, 0, 3), to: at(0.5, 0, 4) }).point, at(0.5, 0, 2));
    close(far.closestPoint({ kind: 'box', min: at(0.5, 0, 3), max: at(0.5, 0, 4) }).onShape, at(0.5, 0, 3));
    const inside = far.contains(at(0, 0, 0, 0, 0, 2.01));
    assert.ok(inside.yes(0) && inside.no(1));
    assert.deepStrictEqual(Array.from(far.windingNumber(at(0, 0, 0, 0, 0, 2.01)).value, Math.round), [1, 0]);
    near(far.distanceBounds(at(0, 0, 3), 0.0001).lower[0], 1);
    assert.ok(far.roundingError(at(0, 0, 3)).value[0] < 0.001);
});

/// Returns shapes around a place that reach 0.25 from it along z.
function bodies([x, y, z]) {
    const tips = [0.25, 0, 0, 0, 0.25, 0, 0, 0, 0.25, -0.25, 0, 0, 0, -0.25, 0, 0, 0, -0.25], middle = [x, y, z];
    const from = (first, count = 3) => tips.slice(first, first + count).map((offset, i) => offset + middle[i % 3]);
    return {
        sphere: { kind: 'sphere', center: middle, radius: 0.25 },
        capsule: { kind: 'capsule', from: middle, to: [x + 0.1, y, z], radius: 0.25 },
        box: { kind: 'box', min: [x - 0.25, y - 0.25, z - 0.25], max: [x + 0.25, y + 0.25, z + 0.25] },
        orientedBox: { kind: 'orientedBox', center: middle, halfAxes: tips.slice(0, 9) },
        convexHull: { kind: 'convexHull', vertices: from(0, 18) },
        triangle: { kind: 'triangle', a: from(0), b: from(6), c: from(15) },
        cone: { kind: 'cone', apex: [x, y, z - 0.25], axis: [0, 0, 0.5], radius: 0.1 },
        convexVolume: {
            kind: 'convexVolume', planes: [1, -1].flatMap((side) => middle.flatMap((coordinate, k) =>
                [...[0, 1, 2].map((i) => (i === k ? side : 0)), side * coordinate + 0.25])),
        },
    };
}

test('shapes', () => {
    for (const [height, touches] of [[2.24, true], [2.26, false]]) {
        const { convexHull, ...volumes } = bodies(at(0.3, 0.4, height));
        for (const shape of Object.values(volumes)) {
            assert.strictEqual(far.overlaps(shape).yes(0), touches, shape.kind);
            assert.strictEqual(far.overlappingTriangles(shape).items.length > 0, touches, shape.kind);
        }
        for (const kind of ['sphere', 'box']) assert.strictEqual(far.overlaps(volumes[kind], { accuracy: 0.001 }).yes(0), touches);
    }
    const { sphere, capsule, box, orientedBox, convexHull } = bodies(at(0.3, 0.4, 6.25)), way = [0, 0, -10];
    for (const shape of [sphere, capsule, box, orientedBox, convexHull]) {
        const hit = far.sweep(shape, way);
        near(10 * hit.t[0], 4);
        assert.ok(hit.point instanceof Float64Array && Math.abs(hit.point[2] - PLACE[2] - 2) < NEAR);
        assert.ok(far.roundingError(shape, way).value[0] < 0.01);
    }
});

test('contacts', () => {
    const { sphere, capsule, orientedBox, convexHull } = bodies(at(0.3, 0.4, 2.2));
    for (const shape of [sphere, capsule, orientedBox, convexHull]) {
        const contacts = far.contacts(shape, 16, 0.1), { point, distance } = contacts.items;
        near(distance[0], -0.05);
        for (let i = 0; i < point.length; i += 3) near(point[i + 2], PLACE[2] + 2);
        const kept = library.reduceContacts(contacts);
        assert.ok(kept.items.point instanceof Float64Array && kept.items.distance.length >= 1 && kept.items.distance.length <= 4);
        assert.ok(kept.items.point.every((x) => point.includes(x)));
        if (shape !== orientedBox) continue;  // a face on the surface is held at its corners
        const across = kept.items.point.filter((_, i) => i % 3 === 0);
        assert.ok(across.length === 4 && Math.max(...across) - Math.min(...across) > 0.45);
    }
});

test('bounds and corners', () => {
    close(far.bounds, at(-2, -2, -2, 2, 2, 2));
    const corners = far.triangles();
    assert.ok(corners instanceof Float64Array);
    corners.forEach((x, i) => near(Math.abs(x - PLACE[i % 3]), 2));
    assert.deepStrictEqual(far.corners([0]).corners, corners.subarray(0, 9).slice());
    close(Float64Array.from(far.report.boundsMin), at(-2, -2, -2));
    const { center, radius } = far.boundingSphere();
    assert.ok(radius < 3.6 && center.every((x, i) => Math.abs(x - PLACE[i]) < 0.1));
    assert.ok(far.orientedBounds().center.every((x, i) => Math.abs(x - PLACE[i]) < 0.1));
    const { directions, low, high } = far.kDopBounds();
    for (let i = 0; i < 13; ++i) {
        const along = [0, 1, 2].reduce((sum, k) => sum + directions[3 * i + k] * PLACE[k], 0);
        assert.ok(low[i] < along && along < high[i] && high[i] - low[i] < 13);
    }
    const { latticeOrigin, latticeStepExponent } = far.info();
    latticeOrigin.forEach((x, i) => assert.ok(Math.abs(Math.round((far.bounds[i] - x) / 2 ** latticeStepExponent) - (far.bounds[i] - x) / 2 ** latticeStepExponent) < 1e-3));
});

test('two blobs', async () => {
    const other = await bake(at(3.9, 0, 0));
    assert.ok(pairs.overlaps(far, other).yes(0) && pairs.overlaps(far, await bake(at(4.01, 0, 0))).no(0));
    const touches = pairs.touches(far, other), contacts = pairs.touchContacts(touches);
    assert.ok(touches.items.points instanceof Float64Array && contacts.items.point instanceof Float64Array && contacts.items.point.length > 0);
    contacts.items.point.forEach((x, i) => assert.ok(Math.abs(x - PLACE[i % 3]) < 6));
    assert.ok(library.reduceContacts(contacts).items.distance.length <= 4);
    const placed = { blob: other, translation: [0.5, 0, 0, 0.5, 0.25, 0, -20, 0, 0] };
    const { distance, onA, onB } = pairs.distance(far, placed);
    [0.4, 0.4, 12.1].forEach((expected, i) => near(distance[i], expected));
    [2, 2, -2].forEach((expected, i) => near(onA[3 * i], PLACE[0] + expected));
    [2.4, 2.4, -14.1].forEach((expected, i) => near(onB[3 * i], PLACE[0] + expected));
    assert.deepStrictEqual([0, 1, 2].map((i) => pairs.withinDistance(far, placed, 0.41).yes(i)), [true, true, false]);
    const turned = (blob) => ({ blob, rotation: [0, 0, 1, 1] }), found = pairs.distance(turned(far), turned(other));
    assert.strictEqual(found.distance[0], 0);
    [-PLACE[1], PLACE[0], PLACE[2]].forEach((x, i) => assert.ok(Math.abs(found.onA[i] - x) < 2.1));
    near(pairs.distance(plain, { blob: far, translation: PLACE.map((x, i) => (i === 0 ? 4.25 : 0) - x) }).distance[0], 0.25);
    const refused = { rotation: [0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1], translation: [NaN, 0, 0, 0, 0, 0, 0, 0, 0], scale: [1, 1, -1] };
    for (const [a, b] of [[{ blob: far, ...refused }, other], [far, { blob: other, ...refused }]])
        assert.deepStrictEqual([...pairs.distance(a, b).status], Array(3).fill(Status.INVALID_ARGUMENT));
});

test('tiles are joined where their sources are', async () => {
    const base = PLACE.map(Math.round), from = (x, y, z) => [base[0] + x + 0.1, base[1] + y + 0.1, base[2] + z + 0.1];
    const ground = (x, shift = 0) => library.bake(
        { positions: [...from(x, -4, 0), ...from(x + 4, -4, 0), ...from(x + 4, 4, 0), ...from(x, 4, 0)], triangles: [0, 1, 2, 0, 2, 3] },
        { stepExponent: -10, flatAngle: 5, origin: [base[0] + x + shift, base[1], base[2]] });
    const tiles = [await ground(-4), await ground(0)];
    const leaning = (both) => both.some((tile, i) => tile.contacts({ kind: 'sphere', center: from(i === 0 ? 0.1 : -0.1, 0, 0.24), radius: 0.25 }, 4, 0.05)
        .items.normal.some((x, k) => k % 3 === 0 && Math.abs(x) > 1e-6));
    assert.ok(leaning(tiles));
    const joined = await library.joinBorders(tiles);
    assert.ok(!leaning(joined));
    assert.deepStrictEqual(joined.map(({ origin }) => origin), tiles.map(({ origin }) => origin));
    await rejects(library.joinBorders([tiles[0], await ground(0, 0.0001)]), BakeError, /blob 1 does not lie/);
});

test('scenes place the source and have an origin', async () => {
    const at = (...local) => local.map((x, i) => PLACE[i % 3] + x), cube = await bake([0, 0, 0]);
    const scene = await library.bakeScene([far, cube], { mesh: [0, 1], translation: [0, 0, 0, ...at(8, 0, 0)] });
    assert.deepStrictEqual(scene.report.warnings, []);
    for (const each of [scene, library.openScene(scene.bytes())]) {
        assert.deepStrictEqual(each.origin, scene.origin);
        each.origin.forEach((x, i) => assert.ok(Math.abs(x - PLACE[i]) < 32));
        const found = each.closestPoint(at(0, 0, 3, 8, 0, 3)), expected = at(0, 0, 2, 8, 0, 2);
        assert.deepStrictEqual([...found.instance], [0, 1]);
        assert.ok(found.point instanceof Float64Array);
        found.point.forEach((x, i) => near(x, expected[i]));
        const bounds = at(-2, -2, -2, 10, 2, 2);  // around boxes, which are larger
        each.bounds.forEach((x, i) => assert.ok(i < 3 ? x < bounds[i] + NEAR && x > bounds[i] - 8 : x > bounds[i] - NEAR && x < bounds[i] + 8));
        near(each.raycast(at(8, 0, 9), [0, 0, -1]).t[0], 7);
        const { items, offsets } = each.contacts({ kind: 'sphere', center: at(8, 0, 2.24, 0, 0, 2.26), radius: 0.25 }, 4);
        assert.deepStrictEqual([offsets[1] > 0, offsets[2] - offsets[1]], [true, 0]);
        assert.strictEqual(items.instance[0], 1);
        near(items.distance[0], -0.01);
        [...items.point.subarray(0, 3)].forEach((x, i) => near(x, at(8, 0, 2)[i]));
        const corner = at(8, 0, 0);
        [...each.instances().translation].slice(3).forEach((x, i) => near(x, corner[i]));
    }
    const tile = library.createMovingScene([far], 4, { stepExponent: -6, tiles: [scene] }).seenFrom(PLACE);
    tile.insert({ mesh: 1, translation: scene.origin });
    tile.closestPoint(at(8, 0, 3)).point.forEach((x, i) => near(x, at(8, 0, 2)[i]));
    const bodies = library.createMovingScene([await bake([0, 0, 0])], 4, { stepExponent: -7 }), view = bodies.seenFrom(scene.origin);
    assert.deepStrictEqual([...view.origin], [...scene.origin]);
    view.insert({ translation: at(11, 0, 0) });
    assert.deepStrictEqual([...view.collidingPairs({ baked: scene }).items.instance], [1]);
    for (const other of [bodies, bodies.seenFrom(at(4000, 0, 0))])  // which take that view themselves
        assert.deepStrictEqual([...other.collidingPairs({ baked: scene }).items.instance], [1]);
    const odd = await library.bakeScene([cube], { translation: [...PLACE] }, { origin: PLACE });
    assert.strictEqual(bodies.collidingPairs({ baked: odd }).status, Status.INVALID_ARGUMENT);
    const without = await library.bakeScene([far], {}, { origin: null });
    assert.match(without.report.warnings[0], /instance 0 lies where float32 is coarser/);
    assert.deepStrictEqual([...(await library.bakeScene([far], {}, { origin: PLACE })).origin], [...PLACE]);
    assert.strictEqual(library.openScene(without.bytes()).report, null);
    await rejects(library.bakeScene([far], {}, { origin: 'near' }), RangeError, /origin must be/);
    await rejects(library.bakeScene([far], {}, { origin: [0, NaN, 0] }), BakeError, /origin/);
    await rejects(library.bakeScene([far, cube], {}), RangeError, /number of the blob of each instance, as there are 2 blobs/);
});

const WORLD = [99876.5, -42123.25, 12];  // as far as float32 has steps of 8 mm
const inWorld = (...local) => local.map((x, i) => x + WORLD[i % 3]);

/// Returns two cubes with a middle in the world that float32 does not hold, each placed through a view of its own.
async function makeWorld() {
    const scene = library.createMovingScene([await bake([0, 0, 0])], 8);
    for (const [apart, x] of [[0, 0], [700, 8.001]]) {
        const view = scene.seenFrom(inWorld(apart, -apart, 0));
        assert.deepStrictEqual([...view.insert({ translation: inWorld(x, 0, 0) }).status], [Status.OK]);
        view.free();
    }
    return scene;
}

test('a view of a moving scene takes and returns places in the world', async () => {
    const world = await makeWorld(), view = world.seenFrom(inWorld(0, 0, 40));
    assert.ok(view.origin.every((x, i) => Math.abs(x - WORLD[i]) < 41 && x % 0.125 === 0));
    assert.deepStrictEqual([...world.origin, ...view.seenFrom([0.01, 0, 0]).origin], [0, 0, 0, 0, 0, 0]);
    view.raycast(inWorld(0, 0, 9, 8.001, 1.999, 9), [0, 0, -1]).t.forEach((t) => near(t, 7));
    assert.ok(view.occluded(inWorld(0, 0, 9), [0, 0, -1]).yes(0) && view.occluded(inWorld(4, 0, 9), [0, 0, -1]).no(0));
    const nearest = view.closestPoint(inWorld(5, 0.5, 0.25));
    close(nearest.point, inWorld(6.001, 0.5, 0.25));
    close(nearest.onShape, inWorld(5, 0.5, 0.25));
    assert.deepStrictEqual([...nearest.instance], [1]);
    const hit = view.sweep({ kind: 'sphere', center: inWorld(4, 0, 0), radius: 0.5 }, [-10, 0, 0]);
    close(hit.point, inWorld(2, 0, 0));
    assert.ok(view.overlaps({ kind: 'box', min: inWorld(1.999, 0, 0), max: inWorld(2.5, 1, 1) }).yes(0));
    assert.ok(view.overlaps({ kind: 'box', min: inWorld(2.003, 0, 0), max: inWorld(2.5, 1, 1) }).no(0));
    assert.ok(world.closestPoint(WORLD).point instanceof Float32Array);
});

test('a view places instances and shares the scene with others', async () => {
    const world = await makeWorld(), view = world.seenFrom(WORLD), other = world.seenFrom(inWorld(5000, 0, 0));
    const handles = view.handles(), boxes = view.boxes(handles);
    close(view.instances().translation, inWorld(0, 0, 0, 8.001, 0, 0));
    assert.ok(boxes.min instanceof Float64Array && Math.abs(boxes.min[0] - WORLD[0] + 2) < 2 * NEAR);
    const first = { slot: handles.slot.slice(0, 1), generation: handles.generation.slice(0, 1) };
    assert.deepStrictEqual([...other.move(first, { translation: inWorld(4.5, 0, 0) })], [Status.OK]);
    for (const each of [view, other, world]) {
        assert.strictEqual(each.instanceCount, 2);
        assert.deepStrictEqual([...each.collidingPairs().items.a], [0]);
    }
    near(view.raycast(inWorld(4.5, 0, 9), [0, 0, -1]).t[0], 7);  // what another view has changed is seen
    const again = library.openMovingScene(other.snapshot(), [await bake([0, 0, 0])]).seenFrom(WORLD);
    assert.deepStrictEqual(again.instances(), view.instances());
    world.free();
    other.free();
    assert.throws(() => other.origin);
    assert.ok(view.occluded(inWorld(4.5, 0, 9), [0, 0, -1]).yes(0));
    const small = await library.bake({ ...cube([0, 0, 0]), positions: cube([0, 0, 0]).positions.map((x) => x / 2) }, { tolerance: 0.001 });
    view.setMesh(0, small);
    near(view.raycast(inWorld(4.5, 0, 9), [0, 0, -1]).t[0], 8);
    for (const place of [[2 ** 20, 0, 0], [NaN, 0, 0], [0, 0, -Infinity]]) assert.throws(() => view.seenFrom(place), /place must be finite/);
    assert.throws(() => view.seenFrom(3), TypeError);
    view.free();
});
