// The package under test and the programs beside it, by the environment that run.sh sets.
import assert from 'node:assert';
import { pathToFileURL } from 'node:url';
import { env } from 'node:process';

/// The folder in which node_modules/espalier is the package.
export const folder = env.ESPALIER_WASM_FOLDER;
/// The program of the folder answers.
export const answersOfCpp = env.ESPALIER_WASM_ANSWERS;
/// The build folder of tests/platform for wasm32 with SIMD128, which has query_answers and make_blobs.
export const platform = env.ESPALIER_WASM_PLATFORM;

const index = pathToFileURL(`${folder}/node_modules/espalier/index.js`);
export const espalier = await import(index.href);

/// Both modules, by name.
export async function loadBoth() {
    return { SIMD128: await espalier.load(null, { simd: true }), scalar: await espalier.load(null, { simd: false }) };
}

/// Requires that a call throws, or a promise is rejected with, an error of a type with these words.
const isError = (type, text) => (error) => error instanceof type && text.test(error.message);
export const throws = (call, type, text) => assert.throws(call, isError(type, text));
export const rejects = (promise, type, text) => assert.rejects(promise, isError(type, text));
