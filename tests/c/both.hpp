// Blobs, scenes and meshes that C and C++ open each for itself, and the comparison of all calls that take them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <espalier/espalier.hpp>

#include "pool.hpp"

namespace espalier::tests {

/// The names of functions that returned the status ok.
using Answered = std::set<std::string>;

class Both {
public:
    Both();
    /// Opens bytes as the first blob or another one. Requires the same status.
    OpenStatus open(std::span<const std::byte> bytes, std::size_t place = 0);
    OpenStatus open_scene(std::span<const std::byte> bytes);
    /// Creates an empty moving scene that places the meshes and tiles of the baked one, in memory of a size behind a
    /// multiple of 32. Returns whether it is open.
    bool create_moving_scene(std::uint32_t capacity, int step_exponent, std::size_t size, std::size_t offset = 0);
    bool open_moving_scene(std::span<const std::byte> snapshot);
    /// Copies the moving part of the first blob to memory of a size at an odd address, and makes the mesh the first
    /// blob.
    QueryStatus create_deformable(std::size_t size);

    /// Requires the same answers to every call that takes such an object, with arguments from a question and from any
    /// bits, and with null for every function and array.
    void compare(Takes takes, const question& asked, bool any_bits = false);
    /// Changes the moving scene by some calls, and requires that its block stays the same.
    void change(const question& asked, Random& random);
    void compare_moving(const question& asked, Random& random, bool any_bits = false);
    void refit(std::span<const Vec3> positions, const question& asked);

    [[nodiscard]] const Blob& blob() const { return to<Blob>(&cpp->blob[0]); }
    [[nodiscard]] const BakedScene& scene() const { return to<BakedScene>(&cpp->scene[0]); }
    [[nodiscard]] MovingScene& moving() { return to<MovingScene>(&cpp->moving_scene[0]); }
    [[nodiscard]] Deformable& mesh() { return to<Deformable>(&cpp->deformable[0]); }
    [[nodiscard]] bool are_memories_equal() const;

    // Of C filled with zeros at first, as static storage is; of C++ with its defaults.
    std::unique_ptr<Pool> c = std::make_unique<Pool>(), cpp = std::make_unique<Pool>();
    Answered answered;

    void prepare(const question& asked, bool any_bits, bool nothing);

private:
    void compare(const Entry& entry);

    std::vector<espalier_blob> c_meshes_;
    std::vector<espalier_scene> c_tiles_;
    std::vector<Blob> meshes_;
    std::vector<BakedScene> tiles_;
    std::vector<std::byte> c_memory_, memory_;
    bool is_moving_ = false;
};

}  // namespace espalier::tests
