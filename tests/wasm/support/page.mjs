// What a browser computes for chromium.test.mjs.
import { load, hasSimd } from '/espalier/index.js';
import { answers, fingerprint } from './answers.mjs';
import { goldenLines } from './golden.mjs';
import { lumpyBody, questions } from './questions.mjs';

const compile = async (name) => WebAssembly.compile(await (await fetch(`/programs/${name}`)).arrayBuffer());

async function compute() {
    const result = { hasSimd: hasSimd(), fingerprints: {} };
    for (const simd of [true, false]) {
        const blob = await (await load(null, { simd })).bake(lumpyBody(), { originalIds: true });
        result.fingerprints[simd ? 'SIMD128' : 'scalar'] = fingerprint(answers(blob, questions()));
    }
    result.golden = await goldenLines(await compile('make_blobs'), await compile('query_answers'), 100);
    return result;
}

const report = (result) => fetch('/result', { method: 'POST', body: JSON.stringify(result) });
compute().then(report, (error) => report({ error: `${error}\n${error.stack}` }));
