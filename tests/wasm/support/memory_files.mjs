// Runs a program for WASI with files in memory, in Node and in browsers: what programs of C need that read and write
// files of one folder.

const OK = 0, BAD_DESCRIPTOR = 8, NOT_FOUND = 44, NOT_SUPPORTED = 58;
const OUTPUT = 1, ERRORS = 2, FOLDER = 3;
const CHARACTERS = 2, DIRECTORY = 3, FILE = 4;
const CREATE = 1, TRUNCATE = 8;

class Exit extends Error {
    constructor(code) {
        super(`exit ${code}`);
        this.code = code;
    }
}

/// Runs a compiled module with arguments; files is a Map of names to Uint8Arrays, which it may change. Returns the exit
/// status and what was written to the output and to the errors.
export async function run(module, programArguments, files) {
    let exports = null;
    const encoder = new TextEncoder(), texts = { [OUTPUT]: [], [ERRORS]: [] };
    const open = new Map();  // descriptor: { name, position }
    const view = () => new DataView(exports.memory.buffer);
    const bytes = (at, length) => new Uint8Array(exports.memory.buffer, at, length);
    const given = programArguments.map((text) => encoder.encode(`${text}\0`));

    /// Returns the pieces of memory that a list of iovecs names.
    const pieces = (list, count) => Array.from({ length: count }, (_, i) =>
        bytes(view().getUint32(list + 8 * i, true), view().getUint32(list + 8 * i + 4, true)));

    function append(descriptor, piece) {
        if (texts[descriptor]) return texts[descriptor].push(piece.slice());
        const file = open.get(descriptor), old = files.get(file.name), end = file.position + piece.length;
        // Room for more, so that a file of many pieces is not copied for each.
        file.room ??= old.slice();
        if (end > file.room.length) {
            const larger = new Uint8Array(2 * end);
            larger.set(file.room);
            file.room = larger;
        }
        file.room.set(piece, file.position);
        file.position = end;
        files.set(file.name, file.room.subarray(0, Math.max(old.length, end)));
    }

    const wasi = {
        args_sizes_get(count, size) {
            view().setUint32(count, given.length, true);
            view().setUint32(size, given.reduce((sum, text) => sum + text.length, 0), true);
            return OK;
        },
        args_get(pointers, at) {
            given.forEach((text, i) => {
                view().setUint32(pointers + 4 * i, at, true);
                bytes(at, text.length).set(text);
                at += text.length;
            });
            return OK;
        },
        environ_sizes_get(count, size) {
            view().setUint32(count, 0, true);
            view().setUint32(size, 0, true);
            return OK;
        },
        environ_get: () => OK,
        clock_time_get(_clock, _precision, at) {
            view().setBigUint64(at, BigInt(Date.now()) * 1_000_000n, true);
            return OK;
        },
        proc_exit(code) {
            throw new Exit(code);
        },
        fd_prestat_get(descriptor, at) {
            if (descriptor !== FOLDER) return BAD_DESCRIPTOR;
            view().setUint32(at, 0, true);
            view().setUint32(at + 4, 1, true);
            return OK;
        },
        fd_prestat_dir_name(_descriptor, at) {
            bytes(at, 1)[0] = '.'.charCodeAt(0);
            return OK;
        },
        fd_fdstat_get(descriptor, at) {
            const kind = descriptor === FOLDER ? DIRECTORY : descriptor < FOLDER ? CHARACTERS : FILE;
            if (kind === FILE && !open.has(descriptor)) return BAD_DESCRIPTOR;
            bytes(at, 24).fill(0);
            bytes(at, 1)[0] = kind;
            for (const rights of [8, 16]) view().setBigUint64(at + rights, 0xFFFFFFFFFFFFFFFFn, true);
            return OK;
        },
        fd_fdstat_set_flags: () => OK,
        path_open(_folder, _lookup, name, length, flags, _rights, _inheriting, _descriptorFlags, at) {
            const path = new TextDecoder().decode(bytes(name, length).slice()).replace(/^\.\//, '');
            if (!files.has(path)) {
                if (!(flags & CREATE)) return NOT_FOUND;
                files.set(path, new Uint8Array(0));
            }
            if (flags & TRUNCATE) files.set(path, new Uint8Array(0));
            let descriptor = FOLDER + 1;
            while (open.has(descriptor)) ++descriptor;
            open.set(descriptor, { name: path, position: 0 });
            view().setUint32(at, descriptor, true);
            return OK;
        },
        fd_close: (descriptor) => open.delete(descriptor) ? OK : BAD_DESCRIPTOR,
        fd_read(descriptor, list, count, at) {
            const file = open.get(descriptor);
            if (!file) return BAD_DESCRIPTOR;
            let read = 0;
            for (const piece of pieces(list, count)) {
                const part = files.get(file.name).subarray(file.position, file.position + piece.length);
                piece.set(part);
                file.position += part.length;
                read += part.length;
            }
            view().setUint32(at, read, true);
            return OK;
        },
        fd_write(descriptor, list, count, at) {
            if (!texts[descriptor] && !open.has(descriptor)) return BAD_DESCRIPTOR;
            let written = 0;
            for (const piece of pieces(list, count)) {
                append(descriptor, piece);
                written += piece.length;
            }
            view().setUint32(at, written, true);
            return OK;
        },
        fd_seek(descriptor, offset, whence, at) {
            const file = open.get(descriptor);
            if (!file) return BAD_DESCRIPTOR;
            file.position = Number(offset) + [0, file.position, files.get(file.name).length][whence];
            view().setBigUint64(at, BigInt(file.position), true);
            return OK;
        },
    };
    const imports = new Proxy(wasi, { get: (all, name) => all[name] ?? (() => NOT_SUPPORTED) });
    const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: imports });
    exports = instance.exports;
    let status = 0;
    try {
        exports._start();
    } catch (error) {
        if (!(error instanceof Exit)) throw error;
        status = error.code;
    }
    const text = (parts) => parts.map((part) => new TextDecoder().decode(part)).join('');
    return { status, output: text(texts[OUTPUT]), errors: text(texts[ERRORS]) };
}
