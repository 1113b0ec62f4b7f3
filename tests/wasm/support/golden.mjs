// The answers that tests/platform/golden.txt records, by its programs: bakes the blobs and queries them.
import { run } from './memory_files.mjs';

/// Returns the lines about all blobs, scenes and poses.
export async function goldenLines(makeBlobs, queryAnswers, questionsOfAKind) {
    const files = new Map();
    const baked = await run(makeBlobs, ['make_blobs', '.'], files);
    if (baked.status !== 0) throw new Error(`make_blobs: ${baked.status}: ${baked.errors}`);
    const names = [...files.keys()].filter((name) => name.endsWith('.espl')).sort();
    const answered = await run(queryAnswers, ['query_answers', String(questionsOfAKind), ...names], files);
    if (answered.status !== 0) throw new Error(`query_answers: ${answered.status}: ${answered.errors}`);
    return answered.output.split('\n').filter((line) => line.startsWith('questions '));
}
