// Baking: triangle meshes in, one blob out. Offline code: it allocates, may throw std::bad_alloc and uses threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <espalier/format.hpp>
#include <espalier/types.hpp>

namespace espalier {

using TriangleVertices = std::array<std::uint32_t, 3>;

/// One input mesh, in world units and axes. Nothing is kept; nothing is trusted.
struct MeshView {
    std::span<const Vec3> positions;
    std::span<const TriangleVertices> triangles;  ///< indices into positions, counter-clockwise seen from the front
    std::span<const std::uint32_t> materials;     ///< one for each triangle, or none: material 0
    std::uint32_t file = 0;                       ///< which input it came from, for original ids
    std::uint32_t mesh = 0;                       ///< which mesh of that input
    std::string name;                             ///< for messages: "level.obj, mesh 3 (walls)"
};

enum class Materials : std::uint8_t { none, bits_8, bits_16 };

/// What the baker minimises where it decides which boxes become nodes and where leaves begin: the expected cost of a
/// ray, in visits of a node, plus a price on bytes,
///   sum over nodes and leaves of (area / the root's area) * cost + byte_price * bytes / triangles.
/// Each is between 0 and a million. The defaults are committed: no clock enters the bytes. bench/cost_model fits them
/// to a machine.
struct CostModel {
    float node_visit = 1.0f;
    float leaf_visit = 0.4f;
    float leaf_group = 0.3f;  ///< for each started group of 8 triangles of a visited leaf
    float triangle = 0.0f;    ///< for each triangle of a visited leaf
    float byte_price = 5.0f;  ///< of one byte a triangle; profile small takes four times this, tiny six times
};

/// How the tree is built, before subtrees are moved (from effort 4 on) and nodes are made wide. All obey the format's
/// depth.
enum class Builder : std::uint8_t {
    binned_sah,      ///< surface area heuristic over planes between bins (Wald 2007)
    sweep_sah,       ///< surface area heuristic over every split along every axis (MacDonald, Booth 1990)
    spatial_splits,  ///< as binned_sah, but large triangles may be in several leaves, clipped (Stich et al. 2009)
    agglomerative,   ///< pairs of near clusters, bottom up (Gu, He, Fatahalian, Blelloch 2013)
    linear,          ///< along a space-filling curve (Lauterbach et al. 2009): fastest to build, most visits
    insertion,       ///< one triangle after the other, with rotations (Goldsmith, Salmon 1987)
};

/// Which bounds of the whole asset a blob carries besides its axis-aligned box: bounds.hpp.
struct StoredBounds {
    bool oriented_box = false;  ///< 32 bytes
    bool sphere = false;        ///< 16 bytes
    bool k_dop = false;         ///< 80 bytes
};

struct BakeOptions {
    /// Largest allowed distance between source and baked surface, in world units. At 22 bits or fewer queries near the
    /// asset move by no more than that either. Without it `bits` decides the lattice.
    std::optional<double> tolerance = std::nullopt;
    /// The lattice step is 2^step_exponent, -100 .. 100, and not what `bits` or a tolerance give. Excludes `tolerance`.
    /// Blobs with one step lie on one lattice: a vertex that two sources have in common is one lattice point in both,
    /// for example where two tiles of a terrain meet. lattice_of(blob).step_exponent is that of another blob.
    std::optional<int> step_exponent = std::nullopt;
    /// Lattice bits for the largest extent, 1..24: the step is the smallest power of two for which they suffice.
    unsigned bits = 16;
    format::Profile profile = format::Profile::balanced;
    Builder builder = Builder::binned_sah;
    /// With Builder::spatial_splits: copies are at most this share of the triangles, 0..1. A blob with copies refuses
    /// for_each_hit and for_each_overlap.
    double duplicates = 0.3;
    bool original_ids = false;
    Materials materials = Materials::none;
    /// Carry how the surface bends at every edge (contact.hpp), in 6 bits a triangle. The number is the largest angle
    /// between two triangles, in degrees, that counts as flat: from 0 to less than 90.
    std::optional<double> edge_flags = std::nullopt;
    StoredBounds bounds = {};
    /// Drop triangles with NaN or infinite corners and with indices out of range, instead of refusing the mesh.
    bool repair = false;
    CostModel cost_model = {};
    /// 1..format::max_leaf_triangles. Smaller leaves test fewer triangles for each ray and take more bytes.
    unsigned max_leaf_triangles = format::max_leaf_triangles;
    /// 0 builds fastest, 9 builds best.
    unsigned effort = 5;
    unsigned threads = 1;  ///< 0: as many as the machine has. The bytes do not depend on it.
    /// Called now and then, from the calling thread, with the stage's name and how much of the whole is done, 0..1.
    std::function<void(const char* stage, double done)> progress = nullptr;
};

/// One mesh of the input, or one triangle of it.
struct SourcePlace {
    std::uint32_t file = 0;  ///< MeshView::file
    std::uint32_t mesh = 0;  ///< MeshView::mesh
    std::optional<std::uint32_t> triangle = std::nullopt;
};

/// One kind of thing that was wrong with the input, how often, and where it was seen first.
struct Finding {
    std::uint64_t count = 0;
    std::string first;                                ///< "level.obj, mesh 3 (walls), triangle 17"
    std::optional<SourcePlace> place = std::nullopt;  ///< of the first
};

/// How much space the bounds of the whole asset take, in cubic world units; 0 for those that were not asked for.
struct BoundsVolumes {
    double box = 0.0;  ///< axis-aligned; 0 also when none was asked for
    double oriented_box = 0.0;
    double sphere = 0.0;
    double k_dop = 0.0;
};

/// What the baker saw and did. Lengths in world units.
struct BakeReport {
    std::uint64_t source_triangles = 0;
    std::uint64_t source_vertices = 0;
    std::uint32_t triangles = 0;  ///< kept
    std::uint32_t copies = 0;     ///< further storage indices of kept triangles, by Builder::spatial_splits
    std::uint32_t vertices = 0;   ///< distinct lattice points of the kept ones
    Finding not_finite;           ///< dropped under repair: a corner is NaN or infinite
    Finding index_out_of_range;   ///< dropped under repair
    Finding zero_area;            ///< dropped: no area in the source
    Finding collapsed;            ///< dropped: no area left on the lattice
    Finding duplicate;            ///< dropped: same three lattice points in the same winding as a kept one
    Vec3 bounds_min;
    Vec3 bounds_max;
    double step = 0.0;
    double extent = 0.0;     ///< largest side of the bounds
    double max_error = 0.0;  ///< what the header says; counts from the float32 positions that were given
    unsigned bits = 0;       ///< what the header says
    bool closed = false;     ///< what the header says
    /// The source is closed and has a triangle with an area, but the baked triangles are not closed. The source is
    /// closed if each of its edges, from position to position, runs as often one way as the other. Two things lose it:
    /// dropping triangles that have an area on the lattice (duplicates, and triangles that had no area in the source),
    /// and the collapse of all triangles.
    bool lost_closed = false;
    /// The fewest bits, above `bits`, with which the same source bakes closed; 0 if there are none. Tried one by one,
    /// and only if lost_closed.
    unsigned bits_that_keep_closed = 0;
    bool rays_rounded_coarsely = false;  ///< 23 or 24 bits: rays from outside are rounded coarser (ray.hpp)
    BoundsVolumes volumes;
    bool step_below_float_spacing =
        false;  ///< the step is finer than the source's own float32 spacing: bits are wasted
    unsigned depth = 0;
    std::uint32_t nodes = 0;
    std::uint64_t leaves = 0;
    std::uint64_t bytes = 0;
    double seconds = 0.0;
};

struct Baked {
    std::vector<std::byte> blob;
    /// Where each triangle of the blob came from, by storage index, copies included: what original_hit takes
    /// (original.hpp), whether or not the blob carries ids.
    std::vector<OriginalTriangle> remap;
    BakeReport report;
};

/// Why nothing was baked: what, where, what to do.
struct BakeError {
    enum class Kind : std::uint8_t {
        invalid_options,
        invalid_mesh,  ///< broken geometry: NaN, indices out of range
        too_fine,      ///< the lattice would need more than 24 bits
        too_large,     ///< a limit of the format
        internal,      ///< the baker's own check of its result failed
    };
    Kind kind = Kind::internal;
    std::string message;
    std::optional<SourcePlace> place =
        std::nullopt;  ///< the first place with this fault; none for a fault of the whole
};

/// A value or the reason why there is none.
template <class Value, class Error>
class Result {
public:
    Result(Value value) : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT(google-explicit-constructor)
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)
    [[nodiscard]] bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }
    [[nodiscard]] Value& value() { return std::get<0>(state_); }
    [[nodiscard]] const Value& value() const { return std::get<0>(state_); }
    Value& operator*() { return value(); }
    const Value& operator*() const { return value(); }
    Value* operator->() { return &value(); }
    const Value* operator->() const { return &value(); }
    [[nodiscard]] const Error& error() const { return std::get<1>(state_); }

private:
    std::variant<Value, Error> state_;
};

/// Bakes all meshes into one blob. The same arrays and options give the same bytes on every machine and at any number
/// of threads. An empty mesh gives a legal, empty blob. About 1 microsecond and 150 bytes of memory for each triangle.
[[nodiscard]] Result<Baked, BakeError> bake(std::span<const MeshView> meshes, const BakeOptions& options);

/// Returns the remap table as the bytes of a file, which read_remap (original.hpp) reads: 16 bytes a triangle.
[[nodiscard]] std::vector<std::byte> remap_file(const Baked& baked);

}  // namespace espalier
