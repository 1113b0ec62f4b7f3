// What queries take: arrays, places, shapes, flags and options.

export type NumberArray = Float32Array | Float64Array | Int8Array | Uint8Array | Uint8ClampedArray | Int16Array
    | Uint16Array | Int32Array | Uint32Array | readonly number[];

/** Elements that lie apart, as those of interleaved vertices. `stride` and `offset` are counted in numbers. */
export interface StridedArray {
    array: NumberArray;
    stride?: number;
    offset?: number;
}

/**
 * Three numbers for each query, or three that serve all. Other numbers than float32 are rounded to the nearest; places after
 * the origin of the blob, if it has one, was subtracted in double.
 */
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

/** A flag for each element: those that are 0 or false do not count, as if they were not there. */
export type Flags = Uint8Array | readonly boolean[];

export interface FilterOptions {
    /** One for each triangle of a blob, instance of a baked scene, or slot of a moving one. All unless given. */
    only?: Flags | null;
}

export interface AccuracyOptions {
    /** A length in the blob's units. With one, a no is certain, and a yes may be off by about as much, for less work. */
    accuracy?: number;
}

export interface SweepOptions {
    culling?: Culling;
    /** Ignores triangles that a shape touches at the start and leaves. */
    ignoreLeaving?: boolean;
    /** How far the shape stops in front of the contact. */
    skin?: number;
}

/** The points origin + t * direction, of any t. */
export interface Ray { kind: 'ray'; origin: Vectors; direction: Vectors }
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
/** The convex hulls of at most 64 vertices each, in any order. */
export interface ConvexHull {
    kind: 'convexHull';
    /** Three numbers for each vertex: of one hull, which serves all queries, or of those that `offsets` divide. */
    vertices: Vectors;
    /** One more than there are hulls: hull i has the vertices from offsets[i] to offsets[i + 1], counted in vertices. */
    offsets?: Offsets;
}
/** All points with dot(normal, x) <= offset for each of at most 32 planes. */
export interface ConvexVolume {
    kind: 'convexVolume';
    /** Four numbers for each plane: its normal, of any length but zero, and its offset. */
    planes: Vectors;
    /** As those of ConvexHull, counted in planes. */
    offsets?: Offsets;
}
export type Offsets = Uint32Array | Uint16Array | Int32Array | readonly number[];
/** What overlaps() takes, of a blob ConvexVolume too. */
export type Volume = Sphere | Capsule | Box | OrientedBox | Cone | Triangle;
/** What sweep() takes. */
export type Moving = Sphere | Capsule | Box | OrientedBox | ConvexHull;
/** What contacts() takes. */
export type Body = Sphere | Capsule | OrientedBox | ConvexHull;
