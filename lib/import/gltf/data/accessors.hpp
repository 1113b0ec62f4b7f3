// The data of a glTF file: the bytes of its buffers, which are its binary chunk, base64 text or files beside it, and
// accessors: numbers in bytes, with a stride, a normalisation and sparse replacements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <import/gltf/data/container.hpp>
#include <import/gltf/data/json.hpp>

namespace espalier::importer {

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
    std::shared_ptr<const std::vector<std::uint32_t>> replaced;  ///< sparse: ascending elements; null: none
    std::span<const std::byte> replacements;                     ///< sparse: what they are instead, without gaps
    std::shared_ptr<const std::vector<std::byte>> owned;         ///< what `bytes` points into, unless a buffer

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

struct GltfBufferView {
    std::span<const std::byte> bytes;
    std::size_t stride = 0;  ///< 0: elements follow each other without a gap
    std::size_t packed = 0;  ///< bytes of an element of EXT_meshopt_compression; 0: the view is not compressed
};

/// The data of a file: its buffers, of which each is read when it is first used, and views of them and accessors. The
/// container outlives it.
class GltfData {
public:
    /// `opened` gets the files beside the glTF file that are read.
    GltfData(const std::string& path, const GltfContainer& container, std::vector<std::string>& opened);

    [[nodiscard]] const GltfObject& root() const { return root_; }
    [[nodiscard]] std::size_t view_count() const { return root_.size_of("bufferViews"); }
    [[nodiscard]] std::size_t accessor_count() const { return root_.size_of("accessors"); }
    /// Returns bytes that live as long as this. Throws ImportError when the view is not inside of its buffer.
    GltfBufferView view(std::size_t number);
    /// Returns an accessor whose elements are all inside of their bytes. Throws ImportError, with `words` for who
    /// uses it: when they are not, or when it has another type than its use allows.
    GltfAccessor accessor(std::size_t number, GltfUse use, std::string_view words);
    /// Returns the accessor's "count", which need not be true.
    [[nodiscard]] std::uint64_t claimed_count(std::size_t number) const;
    /// Returns the accessor's description alone, as Draco uses it: without bytes.
    [[nodiscard]] GltfAccessor described(std::size_t number, GltfUse use, std::string_view words) const;

private:
    /// Returns exactly the buffer's byteLength. Throws ImportError when it has fewer.
    std::span<const std::byte> buffer(std::size_t number);
    [[nodiscard]] std::vector<std::byte> bytes_beside(const GltfObject& buffer, const std::string& uri,
                                                      std::uint64_t length);
    std::span<const std::byte> part_of_buffer(const GltfObject& part);
    [[nodiscard]] GltfObject object(std::size_t number, std::string_view words) const;
    void read_replacements(std::size_t number, const GltfObject& sparse, GltfAccessor& accessor);
    std::span<const std::byte> elements(const GltfObject& place, std::size_t count, std::size_t bytes,
                                        std::size_t* stride);

    const std::string& path_;
    const GltfContainer& container_;
    std::vector<std::string>& opened_;
    GltfObject root_;
    std::vector<std::optional<std::vector<std::byte>>> buffers_;  ///< those that are no binary chunk, once read
    std::map<std::size_t, std::vector<std::byte>> decompressed_;
    /// The values of sparse accessors, kept because many primitives may share one.
    std::map<std::size_t, std::shared_ptr<const std::vector<std::uint32_t>>> replaced_;
};

/// One decompressed primitive: triangles, and attributes by their Draco id.
class GltfDracoMesh {
public:
    virtual ~GltfDracoMesh() = default;

    /// Returns three vertex numbers for each triangle.
    [[nodiscard]] virtual GltfAccessor indices() const = 0;
    /// Returns the attribute's elements with the components and the normalisation of `described`.
    [[nodiscard]] virtual GltfAccessor attribute(const GltfObject& extension, std::uint64_t id,
                                                 const GltfAccessor& described) const = 0;
};

/// Returns what `compressed` holds; `extension` is the primitive's KHR_draco_mesh_compression. Throws ImportError when
/// the bytes are damaged, and (unsupported) in a build without Draco.
std::unique_ptr<const GltfDracoMesh> decode_draco(const GltfObject& extension, std::span<const std::byte> compressed);

/// Returns the bytes that `compressed` holds; `extension` describes them. Throws ImportError when they are
/// damaged, and (unsupported) in a build without meshoptimizer.
std::vector<std::byte> decode_meshopt(const GltfObject& extension, std::span<const std::byte> compressed);

}  // namespace espalier::importer
