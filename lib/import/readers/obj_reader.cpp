#include <import/base/importers.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include <import/base/mesh_collector.hpp>
#include <import/base/missing_vertices.hpp>
#include <import/base/not_finite_vertices.hpp>
#include <import/base/occurrences.hpp>
#include <import/base/polygon.hpp>
#include <import/base/text_file.hpp>
#include <import/readers/obj_materials.hpp>
#include <import/readers/obj_names.hpp>

namespace espalier::importer {

namespace {

constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t lines_per_progress = 1 << 16;

/// Statements that change no triangle.
constexpr std::string_view harmless_statements[] = {
    "vt",   "vn",       "vp",       "s",     "mg",    "usemap", "maplib", "shadow_obj", "trace_obj",
    "lod",  "d_interp", "c_interp", "bevel", "ctech", "stech",  "cstype", "deg",        "bmat",
    "step", "parm",     "trim",     "hole",  "scrv",  "sp",     "end",    "con",        "usemat",
};
/// Statements of names, which may end with a backslash as folders do.
constexpr std::string_view naming[] = {"o",      "g",      "usemtl",     "mtllib",   "usemap",
                                       "maplib", "usemat", "shadow_obj", "trace_obj"};
/// Statements that add a surface or a curve, which no triangle of the file approximates.
constexpr std::string_view free_form[] = {"surf", "curv", "curv2", "bsp", "bzp", "cdc", "cdp", "res"};

template <std::size_t count>
bool contains(const std::string_view (&words)[count], std::string_view word) {
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

struct Face {
    std::uint32_t mesh;
    std::uint32_t material;
    std::uint32_t line;
    std::uint32_t corners;
};

class ObjReader {
public:
    ObjReader(const std::string& path, const ImportOptions& options, ImportResult& imported)
        : options_(options), file_(path, "Wavefront OBJ", options, imported) {}

    void read() {
        std::string content = utf8_text(read_bytes(file_.path()));
        file_.leave_out_zero_bytes(content);
        if (const std::size_t zero = content.find('\0'); zero != std::string::npos) {
            throw_file_error(ImportStatus::invalid_input, file_.path(), " is no Wavefront OBJ: byte ", zero,
                             " is zero, and OBJ is text. Name the file with its format's ending.");
        }
        Lines lines(content);
        for (std::string_view line; lines.next(line);) {
            line_ = lines.number();
            if (line_ % lines_per_progress == 0)
                show_reading(options_, static_cast<double>(lines.offset()), static_cast<double>(content.size()));
            read_line(joined(line, lines));
        }
        if (options_.keep_vertices) {
            add_one_mesh();
        } else {
            add_meshes();
        }
        warn();
        set_materials(file_.record(), materials_.names());
        file_.finish();
    }

private:
    /// A backslash at the end of a line continues it in the next one. In comments it is text, and in a name too:
    /// between names it is a word of its own.
    static bool continues(std::string_view line, bool is_naming) {
        if (!line.ends_with('\\')) return false;
        Words words(line);
        std::string_view last;
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            if (word.starts_with('#')) return false;
            last = word;
        }
        return !is_naming || last == "\\";
    }

    std::string_view joined(std::string_view line, Lines& lines) {
        const bool is_naming = contains(naming, Words(line).next());
        if (!continues(line, is_naming)) return line;
        joined_.clear();
        bool more = true;
        while (more) {
            more = continues(line, is_naming);
            joined_.append(line.substr(0, line.size() - (more ? 1 : 0)));
            joined_ += ' ';
            more = more && lines.next(line);
        }
        return joined_;
    }

    void read_line(std::string_view line) {
        Words words(line);
        const std::string_view keyword = words.next();
        if (keyword.empty() || keyword[0] == '#') return;
        if (keyword == "v") {
            read_vertex(words);
        } else if (keyword == "f" || keyword == "fo") {
            read_face(words);
        } else if (keyword == "p") {
            file_.record().points_and_lines += read_corners(words, loose_);
        } else if (keyword == "l") {
            read_corners(words, loose_);
            ++file_.record().points_and_lines;
        } else if (keyword == "o") {
            names_.set_object(words.rest());
            mesh_ = no_number;
        } else if (keyword == "g") {
            names_.set_group(words.rest());
            mesh_ = no_number;
        } else if (keyword == "usemtl") {
            material_ = words.rest().empty() ? 0 : materials_.number_of(words.rest());
        } else if (keyword == "mtllib") {
            materials_.read_libraries(file_.path(), words.rest(), file_.record().opened);
        } else if (contains(free_form, keyword)) {
            free_form_.add(line_);
        } else if (keyword == "call" || keyword == "csh") {
            refuse(text("statement '", keyword,
                        "' runs another file or a command, which is not supported. Export the geometry itself."));
        } else if (!contains(harmless_statements, keyword)) {
            if (unknown_.count == 0) unknown_word_ = printable(keyword.substr(0, 40));
            unknown_.add(line_);
        }
    }

    void read_vertex(Words& words) {
        std::array<double, 4> numbers{0.0, 0.0, 0.0, 1.0};
        std::size_t count = 0;
        for (std::string_view word = next_word(words); !word.empty(); word = next_word(words), ++count) {
            const auto number = parse_coordinate(word);
            if (!number)
                refuse(text('\'', printable(word), "' is not a number. Correct it, or export the file again."));
            if (count < numbers.size()) numbers[count] = *number;  // a colour may follow
        }
        if (count < 3) refuse(text("a vertex has ", count, " coordinates, not 3. Is the file whole?"));
        if (count == 4 && numbers[3] != 1.0) weights_.add(line_);
        if (positions_.size() >= no_number) refuse("the file has more than 4294967295 vertices. Split it.");
        positions_.push_back({numbers[0], numbers[1], numbers[2]});
        not_finite_.look_at(positions_.size() - 1, positions_.back(),
                            [&] { return text("line ", line_, ": vertex ", positions_.size(), ", counted from 1,"); });
    }

    /// A '#' in a list of numbers begins a comment.
    static std::string_view next_word(Words& words) {
        const std::string_view word = words.next();
        if (!word.starts_with('#')) return word;
        words = Words({});
        return {};
    }

    /// Appends the vertices of "7", "7/1", "7//3" or "7/1/3" and returns how many they are. Negative numbers count back
    /// from the last vertex; positive ones may name vertices that follow.
    std::uint32_t read_corners(Words& words, std::vector<std::uint32_t>& corners) {
        std::uint32_t count = 0;
        written_.clear();
        for (std::string_view word = next_word(words); !word.empty(); word = next_word(words), ++count) {
            const std::string_view written = word.substr(0, word.find('/'));
            const auto number = parse_integer(written);
            if (!number) {
                refuse(text('\'', printable(word),
                            "' is not the number of a vertex. Correct it, or export the file again."));
            }
            const std::int64_t vertex = *number > 0 ? *number - 1
                                        : *number < 0 && *number >= -static_cast<std::int64_t>(positions_.size())
                                            ? static_cast<std::int64_t>(positions_.size()) + *number
                                            : no_number;
            corners.push_back(static_cast<std::uint32_t>(std::min<std::int64_t>(vertex, no_number)));
            written_.push_back(written);
        }
        return count;
    }

    void read_face(Words& words) {
        const std::uint32_t count = read_corners(words, corners_);
        if (count < 3) {
            loose_.insert(loose_.end(), corners_.end() - count, corners_.end());
            corners_.resize(corners_.size() - count);
            ++file_.record().points_and_lines;
            short_faces_.add(line_);
            return;
        }
        for (std::uint32_t i = 0; i < count; ++i)
            if (corners_[corners_.size() - count + i] == no_number) add_missing(line_, written_[i]);
        if (mesh_ == no_number) mesh_ = names_.mesh();
        faces_.push_back(
            {mesh_, material_, static_cast<std::uint32_t>(std::min<std::uint64_t>(line_, no_number)), count});
    }

    /// A number below 0 counts back from the vertices before the face, which may be fewer than the file's.
    void add_missing(std::uint64_t line, std::string_view number) {
        missing_vertices_.add([&] {
            const std::string place = text("line ", line, ": a face");
            if (!number.starts_with('-')) return words_for_missing(place, number, positions_.size(), 1);
            return text(place, " names vertex ", written_number(number), ", counted back, and ",
                        counted(positions_.size(), "vertex"), " precede it");
        });
    }

    void add_meshes() {
        // Counting sort: the faces of each mesh, in the order of the file.
        std::vector<std::uint64_t> begins(names_.count() + 1);
        for (const Face& face : faces_) ++begins[face.mesh + 1];
        for (std::size_t mesh = 0; mesh < names_.count(); ++mesh) begins[mesh + 1] += begins[mesh];
        struct Place {
            std::uint64_t face;
            std::uint64_t corner;
        };
        std::vector<Place> order(faces_.size());
        auto next = begins;
        std::uint64_t corner = 0;
        for (std::size_t face = 0; face < faces_.size(); ++face) {
            order[next[faces_[face].mesh]++] = {face, corner};
            corner += faces_[face].corners;
        }
        owners_.assign(positions_.size(), no_number);
        locals_.resize(positions_.size());
        for (std::uint32_t mesh = 0; mesh < names_.count(); ++mesh) {
            ObjMesh target{mesh, {}, {}, {}};
            for (std::uint64_t at = begins[mesh]; at < begins[mesh + 1]; ++at) {
                const Face& face = faces_[order[at].face];
                add_face(face, std::span(corners_).subspan(order[at].corner, face.corners), target);
            }
            file_.add(names_.name_of(mesh), std::move(target.positions), std::move(target.triangles),
                      std::move(target.materials));
        }
        count_unused_vertices();
    }

    /// All faces and vertices in the order of the file (ImportOptions::keep_vertices).
    void add_one_mesh() {
        ObjMesh target{0, positions_, {}, {}};
        owners_.assign(positions_.size(), target.number);
        locals_.resize(positions_.size());
        std::iota(locals_.begin(), locals_.end(), 0u);
        std::size_t corner = 0;
        for (const Face& face : faces_) {
            add_face(face, std::span(corners_).subspan(corner, face.corners), target);
            corner += face.corners;
        }
        file_.add(names_.count() == 1 ? names_.name_of(0) : "", std::move(target.positions),
                  std::move(target.triangles), std::move(target.materials));
    }

    struct ObjMesh {
        std::uint32_t number;
        std::vector<Vec3d> positions;
        std::vector<TriangleVertices> triangles;
        std::vector<std::uint32_t> materials;
    };

    void add_face(const Face& face, std::span<const std::uint32_t> corners, ObjMesh& mesh) {
        local_corners_.clear();
        not_finite_.check(corners, file_.record(), options_, mesh.number, mesh.triangles.size());
        for (const std::uint32_t vertex : corners) {
            if (vertex >= positions_.size()) {
                if (vertex != no_number) add_missing(face.line, text(std::uint64_t{vertex} + 1));
                local_corners_.push_back(vertex);  // no vertex of the mesh either
                continue;
            }
            if (owners_[vertex] != mesh.number) {
                owners_[vertex] = mesh.number;
                locals_[vertex] = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.push_back(positions_[vertex]);
            }
            local_corners_.push_back(locals_[vertex]);
        }
        const PolygonCut cut = cutter_.cut_face(local_corners_, mesh.positions, mesh.triangles);
        if (cut == PolygonCut::too_tangled) refuse_line(file_.path(), face.line, tangled_polygon_words);
        if (cut == PolygonCut::crossing) crossing_.add(face.line);
        mesh.materials.resize(mesh.triangles.size(), face.material);
    }

    void count_unused_vertices() {
        for (const std::uint32_t vertex : loose_) {
            if (vertex < owners_.size()) owners_[vertex] = 0;
        }
        file_.record().points_and_lines +=
            static_cast<std::uint64_t>(std::count(owners_.begin(), owners_.end(), no_number));
    }

    void warn() {
        missing_vertices_.report(file_.record(), options_);
        short_faces_.warn(
            file_, "short_face",
            "a face has fewer than three corners, and was left out. Correct it, or export the file again.");
        crossing_.warn(file_, "crossing_polygon", crossing_polygon_words);
        free_form_.warn(file_, "free_form", "a free-form curve or surface was left out. Export it as polygons.");
        weights_.warn(file_, "vertex_weight",
                      "the fourth number of a vertex is not 1; it was ignored, and x, y, z were not divided by it.");
        unknown_.warn(file_, "unknown_statement",
                      text("'", unknown_word_, "' is no statement of Wavefront OBJ; the line was left out."));
        warn_about_materials();
    }

    void warn_about_materials() {
        const auto& missing = materials_.first_missing();
        if (!options_.materials || !missing) return;
        const auto is_changed = [&](const Face& face) { return face.material >= missing->first_changed; };
        if (std::none_of(faces_.begin(), faces_.end(), is_changed)) return;
        file_.warn("missing_file", text(": the library '", printable(missing->name),
                                        "' is missing, so materials may have other numbers than with it. Put it beside "
                                        "the file."));
    }

    [[noreturn]] void refuse(const std::string& problem) const { refuse_line(file_.path(), line_, problem); }

    const ImportOptions& options_;
    UnitlessFile file_;
    ObjMaterials materials_;
    PolygonCutter cutter_;
    std::uint64_t line_ = 0;
    std::string joined_;

    std::vector<Vec3d> positions_;
    std::vector<Face> faces_;
    std::vector<std::uint32_t> corners_;     // of the faces, one after the other
    std::vector<std::string_view> written_;  // the numbers of a line's corners
    std::vector<std::uint32_t> loose_;       // of points and lines
    ObjNames names_;
    std::uint32_t mesh_ = no_number;  // none for the names yet
    std::uint32_t material_ = 0;

    std::vector<std::uint32_t> owners_;  // the mesh that used a vertex last,
    std::vector<std::uint32_t> locals_;  // and its number there
    std::vector<std::uint32_t> local_corners_;

    MissingVertices missing_vertices_;
    NotFiniteVertices not_finite_;
    Occurrences short_faces_;
    Occurrences crossing_;
    Occurrences free_form_;
    Occurrences weights_;
    Occurrences unknown_;
    std::string unknown_word_;
};

}  // namespace

void import_obj(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    ObjReader(path, options, imported).read();
}

}  // namespace espalier::importer
