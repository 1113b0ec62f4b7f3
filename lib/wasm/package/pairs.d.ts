// Queries of two blobs, each at one place in the world or at many. Results are in world space.
import type { Blob, Numbers, Places } from './index.js';
import type { Contacts, Lists, PlaceArray, YesNo } from './results.js';

/**
 * A blob at a place for each query, or at one that serves all. A place moves the coordinates of the blob's source. Where either
 * blob has an origin, both are moved near 0 together before places are rounded to float32.
 */
export interface PlacedBlob extends Places {
    blob: Blob;
}

/** A blob alone is where its source is. */
export type Placed = Blob | PlacedBlob;

export interface PairOptions {
    /**
     * The number of pairs of nodes or leaves that each query may visit; unlimited unless given. A query that reaches it has
     * the status WORK_LIMIT. Give one for meshes that you did not make yourself.
     */
    workLimit?: number;
}

/** Two triangles that touch, one of each blob. They count where the status is OK. */
export interface PairContacts {
    a: Uint32Array;
    b: Uint32Array;
    status: Uint8Array;
}

/**
 * Where two triangles touch, one of each blob. points has 18 numbers for each: up to six points, of which the first `count`
 * count; normal has three. b leaves the triangle of a when it moves by `depth` along `normal`: the shortest way out of these
 * two alone.
 */
export interface PairTouches {
    points: PlaceArray;
    normal: Float32Array;
    depth: Float32Array;
    a: Uint32Array;
    b: Uint32Array;
    count: Uint8Array;
    status: Uint8Array;
}

/**
 * The nearest points of two surfaces; onA and onB have three numbers each. The distance is 0 where the surfaces touch, and
 * infinite where nothing was found. After WORK_LIMIT it is an upper bound.
 */
export interface BlobDistances {
    distance: Float32Array;
    onA: PlaceArray;
    onB: PlaceArray;
    a: Uint32Array;
    b: Uint32Array;
    status: Uint8Array;
}

/** Returns whether a triangle of a touches one of b. A surface inside another one does not touch it. */
export function overlaps(a: Placed, b: Placed, options?: PairOptions): YesNo;
/** Returns whether the surfaces are within a distance of each other; equal counts. Takes less time than distance(). */
export function withinDistance(a: Placed, b: Placed, distance: Numbers, options?: PairOptions): YesNo;
/** Returns a pair of triangles that touch. */
export function firstContact(a: Placed, b: Placed, options?: PairOptions): PairContacts;
/** Returns the smallest distance of the surfaces within maxDistance, infinite unless given, and where it is. */
export function distance(a: Placed, b: Placed, options?: PairOptions & { maxDistance?: Numbers }): BlobDistances;
/** Returns all pairs of triangles that touch. */
export function contacts(a: Placed, b: Placed, options?: PairOptions): Lists<PairContacts>;
/** Returns where, how deep and in which direction each pair of triangles of contacts() touches. */
export function touches(a: Placed, b: Placed, options?: PairOptions): Lists<PairTouches>;
/** Returns the points of touches() as contacts of body b with the surface a, for reduceContacts(). */
export function touchContacts(touches: Lists<PairTouches>): Lists<Contacts>;
