// The least that is useful: open a blob and cast one ray. Its size less that of the empty image is what the library
// adds.
#include <espalier/blob.hpp>
#include <espalier/ray.hpp>

#include "blob_in_image.hpp"

int main() {
    const espalier::Blob blob = espalier::open(espalier::firmware::blob_in_image());
    if (!blob) return 2;
    const auto hit = espalier::raycast(blob, {.origin = {8.0f, 8.0f, 50.0f}, .direction = {0.0f, 0.0f, -1.0f}});
    return hit ? 0 : 3;
}
