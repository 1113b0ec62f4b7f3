// Every query returns the bits that C++ returns for each element, with SIMD128 and without.
import assert from 'node:assert';
import { execFileSync } from 'node:child_process';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import test from 'node:test';

import { answers } from './support/answers.mjs';
import { lumpyBody, questions } from './support/questions.mjs';
import { answersOfCpp, folder, loadBoth } from './support/setup.mjs';

const mesh = lumpyBody(), asked = questions();
const files = `${folder}/answers`;
await mkdir(files, { recursive: true });
for (const [name, array] of Object.entries({ ...mesh, ...asked })) await writeFile(`${files}/${name}`, array);
execFileSync(answersOfCpp, [files]);

for (const [name, library] of Object.entries(await loadBoth())) {
    test(`a bake gives the bytes of C++, ${name}`, async () => {
        const blob = await library.bake(mesh, { originalIds: true, flatAngle: 5 });
        assert.deepStrictEqual(Buffer.from(blob.bytes()), await readFile(`${files}/blob`));
        blob.free();
    });

    test(`answers are those of C++, ${name}`, async () => {
        const blob = library.openBlob(await readFile(`${files}/blob`));
        for (const [query, words] of Object.entries(answers(blob, asked))) {
            const bytes = await readFile(`${files}/${query}`);
            const expected = new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
            assert.ok(expected.length >= 400, `C++ has answers of ${query}`);
            const differing = words.findIndex((word, i) => word !== expected[i]);
            assert.strictEqual(differing, -1, `${query} differs at word ${differing} of ${words.length}`);
            assert.strictEqual(words.length, expected.length, query);
        }
        blob.free();
    });
}
