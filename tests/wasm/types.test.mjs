// The types describe the package: a program that uses all of it passes the TypeScript compiler, mistakes do not.
import assert from 'node:assert';
import { spawnSync } from 'node:child_process';
import { copyFile, readFile, writeFile } from 'node:fs/promises';
import test from 'node:test';

import { espalier, folder } from './support/setup.mjs';

const OPTIONS = ['--noEmit', '--strict', '--target', 'es2022', '--module', 'node16', '--moduleResolution', 'node16', '--lib',
    'es2022,dom'];
const isInstalled = spawnSync('tsc', ['--version']).status === 0;
const skip = isInstalled ? false : 'tsc is not installed (node-typescript; tools/dev wasm installs it)';
const compile = (file) => spawnSync('tsc', [...OPTIONS, file], { cwd: folder, encoding: 'utf8' });

test('a program that uses the types compiles', { skip }, async () => {
    await copyFile(new URL('support/uses_types.mts', import.meta.url), `${folder}/uses_types.mts`);
    const { status, stdout } = compile('uses_types.mts');
    assert.strictEqual(status, 0, stdout);
});

test('mistakes do not compile', { skip }, async () => {
    const mistakes = [
        'blob.raycast(origins, "down");', 'blob.raycast(origins, origins, { culling: "both" });',
        'blob.overlaps({ kind: "sphere", center: origins });', 'blob.sweep({ kind: "cone", apex: origins, axis: origins, radius: 1 }, origins);',
        'const hit: boolean = blob.occluded(origins, origins);', 'new Blob();', 'library.bake({ positions: origins });',
        'library.bake(mesh, { profile: "huge" });', 'library.bake(mesh, { origin: "middle" });', 'const point: Float32Array = blob.closestPoint(origins).point;', 'const t: Uint32Array = blob.raycast(origins, origins).t;',
        'blob.contacts({ kind: "box", min: origins, max: origins }, 4);', 'blob.contacts({ kind: "sphere", center: origins, radius: 1 });',
        'library.bakeScene(blob);', 'library.bakeScene([blob], { place: origins });', 'scene.raycast(origins, origins, { mask: [1] });',
        'blob.raycast(origins, origins, { only: [0, 1] });', 'blob.allHits(origins, origins, { only: [true] });', 'blob.overlaps(hull);',
        'blob.sweep({ kind: "convexHull", vertices: origins, offsets: 4 }, origins);', 'blob.sweep({ kind: "convexVolume", planes: origins }, origins);',
        'scene.overlaps({ kind: "convexVolume", planes: origins });', 'scene.closestPoint(origins, 1, { only: [true] });',
        'library.createMovingScene([blob]);', 'library.createMovingScene([scene], 4);', 'new MovingScene();', 'moving.move(moving.handles());',
        'moving.remove([0]);', 'moving.setMesh(0, scene);', 'const a: Uint32Array = moving.candidatePairs({ baked: scene }).items.a;',
        'moving.candidatePairs({ workLimit: 5 });', 'moving.bytes();', 'library.openMovingScene(moving, [blob]);',
        'pairs.overlaps(blob);', 'pairs.distance(blob, { translation: origins });', 'pairs.contacts(blob, blob, { workLimit: 5n });',
    ];
    const start = 'import { load, Blob, MovingScene, pairs, type ConvexHull } from "espalier";\nconst library = await load();\nconst origins = new Float32Array(3);\n' +
        'const mesh = { positions: origins, triangles: [0, 1, 2] };\nconst blob = await library.bake(mesh);\nconst scene = await library.bakeScene([blob]);\n' +
        'const moving = library.createMovingScene([blob], 4), hull: ConvexHull = { kind: "convexHull", vertices: origins };\n';
    await writeFile(`${folder}/mistakes.mts`, start + mistakes.join('\n'));
    const { stdout } = compile('mistakes.mts');
    const lines = new Set([...stdout.matchAll(/^mistakes\.mts\((\d+),/gm)].map(([, line]) => Number(line)));
    const first = start.split('\n').length;
    assert.deepStrictEqual([...lines].sort((a, b) => a - b), mistakes.map((_, i) => first + i), stdout);
});

test('every name of the package has a type and every type a value', async () => {
    const typesOf = (file) => readFile(`${folder}/node_modules/espalier/${file}.d.ts`, 'utf8');
    const declaredIn = (text) => [...text.matchAll(/^export (?:class|const|function|\* as) (\w+)/gm)].map(([, name]) => name).sort();
    const types = (await Promise.all(['index', 'arguments', 'bake', 'results', 'scenes/scene', 'scenes/moving_scene'].map(typesOf))).join('');
    assert.deepStrictEqual(declaredIn(types), Object.keys(espalier).sort());
    const typesOfPairs = await typesOf('pairs');
    assert.deepStrictEqual(declaredIn(typesOfPairs), Object.keys(espalier.pairs).sort());
    const library = await espalier.load();
    const blob = await library.bake({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: [0, 1, 2] });
    const scene = await library.bakeScene([blob]), moving = library.createMovingScene([blob, blob], 4);
    moving.insert({ mesh: [0, 1] });
    const membersOf = (name, text = types) => [...text.match(new RegExp(`export (?:class|interface) ${name}[ <][^]*?\n}`))[0]
        .matchAll(/^    (?:readonly )?(\w+)[(?:]/gm)].map(([, member]) => member);
    for (const [name, value] of Object.entries({ Blob: blob, Scene: scene, MovingScene: moving, SceneQueries: moving, Espalier: library, BakeReport: blob.report, BlobInfo: blob.info() }))
        for (const member of membersOf(name)) assert.ok(member in value, `${name} has no ${member}`);
    assert.deepStrictEqual(membersOf('BakeReport').sort(), Object.keys(blob.report).sort());
    assert.deepStrictEqual(membersOf('BlobInfo').sort(), Object.keys(blob.info()).sort());
    assert.deepStrictEqual(membersOf('RayHits').sort(), Object.keys(blob.raycast([0, 0, 1], [0, 0, -1])).sort());
    assert.deepStrictEqual(membersOf('ClosestPoints').sort(), Object.keys(blob.closestPoint([0, 0, 1])).sort());
    const contactsOfBall = blob.contacts({ kind: 'sphere', center: [0, 0, 1], radius: 1 }, 4);
    assert.deepStrictEqual(membersOf('Contacts').sort(), Object.keys(contactsOfBall.items).sort());
    assert.deepStrictEqual(membersOf('Instances').sort(), Object.keys(scene.instances()).sort());
    const { instance, inTile, ...hits } = scene.raycast([0, 0, 1], [0, 0, -1]);
    assert.deepStrictEqual([Object.keys(hits).sort(), instance.length, inTile.length], [membersOf('RayHits').sort(), 1, 1]);
    const columns = {
        Instances: moving.instances(), FoundHandles: moving.handles(), InstancePairs: moving.candidatePairs().items,
        BakedPairs: moving.candidatePairs({ baked: scene }).items, CollectedPairs: moving.collidingPairs(),
    };
    for (const [name, all] of Object.entries(columns)) assert.deepStrictEqual(membersOf(name).sort(), Object.keys(all).sort(), name);
    const { contacts, distance, touches } = espalier.pairs;
    const results = { PairContacts: contacts(blob, blob).items, PairTouches: touches(blob, blob).items, BlobDistances: distance(blob, blob) };
    for (const [name, columns] of Object.entries(results))
        assert.deepStrictEqual(membersOf(name, typesOfPairs).sort(), Object.keys(columns).sort());
});
