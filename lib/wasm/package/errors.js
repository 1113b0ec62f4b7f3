// The errors that the package throws, with the texts of the library. Arguments of a wrong type or length are a TypeError
// or a RangeError.

/// The error that all others of the package extend. `status` is the library's number.
export class EspalierError extends Error {
    constructor(message, status, options) {
        super(message, options);
        this.status = status;
    }
    get name() {
        return this.constructor.name;
    }
}

/// Bytes are no sound blob or scene.
export class OpenError extends EspalierError {}

/// Nothing was baked. The text states what is wrong, where, and what to do; `place` is { file, mesh, triangle } of the
/// first fault, or null. The triangle is null where the fault is one of the mesh.
export class BakeError extends EspalierError {
    constructor(message, status, place = null, options) {
        super(message, status, options);
        this.place = place;
    }
}

/// A blob or a scene is not what its header states.
export class VerifyError extends EspalierError {}

/// A batch was refused as a whole, such as one of a blob that was freed.
export class QueryError extends EspalierError {}

/// The memory of the module cannot grow by what a call needs.
export class MemoryError extends EspalierError {}
