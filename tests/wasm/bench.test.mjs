// The script that measures runs.
import assert from 'node:assert';
import { execFileSync } from 'node:child_process';
import { execPath } from 'node:process';
import test from 'node:test';
import { fileURLToPath } from 'node:url';

import { folder } from './support/setup.mjs';

test('compare.mjs measures both modules', () => {
    const script = fileURLToPath(new URL('../../bench/wasm/compare.mjs', import.meta.url));
    const output = execFileSync(execPath, [script, `${folder}/node_modules/espalier`, '--queries', '64', '--rounds', '1'], { encoding: 'utf8' });
    const rows = output.trim().split('\n').slice(2).map((line) => line.split('\t'));
    assert.deepStrictEqual(rows.map((row) => row[3]), ['closest ray, incoherent', 'closest ray, coherent', 'closest point']);
    for (const row of rows) assert.ok(Number(row[2]) > 1000 && Number(row[4]) > 10 && Number(row[5]) > 0 && Number(row[7]) > 0, row.join());
});
