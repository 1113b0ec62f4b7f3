// What the modules import: the part of WASI that their C library is linked with. They have no files, no arguments and no
// environment; the clock is for the seconds of a bake's report.

const OK = 0, BAD_DESCRIPTOR = 8, NOT_SUPPORTED = 58;

/// Returns the imports of one instance. memory() returns its buffer, which changes as it grows.
export function importsOf(memory) {
    const view = () => new DataView(memory());
    const known = {
        clock_time_get(_clock, _precision, at) {
            view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
            return OK;
        },
        environ_sizes_get(count, bytes) {
            view().setUint32(count, 0, true);
            view().setUint32(bytes, 0, true);
            return OK;
        },
        environ_get: () => OK,
        proc_exit(code) {
            throw new WebAssembly.RuntimeError(`the module ended with ${code}`);
        },
        fd_close: () => BAD_DESCRIPTOR,
        fd_fdstat_get: () => BAD_DESCRIPTOR,
        fd_seek: () => BAD_DESCRIPTOR,
        fd_write: () => BAD_DESCRIPTOR,
        fd_read: () => BAD_DESCRIPTOR,
    };
    // The C library of another version may be linked with more of WASI.
    const wasi = new Proxy(known, { get: (all, name) => all[name] ?? (() => NOT_SUPPORTED) });
    return { wasi_snapshot_preview1: wasi };
}
