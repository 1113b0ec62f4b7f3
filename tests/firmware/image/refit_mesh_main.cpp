// The least that is useful with a deformable mesh: its moving part in memory, and a pose.
#include <espalier/blob.hpp>
#include <espalier/deformation.hpp>

#include "blob_in_image.hpp"

using namespace espalier;

int main() {
    static std::byte memory[1024];
    static Vec3 positions[16];
    const Blob mesh = open_unchecked(firmware::blob_in_image());
    Deformable deformable = create_deformable(mesh, memory);
    if (!deformable) return 2;
    return static_cast<int>(refit(deformable, positions).quality);
}
