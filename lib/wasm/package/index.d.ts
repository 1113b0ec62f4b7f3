// Types of espalier: baked collision meshes, queried straight from their bytes.

import type {
    ClosestPoints, Contacts, Corners, Lists, OriginalHits, OriginalTriangles, RayHits, Remap, SweepHits, WindingNumbers, YesNo,
} from './results.js';
import type { InstancesToBake, Scene } from './scene.js';

export * from './results.js';
export * from './scene.js';
/** Queries of two blobs. */
export * as pairs from './pairs.js';

export type NumberArray = Float32Array | Float64Array | Int8Array | Uint8Array | Uint8ClampedArray | Int16Array
    | Uint16Array | Int32Array | Uint32Array | readonly number[];

/** Elements that lie apart, as those of interleaved vertices. `stride` and `offset` are counted in numbers. */
export interface StridedArray {
    array: NumberArray;
    stride?: number;
    offset?: number;
}

/** Three numbers for each query, or three that serve all. Other numbers than float32 are rounded to the nearest. */
export type Vectors = NumberArray | StridedArray;
/** A number for each query, or one that serves all. */
export type Numbers = number | NumberArray | StridedArray;
/** Numbers of triangles, as results have them. Those that no blob can have become NO_TRIANGLE. */
export type Triangles = number | Uint32Array | Uint16Array | Int32Array | readonly number[];

/**
 * Places in the world, of one blob for each query: rotations as quaternions x, y, z, w of any length but zero, translations,
 * and scales above 0. What is not given is that of the origin.
 */
export interface Places {
    /** Four numbers for each place. */
    rotation?: Vectors;
    translation?: Vectors;
    scale?: Numbers;
}

/** Selects the triangles that a query ignores: those that show their back, or their front. */
export type Culling = 'none' | 'back' | 'front';

export interface RayOptions {
    /** 0 unless given. */
    tMin?: Numbers;
    /** Infinite unless given. */
    tMax?: Numbers;
    culling?: Culling;
}

export interface SweepOptions {
    culling?: Culling;
    /** Ignores triangles that a shape touches at the start and leaves. */
    ignoreLeaving?: boolean;
    /** How far the shape stops in front of the contact. */
    skin?: number;
}

export interface Segment { kind: 'segment'; from: Vectors; to: Vectors }
export interface Sphere { kind: 'sphere'; center: Vectors; radius: Numbers }
/** All points within a radius of a segment. */
export interface Capsule { kind: 'capsule'; from: Vectors; to: Vectors; radius: Numbers }
/** Empty where a coordinate of `min` is above that of `max`. */
export interface Box { kind: 'box'; min: Vectors; max: Vectors }
/** halfAxes has nine numbers for each box: each half axis leads from the center to the middle of a face. */
export interface OrientedBox { kind: 'orientedBox'; center: Vectors; halfAxes: Vectors }
/** The convex hull of a point and of a disc around apex + axis, perpendicular to the axis. */
export interface Cone { kind: 'cone'; apex: Vectors; axis: Vectors; radius: Numbers }
export interface Triangle { kind: 'triangle'; a: Vectors; b: Vectors; c: Vectors }
export type Volume = Sphere | Capsule | Box | OrientedBox | Cone | Triangle;

/** Facts about a blob. */
export interface BlobInfo {
    triangleCount: number;
    vertexCount: number;
    duplicateReferenceCount: number;
    size: number;
    checksum: number;
    depth: number;
    profile: Profile;
    isClosed: boolean;
    hasOriginalIds: boolean;
    hasMaterials: boolean;
    hasEdgeFlags: boolean;
    maxError: number;
    bounds: Float32Array;
    latticeOrigin: Float32Array;
    latticeStepExponent: number;
}

/**
 * A baked mesh in the memory of the module. It never changes. Coordinates are in the space and units of the mesh.
 *
 * The methods take arguments for any number of queries and return arrays with one element for each. Errors of single
 * queries never throw: each has a status.
 */
export class Blob {
    private constructor();
    /** The figures of the bake; null for a blob that was opened. */
    readonly report: BakeReport | null;
    /** The source of each triangle; null for a blob that was opened. */
    readonly remap: Remap | null;
    readonly triangleCount: number;
    readonly vertexCount: number;
    /** Whether contains() and signedDistance() answer. */
    readonly isClosed: boolean;
    readonly hasOriginalIds: boolean;
    readonly profile: Profile;
    /** The largest distance between the baked surface and its float32 source. */
    readonly maxError: number;
    /** The lower and the upper corner of a box around all triangles: six numbers. */
    readonly bounds: Float32Array;
    readonly isFreed: boolean;
    info(): BlobInfo;
    /** Returns a copy of the bytes, for a file. */
    bytes(): Uint8Array;
    /** Releases the memory. All later queries throw QueryError. Freeing again does nothing. */
    free(): void;

    /** Returns the closest hit of each ray: the points origin + t * direction with tMin <= t <= tMax. */
    raycast(origins: Vectors, directions: Vectors, options?: RayOptions): RayHits;
    /** Returns whether each ray hits any triangle, in less time than raycast(). */
    occluded(origins: Vectors, directions: Vectors, options?: RayOptions): YesNo;
    /** Returns the first hits of each ray, at most `most`, sorted by t. */
    closestHits(origins: Vectors, directions: Vectors, most: number, options?: RayOptions): Lists<RayHits>;
    /** Returns all hits of each ray, in ascending order of triangles. */
    allHits(origins: Vectors, directions: Vectors, options?: RayOptions): Lists<RayHits>;
    /** Returns each crossing of the surface once, also where a ray meets a shared edge or vertex. */
    crossings(origins: Vectors, directions: Vectors, options?: RayOptions): Lists<RayHits>;

    /** Returns the closest point of the surface to each point, segment or box. */
    closestPoint(points: Vectors | Segment | Box, maxDistance?: number): ClosestPoints;
    /** Returns the closest point with a negative distance inside of a closed surface. */
    signedDistance(points: Vectors, maxDistance?: number): ClosestPoints;
    /** Returns the triangles closest to each point, at most `most`, sorted by distance. */
    closestTriangles(points: Vectors, most: number, maxDistance?: number): Lists<ClosestPoints>;
    /** Returns whether each point is inside of the closed surface. A point on the surface is inside. */
    contains(points: Vectors): YesNo;
    /** Returns approximately how often the surface, open or closed, winds around each point. */
    windingNumber(points: Vectors, directions?: number): WindingNumbers;

    /** Returns whether any triangle touches each shape. */
    overlaps(shape: Volume): YesNo;
    /** Returns the triangles that touch each shape, ascending. */
    overlappingTriangles(shape: Volume): Lists<Uint32Array>;
    /**
     * Returns the contacts of each body with the triangles within a margin, 0 unless given, the deepest first. Of more than
     * `most` the deepest are kept, and the status is OUTPUT_FULL.
     */
    contacts(shape: Sphere | Capsule | OrientedBox, most: number, margin?: Numbers): Lists<Contacts>;
    /** Returns the first contact of each shape as it moves by a displacement. */
    sweep(shape: Sphere | Capsule | Box | OrientedBox, displacements: Vectors, options?: SweepOptions): SweepHits;

    /** Returns the baked corners of triangles. */
    corners(triangles: Triangles): Corners;
    /** Returns the materials of triangles; 0 where the blob stores none. */
    materials(triangles: Triangles): Uint16Array;
    /** Returns the sources of triangles. Without ids the status is NO_DATA. */
    originalTriangles(triangles: Triangles): OriginalTriangles;
    /** Returns the sources of hits that a query of rays of this blob returned. Without ids the status is NO_DATA. */
    originalHits(hits: RayHits): OriginalHits;
}

export type Profile = 'fast' | 'balanced' | 'small' | 'tiny';

/** A mesh to bake. float32 is baked as it is; other positions are rounded to it after `origin` was subtracted. */
export interface Mesh {
    positions: Vectors;
    /** Three numbers of positions for each triangle, counter-clockwise when seen from the front. */
    triangles: Uint32Array | Uint16Array | Int32Array | readonly number[];
    /** One for each triangle, 0 to 65535. */
    materials?: Uint32Array | Uint16Array | Uint8Array | readonly number[];
    /** For messages. */
    name?: string;
    /** For the sources of triangles; 0 unless given. */
    file?: number;
    /** For the sources of triangles; the position among the meshes unless given. */
    mesh?: number;
}

export interface BakeOptions {
    /** Of the largest extent, 1 to 24; 16 unless one of the next two is given. */
    bits?: number;
    /** The largest distance between source and baked surface, in the unit of the mesh. */
    tolerance?: number;
    /** Of the lattice's step, a power of two. */
    stepExponent?: number;
    /** 'balanced' unless given. */
    profile?: Profile;
    /** 'normal' unless given. */
    effort?: 'fast' | 'normal' | 'best';
    builder?: 'binned_sah' | 'sweep_sah' | 'spatial_splits' | 'agglomerative' | 'linear' | 'insertion';
    /** Stores the source of each triangle in the blob. */
    originalIds?: boolean;
    /** Drops triangles with NaN or wrong indices, which else refuse the bake. */
    dropBadTriangles?: boolean;
    /** In degrees; stores how the surface bends at edges. */
    flatAngle?: number | null;
    /** Stores tighter bounds of the asset. */
    bounds?: boolean;
    /** Three numbers, which are subtracted from all positions; queries then take coordinates relative to it. */
    origin?: NumberArray;
    duplicateBudget?: number;
    bytePrice?: number;
    maxLeafTriangles?: number;
}

/** Triangles that were dropped for one reason. */
export interface Finding {
    count: number;
    /** "level.obj, mesh 3 (walls), triangle 17"; empty if the count is 0. */
    first: string;
}

/** The figures of a bake. Lengths are in the blob's units. */
export interface BakeReport {
    sourceTriangles: number;
    sourceVertices: number;
    notFinite: Finding;
    indexOutOfRange: Finding;
    zeroArea: Finding;
    collapsed: Finding;
    duplicate: Finding;
    boundsMin: number[];
    boundsMax: number[];
    extent: number;
    boxVolume: number;
    orientedBoxVolume: number;
    sphereVolume: number;
    kDopVolume: number;
    step: number;
    maxError: number;
    conversionError: number;
    bits: number;
    triangles: number;
    duplicateReferences: number;
    vertices: number;
    nodes: number;
    leaves: number;
    depth: number;
    bitsThatKeepClosed: number;
    bytes: number;
    seconds: number;
    isClosed: boolean;
    warnings: string[];
}

/** The library, loaded. */
export interface Espalier {
    readonly version: string;
    /** Bakes a mesh, or several into one blob. The arrays must not change until the promise is settled. */
    bake(meshes: Mesh | readonly Mesh[], options?: BakeOptions): Promise<Blob>;
    /** Opens a baked mesh: copies the bytes into the module's memory and checks all of them. */
    openBlob(bytes: ArrayBuffer | ArrayBufferView): Blob;
    /**
     * Joins blobs, or their bytes, and instances of them in one scene. Scenes among the blobs become tiles. The arrays must
     * not change until the promise is settled.
     */
    bakeScene(blobs: readonly (Blob | Scene | ArrayBuffer | ArrayBufferView)[], instances?: InstancesToBake): Promise<Scene>;
    /** Opens a baked scene: copies the bytes into the module's memory and checks all of them. */
    openScene(bytes: ArrayBuffer | ArrayBufferView): Scene;
    /** Tests whether a blob is what its header states. Throws VerifyError with the first thing that is wrong. */
    verify(source: Blob | ArrayBuffer | ArrayBufferView): Promise<void>;
    /** Tests whether a scene is what its header states, as verify() does. */
    verifyScene(source: Scene | ArrayBuffer | ArrayBufferView): Promise<void>;
}

export type Source = string | URL | Response | ArrayBuffer | ArrayBufferView | WebAssembly.Module;

/**
 * Loads a module: by default the one beside this file that the engine takes, with SIMD128 or without. Any other is given
 * by its URL, its bytes or the Response to a request.
 */
export function load(source?: Source | Promise<Source> | null, options?: { simd?: boolean }): Promise<Espalier>;
/** Returns whether the engine has SIMD128. */
export function hasSimd(): boolean;

/** The error that all others of the package extend. `status` is the library's number. */
export class EspalierError extends Error {
    readonly status: number;
}
/** Bytes are no sound blob or scene. */
export class OpenError extends EspalierError {}
/** Nothing was baked. The text states what is wrong, where, and what to do. */
export class BakeError extends EspalierError {
    /** The first fault. Its triangle is null where it is one of the mesh. */
    readonly place: { file: number; mesh: number; triangle: number | null } | null;
}
/** A blob or a scene is not what its header states. */
export class VerifyError extends EspalierError {}
/** A batch was refused as a whole, such as one of a blob that was freed. */
export class QueryError extends EspalierError {}
/** The memory of the module cannot grow by what a call needs. */
export class MemoryError extends EspalierError {}
