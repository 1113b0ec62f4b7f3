// What the package answers about two blobs, as words under the names of the files of C++.
import { codesOf, endedWords, wordsOf } from './words.mjs';

/// Returns the places of C++: one for each question.
export function placesOf({ origins, directions, limits, radii }) {
    const rotation = new Float32Array(4 * limits.length);
    for (let i = 0; i < limits.length; ++i) rotation.set([...directions.subarray(3 * i, 3 * i + 3), limits[i]], 4 * i);
    return { rotation, translation: origins, scale: radii };
}

export function pairAnswers(pairs, a, b, questions) {
    const first = { blob: a, rotation: [1, 2, 3, 4], translation: [0.25, 0, -0.5], scale: 1.25 };
    const second = { blob: b, ...placesOf(questions) }, few = { workLimit: 40 };
    const all = pairs.overlaps(first, second), some = pairs.overlaps(first, second, few);
    return {
        pair_overlaps: codesOf(all).flatMap((code, i) => [code, codesOf(some)[i]]),
        pair_within: codesOf(pairs.withinDistance(first, second, questions.limits)),
        pair_first_contact: wordsOf('pair', pairs.firstContact(first, second)),
        pair_distance: wordsOf('distance', pairs.distance(first, second, { maxDistance: 1.5 })),
        pair_contacts: endedWords('pair', pairs.contacts(first, second)),
        pair_contacts_limited: endedWords('pair', pairs.contacts(first, second, few)),
        pair_touches: endedWords('touch', pairs.touches(first, second)),
    };
}
