// Types of moving scenes: instances that come, move and go, and pairs of them.
import type { Places, Vectors } from '../arguments.js';
import type { Blob } from '../index.js';
import type { PairOptions } from '../pairs.js';
import type { PlaceArray, YesNo } from '../results.js';
import type { Instances, InstancesToBake, Integers, Scene, SceneQueries } from './scene.js';

export interface MovingSceneOptions {
    /** Scenes without tiles, numbered after the blobs. */
    tiles?: readonly Scene[];
}

/** Names of instances, from their insertion to their removal. */
export interface Handles {
    slot: Integers;
    generation: Integers;
}

/** The names of some instances; each counts where its status is OK. */
export interface FoundHandles {
    slot: Uint32Array;
    generation: Uint32Array;
    status: Uint8Array;
}

/** Boxes in the tree, rounded outward. */
export interface InstanceBoxes {
    min: PlaceArray;
    max: PlaceArray;
    status: Uint8Array;
}

/** Pairs of slots: a < b. */
export interface InstancePairs {
    a: Uint32Array;
    b: Uint32Array;
}

/** A slot of a moving scene and an instance of a baked one. */
export interface BakedPairs {
    moving: Uint32Array;
    instance: Uint32Array;
    inTile: Uint32Array;
}

/** Pairs in ascending order, and whether they are all. */
export interface CollectedPairs<Items> {
    items: Items;
    /**
     * OK: all. WORK_LIMIT: pairs are missing, from `next` on; if that is `start`, the limit is too small for one pair.
     * OUT_OF_RANGE: `next` was refused, and what is behind it is missing.
     */
    status: number;
    /** A pair to begin at, as `start` of the next call: its numbers in the order of the items' arrays. */
    next: number[];
}

export interface SelectedPairs {
    /** Only pairs of which an instance was moved or inserted since endStep(). */
    onlyMoved?: boolean;
    /** The pair to begin at; the first one unless given. */
    start?: readonly number[] | null;
    /** A scene that stays, in the same world: the pairs are then those of an instance of each. */
    baked?: Scene | null;
}

/** Those of which triangles touch. The limit is that of all pairs together. */
export interface SelectedCollisions extends SelectedPairs, PairOptions {}

export interface MovingScene extends SceneQueries {}
/**
 * Instances of blobs that are inserted, moved and removed. Shapes and results are in world space.
 *
 * Results name an instance by its slot, and lists are in ascending order of slots. Flags (`only`) are those of slots,
 * `slotEnd` of them. Of a batch of changes each instance has a status: a refused one changes nothing, and the others go on.
 */
export class MovingScene {
    private constructor();
    readonly instanceCount: number;
    /** The number of instances that there is room for. */
    readonly capacity: number;
    /** A number above each slot that was ever used: the length of instances(), of handles() and of flags. */
    readonly slotEnd: number;
    /** A step of the world is 2^stepExponent long. */
    readonly stepExponent: number;
    /** The place in the world from which float32 counts in this view: three numbers. 0 unless seenFrom() made it. */
    readonly origin: Float64Array;
    /**
     * How much more surface the boxes of the tree have than after the last repack(); from 1.3 on, repack(). Infinite before
     * the first one; 1 without instances. O(n).
     */
    readonly quality: number;
    readonly isFreed: boolean;
    /** Releases the memory. All later calls throw QueryError. Freeing again does nothing. */
    free(): void;
    /**
     * Returns the same scene as float32 resolves it near a place of three numbers: a view, to be freed by itself. Places that
     * it is given are rounded once to float32, from its `origin`: the multiple of 128 steps nearest to `place`. Those in
     * results are Float64Arrays. An instance keeps the place that it was given through a view; others, from elsewhere, round
     * it once more, by less than a ten-millionth of the distance. Handles and pairs do not depend on the view, and a change
     * through one changes all. Pairs with a baked scene take the view with its `origin` by themselves. Throws RangeError
     * for a place that is not in the world.
     */
    seenFrom(place: Vectors): MovingScene;
    /** Returns the handles of all slots. A free slot has the status NOT_FOUND. */
    handles(): FoundHandles;
    /** Returns the instances of all slots, whose `source` is the slot. A free one has NO_TRIANGLE for mesh and source. */
    instances(): Instances;

    /**
     * Inserts instances and returns their handles, which name them until they are removed. Refuses a number without a mesh or
     * a place that is not valid (INVALID_ARGUMENT), a place outside of the world (OUT_OF_RANGE), and what a full scene has no
     * room for (NO_ROOM).
     */
    insert(instances: InstancesToBake): FoundHandles;
    /** Removes instances and returns the status of each: OK or STALE_HANDLE. */
    remove(handles: Handles): Uint8Array;
    /**
     * Moves instances to other places, as insert() takes them, and returns the status of each. A refused one stays where it
     * is. Give all instances of a step in one call, which renews the tree once.
     */
    move(handles: Handles, places: Places): Uint8Array;
    /** Returns the boxes of instances in the tree. */
    boxes(handles: Handles): InstanceBoxes;
    /** Returns whether rays are rounded once for each instance and others, so that none passes between them. */
    isOnCommonLattice(handles: Handles): YesNo;
    /** Sets the masks of instances and returns the status of each. */
    setMasks(handles: Handles, masks: Integers): Uint8Array;
    /** Sets the program's numbers of instances and returns the status of each. */
    setUsers(handles: Handles, users: Integers): Uint8Array;
    /**
     * Gives all instances of a mesh another blob, such as another pose of it; they count as moved. O(n) for one with the same
     * lattice; another repacks the scene. Throws QueryError for one that leaves the world, and the mesh then keeps its blob.
     */
    setMesh(mesh: number, blob: Blob): void;
    /** Builds the tree anew, for faster queries. Call it every few steps, or when quality has risen. O(n). */
    repack(): void;
    /** Ends a step: no instance counts as moved until it is moved or inserted again. */
    endStep(): void;

    /** Returns the pairs of instances that may touch: those whose boxes do, and whose masks share a bit. */
    candidatePairs(options?: SelectedPairs & { baked?: null }): CollectedPairs<InstancePairs>;
    candidatePairs(options: SelectedPairs & { baked: Scene }): CollectedPairs<BakedPairs>;
    /** Returns the candidate pairs of which triangles touch. A surface inside another one does not touch it. */
    collidingPairs(options?: SelectedCollisions & { baked?: null }): CollectedPairs<InstancePairs>;
    collidingPairs(options: SelectedCollisions & { baked: Scene }): CollectedPairs<BakedPairs>;
    /** Returns the bytes of the scene without its blobs, with which openMovingScene() continues. */
    snapshot(): Uint8Array;
}
