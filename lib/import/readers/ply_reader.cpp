#include <import/base/importers.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include <import/base/mesh_collector.hpp>
#include <import/base/missing_vertices.hpp>
#include <import/base/not_finite_vertices.hpp>
#include <import/base/occurrences.hpp>
#include <import/base/polygon.hpp>
#include <import/readers/ply.hpp>

namespace espalier::importer {

namespace {

constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/// Values is PlyText or PlyBytes.
template <class Values>
class PlyReader {
public:
    PlyReader(const PlyHeader& header, Values values, const ImportOptions& options, UnitlessFile& file)
        : header_(header), values_(values), options_(options), file_(file) {}

    void read() {
        // Faces are cut into triangles by their vertices, which may follow them.
        const Values start = values_;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                read_vertices(element);
                break;
            }
            values_.skip_elements(element);
        }
        values_ = start;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "face") {
                read_lists(element, [this] { add_face(); });
            } else if (element.name == "tristrips") {
                read_lists(element, [this] { add_strips(); });
            } else {
                values_.skip_elements(element);
                if (element.name == "edge") file_.record().points_and_lines += element.count;
                if (may_be_faces(element) && element.count > 0) {
                    warn("unknown_element", text("the header's element '", printable(element.name),
                                                 "' may name the vertices of faces, and is neither 'face' nor "
                                                 "'tristrips': it was left out."));
                }
            }
        }
        finish();
    }

private:
    const PlyProperty* list_of_vertices(const PlyElement& element) const {
        const PlyProperty* result = nullptr;
        for (const char* name : {"vertex_indices", "vertex_index"}) {
            const PlyProperty* list = element.find(name);
            if (list == nullptr || !list->count_type) continue;
            if (result != nullptr && element.count > 0) {
                values_.refuse(text("the element '", printable(element.name),
                                    "' has the lists 'vertex_indices' and 'vertex_index', and only one can count. "
                                    "Export the file again."));
            }
            result = list;
        }
        return result;
    }

    /// Returns whether an element that the format does not define has a list of integers or of vertices, or three
    /// integers.
    static bool may_be_faces(const PlyElement& element) {
        if (element.name == "vertex" || element.name == "edge" || element.name == "material") return false;
        std::size_t integers = 0;
        for (const PlyProperty& property : element.properties) {
            if (property.count_type && lower_case(property.name).find("vertex") != std::string::npos) return true;
            if (is_integer(property.type)) integers += property.count_type ? 3u : 1u;
        }
        return integers >= 3;
    }

    void read_vertices(const PlyElement& element) {
        std::vector<std::size_t> axis_of(element.properties.size(), 3);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const PlyProperty* property = element.find(std::string_view("xyz").substr(axis, 1));
            if (property == nullptr || property->count_type) {
                values_.refuse(text("the vertices have no property '", "xyz"[axis],
                                    "'. Export the file again with coordinates x, y, z."));
            }
            axis_of[static_cast<std::size_t>(property - element.properties.data())] = axis;
        }
        if (element.count >= no_vertex)
            values_.refuse("the header states more than 4294967294 vertices. Split the mesh.");
        positions_.reserve(std::min(element.count, values_.room_for(element)));
        for (std::uint64_t i = 0; i < element.count; ++i) {
            values_.begin_element(element);
            double coordinates[4];
            for (std::size_t at = 0; at < axis_of.size(); ++at) {
                const PlyProperty& property = element.properties[at];
                if (axis_of[at] < 3) {
                    coordinates[axis_of[at]] = values_.coordinate(property.type);
                } else {
                    values_.skip(property.type, property.count_type ? count_of(*property.count_type) : 1);
                }
            }
            values_.end_element();
            positions_.push_back({coordinates[0], coordinates[1], coordinates[2]});
            not_finite_.look_at(i, positions_.back(),
                                [&] { return text(values_.place(), ": vertex ", i, ", counted from 0,"); });
        }
    }

    std::uint64_t count_of(PlyType type) {
        const std::int64_t count = values_.integer(type);
        if (count < 0) values_.refuse("a list has a negative length.");
        return static_cast<std::uint64_t>(count);
    }

    /// Calls `add` for each list of vertices, which is in list_ then.
    template <class Add>
    void read_lists(const PlyElement& element, const Add& add) {
        const PlyProperty* list = list_of_vertices(element);
        if (list == nullptr) {
            if (element.count == 0) return values_.skip_elements(element);
            values_.refuse(text("the element '", printable(element.name),
                                "' has no list 'vertex_indices' or 'vertex_index'. Export the file again."));
        }
        if (!is_integer(list->type)) values_.refuse("the numbers of vertices are integers. Export the file again.");
        for (std::uint64_t i = 0; i < element.count; ++i) {
            values_.begin_element(element);
            for (const PlyProperty& property : element.properties) {
                const std::uint64_t count = property.count_type ? count_of(*property.count_type) : 1;
                if (&property != list) {
                    values_.skip(property.type, count);
                    continue;
                }
                list_.clear();
                for (std::uint64_t entry = 0; entry < count; ++entry) list_.push_back(values_.integer(property.type));
            }
            values_.end_element();
            add();
        }
    }

    /// The vertex, or a number that no vertex has, which the baker refuses or drops.
    std::uint32_t checked(std::int64_t vertex) {
        if (vertex >= 0 && static_cast<std::uint64_t>(vertex) < positions_.size()) {
            return static_cast<std::uint32_t>(vertex);
        }
        missing_vertices_.add([&] {
            return words_for_missing(values_.place() + ": a face", values_.written(vertex), positions_.size(), 0);
        });
        return vertex < 0 || vertex > no_vertex ? no_vertex : static_cast<std::uint32_t>(vertex);
    }

    void add_face() {
        if (list_.size() < 3) {
            ++file_.record().points_and_lines;
            return;
        }
        corners_.clear();
        for (const std::int64_t vertex : list_) corners_.push_back(checked(vertex));
        not_finite_.check(corners_, file_.record(), options_, 0, triangles_.size());
        const PolygonCut cut = cutter_.cut_face(corners_, positions_, triangles_);
        if (cut == PolygonCut::too_tangled) values_.refuse(tangled_polygon_words);
        if (cut == PolygonCut::crossing && crossing_++ == 0) first_crossing_ = values_.place();
    }

    /// A negative number ends a strip. Every second triangle of a strip runs the other way round.
    void add_strips() {
        std::size_t begin = 0;
        for (std::size_t at = 0; at < list_.size(); ++at) {
            if (list_[at] < 0) {
                begin = at + 1;
                continue;
            }
            if (at < begin + 2) continue;
            const std::uint32_t corners[] = {checked(list_[at - 2]), checked(list_[at - 1]), checked(list_[at])};
            not_finite_.check(corners, file_.record(), options_, 0, triangles_.size());
            const bool turned = (at - begin) % 2 == 1;
            const TriangleVertices triangle{corners[turned ? 1 : 0], corners[turned ? 0 : 1], corners[2]};
            if (!repeats_a_vertex(triangle, positions_.size())) triangles_.push_back(triangle);
        }
    }

    void warn(const char* kind, const std::string& message) { file_.warn(kind, ": " + message); }

    void finish() {
        missing_vertices_.report(file_.record(), options_);
        if (crossing_ > 0) {
            warn("crossing_polygon", text(counted(crossing_, "face"),
                                          " with an outline that crosses itself, the first at ", first_crossing_,
                                          "; its triangles may cover more or less than meant. Triangulate it before "
                                          "export."));
        }
        if (values_.has_more()) {
            warn("trailing_bytes", text("after the elements that the header states more follows, from ",
                                        values_.place(), " on; it was not read."));
        }
        if (!options_.keep_vertices) file_.record().points_and_lines += unused_vertices(positions_.size(), triangles_);
        file_.add("", std::move(positions_), std::move(triangles_), {});
    }

    const PlyHeader& header_;
    Values values_;
    const ImportOptions& options_;
    UnitlessFile& file_;
    PolygonCutter cutter_;
    std::vector<Vec3d> positions_;
    std::vector<TriangleVertices> triangles_;
    std::vector<std::int64_t> list_;
    std::vector<std::uint32_t> corners_;
    MissingVertices missing_vertices_;
    NotFiniteVertices not_finite_;
    std::uint64_t crossing_ = 0;
    std::string first_crossing_;
};

template <class Values>
void read_values(const PlyHeader& header, const std::string& content, const ImportOptions& options,
                 UnitlessFile& file) {
    PlyReader<Values>(header, Values(file.path(), header, content), options, file).read();
}

}  // namespace

void import_ply(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    UnitlessFile file(path, "PLY", options, imported);
    std::string content = utf8_text(read_bytes(path));
    const PlyHeader header = read_ply_header(path, content);
    if (header.form == PlyForm::text) {
        file.leave_out_zero_bytes(content);
        read_values<PlyText>(header, content, options, file);
    } else {
        read_values<PlyBytes>(header, content, options, file);
    }
    file.finish();
}

}  // namespace espalier::importer
