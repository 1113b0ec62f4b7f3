// Bytes that were opened, in the memory of the module.
import { OpenError } from '../errors.js';
import { Held, Memory, releaseAll } from './held.js';

const OK = 0;

/// Bytes in the module's memory with the view of them that queries take.
export class Opened extends Held {
    #bytes;

    /// Copies the bytes and calls open(view, address, length), which returns the library's status. The view has the number
    /// of bytes that sizeOfView(address, length) returns.
    constructor(instance, bytes, sizeOfView, open) {
        const { length } = bytes, addresses = [instance.allocate(length)];
        try {
            const [address] = addresses;
            instance.array(Uint8Array, address, length).set(bytes);
            const view = instance.allocate(sizeOfView(address, length));
            addresses.push(view);
            const status = open(view, address, length);
            if (status !== OK) throw new OpenError(instance.text(instance.functions.espalier_describe_open_status(status) >>> 0), status);
        } catch (error) {
            releaseAll(instance, addresses);
            throw error;
        }
        super(instance, addresses[1], [new Memory(instance, addresses)]);
        this.#bytes = { address: addresses[0], length };
    }

    /// Returns a copy of the bytes, for a file.
    bytes() {
        return this.use((instance) => instance.array(Uint8Array, this.#bytes.address, this.#bytes.length).slice());
    }
}
