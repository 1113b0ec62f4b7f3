// A headless Chromium loads the package, and gives the answers of Node and the golden hash.
import assert from 'node:assert';
import { spawn, spawnSync } from 'node:child_process';
import { mkdir, readFile, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';

import { answers, fingerprint } from './support/answers.mjs';
import { lumpyBody, questions } from './support/questions.mjs';
import { folder, loadBoth, platform } from './support/setup.mjs';

const golden = await readFile(new URL('../platform/golden.txt', import.meta.url), 'utf8');
const TYPES = { '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '': 'application/octet-stream' };
const FOLDERS = {
    espalier: `${folder}/node_modules/espalier`, support: fileURLToPath(new URL('support', import.meta.url)), programs: platform,
};
const browser = ['chromium', 'chromium-browser'].find((name) => spawnSync(name, ['--version']).status === 0);

/// Serves the page and its files; resolves `result` with what the page posts.
function serve(resolve) {
    return createServer(async (request, response) => {
        const [, name, file] = request.url.match(/^\/(\w+)\/((?:\w+\/)?[\w.]+)$/) ?? [];
        if (request.url === '/') {
            response.writeHead(200, { 'content-type': 'text/html' });
            response.end('<!doctype html><script type="module" src="/support/page.mjs"></script>');
        } else if (request.url === '/result') {
            let body = '';
            for await (const part of request) body += part;
            response.end();
            resolve(JSON.parse(body));
        } else if (FOLDERS[name]) {
            const bytes = await readFile(`${FOLDERS[name]}/${file}`).catch(() => null);
            response.writeHead(bytes ? 200 : 404, { 'content-type': TYPES[extname(file)] ?? 'text/plain' });
            response.end(bytes);
        } else {
            response.writeHead(404);
            response.end();
        }
    });
}

/// Opens the page in the browser and returns what it computes.
async function compute() {
    const profile = `${folder}/chromium`;
    await rm(profile, { recursive: true, force: true });
    await mkdir(profile);
    let server, child, timer;
    try {
        return await new Promise((resolve, reject) => {
            server = serve(resolve);
            timer = setTimeout(() => reject(new Error('the page posts nothing')), 600_000);
            server.listen(0, '127.0.0.1', () => {
                child = spawn(browser, ['--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
                    `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/`], { stdio: 'ignore', env: { ...process.env, HOME: profile } });
                child.on('error', reject);
                child.on('exit', (code) => reject(new Error(`${browser} ended with ${code}`)));
            });
        });
    } finally {
        clearTimeout(timer);
        child?.kill();
        server.close();
        server.closeAllConnections?.();
    }
}

test('Chromium gives the answers of Node and the golden hash', { skip: browser ? false : 'chromium is not installed (tools/dev wasm installs it)' }, async () => {
    const computed = await compute();
    assert.strictEqual(computed.error, undefined);
    assert.strictEqual(computed.hasSimd, true);
    for (const [name, library] of Object.entries(await loadBoth())) {
        const blob = await library.bake(lumpyBody(), { originalIds: true });
        assert.strictEqual(computed.fingerprints[name], fingerprint(answers(blob, questions())), name);
    }
    assert.ok(computed.golden.length >= 4, computed.golden.join('\n'));
    for (const line of computed.golden) assert.ok(golden.split('\n').includes(line), `golden.txt has other bits than: ${line}`);
});
