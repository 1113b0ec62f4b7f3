#include <import/gltf/nodes.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <string>

#include <import/base/numbers.hpp>
#include <import/base/polygon.hpp>

namespace espalier::importer {

namespace {

/// The most elements that an accessor without stored bytes may have where it decides how much is allocated.
constexpr std::size_t most_elements_without_bytes = std::size_t{1} << 20;
constexpr std::size_t most_gaps = 16;  // of a table of vertices, for each corner
constexpr std::uint32_t not_used = std::numeric_limits<std::uint32_t>::max();

/// Reads accessors, or what Draco packs in their place.
class PrimitiveReader {
public:
    PrimitiveReader(const GltfObject& object, GltfData& data)
        : object_(object),
          data_(data),
          attributes_(object.object("attributes")),
          extension_(object.extension("KHR_draco_mesh_compression")) {
        if (!extension_) return;
        packed_attributes_ = extension_->object("attributes");
        if (!packed_attributes_ || !packed_attributes_->has("POSITION")) {
            extension_->fail("its \"attributes\" have no POSITION");
        }
        const std::size_t view = extension_->required_index("bufferView", data.view_count());
        draco_ = decode_draco(*extension_, data.view(view).bytes);
    }

    [[nodiscard]] bool has(const std::string& name) const { return attributes_ && attributes_->has(name.c_str()); }
    [[nodiscard]] bool is_packed() const { return draco_ != nullptr; }
    [[nodiscard]] bool differs_from_accessors() const { return differs_from_accessors_; }

    GltfAccessor attribute(const std::string& name, GltfUse use) {
        const std::size_t number = attributes_->required_index(name.c_str(), data_.accessor_count());
        const std::string words = text(object_.words(), ", ", name);
        if (!packed_attributes_ || !packed_attributes_->has(name.c_str())) {
            return data_.accessor(number, use, words);
        }
        const std::uint64_t id = packed_attributes_->required_whole(name.c_str());
        const GltfAccessor described = data_.described(number, use, words);
        GltfAccessor result = draco_->attribute(*extension_, id, described);
        differs_from_accessors_ = differs_from_accessors_ || result.count != described.count;
        return result;
    }

    std::optional<GltfAccessor> indices() {
        const auto number = object_.index("indices", data_.accessor_count());
        if (draco_) {
            GltfAccessor result = draco_->indices();
            differs_from_accessors_ =
                differs_from_accessors_ || (number && result.count != data_.claimed_count(*number));
            return result;
        }
        if (!number) return std::nullopt;
        return data_.accessor(*number, GltfUse::index, text(object_.words(), ", indices"));
    }

private:
    const GltfObject& object_;
    GltfData& data_;
    std::optional<GltfObject> attributes_;
    std::optional<GltfObject> extension_, packed_attributes_;
    std::unique_ptr<const GltfDracoMesh> draco_;
    bool differs_from_accessors_ = false;
};

/// Many primitives may share the vertices of a whole file; each gets those that its triangles use. An index beyond the
/// accessor stays, for the baker refuses or repairs it.
void keep_used_vertices(GltfPrimitive& primitive) {
    const std::size_t count = primitive.positions.count;
    std::uint32_t first = not_used, last = 0;
    const auto for_each_index = [&](const auto& use) {
        for (TriangleVertices& triangle : primitive.triangles) {
            for (std::uint32_t& index : triangle) {
                if (index < count) use(index);
            }
        }
    };
    for_each_index([&](std::uint32_t index) {
        first = std::min(first, index);
        last = std::max(last, index);
    });
    if (first > last) return;
    // Two vertices may be a million apart, in each of many primitives.
    if (last - first > most_gaps * 3 * primitive.triangles.size()) {
        std::vector<std::uint32_t>& used = primitive.vertices;
        for_each_index([&](std::uint32_t index) { used.push_back(index); });
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for_each_index([&](std::uint32_t& index) {
            const auto place = std::lower_bound(used.begin(), used.end(), index);
            index = static_cast<std::uint32_t>(place - used.begin());
        });
        return;
    }
    std::vector<std::uint32_t> numbers(std::size_t{last - first} + 1, not_used);
    for_each_index([&](std::uint32_t index) { numbers[index - first] = 0; });
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] == not_used) continue;
        numbers[i] = static_cast<std::uint32_t>(primitive.vertices.size());
        primitive.vertices.push_back(first + static_cast<std::uint32_t>(i));
    }
    for_each_index([&](std::uint32_t& index) { index = numbers[index - first]; });
}

GltfInfluences read_influences(PrimitiveReader& reader, const GltfObject& object, std::size_t vertices) {
    GltfInfluences result;
    for (int set = 0; reader.has(text("JOINTS_", set)) && reader.has(text("WEIGHTS_", set)); ++set) {
        result.emplace_back(reader.attribute(text("JOINTS_", set), GltfUse::joints),
                            reader.attribute(text("WEIGHTS_", set), GltfUse::weights));
        if (result.back().first.count < vertices || result.back().second.count < vertices) {
            object.fail(text("JOINTS_", set, " or WEIGHTS_", set, " has fewer elements than POSITION"));
        }
    }
    return result;
}

enum Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles, strip, fan };

std::uint64_t lines_of(std::uint64_t mode, std::uint64_t corners) {
    if (mode == points) return corners;
    if (mode == lines) return corners / 2;
    if (corners < 2) return 0;
    return mode == line_loop ? corners : corners - 1;
}

/// Refuses the largest value of the indices' type where it would name a vertex: programs that draw take it as the end
/// of a strip, and glTF forbids it.
void refuse_restarts(const GltfObject& object, const GltfAccessor& indices, std::size_t vertices) {
    const std::uint64_t restart = (std::uint64_t{1} << (8 * bytes_of(indices.component))) - 1;
    if (restart >= vertices) return;  // a vertex that is missing, which the baker refuses or drops
    for (std::size_t corner = 0; corner < indices.count; ++corner) {
        if (indices.whole(corner, 0) != restart) continue;
        object.fail(
            text("index ", corner, " is ", restart, ", the largest value of its type, which glTF forbids as an index"));
    }
}

/// Sets the triangles of `primitive` with indices into its positions, or counts its points and lines.
void read_topology(const GltfObject& object, std::uint64_t mode, const std::optional<GltfAccessor>& indices,
                   GltfPrimitive& primitive) {
    const std::size_t corners = indices ? indices->count : primitive.positions.count;
    if (mode > fan) object.fail(text("its mode ", mode, " is none"));
    if (mode < triangles) {
        primitive.points_and_lines = lines_of(mode, corners);
        return;
    }
    if (indices) refuse_restarts(object, *indices, primitive.positions.count);
    const auto vertex = [&](std::size_t corner) {
        return indices ? indices->whole(corner, 0) : static_cast<std::uint32_t>(corner);
    };
    if (mode == triangles) {
        primitive.left_over_corners = corners % 3;
        primitive.triangles.reserve(corners / 3);
        for (std::size_t i = 0; i + 2 < corners; i += 3) {
            primitive.triangles.push_back({vertex(i), vertex(i + 1), vertex(i + 2)});
        }
        return;
    }
    if (corners < 3) {
        primitive.left_over_corners = corners;
        return;
    }
    primitive.triangles.reserve(corners - 2);
    for (std::size_t i = 0; i + 2 < corners; ++i) {
        const TriangleVertices triangle =
            mode == strip ? TriangleVertices{vertex(i), vertex(i + 1 + i % 2), vertex(i + 2 - i % 2)}
                          : TriangleVertices{vertex(i + 1), vertex(i + 2), vertex(0)};
        if (!repeats_a_vertex(triangle, primitive.positions.count)) primitive.triangles.push_back(triangle);
    }
}

}  // namespace

std::vector<Vec3d> GltfPrimitive::shape_by(const GltfObject& stated, GltfData& data) const {
    struct Morph {
        double weight;
        GltfAccessor displacement;
    };
    std::vector<Morph> morphs;
    const std::size_t weights = is_morphed ? std::min(object.size_of("targets"), stated.size_of("weights")) : 0;
    for (std::size_t i = 0; i < weights; ++i) {
        const double weight = stated.number_in("weights", i);
        if (weight == 0.0) continue;
        const GltfObject target = object.object_in("targets", i, text(object.words(), ", morph target ", i));
        const auto number = target.index("POSITION", data.accessor_count());
        if (!number) continue;
        morphs.push_back({weight, data.accessor(*number, GltfUse::displacement, target.words())});
        if (morphs.back().displacement.count < positions.count) target.fail("it has fewer elements than POSITION");
    }
    std::vector<Vec3d> result;
    result.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) {
        std::array<double, 3> position{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            position[axis] = positions.number(vertex, axis);
            for (const Morph& morph : morphs) position[axis] += morph.weight * morph.displacement.number(vertex, axis);
        }
        result.push_back({position[0], position[1], position[2]});
    }
    return result;
}

GltfPrimitive read_gltf_primitive(const GltfObject& object, GltfData& data, bool keeps_vertices) {
    PrimitiveReader reader(object, data);
    if (keeps_vertices && reader.is_packed()) {
        object.refuse("Draco sorts its vertices, so poses of it do not match. Export it without compression.");
    }
    GltfPrimitive result{object, {}, {}, 0, 0, false, false, {}, {}, {}};
    const std::uint64_t mode = object.whole("mode").value_or(Mode::triangles);
    if (reader.is_packed() && mode != Mode::triangles)
        object.fail("Draco packs triangles, and its mode is another one");
    if (!reader.has("POSITION")) return result;
    result.has_positions = true;
    result.positions = reader.attribute("POSITION", GltfUse::position);
    require_stored(result.positions, object);
    const auto indices = reader.indices();
    if (indices) require_stored(*indices, object);
    read_topology(object, mode, indices, result);
    if (keeps_vertices) {
        result.vertices.resize(result.positions.count);
        std::iota(result.vertices.begin(), result.vertices.end(), 0u);
    } else {
        keep_used_vertices(result);
    }
    result.influences = read_influences(reader, object, result.positions.count);
    result.differs_from_accessors = reader.differs_from_accessors();
    for (std::size_t i = 0; i < object.size_of("targets"); ++i) {
        const GltfObject target = object.object_in("targets", i, text(object.words(), ", morph target ", i));
        result.is_morphed = target.index("POSITION", data.accessor_count()) || result.is_morphed;
    }
    return result;
}

std::uint64_t count_gltf_triangles(const GltfObject& object, GltfData& data) {
    const std::uint64_t mode = object.whole("mode").value_or(Mode::triangles);
    const auto attributes = object.object("attributes");
    auto corners = object.index("indices", data.accessor_count());
    if (!corners && attributes) corners = attributes->index("POSITION", data.accessor_count());
    if (mode < Mode::triangles || !corners) return 0;
    const std::uint64_t count = data.claimed_count(*corners);
    return mode == Mode::triangles ? count / 3 : count - std::min<std::uint64_t>(count, 2);
}

void require_stored(const GltfAccessor& accessor, const GltfObject& user) {
    if (accessor.count > not_used) user.refuse("an accessor of it has more than 2^32 elements. Split the mesh.");
    if (accessor.is_stored() || accessor.count <= most_elements_without_bytes) return;
    user.refuse(text("an accessor of it has ", accessor.count, " elements without \"bufferView\"; up to ",
                     most_elements_without_bytes, " are read. Export it with stored elements."));
}

}  // namespace espalier::importer
