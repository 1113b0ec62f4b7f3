// Which of the two modules an engine takes, and where their bytes come from.

/// A module whose only function contains an instruction of SIMD128: (func (result v128) i32.const 0 i8x16.splat).
const SIMD_PROBE = Uint8Array.of(
    0x00, 0x61, 0x73, 0x6D, 0x01, 0x00, 0x00, 0x00, 0x01, 0x05, 0x01, 0x60, 0x00, 0x01, 0x7B, 0x03, 0x02, 0x01, 0x00,
    0x0A, 0x08, 0x01, 0x06, 0x00, 0x41, 0x00, 0xFD, 0x0F, 0x0B);

/// Returns whether the engine has SIMD128.
export function hasSimd() {
    return WebAssembly.validate(SIMD_PROBE);
}

/// Returns a compiled module of a Response, of bytes, of a URL, or of a module.
export async function compiled(given) {
    const source = await given;
    if (source instanceof WebAssembly.Module) return source;
    if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source);
    if (typeof Response !== 'undefined' && source instanceof Response) {
        if (!source.ok) throw new TypeError(`${source.url} was answered with ${source.status}`);
        // Streams where the server states the type.
        const isTyped = /^application\/wasm(;|$)/.test(source.headers.get('content-type') ?? '');
        return isTyped ? WebAssembly.compileStreaming(source) : WebAssembly.compile(await source.arrayBuffer());
    }
    const url = source instanceof URL ? source : new URL(source, import.meta.url);
    if (url.protocol !== 'file:') return compiled(fetch(url));
    const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ 'node:fs/promises');
    return WebAssembly.compile(await readFile(url));
}

/// Returns the module beside this file that suits the engine. Bundlers find both by these expressions.
export function moduleBeside(withSimd) {
    return withSimd ? new URL('./espalier.wasm', import.meta.url) : new URL('./espalier_scalar.wasm', import.meta.url);
}
