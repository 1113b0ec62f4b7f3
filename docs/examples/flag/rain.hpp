// Drops that fall on the cloth, bounce off it and run down.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/blob.hpp>

#include "vector.hpp"

namespace flag {

struct Drop {
    Vector position;
    Vector velocity;
};

/// What happened to drops since the counts were set to zero.
struct Counts {
    std::uint32_t hits = 0;    ///< paths that met the cloth
    std::uint32_t pushes = 0;  ///< drops that the cloth came up to
    std::uint32_t landed = 0;  ///< drops that reached the ground
};

class Rain {
public:
    explicit Rain(std::uint32_t count);

    [[nodiscard]] const std::vector<Drop>& drops() const { return drops_; }
    /// Moves all drops by a step, past the cloth in its latest pose.
    void fall(const espalier::Blob& cloth, Counts& counts);

private:
    void start(Drop& drop);

    std::vector<Drop> drops_;
    std::uint32_t started_ = 0;
};

}  // namespace flag
