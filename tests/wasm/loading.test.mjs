// Where modules come from, and which one an engine takes.
import assert from 'node:assert';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import test from 'node:test';

import { espalier, folder } from './support/setup.mjs';

const { hasSimd, load } = espalier;
const modules = `${folder}/node_modules/espalier`;
const version = JSON.parse(await readFile(`${modules}/package.json`)).version;
const isLibrary = async (promise) => assert.strictEqual((await promise).version, version);

/// Returns whether a module has instructions of SIMD128: an engine without them refuses it.
const contains = (bytes, opcodes) => bytes.includes(Buffer.from(opcodes));

test('the package has both modules and this engine takes the one with SIMD128', async () => {
    const simd128 = await readFile(`${modules}/espalier.wasm`), scalar = await readFile(`${modules}/espalier_scalar.wasm`);
    // f32x4.mul: the opcode 0xE6 after the prefix
    assert.ok(contains(simd128, [0xFD, 0xE6, 0x01]));
    assert.ok(!contains(scalar, [0xFD, 0xE6, 0x01]));
    assert.strictEqual(hasSimd(), true);
    const { compile } = WebAssembly, sizes = [];
    WebAssembly.compile = (bytes) => { sizes.push(bytes.byteLength); return compile(bytes); };
    try {
        await load();
        await load(null, { simd: false });
    } finally {
        WebAssembly.compile = compile;
    }
    const ours = sizes.filter((size) => size > 500_000);  // Node compiles a small module of its own where Response is first used
    assert.deepStrictEqual(ours, [simd128.length, scalar.length]);
});

test('modules need nothing but the part of WASI that the package has', async () => {
    for (const name of ['espalier.wasm', 'espalier_scalar.wasm']) {
        const imports = WebAssembly.Module.imports(await WebAssembly.compile(await readFile(`${modules}/${name}`)));
        for (const { module } of imports) assert.strictEqual(module, 'wasi_snapshot_preview1');
    }
});

test('a module comes from bytes or a URL or a response or itself', async () => {
    const bytes = await readFile(`${modules}/espalier.wasm`);
    await isLibrary(load());
    await isLibrary(load(bytes));
    await isLibrary(load(Uint8Array.from(bytes).buffer));
    await isLibrary(load(WebAssembly.compile(bytes)));
    await isLibrary(load(new URL(`file://${modules}/espalier_scalar.wasm`)));
    await isLibrary(load('./espalier_scalar.wasm'));
    for (const type of ['application/wasm', 'application/octet-stream']) {
        const server = createServer((request, response) => {
            response.writeHead(request.url === '/espalier.wasm' ? 200 : 404, { 'content-type': type });
            response.end(bytes);
        });
        await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
        const url = `http://127.0.0.1:${server.address().port}/espalier.wasm`;
        await isLibrary(load(url));
        await isLibrary(load(fetch(url)));
        await assert.rejects(load(`${url}.gz`), /404/);
        server.close();
        server.closeAllConnections?.();
    }
});
