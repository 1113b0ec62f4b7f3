// Startup code and the blob, nothing else: what the other images are measured against.
#include "blob_in_flash.hpp"

int main() {
    const volatile unsigned char* const bytes = espalier::firmware::odd_then_blob;
    return bytes[1] == 'E' ? 0 : 2;
}
