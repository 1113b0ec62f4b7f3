// The code of docs/wasm.md runs, block after block.
import assert from 'node:assert';
import { readFile, writeFile } from 'node:fs/promises';
import test from 'node:test';
import { pathToFileURL } from 'node:url';

import { folder } from './support/setup.mjs';

test('the code of wasm.md runs', async () => {
    const document = await readFile(new URL('../../docs/wasm.md', import.meta.url), 'utf8');
    const blocks = [...document.matchAll(/^```js\n([^]*?)^```$/gm)].map(([, code]) => code);
    assert.ok(blocks.length >= 9);
    const questions = new URL('support/questions.mjs', import.meta.url), bytes = `${folder}/node_modules/espalier/espalier.wasm`;
    const start = `import { readFile } from 'node:fs/promises';
import { lumpyBody, questions } from '${questions}';
const { positions, triangles } = lumpyBody(), asked = questions();
const origins = asked.origins.subarray(0, 60), directions = asked.directions.subarray(0, 60);
const bodies = Uint32Array.from({ length: 20 }, (_, i) => 100 + i), placesAt = (step) => new Float32Array(60).fill(step / 16);
const interleaved = new Float32Array(80), compiledModule = await WebAssembly.compile(await readFile('${bytes}'));
const printed = [], console = { log: (...values) => printed.push(values) };
`;
    const names = 'apart, blob, collides, continued, down, hits, inMoving, nearest, onGround, printed, scene, seen, solid, swept, tetrahedron, touches';
    await writeFile(`${folder}/documented.mjs`, `${start}${blocks.join('\n')}\nexport { ${names} };\n`);
    const {
        apart, blob, collides, continued, down, hits, inMoving, nearest, onGround, printed, scene, seen, solid, swept, tetrahedron, touches,
    } = await import(pathToFileURL(`${folder}/documented.mjs`));
    assert.ok(hits.status.includes(0) && down.t.length === 20 && nearest.distance.length === 10 && touches.length === 20);
    assert.deepStrictEqual([...swept.status], [0]);
    assert.ok(collides.length === 20 && apart.status.includes(0) && scene.instanceCount === 3 && seen.instance.includes(0));
    assert.deepStrictEqual([solid.status.includes(0), tetrahedron.status[0]], [true, 0]);
    assert.ok(continued.instanceCount > 10 && inMoving.status.includes(0) && onGround.items.moving.length > 10);
    assert.ok(printed.some(([a, b]) => a >= 100 && a < b && b < 120), 'bodies that touch');
    assert.ok(blob.maxError <= 0.0005);
    const [message, triangle] = printed.at(-2);
    assert.match(message, /triangle 0/);
    assert.strictEqual(triangle, 0);
    assert.deepStrictEqual(printed.at(-1), [true, true]);
});
