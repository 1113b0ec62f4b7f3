// Every query returns the bits that C++ returns for each element, with SIMD128 and without.
import assert from 'node:assert';
import { execFileSync } from 'node:child_process';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import test from 'node:test';

import { answers, filteredAnswers } from './support/answers.mjs';
import { movingAnswers, movingScene } from './support/moving.mjs';
import { pairAnswers } from './support/pairs.mjs';
import { lumpyBody, questions } from './support/questions.mjs';
import { instancesOf, sceneAnswers } from './support/scene.mjs';
import { answersOfCpp, espalier, folder, loadBoth } from './support/setup.mjs';

const { Status } = espalier;
const mesh = lumpyBody(), asked = questions();
const files = `${folder}/answers`;
await mkdir(files, { recursive: true });
for (const [name, array] of Object.entries({ ...mesh, ...asked })) await writeFile(`${files}/${name}`, array);
execFileSync(answersOfCpp, [files]);

/// Compares the words of each query with those that C++ wrote: at least so many.
async function areThoseOfCpp(answered, least = 400) {
    for (const [query, words] of Object.entries(answered)) {
        const bytes = await readFile(`${files}/${query}`);
        const expected = new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
        assert.ok(expected.length >= least, `C++ has answers of ${query}`);
        const differing = words.findIndex((word, i) => word !== expected[i]);
        assert.strictEqual(differing, -1, `${query} differs at word ${differing} of ${words.length}`);
        assert.strictEqual(words.length, expected.length, query);
    }
}

for (const [name, library] of Object.entries(await loadBoth())) {
    test(`a bake gives the bytes of C++, ${name}`, async () => {
        const blob = await library.bake(mesh, { originalIds: true, flatAngle: 5 });
        assert.deepStrictEqual(Buffer.from(blob.bytes()), await readFile(`${files}/blob`));
        blob.free();
    });

    test(`answers are those of C++, ${name}`, async () => {
        const blob = library.openBlob(await readFile(`${files}/blob`));
        await areThoseOfCpp(answers(blob, asked));
        await areThoseOfCpp(filteredAnswers(blob, asked));
        blob.free();
    });

    test(`answers about two blobs are those of C++, ${name}`, async () => {
        const a = library.openBlob(await readFile(`${files}/blob`)), b = library.openBlob(await readFile(`${files}/coarse_blob`));
        const answered = pairAnswers(espalier.pairs, a, b, asked);
        const statuses = [...new Set(answered.pair_overlaps)].sort((x, y) => x - y);
        assert.deepStrictEqual(statuses, [0, 1, 4, 17, 18], 'questions of each kind');
        await areThoseOfCpp(answered);
        a.free();
        b.free();
    });

    test(`a scene has the bytes and gives the answers of C++, ${name}`, async () => {
        const blobs = [library.openBlob(await readFile(`${files}/blob`)), await readFile(`${files}/coarse_blob`)];
        const scene = await library.bakeScene(blobs, instancesOf(asked));
        assert.deepStrictEqual(Buffer.from(scene.bytes()), await readFile(`${files}/scene`));
        await areThoseOfCpp(sceneAnswers(scene, asked));
        blobs[0].free();
        scene.free();
    });

    test(`a moving scene has the bytes and gives the answers of C++, ${name}`, async () => {
        const [blob, coarse] = await Promise.all(['blob', 'coarse_blob'].map(async (file) => library.openBlob(await readFile(`${files}/${file}`))));
        const baked = library.openScene(await readFile(`${files}/scene`));
        const { scene, moving_changes, statuses: ofChanges } = movingScene(library, blob, coarse, baked, asked);
        assert.deepStrictEqual([...new Set(ofChanges)].sort((x, y) => x - y), [0, 17, 18, 21, 22], 'changes of each kind');
        await areThoseOfCpp({ moving_changes });
        const snapshot = await readFile(`${files}/moving_scene`);
        assert.deepStrictEqual(Buffer.from(scene.snapshot()), snapshot);
        for (const each of [scene, library.openMovingScene(snapshot, [blob, blob], { tiles: [baked] })]) {
            const { queries, pairs, statuses } = movingAnswers(each, baked, asked);
            await areThoseOfCpp(queries);
            await areThoseOfCpp(pairs, 5);
            assert.ok(pairs.moving_collisions.length > 20 && pairs.moving_collisions_with_baked.length > 20, 'pairs that touch');
            assert.deepStrictEqual([...new Set(Object.values(statuses))].sort(), [Status.OK, Status.WORK_LIMIT]);
            each.free();
        }
        for (const each of [blob, coarse, baked]) each.free();
    });
}
