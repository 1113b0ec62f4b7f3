// Baking: meshes, options and reports.
import type { NumberArray, Vectors } from './arguments.js';

export type Profile = 'fast' | 'balanced' | 'small' | 'tiny';

/** A mesh to bake. Positions are rounded once, to the blob's lattice; those that are not float32 are taken as float64. */
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
    /** The share of triangles, in percent, that may be lost before the bake is refused: broken, without area, or flattened by the lattice. 10 unless given. */
    maxDropped?: number;
    /** Accepts that no triangle is left, which else refuses the bake. */
    allowEmpty?: boolean;
    /** Refuses the bake for what else is a warning. */
    strict?: boolean;
    /** In degrees; stores how the surface bends at edges. */
    flatAngle?: number | null;
    /** Stores tighter bounds of the asset. */
    bounds?: boolean;
    /**
     * Three numbers, which are subtracted from all positions in double and stored in the blob. Its queries take and return
     * places in the coordinates of the source all the same. 'auto' unless given: one near the middle where float32 rounds
     * places at the mesh by more than a quarter of the lattice's step, as on a map far from 0, and else none. null: none.
     */
    origin?: 'auto' | NumberArray | null;
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
    /** What was subtracted from all positions. */
    origin: number[];
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
