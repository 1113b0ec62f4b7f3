// Types of espalier: baked collision meshes, queried straight from their bytes.

import type {
    AccuracyOptions, Body, Box, Capsule, ConvexVolume, FilterOptions, Moving, Numbers, OrientedBox, Ray, RayOptions, Segment, Sphere,
    SweepOptions, Triangle, Triangles, Vectors, Volume,
} from './arguments.js';
import type { BakeOptions, BakeReport, Mesh, Profile } from './bake.js';
import type {
    ClosestPoints, ContactPlanes, Contacts, Corners, DistanceBounds, EdgeKinds, Lengths, Lists, OriginalHits, OriginalTriangles, PlaceArray, RayHits,
    Remap, Slabs, SweepHits, Ways, WindingNumbers, YesNo,
} from './results.js';
import type { MovingScene, MovingSceneOptions } from './scenes/moving_scene.js';
import type { InstancesToBake, Scene, SceneBakeOptions } from './scenes/scene.js';

export * from './arguments.js';
export * from './bake.js';
export * from './results.js';
export * from './scenes/moving_scene.js';
export * from './scenes/scene.js';
/** Queries of two blobs. */
export * as pairs from './pairs.js';

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
    isDeformable: boolean;
    hasOriginalIds: boolean;
    hasMaterials: boolean;
    hasEdgeFlags: boolean;
    maxError: number;
    bounds: PlaceArray;
    origin: Float64Array;
    latticeOrigin: PlaceArray;
    latticeStepExponent: number;
}

/**
 * A baked mesh in the memory of the module. It never changes. Coordinates are in the space and units of the mesh, also where
 * the blob has an `origin`: then places in results are Float64Arrays, and those in arguments should not be float32.
 *
 * The methods take arguments for any number of queries and return arrays with one element for each. Errors of single
 * queries never throw: each has a status. Flags (`only`) are those of triangles, `triangleCount` of them.
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
    /** Whether refit() can move the vertices. */
    readonly isDeformable: boolean;
    readonly hasOriginalIds: boolean;
    readonly profile: Profile;
    /** The largest distance between the baked surface and its source. */
    readonly maxError: number;
    /**
     * What the bake subtracted from all positions: three numbers, 0 for most blobs. The blob stores it and counts places from
     * there in float32. All calls but those of moving scenes take and return places in the coordinates of the source.
     */
    readonly origin: Float64Array;
    /** The lower and the upper corner of a box around all triangles: six numbers. */
    readonly bounds: PlaceArray;
    readonly isFreed: boolean;
    info(): BlobInfo;
    /** Returns a copy of the bytes, for a file. */
    bytes(): Uint8Array;
    /** Releases the memory. All later queries throw QueryError. Freeing again does nothing. */
    free(): void;

    /** Returns the closest hit of each ray: the points origin + t * direction with tMin <= t <= tMax. */
    raycast(origins: Vectors, directions: Vectors, options?: RayOptions & FilterOptions): RayHits;
    /** Returns whether each ray hits any triangle, in less time than raycast(). */
    occluded(origins: Vectors, directions: Vectors, options?: RayOptions & FilterOptions & AccuracyOptions): YesNo;
    /** Returns the first hits of each ray, at most `most`, sorted by t. */
    closestHits(origins: Vectors, directions: Vectors, most: number, options?: RayOptions & FilterOptions): Lists<RayHits>;
    /** Returns all hits of each ray, in ascending order of triangles. */
    allHits(origins: Vectors, directions: Vectors, options?: RayOptions): Lists<RayHits>;
    /** Returns each crossing of the surface once, also where a ray meets a shared edge or vertex. */
    crossings(origins: Vectors, directions: Vectors, options?: RayOptions): Lists<RayHits>;

    /** Returns the closest point of the surface to each point, segment or box. */
    closestPoint(points: Vectors | Segment | Box, maxDistance?: number): ClosestPoints;
    /**
     * Returns a lower and an upper bound of the distance to each point, which differ by about the accuracy, a length: the
     * larger it is, the less work.
     */
    distanceBounds(points: Vectors, accuracy: number, maxDistance?: number): DistanceBounds;
    /**
     * Returns how far rounding moves each query at most. With displacements the shape is that of a sweep, whose whole way
     * counts. Lift a ray that leaves the surface by this: without, most such rays hit the wall that they start from.
     */
    roundingError(shape: Vectors | Ray | Segment | Sphere | Capsule | Box | OrientedBox | Triangle): Lengths;
    roundingError(shape: Moving, displacements: Vectors): Lengths;
    /** Returns the closest point with a negative distance inside of a closed surface. */
    signedDistance(points: Vectors, maxDistance?: number): ClosestPoints;
    /** Returns the triangles closest to each point, at most `most`, sorted by distance. */
    closestTriangles(points: Vectors, most: number, maxDistance?: number): Lists<ClosestPoints>;
    /** Returns whether each point is inside of the closed surface. A point on the surface is inside. */
    contains(points: Vectors): YesNo;
    /** Returns approximately how often the surface, open or closed, winds around each point. */
    windingNumber(points: Vectors, directions?: number): WindingNumbers;

    /** Returns whether any triangle touches each shape. */
    overlaps(shape: Volume | ConvexVolume): YesNo;
    /** With an accuracy a no is certain, and a yes may be off by about as much, for less work. */
    overlaps(shape: Sphere | Box, options: AccuracyOptions): YesNo;
    /** Returns the triangles that touch each shape, ascending. */
    overlappingTriangles(shape: Volume | ConvexVolume): Lists<Uint32Array>;
    /**
     * Returns the contacts of each body with the triangles within a margin, 0 unless given, the deepest first. Of more than
     * `most` the deepest are kept, and the status is OUTPUT_FULL.
     */
    contacts(shape: Body, most: number, margin?: Numbers): Lists<Contacts>;
    /**
     * Returns the planes that hold back each capsule which moves by at most a margin, the nearest first: one for an even
     * floor, whichever of its triangles are near. Of more than `most` the nearest are kept, and the status is OUTPUT_FULL.
     */
    planes(capsule: Capsule, most: number, margin: Numbers): Lists<ContactPlanes>;
    /** Returns the first contact of each shape as it moves by a displacement. */
    sweep(shape: Moving, displacements: Vectors, options?: SweepOptions & FilterOptions): SweepHits;

    /** Returns the kinds of the edges of triangles, between the corners of corners(). Without edge flags the status is NO_DATA. */
    edgeKinds(triangles: Triangles): EdgeKinds;
    /**
     * Returns the normals to use for contacts on features of triangles: on an edge that is flat, or a valley on the side of
     * the normal, that of the triangle. contacts() does this by itself.
     */
    fixInternalEdgeNormals(triangles: Triangles, features: Triangles | Uint8Array, normals: Vectors): Float32Array;
    /** Bounds that a bake with `bounds` stored, tighter than the box. Throws QueryError for a blob without. */
    boundingSphere(): Sphere;
    orientedBounds(): OrientedBox;
    kDopBounds(): Slabs;
    /**
     * Returns the blob with its vertices at other positions, without a bake: those of all baked meshes in a row. The quality
     * is the cost of the tree over that at rest: from 1.5 on, bake again. The origin is subtracted. Throws QueryError for a blob that was not baked
     * for it, as the command and other languages do, and for positions that it does not take.
     */
    refit(positions: Vectors): { blob: Blob; quality: number };

    /** Returns the corners of all triangles, nine numbers for each. */
    triangles(): PlaceArray;
    /** Returns the baked corners of triangles. */
    corners(triangles: Triangles): Corners;
    /** Returns the materials of triangles; 0 where the blob stores none. */
    materials(triangles: Triangles): Uint16Array;
    /** Returns the sources of triangles. Without ids the status is NO_DATA. */
    originalTriangles(triangles: Triangles): OriginalTriangles;
    /** Returns the sources of hits that a query of rays of this blob returned. Without ids the status is NO_DATA. */
    originalHits(hits: RayHits): OriginalHits;
}

/** The library, loaded. */
export interface Espalier {
    readonly version: string;
    /** Returns one English sentence of the status of a query. */
    describe(status: number): string;
    /** Returns of each list of contacts() the contacts, at most four, that support its body best, the deepest first. */
    reduceContacts<Items extends Contacts>(contacts: Lists<Items>): Lists<Items>;
    /**
     * Returns the way nearest to each wish that comes no nearer to the planes of a list of planes() than a skin. The status
     * is NOT_FOUND where there is none, as between a floor and a ceiling that are too near.
     */
    solvePlanes(planes: Lists<ContactPlanes>, wishes: Vectors, skins: Numbers): Ways;
    /** Bakes a mesh, or several into one blob. The arrays must not change until the promise is settled. */
    bake(meshes: Mesh | readonly Mesh[], options?: BakeOptions): Promise<Blob>;
    /** Opens a baked mesh: copies the bytes into the module's memory and checks all of them. */
    openBlob(bytes: ArrayBuffer | ArrayBufferView): Blob;
    /**
     * Returns the blobs with the kinds of edges that the surface has where it goes on in another of them: the pieces of
     * a ground, on which contacts then do not lean over the seams. They have edge flags of one flatAngle and one lattice step.
     * `translations` are whole steps by which each is moved from where its source is. Throws BakeError with the number of the blob that does not fit.
     */
    joinBorders(blobs: readonly (Blob | ArrayBuffer | ArrayBufferView)[], translations?: Vectors): Promise<Blob[]>;
    /**
     * Joins blobs, or their bytes, and instances of them in one scene. Scenes among the blobs become tiles. There are as
     * many instances as the longest array has elements; without arrays one, of blob 0. The arrays must not change until the
     * promise is settled.
     */
    bakeScene(blobs: readonly (Blob | Scene | ArrayBuffer | ArrayBufferView)[], instances?: InstancesToBake,
              options?: SceneBakeOptions): Promise<Scene>;
    /** Opens a baked scene: copies the bytes into the module's memory and checks all of them. */
    openScene(bytes: ArrayBuffer | ArrayBufferView): Scene;
    /**
     * Makes an empty scene whose instances come, move and go. Instances name the blobs by their numbers. `capacity` is the
     * largest number of instances at once, 1 to 2^24; it takes about 173 bytes for each. stepExponent is -10
     * unless given. Freeing a blob or a tile leaves the scene as it is. No ray passes between pieces of a ground whose lattice has the step of the world, 2^stepExponent, and that are
     * moved by whole steps of it.
     */
    createMovingScene(blobs: readonly Blob[], capacity: number, options?: MovingSceneOptions & { stepExponent?: number }): MovingScene;
    /**
     * Continues with a snapshot, whose handles stay valid. Takes the blobs and tiles of that scene, and throws OpenError for
     * those of other bounds or lattice steps, and for other bytes.
     */
    openMovingScene(snapshot: ArrayBuffer | ArrayBufferView, blobs: readonly Blob[], options?: MovingSceneOptions): MovingScene;
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
