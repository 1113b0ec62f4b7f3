// Moving scenes: changes, slots, pairs, snapshots, what they hold, and errors.
import assert from 'node:assert';
import test from 'node:test';

import { lumpyBody, questions } from './support/questions.mjs';
import { espalier, throws } from './support/setup.mjs';

const { load, NO_TRIANGLE, OpenError, QueryError, Status } = espalier;
const library = await load();
const body = await library.bake(lumpyBody());
const square = await library.bake({ positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], triangles: [0, 1, 2, 0, 2, 3] });
const upright = { rotation: [0, Math.SQRT1_2, 0, Math.SQRT1_2] };  // by 90 degrees around y
const down = { origins: [0.25, 0.5, 9], directions: [0, 0, -1] };
const rayAt = (x) => [[x + 0.25, 0.5, 9], down.directions];

/// A row of three squares, 5 apart, with a user's number each.
function row() {
    const scene = library.createMovingScene([square], 8);
    const handles = scene.insert({ translation: [0, 0, 0, 5, 0, 0, 10, 0, 0], mask: [1, 2, 4], user: [7, 8, 9] });
    return { scene, handles };
}
const one = (handles, i) => ({ slot: handles.slot[i], generation: handles.generation[i] });

test('instances come and move and go', () => {
    const { scene, handles } = row();
    assert.deepStrictEqual([[...handles.slot], [...handles.status]], [[0, 1, 2], [0, 0, 0]]);
    assert.deepStrictEqual([scene.instanceCount, scene.slotEnd, scene.capacity, scene.stepExponent], [3, 3, 8, -10]);
    assert.deepStrictEqual([...scene.raycast(...rayAt(5)).instance], [1]);
    assert.deepStrictEqual([...scene.move(one(handles, 1), { translation: [5, 0, 3] })], [Status.OK]);
    assert.deepStrictEqual([...scene.raycast(...rayAt(5)).t], [6]);
    assert.deepStrictEqual([...scene.move(handles, { translation: [0, 0, 1, 5, 0, 1, 10, 0, 1], scale: 0.5 })], [0, 0, 0]);
    assert.deepStrictEqual([...scene.instances().scale], [0.5, 0.5, 0.5]);
    assert.deepStrictEqual([...scene.raycast([0.25, 0.25, 9, 5.25, 0.25, 9, 10.25, 0.25, 9], down.directions).t], [8, 8, 8]);
    assert.deepStrictEqual([...scene.remove({ slot: [1, 1], generation: [handles.generation[1], handles.generation[1]] })], [Status.OK, Status.STALE_HANDLE]);
    assert.deepStrictEqual([...scene.raycast([5.25, 0.25, 9], down.directions).status], [Status.NOT_FOUND]);
    assert.deepStrictEqual([...scene.handles().status], [Status.OK, Status.NOT_FOUND, Status.OK]);
    const { mesh, source, user, mask } = scene.instances();
    assert.deepStrictEqual([[...mesh], [...source], [...user], [...mask]], [[0, NO_TRIANGLE, 0], [0, NO_TRIANGLE, 2], [7, 0, 9], [1, 0, 4]]);
    const again = scene.insert({});
    assert.strictEqual(again.slot[0], 1);
    assert.notStrictEqual(again.generation[0], handles.generation[1]);
    assert.deepStrictEqual([...scene.move(one(handles, 1), {})], [Status.STALE_HANDLE]);
});

test('instances that are moved by whole steps of the world are on its lattice', async () => {
    const tile = await library.bake({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: [0, 1, 2] }, { stepExponent: -10 });
    const scene = library.createMovingScene([tile], 3), handles = scene.insert({ translation: [0, 0, 0, 1, 0, 0, 1, 0, 2 ** -12] });
    const answers = scene.isOnCommonLattice(handles);
    assert.deepStrictEqual([0, 1, 2].map((i) => answers.yes(i)), [true, true, false]);
    scene.remove(one(handles, 0));
    assert.deepStrictEqual([...scene.isOnCommonLattice(handles).status], [Status.STALE_HANDLE, Status.OK, Status.OK]);
});

test('masks and users belong to instances', () => {
    const { scene, handles } = row();
    assert.deepStrictEqual([1, 2].map((mask) => scene.raycast(...rayAt(5), { mask }).t[0]), [Infinity, 9]);
    assert.deepStrictEqual([...scene.setMasks(one(handles, 1), 1)], [0]);
    assert.deepStrictEqual([1, 2].map((mask) => scene.raycast(...rayAt(5), { mask }).t[0]), [9, Infinity]);
    assert.deepStrictEqual([...scene.setUsers(handles, [1, 2, 0xFFFFFFFF])], [0, 0, 0]);
    assert.deepStrictEqual([...scene.instances().user], [1, 2, 0xFFFFFFFF]);
    assert.deepStrictEqual([...scene.setMasks({ slot: 7, generation: 1 }, 1)], [Status.STALE_HANDLE]);
});

test('a moving scene answers as a baked one of its instances', async () => {
    const asked = questions(300), { origins, directions } = asked, count = 40;
    const places = { translation: origins.subarray(120, 240), scale: 0.5 };
    const moving = library.createMovingScene([body], count);
    moving.insert({});
    moving.repack();
    const handles = moving.insert({ translation: new Float32Array(3 * (count - 1)) });
    moving.move({ slot: [0, ...handles.slot], generation: [moving.handles().generation[0], ...handles.generation] }, places);
    const baked = await library.bakeScene([body], places), { source } = baked.instances();
    const hits = moving.raycast(origins, directions), theirs = baked.raycast(origins, directions);
    assert.ok(hits.status.filter((status) => status === Status.OK).length > 100);
    for (const name of ['t', 'u', 'v', 'normal', 'triangle', 'status']) assert.deepStrictEqual(hits[name], theirs[name], name);
    assert.deepStrictEqual([...hits.instance], [...theirs.instance].map((i) => i === NO_TRIANGLE ? i : source[i]));
    const lists = moving.overlappingTriangles({ kind: 'sphere', center: origins, radius: 0.5 });
    for (let i = 0; i < lists.length; ++i)
        for (let k = lists.begin(i) + 1; k < lists.end(i); ++k) assert.ok(lists.items.instance[k - 1] <= lists.items.instance[k]);
    const expected = baked.overlappingTriangles({ kind: 'sphere', center: origins, radius: 0.5 });
    assert.deepStrictEqual(lists.offsets, expected.offsets);
    assert.ok(lists.items.triangle.length > 500);
});

test('pairs are those that touch, and of which one moved', async () => {
    const scene = library.createMovingScene([square], 8), ground = await library.bakeScene([square], { translation: [0, 0, 0, 5, 0, 0], scale: 2 });
    const handles = scene.insert({ translation: [0, 0, 0, 0.5, 0, 0, 5, 0, 0, 9, 0, 0] });
    const standing = scene.insert({ ...upright, translation: [0.25, 0, 0], user: 5 });
    const rows = ({ items }) => Array.from(Object.values(items)[0], (_, i) => Object.values(items).map((column) => column[i]));
    const all = scene.collidingPairs();
    assert.deepStrictEqual([all.status, rows(all)], [Status.OK, [[0, 1], [0, 4], [1, 4]]]);
    assert.deepStrictEqual(rows(scene.candidatePairs({ start: [0, 2] })), [[0, 4], [1, 4]]);
    scene.endStep();
    assert.deepStrictEqual(rows(scene.candidatePairs({ onlyMoved: true })), []);
    scene.move(one(standing, 0), { ...upright, translation: [9, 0, 0] });
    assert.deepStrictEqual(rows(scene.collidingPairs({ onlyMoved: true })), [[3, 4]]);
    const limited = scene.collidingPairs({ workLimit: 0 });
    assert.deepStrictEqual([limited.status, limited.next, limited.items.a.length], [Status.WORK_LIMIT, [0, 1], 0]);
    assert.deepStrictEqual(rows(scene.collidingPairs({ start: limited.next })), rows(scene.collidingPairs()));
    const touched = scene.collidingPairs({ baked: ground }), { source } = ground.instances();
    assert.deepStrictEqual(rows(touched).map(([moving, instance, inTile]) => [moving, source[instance], inTile]),
                           [[0, 0, NO_TRIANGLE], [1, 0, NO_TRIANGLE], [2, 1, NO_TRIANGLE]]);
    assert.deepStrictEqual(rows(scene.candidatePairs({ baked: ground, start: [2, 0, 0] })).map(([moving]) => moving), [2]);
    scene.setMasks(one(handles, 0), 0);
    assert.ok(rows(scene.candidatePairs()).every(([a]) => a !== 0));
});

test('more pairs than the first guess are complete', () => {
    const scene = library.createMovingScene([square], 100);
    scene.insert({ translation: new Float32Array(300) });
    assert.strictEqual(scene.candidatePairs().items.a.length, 4950);
});

test('a snapshot continues with its handles', () => {
    const { scene, handles } = row();
    const bytes = scene.snapshot();
    scene.remove(handles);
    const again = library.openMovingScene(bytes, [square]);
    assert.deepStrictEqual([scene.instanceCount, again.instanceCount], [0, 3]);
    assert.deepStrictEqual(again.snapshot(), bytes);
    assert.deepStrictEqual([...again.move(one(handles, 1), { translation: [5, 0, 4] })], [Status.OK]);
    assert.deepStrictEqual([...again.raycast(...rayAt(5)).t], [5]);
    const damaged = Uint8Array.from(bytes);
    damaged[0] ^= 0x40;
    for (const [snapshot, ...blobs] of [[bytes, body], [bytes], [bytes.subarray(0, 100), square], [new Uint8Array(0), square], [square, square], [damaged, square]])
        throws(() => library.openMovingScene(snapshot, blobs), OpenError, /./);
});

test('a mesh takes another blob', async () => {
    const scene = library.createMovingScene([square], 10);  // boxes in more than one node
    const handles = scene.insert({ translation: Array.from({ length: 30 }, (_, i) => i % 3 === 0 ? 5 * i / 3 : 0) });
    const half = await library.bake({ positions: [-1, -1, 0, 1, -1, 0, 1, 1, 0], triangles: [0, 1, 2] });
    const raised = await library.bake({ positions: [-1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1], triangles: [0, 1, 2, 0, 2, 3] });
    scene.repack();
    scene.move(one(handles, 0), { translation: [400, 0, 0] });
    const { quality } = scene;
    assert.ok(quality > 1);
    scene.setMesh(0, half);  // with the same lattice: the tree is refitted
    assert.deepStrictEqual([...scene.raycast(...rayAt(5)).status, ...scene.raycast([5.5, 0.25, 9], down.directions).status], [Status.NOT_FOUND, Status.OK]);
    assert.strictEqual(scene.quality, quality);
    scene.setMesh(0, raised);  // with another one: the scene is repacked
    assert.deepStrictEqual([...scene.raycast(...rayAt(5)).t], [8]);
    assert.strictEqual(scene.quality, 1);
    const far = await library.bake({ positions: [-1e7, 0, 0, 1e7, 0, 0, 0, 1e7, 0], triangles: [0, 1, 2] });
    assert.throws(() => scene.setMesh(0, far), (error) => error instanceof QueryError && error.status === Status.OUT_OF_RANGE && /keeps its blob/.test(error.message));
    assert.deepStrictEqual([...scene.raycast(...rayAt(5)).t], [8]);
    for (const mesh of [1, -1, 0.5, undefined]) assert.throws(() => scene.setMesh(mesh, raised), { name: 'RangeError', message: /no mesh/ });
    assert.throws(() => scene.setMesh(0, scene), { name: 'TypeError', message: /must be a blob/ });
    const empty = await library.bake([], { allowEmpty: true });
    assert.throws(() => scene.setMesh(0, empty), { name: 'RangeError', message: /no triangles/ });
    assert.deepStrictEqual([...scene.raycast(...rayAt(5)).t], [8]);
});

test('tiles are instances of scenes', async () => {
    const pair = await library.bakeScene([square], { translation: [0, 0, 0, 5, 0, 0] });
    const scene = library.createMovingScene([body], 4, { tiles: [pair], stepExponent: -12 });
    const { status } = scene.insert({ mesh: [1, 1, 2], translation: [0, 0, 0, 0, 0, 3, 0, 0, 0] });
    assert.deepStrictEqual([...status], [0, 0, Status.INVALID_ARGUMENT]);
    const { t, instance, inTile } = scene.raycast(...rayAt(5));
    assert.deepStrictEqual([t[0], instance[0], pair.instances().source[inTile[0]]], [6, 1, 1]);
});

test('a moving scene holds what it places', async () => {
    const copy = library.openBlob(square.bytes()), tile = await library.bakeScene([square]);
    const scene = library.createMovingScene([copy], 4, { tiles: [tile] });
    scene.insert({ mesh: [0, 1], translation: [0, 0, 0, 5, 0, 0] });
    copy.free();
    tile.free();
    // What takes the memory of freed blobs.
    const others = Array.from({ length: 20 }, () => library.openBlob(body.bytes()));
    assert.deepStrictEqual([...scene.raycast([0.25, 0.5, 9, 5.25, 0.5, 9], down.directions).t], [9, 9]);
    for (const each of [...others, scene, scene]) each.free();
    assert.strictEqual(scene.isFreed, true);
    for (const call of [() => scene.raycast(...rayAt(0)), () => scene.insert({}), () => scene.instanceCount, () => scene.snapshot(), () => scene.collidingPairs(),
        () => scene.setMesh(0, square)])
        assert.throws(call, (error) => error instanceof QueryError && error.status === Status.NOT_OPEN);
    assert.throws(() => library.createMovingScene([copy], 4), QueryError);
});

test('wrong arguments of moving scenes throw and name the argument', async () => {
    const { scene, handles } = row(), other = await load(), elsewhere = other.openBlob(square.bytes());
    for (const capacity of [0, 2 ** 24 + 1, 1.5, '8', undefined]) throws(() => library.createMovingScene([square], capacity), RangeError, /capacity must be/);
    for (const stepExponent of [-101, 81, 0.5, '0']) throws(() => library.createMovingScene([square], 4, { stepExponent }), RangeError, /stepExponent must be/);
    throws(() => library.createMovingScene(square, 4), TypeError, /blobs must be an array of blobs/);
    throws(() => library.createMovingScene([square.bytes()], 4), TypeError, /blobs must be an array/);
    throws(() => library.createMovingScene([], 4, { tiles: [square] }), TypeError, /tiles must be an array of scenes/);
    throws(() => library.createMovingScene([elsewhere], 4), TypeError, /one load/);
    throws(() => scene.insert({ mesh: -1 }), RangeError, /mesh/);
    throws(() => scene.insert({ translation: [0, 0] }), RangeError, /instances.translation/);
    throws(() => scene.move(handles), TypeError, /places must be/);
    throws(() => scene.move(handles, { translation: [0, 0, 0, 1, 1, 1] }), RangeError, /elements/);
    throws(() => scene.move(one(handles, 0), { translation: [0, 0, 0, 1, 1, 1] }), RangeError, /handles has 1 elements, but another argument has 2/);
    throws(() => scene.remove([0]), TypeError, /handles must be those that insert\(\) returned/);
    throws(() => scene.remove({ slot: 0.5, generation: 1 }), RangeError, /handles.slot/);
    throws(() => scene.setMasks(handles, -1), RangeError, /masks/);
    throws(() => scene.candidatePairs({ baked: scene }), TypeError, /baked must be/);
    throws(() => scene.candidatePairs({ start: [0] }), RangeError, /start must be 2 integers/);
    throws(() => scene.collidingPairs({ start: [0, -1] }), RangeError, /start must be 2 integers/);
    throws(() => scene.collidingPairs({ workLimit: 0.5 }), RangeError, /workLimit/);
    throws(() => scene.overlaps({ kind: 'convexVolume', planes: [0, 0, 1, 0] }), RangeError, /kind of a shape/);
    assert.deepStrictEqual([...scene.insert({ translation: [NaN, 0, 0, 1e9, 0, 0] }).status], [Status.INVALID_ARGUMENT, Status.OUT_OF_RANGE]);
    assert.deepStrictEqual([...scene.insert({ translation: new Float32Array(18) }).status], [0, 0, 0, 0, 0, Status.NO_ROOM]);
});
