// Answers as words of 32 bits in the order in which C++ writes them (answers).

/// Fields in the order of their structure, and how many numbers each has.
const ORDER = {
    hit: { t: 1, u: 1, v: 1, normal: 3, triangle: 1, status: 1, side: 1 },
    nearest: { point: 3, onShape: 3, faceNormal: 3, distance: 1, u: 1, v: 1, triangle: 1, status: 1, feature: 1, side: 1 },
    sweep: { t: 1, point: 3, normal: 3, faceNormal: 3, triangle: 1, status: 1, feature: 1, startsOverlapping: 1 },
    original: { file: 1, mesh: 1, triangle: 1, u: 1, v: 1, status: 1 },
    winding: { value: 1, status: 1 },
    instance: { rotation: 4, translation: 3, scale: 1, mesh: 1, mask: 1, user: 1, source: 1 },
    plane: { normal: 3, distance: 1, triangle: 1 },
    contact: { point: 3, normal: 3, distance: 1, triangle: 1, feature: 1, side: 1 },
    pair: { a: 1, b: 1, status: 1 },
    touch: { points: 18, normal: 3, depth: 1, a: 1, b: 1, count: 1, status: 1 },
    distance: { distance: 1, onA: 3, onB: 3, a: 1, b: 1, status: 1 },
};

export const bits = (array) => array instanceof Float32Array ? new Uint32Array(array.buffer) : array;

// Results of a scene have the instance behind the other fields; its triangles have it in front.
const INSTANCE = { instance: 1, inTile: 1 };
for (const kind of ['hit', 'nearest', 'sweep']) ORDER[`scene_${kind}`] = { ...ORDER[kind], ...INSTANCE };
ORDER.scene_triangle = { ...INSTANCE, triangle: 1 };

/// Returns a function that adds the words of one element to a list.
function writer(kind, columns) {
    const fields = Object.entries(ORDER[kind]).map(([name, count]) => [bits(columns[name]), count]);
    return (words, element) => {
        for (const [array, count] of fields)
            for (let k = 0; k < count; ++k) words.push(array[count * element + k]);
    };
}

export function wordsOf(kind, columns) {
    const words = [], write = writer(kind, columns);
    for (let i = 0; i < (columns.status ?? columns.scale).length; ++i) write(words, i);
    return words;
}

/// Words of lists with how many elements each has, and why, in front; and with why each ends behind.
export const countedWords = (kind, lists) => wordsOfLists(kind, lists, { begin: (to, i) => to.push(lists.end(i) - lists.begin(i), lists.status[i]) });
export const endedWords = (kind, lists) => wordsOfLists(kind, lists, { end: (to, i) => to.push(lists.status[i]) });

/// Words of lists of columns: of each query begin(words, query), its elements, end(words, query).
export function wordsOfLists(kind, lists, { begin = () => {}, end = () => {} }) {
    const words = [], write = kind === 'triangle' ? (to, i) => to.push(lists.items[i]) : writer(kind, lists.items);
    for (let query = 0; query < lists.length; ++query) {
        begin(words, query);
        for (let i = lists.begin(query); i < lists.end(query); ++i) write(words, i);
        end(words, query);
    }
    return words;
}

/// The numbers that C++ has for the answers of a YesNo: there, NOT_FOUND is a no.
export const codesOf = (answers) => Array.from(answers.status, (status, i) => (answers.no(i) ? 1 : status));
