// The numbers in results, and the results that are no plain arrays.

/// The number in `triangle`, `a`, `b`, `instance` and `inTile` where there is none.
export const NO_TRIANGLE = 0xFFFFFFFF;

/// The status of one query. Below 16 it was answered, at least in part; from 16 on it was refused.
export const Status = Object.freeze({
    OK: 0, NOT_FOUND: 1, STOPPED: 2, OUTPUT_FULL: 3, WORK_LIMIT: 4, NOT_OPEN: 16, INVALID_ARGUMENT: 17, OUT_OF_RANGE: 18,
    NOT_CLOSED: 19, NO_DATA: 20, NO_ROOM: 21, STALE_HANDLE: 22, NOT_REFITTED: 23,
});

/// A side of a triangle. Its corners run counter-clockwise when seen from the front.
export const Side = Object.freeze({ FRONT: 0, BACK: 1 });

/// The part of a triangle that a point lies on.
export const Feature = Object.freeze({ FACE: 0, EDGE_AB: 1, EDGE_BC: 2, EDGE_CA: 3, VERTEX_A: 4, VERTEX_B: 5, VERTEX_C: 6 });

/// The bend of the surface at an edge, seen from the front of its triangles.
export const EdgeKind = Object.freeze({ FLAT: 0, CONVEX: 1, CONCAVE: 2, BOUNDARY: 3 });

/// Answers that are yes, no, or neither: a refusal, or a work limit that was reached. Where a mistake is dangerous, test
/// no(i), not !yes(i).
export class YesNo {
    #codes;

    /// Takes the numbers of the library: there, NOT_FOUND is a no.
    constructor(codes) {
        this.#codes = codes;
        /// OK for a yes and for a no, else why it is neither.
        this.status = codes.map((code) => (code === Status.NOT_FOUND ? Status.OK : code));
    }
    get length() {
        return this.status.length;
    }
    yes(query) {
        return this.#codes[query] === Status.OK;
    }
    no(query) {
        return this.#codes[query] === Status.NOT_FOUND;
    }
    valueOr(query, otherwise) {
        return this.yes(query) || (!this.no(query) && otherwise);
    }
}

/// A list for each query, all in the same arrays: list i has the elements from offsets[i] to offsets[i + 1].
export class Lists {
    constructor(offsets, items, status) {
        this.offsets = offsets;
        this.items = items;
        this.status = status;
    }
    get length() {
        return this.status.length;
    }
    begin(query) {
        return this.offsets[query];
    }
    end(query) {
        return this.offsets[query + 1];
    }
}
