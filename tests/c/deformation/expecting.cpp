#include "c/expecting.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace espalier::tests {

void Expecting::tell(const RefitResult& result) {
    tell(result.status);
    tell(result.position);
    tell(result.quality);
}

void Expecting::mesh_itself() {
    tell(mesh_->status());
    tell(mesh_->position_count());
    tell(static_cast<std::uint32_t>(deformable_bytes(mesh_->blob())));
    for (const Box& box : {mesh_->range(), mesh_->blob().bounds()}) {
        tell(box.min);
        tell(box.max);
    }
}

void Expecting::refits() {
    const std::size_t fewer = positions_.empty() ? 0 : asked_.bits % positions_.size();
    std::array<std::byte, 1> byte = {};
    mesh_itself();
    tell(refit(*mesh_, {}));
    tell(refit(*mesh_, positions_.first(fewer)));
    tell(refit(*mesh_, positions_));
    mesh_itself();
    tell(seal(*mesh_, {}));
    tell(seal(*mesh_, byte));
    tell(std::to_integer<std::uint32_t>(byte[0]));
}

}  // namespace espalier::tests
