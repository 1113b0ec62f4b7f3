// Accessors of a glTF file: numbers in bytes, with a stride, a normalisation and sparse replacements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "buffers.hpp"
#include "json.hpp"

namespace espalier::tools {

enum class GltfComponent : std::uint16_t {
    signed_8 = 5120,
    unsigned_8 = 5121,
    signed_16 = 5122,
    unsigned_16 = 5123,
    unsigned_32 = 5125,
    float_32 = 5126
};

std::size_t bytes_of(GltfComponent component);

/// A list of elements of one to 16 components each. All of them are inside of the bytes: who makes one, checks that.
struct GltfAccessor {
    std::size_t count = 0;
    std::size_t components = 0;
    GltfComponent component = GltfComponent::float_32;
    bool normalised = false;           ///< of integers; glTF forbids it for float32, where it changes nothing
    std::span<const std::byte> bytes;  ///< empty: all are zero
    std::size_t stride = 0;
    std::vector<std::uint32_t> replaced;                  ///< sparse: ascending elements
    std::span<const std::byte> replacements;              ///< sparse: what they are instead, without gaps
    std::shared_ptr<const std::vector<std::byte>> owned;  ///< what `bytes` points into, unless a buffer

    /// Returns a component: a normalised integer as -1..1 or 0..1, other numbers by their value.
    [[nodiscard]] double number(std::size_t element, std::size_t of) const;
    /// Returns a component of an unsigned integer type.
    [[nodiscard]] std::uint32_t whole(std::size_t element, std::size_t of) const;
    /// Tests whether there are as many bytes as elements, so that their count is no mere claim.
    [[nodiscard]] bool is_stored() const { return !bytes.empty(); }

private:
    [[nodiscard]] const std::byte* place(std::size_t element, std::size_t of) const;
};

/// What an accessor is used for: the types that the specification and KHR_mesh_quantization allow there.
enum class GltfUse { position, displacement, index, joints, weights, matrix, translation, rotation, scale };

class GltfAccessors {
public:
    GltfAccessors(const GltfObject& root, GltfBufferViews& views) : root_(root), views_(views) {}

    [[nodiscard]] std::size_t count() const { return root_.size_of("accessors"); }
    /// Returns an accessor whose elements are all inside of their bytes. Throws CommandError, with `words` for who
    /// uses it: when they are not, or when it has another type than its use allows.
    GltfAccessor accessor(std::size_t number, GltfUse use, std::string_view words);
    /// Returns the accessor's "count", which need not be true.
    std::uint64_t claimed_count(std::size_t number);
    /// Returns the accessor's description alone, as Draco uses it: without bytes.
    GltfAccessor described(std::size_t number, GltfUse use, std::string_view words);

private:
    [[nodiscard]] GltfObject object(std::size_t number, std::string_view words) const;
    void read_replacements(const GltfObject& sparse, GltfAccessor& accessor);
    std::span<const std::byte> elements(const GltfObject& place, std::size_t count, std::size_t bytes,
                                        std::size_t* stride);

    const GltfObject& root_;
    GltfBufferViews& views_;
};

}  // namespace espalier::tools
