// Types of scenes: many instances of blobs, each with a place in the world.
import type { Body, Box, FilterOptions, Moving, Numbers, Places, RayOptions, SweepOptions, Vectors, Volume } from '../arguments.js';
import type { ClosestPoints, Contacts, Lists, PlaceArray, RayHits, SweepHits, YesNo } from '../results.js';

export interface MaskOptions {
    /** Instances whose mask shares no bit with it are passed over. All bits unless given. */
    mask?: number;
}

/** Flags (`only`) are those of instances; a tile is one. Passing over by mask takes less time. */
export interface SceneOptions extends MaskOptions, FilterOptions {}

/** The instance of each element, and that in the tile if it is one; else NO_TRIANGLE. */
export interface InstanceIds {
    instance: Uint32Array;
    inTile: Uint32Array;
}

export interface SceneRayHits extends RayHits, InstanceIds {}
export interface SceneClosestPoints extends ClosestPoints, InstanceIds {}
export interface SceneSweepHits extends SweepHits, InstanceIds {}
export interface SceneContacts extends Contacts, InstanceIds {}
/** Triangles of instances. */
export interface SceneTriangles extends InstanceIds {
    triangle: Uint32Array;
}

/** Instances near boxes. */
export interface SceneCandidates extends InstanceIds {}

/** An integer of 32 bits for each instance, or one that serves all. */
export type Integers = number | Uint32Array | Uint16Array | Uint8Array | readonly number[];

/**
 * Instances to bake, or to insert in a moving scene: at each of the places one of a blob. In a baked scene a place moves the
 * source of the blob, in a moving one what the blob counts from its `origin`: insert it there.
 */
export interface InstancesToBake extends Places {
    /** The number of its blob among those that the scene is made of; 0 unless given, but bakeScene() of several blobs needs it. */
    mesh?: Integers;
    /** A query skips this instance unless the masks share a bit. All bits unless given. */
    mask?: Integers;
    /** For the program; 0 unless given. */
    user?: Integers;
}

export interface SceneBakeOptions {
    /**
     * What is subtracted from all places, in double; null for 0 0 0. By default 'auto': chosen where float32 rounds places at
     * an instance by more than a quarter of its step, if it needs double or all lie far from 0. The scene keeps it as `origin`.
     */
    origin?: 'auto' | ArrayLike<number> | null;
}

export interface SceneReport {
    warnings: string[];
}

/** The instances of a scene: a transform places what a mesh or tile counts from its `origin`. rotation has four numbers for each, translation three. */
export interface Instances {
    rotation: Float32Array;
    translation: PlaceArray;
    scale: Float32Array;
    /** The number of its mesh in the scene; tiles are numbered after the meshes. */
    mesh: Uint32Array;
    mask: Uint32Array;
    user: Uint32Array;
    /** Its number among the instances that were baked. */
    source: Uint32Array;
}

/** The queries of baked and of moving scenes. Shapes and results are in world space. */
export interface SceneQueries {
    /** Returns the closest hit of each ray. */
    raycast(origins: Vectors, directions: Vectors, options?: RayOptions & SceneOptions): SceneRayHits;
    /** Returns whether each ray hits any triangle, in less time than raycast(). */
    occluded(origins: Vectors, directions: Vectors, options?: RayOptions & SceneOptions): YesNo;
    /** Returns all hits of each ray, in ascending order of instances, then of triangles. */
    allHits(origins: Vectors, directions: Vectors, options?: RayOptions & SceneOptions): Lists<SceneRayHits>;
    /** Returns the closest point of any surface to each point. */
    closestPoint(points: Vectors, maxDistance?: number, options?: MaskOptions): SceneClosestPoints;
    /**
     * Returns the instances whose boxes in the tree touch each box, for queries of your own, in ascending order. These boxes
     * are larger than their instances.
     */
    candidates(box: Box, options?: MaskOptions): Lists<SceneCandidates>;
    /** Returns whether any triangle touches each shape. */
    overlaps(shape: Volume, options?: SceneOptions): YesNo;
    /** Returns the triangles that touch each shape, in ascending order of instances. */
    overlappingTriangles(shape: Volume, options?: SceneOptions): Lists<SceneTriangles>;
    /**
     * Returns the contacts of each body with all instances within a margin in world units, 0 unless given, the deepest first:
     * those of Blob.contacts() with each instance by itself. Of more than `most` the deepest are kept, and the status is
     * OUTPUT_FULL.
     */
    contacts(shape: Body, most: number, margin?: Numbers, options?: SceneOptions): Lists<SceneContacts>;
    /** Returns the first contact of each shape as it moves by a displacement. The skin is in world units. */
    sweep(shape: Moving, displacements: Vectors, options?: SweepOptions & SceneOptions): SceneSweepHits;
}

export interface Scene extends SceneQueries {}
/**
 * A baked scene in the memory of the module. It never changes. Shapes and results are in world space.
 *
 * Arguments and results are those of Blob; results have the instance of each element too.
 */
export class Scene {
    private constructor();
    readonly instanceCount: number;
    /** The number of meshes, without those of tiles. */
    readonly meshCount: number;
    /** The largest distance between the surface of any instance and its source. */
    readonly maxError: number;
    /** The lower and the upper corner of a box around all instances: six numbers. */
    readonly bounds: PlaceArray;
    /** What the bake subtracted from all places: three numbers, 0 for most scenes. Places are those of the source. */
    readonly origin: Float64Array;
    /** What the bake accepted, but its caller may not expect; null for a scene that was opened. */
    readonly report: SceneReport | null;
    readonly isFreed: boolean;
    /** Returns a copy of the bytes, for a file. */
    bytes(): Uint8Array;
    /** Releases the memory. All later queries throw QueryError. Freeing again does nothing. */
    free(): void;
    instances(): Instances;
    /** Returns for each instance whether rays are rounded once for it and others, so that none passes between them. */
    isOnCommonLattice(): YesNo;
}
