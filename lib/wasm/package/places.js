// Places in the world: rotations, translations and uniform scales, each for one query or for all.
import { fieldsOf } from './memory/batch.js';

const COMPONENTS = { rotation: 4, translation: 3, scale: 1 };
const ORIGIN = { rotation: [0, 0, 0, 1], translation: [0, 0, 0], scale: 1 };

/// Makes the arguments of places. What is not given is that of the origin.
export function fieldsOfPlaces(given, name) {
    const fields = {};
    for (const field of Object.keys(ORIGIN)) fields[field] = given[field] ?? ORIGIN[field];
    return fieldsOf(fields, COMPONENTS, name);
}
