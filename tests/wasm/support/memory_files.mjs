// Runs a program for WASI with files in memory, in browsers: what programs of C need that read or write whole files of one
// folder, beside what the package has of WASI.
import { importsOf } from '/espalier/memory/imports.js';

const OK = 0, BAD_DESCRIPTOR = 8, NOT_FOUND = 44;
const FOLDER = 3, CHARACTERS = 2, DIRECTORY = 3, FILE = 4, CREATE = 1;

/// Bytes of which there may be more later.
const growing = () => new Uint8Array(new ArrayBuffer(0, { maxByteLength: 2 ** 24 }));

/// Runs a compiled module with arguments; files is a Map of names to Uint8Arrays, which it may change. Returns the exit
/// status and what was written to the output and to the errors.
export async function run(module, programArguments, files) {
    let exports = null, status = null;
    const view = () => new DataView(exports.memory.buffer);
    const bytes = (at, length) => new Uint8Array(exports.memory.buffer, at, length);
    const given = programArguments.map((text) => new TextEncoder().encode(`${text}\0`));
    const output = growing(), errors = growing();
    // By descriptor.
    const open = [null, { kind: CHARACTERS, content: output, at: 0 }, { kind: CHARACTERS, content: errors, at: 0 }, { kind: DIRECTORY }];

    /// Returns a function that calls transfer(file, piece) for each piece of memory in a list of iovecs.
    const transferring = (transfer) => (descriptor, list, count, total) => {
        const file = open[descriptor], before = file?.at;
        if (!file?.content) return BAD_DESCRIPTOR;
        for (let each = list; each < list + 8 * count; each += 8) transfer(file, bytes(view().getUint32(each, true), view().getUint32(each + 4, true)));
        view().setUint32(total, file.at - before, true);
        return OK;
    };

    const wasi = {
        __proto__: importsOf(() => exports.memory.buffer).wasi_snapshot_preview1,
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
        proc_exit(code) {
            status = code;
            throw new Error(`exit ${code}`);
        },
        fd_prestat_get(descriptor, at) {
            if (descriptor !== FOLDER) return BAD_DESCRIPTOR;
            bytes(at, 8).set([0, 0, 0, 0, 1, 0, 0, 0]);  // a folder with a name of one byte
            return OK;
        },
        fd_prestat_dir_name(_descriptor, at) {
            bytes(at, 1)[0] = '.'.charCodeAt(0);
            return OK;
        },
        fd_fdstat_get(descriptor, at) {
            if (!open[descriptor]) return BAD_DESCRIPTOR;
            bytes(at, 8).set([open[descriptor].kind, 0, 0, 0, 0, 0, 0, 0]);
            bytes(at + 8, 16).fill(0xFF);  // all rights
            return OK;
        },
        path_open(_folder, _lookup, name, length, flags, _rights, _inheriting, _descriptorFlags, at) {
            const path = new TextDecoder().decode(bytes(name, length)).replace(/^\.\//, '');
            if (flags & CREATE) files.set(path, growing());
            if (!files.has(path)) return NOT_FOUND;
            view().setUint32(at, open.push({ kind: FILE, content: files.get(path), at: 0 }) - 1, true);
            return OK;
        },
        fd_close: (descriptor) => open[descriptor] && delete open[descriptor] ? OK : BAD_DESCRIPTOR,
        fd_read: transferring((file, piece) => {
            const part = file.content.subarray(file.at, file.at + piece.length);
            piece.set(part);
            file.at += part.length;
        }),
        fd_write: transferring((file, piece) => {
            file.content.buffer.resize(file.at + piece.length);
            file.content.set(piece, file.at);
            file.at += piece.length;
        }),
    };
    const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: wasi });
    exports = instance.exports;
    try {
        exports._start();
    } catch (error) {
        if (status === null) throw error;
    }
    const text = (content) => new TextDecoder().decode(content.slice());
    return { status: status ?? 0, output: text(output), errors: text(errors) };
}
