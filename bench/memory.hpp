// Memory whose address does not decide a measurement: it begins at a multiple of 2 MiB, and states its pages. Without
// advice large pages would be given to some and not to others, as the system has them left, which is worth a fifth of a
// ray's time.
#pragma once

#include "base.hpp"

namespace espalier::bench {

enum class Pages {
    small,
    huge,  ///< where the system has them
};

class Memory {
public:
    /// Throws std::bad_alloc.
    explicit Memory(std::size_t size, Pages pages = Pages::small);
    ~Memory();
    Memory(Memory&& other) noexcept;
    [[nodiscard]] std::byte* data() const { return data_; }

private:
    void* mapping_;
    std::size_t mapped_;
    std::byte* data_;
};

}  // namespace espalier::bench
