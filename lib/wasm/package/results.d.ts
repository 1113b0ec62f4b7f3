// What queries return: an array for each field, with an element for each query.

/** The number in `triangle`, `a`, `b`, `instance` and `inTile` where there is none. */
export const NO_TRIANGLE: 0xFFFFFFFF;

/** The status of one query. Below 16 it was answered, at least in part; from 16 on it was refused. */
export const Status: {
    readonly OK: 0; readonly NOT_FOUND: 1; readonly STOPPED: 2; readonly OUTPUT_FULL: 3; readonly WORK_LIMIT: 4;
    readonly NOT_OPEN: 16; readonly INVALID_ARGUMENT: 17; readonly OUT_OF_RANGE: 18; readonly NOT_CLOSED: 19;
    readonly NO_DATA: 20; readonly NO_ROOM: 21; readonly STALE_HANDLE: 22; readonly NOT_REFITTED: 23;
};
/** A side of a triangle. Its corners run counter-clockwise when seen from the front. */
export const Side: { readonly FRONT: 0; readonly BACK: 1 };
/** The part of a triangle that a point lies on. */
export const Feature: {
    readonly FACE: 0; readonly EDGE_AB: 1; readonly EDGE_BC: 2; readonly EDGE_CA: 3;
    readonly VERTEX_A: 4; readonly VERTEX_B: 5; readonly VERTEX_C: 6;
};

/** The bend of the surface at an edge, seen from the front of its triangles. */
export const EdgeKind: { readonly FLAT: 0; readonly CONVEX: 1; readonly CONCAVE: 2; readonly BOUNDARY: 3 };

/** Places, three numbers each: a Float64Array where a blob has an origin, and else a Float32Array. */
export type PlaceArray = Float32Array | Float64Array;

/** One element for each ray; `normal` has three numbers. A miss has an infinite t and NO_TRIANGLE. */
export interface RayHits {
    t: Float32Array;
    u: Float32Array;
    v: Float32Array;
    normal: Float32Array;
    triangle: Uint32Array;
    status: Uint8Array;
    side: Uint8Array;
}

/** One element for each point or shape; point, onShape and faceNormal have three numbers each. */
export interface ClosestPoints {
    point: PlaceArray;
    onShape: PlaceArray;
    faceNormal: Float32Array;
    distance: Float32Array;
    u: Float32Array;
    v: Float32Array;
    triangle: Uint32Array;
    status: Uint8Array;
    feature: Uint8Array;
    side: Uint8Array;
}

/** One element for each sweep; point, normal and faceNormal have three numbers each. A miss has t 1, a refusal 0. */
export interface SweepHits {
    t: Float32Array;
    point: PlaceArray;
    normal: Float32Array;
    faceNormal: Float32Array;
    triangle: Uint32Array;
    status: Uint8Array;
    feature: Uint8Array;
    startsOverlapping: Uint8Array;
}

/** Where bodies are near a triangle or in it: then the distance is below 0. point and normal have three numbers each. */
export interface Contacts {
    /** On the triangle. */
    point: PlaceArray;
    /** Leads from the surface to the body, which leaves along it. */
    normal: Float32Array;
    distance: Float32Array;
    triangle: Uint32Array;
    feature: Uint8Array;
    side: Uint8Array;
}

/** Planes that hold capsules back. normal has three numbers each, from the surface to the capsule. */
export interface ContactPlanes {
    normal: Float32Array;
    distance: Float32Array;
    triangle: Uint32Array;
}

/** The ways that planes leave, of three numbers each. A way counts where the status is OK. */
export interface Ways {
    value: Float32Array;
    status: Uint8Array;
}

/** Lengths in the blob's units. A value counts where the status is OK. */
export interface Lengths {
    value: Float32Array;
    status: Uint8Array;
}

/** Bounds of distances. */
export interface DistanceBounds {
    lower: Float32Array;
    upper: Float32Array;
    status: Uint8Array;
}

/** The kinds of the edges of triangles, each a number of EdgeKind. */
export interface EdgeKinds {
    ab: Uint8Array;
    bc: Uint8Array;
    ca: Uint8Array;
    status: Uint8Array;
}

/** Slabs along 13 directions, of three numbers each: low <= dot(direction, corner) <= high for each corner. */
export interface Slabs {
    directions: Float32Array;
    low: PlaceArray;
    high: PlaceArray;
}

/** How often the surface winds around each point. A value counts where the status is OK. */
export interface WindingNumbers {
    value: Float32Array;
    status: Uint8Array;
}

/** Sources of triangles. They count where the status is OK. */
export interface OriginalTriangles {
    file: Uint32Array;
    mesh: Uint32Array;
    triangle: Uint32Array;
    firstCorner: Uint32Array;
    status: Uint8Array;
}

/** Sources of hits. u and v are the weights of the source's second and third corner. */
export interface OriginalHits {
    file: Uint32Array;
    mesh: Uint32Array;
    triangle: Uint32Array;
    u: Float32Array;
    v: Float32Array;
    status: Uint8Array;
}

/** The source of each triangle of a bake. */
export type Remap = Omit<OriginalTriangles, 'status'>;

/** Corners of triangles: nine numbers for each. */
export interface Corners {
    corners: PlaceArray;
    status: Uint8Array;
}

/**
 * Answers that are yes, no, or neither: a refusal, or a work limit that was reached. Where a mistake is dangerous, test no(i),
 * not !yes(i).
 */
export class YesNo {
    private constructor();
    /** OK for a yes and for a no, else why it is neither. */
    readonly status: Uint8Array;
    readonly length: number;
    yes(query: number): boolean;
    no(query: number): boolean;
    /** Returns whether the answer is yes, or `otherwise` where it is neither. */
    valueOr(query: number, otherwise: boolean): boolean;
}

/** A list for each query, all in the same arrays: list i has the elements from offsets[i] to offsets[i + 1]. */
export class Lists<Items> {
    private constructor();
    readonly offsets: Uint32Array;
    readonly items: Items;
    /** The status of each query. */
    readonly status: Uint8Array;
    /** The number of lists. */
    readonly length: number;
    begin(query: number): number;
    end(query: number): number;
}
