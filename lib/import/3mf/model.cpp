#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <import/3mf/extensions.hpp>
#include <import/3mf/package.hpp>
#include <import/3mf/xml.hpp>
#include <import/base/error.hpp>
#include <import/base/missing_vertices.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

constexpr std::uint32_t beyond_all = std::numeric_limits<std::uint32_t>::max();
constexpr std::pair<std::string_view, double> units[] = {{"millimeter", 0.001}, {"micron", 1e-6}, {"centimeter", 0.01},
                                                         {"inch", 0.0254},      {"foot", 0.3048}, {"meter", 1.0}};
constexpr std::string_view object_types[] = {"model", "support", "solidsupport", "surface", "other"};

/// What an element belongs to, by the elements around it.
enum class Place {
    outside,
    model,
    resources,
    base_materials,
    object,
    mesh,
    vertices,
    triangles,
    components,
    build,
    elsewhere,  ///< of an extension, or without a meaning for geometry
};

class ModelReader : public XmlHandler {
public:
    ModelReader(std::size_t model, const ImportOptions& options, ImportedFile& file, ThreeMfPackage& package)
        : model_(model), options_(options), file_(file), package_(package) {}

    void name_space(std::string_view prefix, std::string_view name) override { prefixes_[std::string(prefix)] = name; }

    void begin(const XmlElement& element) override {
        line_ = element.line();
        const Place outer = places_.back();
        const bool is_core =
            element.name_space().empty() || element.name_space().find("/core/") != std::string_view::npos;
        places_.push_back(is_core ? read(outer, element) : Place::elsewhere);
        // Slices repeat a mesh that is there, unless they are required.
        if (is_core || outer == Place::elsewhere) return;
        const std::string_view extension = name_of_3mf_geometry(element.name_space());
        if (extension.empty() || extension == "slices" || !left_out_.insert(extension).second) return;
        add_warning(file_, "extension_left_out",
                    text(words(), ", line ", line_, ": '", printable(element.name()), "' of the 3MF extension for ",
                         extension, " is not read, and its geometry was left out. Export it as a mesh."));
    }

    void end() override {
        if (places_.back() == Place::mesh) end_mesh();
        places_.pop_back();
    }

    void finish() { missing_vertices_.report(file_, options_); }

    [[nodiscard]] std::string words() const {
        return text('\'', printable(file_.path), "', ", printable(package_.models[model_]));
    }

private:
    /// Reads an element of the core specification and returns where its own elements are.
    Place read(Place outer, const XmlElement& element) {
        const std::string_view name = element.name();
        switch (outer) {
            case Place::outside:
                if (name != "model") refuse(text("the outermost element is '", printable(name), "', not 'model'"));
                read_model(element);
                return Place::model;
            case Place::model:
                if (name == "resources") return Place::resources;
                return name == "build" && is_root() ? Place::build : Place::elsewhere;
            case Place::resources:
                if (name == "basematerials") return begin_base_materials(element);
                return name == "object" ? begin_object(element) : Place::elsewhere;
            case Place::base_materials:
                if (name == "base") add_base_material(element);
                return Place::elsewhere;
            case Place::object:
                if (name == "mesh") return Place::mesh;
                return name == "components" ? Place::components : Place::elsewhere;
            case Place::mesh:
                if (name == "vertices") return Place::vertices;
                return name == "triangles" ? Place::triangles : Place::elsewhere;
            case Place::vertices:
                if (name == "vertex") read_vertex(element);
                return Place::elsewhere;
            case Place::triangles:
                if (name == "triangle") read_triangle(element);
                return Place::elsewhere;
            case Place::components:
                if (name == "component") read_component(element);
                return Place::elsewhere;
            case Place::build:
                if (name == "item") package_.items.push_back(use(element));
                return Place::elsewhere;
            case Place::elsewhere:
                break;
        }
        return Place::elsewhere;
    }

    void read_model(const XmlElement& element) {
        Words required(element.attribute("requiredextensions").value_or(""));
        std::set<std::string_view> known_prefixes;
        for (std::string_view prefix = required.next(); !prefix.empty(); prefix = required.next()) {
            if (!known_prefixes.insert(prefix).second) continue;
            const auto found = prefixes_.find(prefix);
            require_known_3mf_extension(words(), found == prefixes_.end() ? prefix : found->second, file_);
        }
        const std::string stated(element.attribute("unit").value_or(""));
        const std::string_view unit = stated.empty() ? units[0].first : std::string_view(stated);
        const auto* const known =
            std::find_if(std::begin(units), std::end(units), [unit](const auto& each) { return each.first == unit; });
        if (known == std::end(units)) {
            refuse(text("its unit '", printable(stated), "' is none of 3MF"), "State the unit with --unit.");
        }
        if (is_root()) {
            package_.unit = stated;
            package_.metres_per_unit = known->second;
        } else if (known->second != package_.metres_per_unit) {
            refuse(text("its unit is ", unit, ", and that of the model which places its objects is ",
                        package_.unit.empty() ? units[0].first : std::string_view(package_.unit)));
        }
    }

    Place begin_base_materials(const XmlElement& element) {
        material_groups_.emplace(number(element, "id"), base_materials_.size());
        base_materials_.push_back({package_.materials.size(), 0});
        return Place::base_materials;
    }

    void add_base_material(const XmlElement& element) {
        ++base_materials_.back().count;
        package_.materials.emplace_back(element.attribute("name").value_or(""));
    }

    Place begin_object(const XmlElement& element) {
        const std::uint32_t id = number(element, "id");
        ThreeMfObject object;
        object.name = element.attribute("name").value_or("");
        label_ = text("object ", id, object.name.empty() ? "" : text(" (", printable(object.name), ")"));
        object.words = text('\'', printable(file_.path), "', ", label_);
        const std::string_view type = element.attribute("type").value_or("model");
        if (std::find(std::begin(object_types), std::end(object_types), type) == std::end(object_types))
            refuse(text("object ", id, " has the type '", printable(type), "', which 3MF does not have"));
        object.is_other = type == "other";
        if (!package_.numbers.emplace(std::pair(model_, id), package_.objects.size()).second)
            refuse(text("two objects have the id ", id));
        package_.objects.push_back(std::move(object));
        object_group_ = element.attribute("pid");
        object_material_ = material(element, object_group_, "pindex", 0);
        return Place::object;
    }

    void read_vertex(const XmlElement& element) {
        std::array<double, 3> numbers{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string_view name = std::string_view("xyz").substr(axis, 1);
            const std::string_view word = trimmed(element.attribute(name).value_or(""));
            const std::optional<double> value = parse_coordinate(word);
            if (!value)
                refuse(text("a vertex has ", name, " = '", printable(word.substr(0, 40)), "', which is no number"));
            numbers[axis] = *value;
        }
        object().positions.push_back({numbers[0], numbers[1], numbers[2]});
    }

    void read_triangle(const XmlElement& element) {
        TriangleVertices triangle{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            constexpr std::string_view names[] = {"v1", "v2", "v3"};
            const std::string_view word = trimmed(element.attribute(names[corner]).value_or(""));
            const std::optional<std::int64_t> vertex = parse_integer(word);
            if (!vertex)
                refuse(text("a triangle has ", names[corner], " = '", printable(word.substr(0, 40)),
                            "', which is no vertex"));
            triangle[corner] = *vertex < 0 || *vertex >= beyond_all ? beyond_all : static_cast<std::uint32_t>(*vertex);
            if (triangle[corner] == beyond_all) add_missing(object().triangles.size(), word);
        }
        object().triangles.push_back(triangle);
        const auto group = element.attribute("pid");
        object().materials.push_back(material(element, group ? group : object_group_, "p1", object_material_));
    }

    /// Vertices may follow the triangles.
    void end_mesh() {
        const ThreeMfObject& mesh = object();
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (const std::uint32_t vertex : mesh.triangles[i])
                if (vertex != beyond_all && vertex >= mesh.positions.size()) add_missing(i, text(vertex));
    }

    void add_missing(std::size_t triangle, std::string_view number) {
        missing_vertices_.add([&] {
            return text(label_, ": triangle ", triangle, " names vertex ", written_number(number),
                        ", and its mesh has ", counted(object().positions.size(), "vertex"), ", counted from 0");
        });
    }

    void read_component(const XmlElement& element) { object().components.push_back(use(element)); }

    [[nodiscard]] ThreeMfUse use(const XmlElement& element) {
        const auto path = element.attribute_of("/production/", "path");
        ThreeMfUse result{path ? package_.model_number(*path) : model_, number(element, "objectid"), {}};
        if (const auto transform = element.attribute("transform")) result.placement = placement(*transform);
        return result;
    }

    /// Twelve numbers by rows, of a matrix that follows the point: the last row is the translation.
    [[nodiscard]] Placement placement(std::string_view transform) const {
        std::array<double, 12> numbers{};
        Words words(transform);
        for (double& number : numbers) {
            const std::optional<double> value = parse_double(std::string(words.next()));
            if (!value || !std::isfinite(*value)) refuse("a transform has not twelve finite numbers");
            number = *value;
        }
        if (!words.next().empty()) refuse("a transform has more than twelve numbers");
        Placement result;
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column < 3; ++column) result.linear[row][column] = numbers[3 * column + row];
            result.offset[row] = numbers[9 + row];
        }
        return result;
    }

    /// The number of a base material; 0 for properties of another kind, such as colours, which are no materials.
    [[nodiscard]] std::uint32_t material(const XmlElement& element, std::optional<std::string_view> group,
                                         std::string_view index_name, std::uint32_t otherwise) const {
        const auto index = element.attribute(index_name);
        if (!group || !index) return otherwise;
        const std::optional<std::int64_t> id = parse_integer(trimmed(*group)), number = parse_integer(trimmed(*index));
        const auto found = id ? material_groups_.find(*id) : material_groups_.end();
        if (found == material_groups_.end()) return 0;
        const BaseMaterials& known = base_materials_[found->second];
        if (!number || *number < 0 || static_cast<std::uint64_t>(*number) >= known.count)
            refuse(
                text(index_name, " is '", printable(*index), "', and the group has ", known.count, " base materials"));
        return static_cast<std::uint32_t>(known.first + static_cast<std::uint64_t>(*number));
    }

    [[nodiscard]] std::uint32_t number(const XmlElement& element, std::string_view name) const {
        const std::string_view word = trimmed(element.attribute(name).value_or(""));
        const std::optional<std::int64_t> value = parse_integer(word);
        if (!value || *value < 0 || *value >= beyond_all)
            refuse(text("'", element.name(), "' has ", name, " = '", printable(word.substr(0, 40)),
                        "', which is no number"));
        return static_cast<std::uint32_t>(*value);
    }

    static std::string_view trimmed(std::string_view word) { return Words(word).rest(); }

    [[nodiscard]] ThreeMfObject& object() const { return package_.objects.back(); }

    [[noreturn]] void refuse(const std::string& problem, const char* remedy = "Export it again.") const {
        throw_error(ImportStatus::invalid_input, words(), ", line ", line_, ": ", problem, ". ", remedy);
    }

    /// The build of other models places nothing.
    [[nodiscard]] bool is_root() const { return model_ == 0; }

    struct BaseMaterials {
        std::uint64_t first;  ///< the number of the first
        std::uint64_t count;
    };

    std::size_t model_;
    const ImportOptions& options_;
    ImportedFile& file_;
    ThreeMfPackage& package_;
    std::uint64_t line_ = 1;
    std::vector<Place> places_ = {Place::outside};
    std::map<std::string, std::string, std::less<>> prefixes_;
    std::set<std::string_view> left_out_;
    std::vector<BaseMaterials> base_materials_;
    std::map<std::int64_t, std::size_t> material_groups_;  // in base_materials_, by the first group's id
    std::string label_;                                    // of the object
    std::optional<std::string> object_group_;
    std::uint32_t object_material_ = 0;
    MissingVertices missing_vertices_;
};

}  // namespace

void read_3mf_model(std::size_t model, std::string_view xml, const ImportOptions& options, ImportedFile& file,
                    ThreeMfPackage& package) {
    ModelReader reader(model, options, file, package);
    parse_xml(reader.words(), xml, reader);
    reader.finish();
}

}  // namespace espalier::importer
