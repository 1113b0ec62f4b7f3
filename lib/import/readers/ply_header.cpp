#include <import/readers/ply.hpp>

#include <set>

namespace espalier::importer {

namespace {

std::optional<PlyType> type_named(std::string_view name) {
    /// Both names of each type.
    static constexpr std::array<std::string_view, 2> names[] = {
        {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
        {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"},
    };
    for (std::size_t type = 0; type < std::size(names); ++type)
        if (name == names[type][0] || name == names[type][1]) return static_cast<PlyType>(type);
    return std::nullopt;
}

class HeaderReader {
public:
    HeaderReader(const std::string& path, std::string_view content) : path_(path), lines_(content) {}

    PlyHeader read() {
        std::string_view line;
        if (!lines_.next(line) || Words(line).next() != "ply") {
            throw_file_error(ImportStatus::invalid_input, path_,
                             " is no PLY: it does not begin with 'ply'. Is it whole, and "
                             "named with its format's ending?");
        }
        bool has_form = false;
        while (lines_.next(line)) {
            Words words(line);
            const std::string_view keyword = words.next();
            if (keyword == "end_header") {
                if (!has_form) refuse("the header has no line 'format'.");
                header_.bytes = lines_.offset();
                header_.lines = lines_.number();
                return std::move(header_);
            }
            if (keyword == "format") {
                has_form = true;
                read_form(words);
            } else if (keyword == "element") {
                read_element(words);
            } else if (keyword == "property") {
                read_property(words);
            } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info" && !header_.elements.empty()) {
                // Before the elements nothing is lost: Blender 2.4 left out the word "comment" there.
                refuse(text("'", printable(keyword.substr(0, 40)), "' is no statement of a PLY header."));
            }
        }
        refuse_line(path_, lines_.number(), "the header has no end. Is the file whole?");
    }

private:
    void read_form(Words& words) {
        const std::string_view form = words.next();
        if (form == "ascii") {
            header_.form = PlyForm::text;
        } else if (form == "binary_little_endian") {
            header_.form = PlyForm::little_endian;
        } else if (form == "binary_big_endian") {
            header_.form = PlyForm::big_endian;
        } else {
            refuse(text("the format '", printable(form.substr(0, 40)), "' is not known."));
        }
    }

    void read_element(Words& words) {
        PlyElement element;
        element.name = words.next();
        const auto count = parse_integer(words.next());
        if (element.name.empty() || !count || *count < 0) refuse("an element needs a name and how many there are.");
        if (!elements_.insert(element.name).second) {
            refuse(text("the element '", printable(element.name), "' is there twice."));
        }
        properties_.clear();
        element.count = static_cast<std::uint64_t>(*count);
        header_.elements.push_back(std::move(element));
    }

    void read_property(Words& words) {
        if (header_.elements.empty()) refuse("a property comes before the first element.");
        PlyProperty property;
        std::string_view type = words.next();
        if (type == "list") {
            property.count_type = read_type(words.next());
            if (!is_integer(*property.count_type)) refuse("the number of entries of a list is an integer.");
            type = words.next();
        }
        property.type = read_type(type);
        property.name = words.next();
        if (property.name.empty()) refuse("a property needs a name.");
        if (!properties_.insert(property.name).second) {
            refuse(text("the element '", printable(header_.elements.back().name), "' has the property '",
                        printable(property.name), "' twice."));
        }
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType read_type(std::string_view name) const {
        const auto type = type_named(name);
        if (!type) refuse(text("'", printable(name.substr(0, 40)), "' is no type of PLY."));
        return *type;
    }

    [[noreturn]] void refuse(const std::string& problem) const {
        refuse_line(path_, lines_.number(), text(problem, " Correct it, or export the file again."));
    }

    const std::string& path_;
    Lines lines_;
    PlyHeader header_;
    std::set<std::string> elements_;
    std::set<std::string> properties_;  // of the last element
};

}  // namespace

bool PlyElement::has_list() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const PlyProperty& property) { return property.count_type.has_value(); });
}

std::size_t PlyElement::least_bytes() const {
    std::size_t bytes = 0;
    for (const PlyProperty& property : properties) bytes += size_of(property.count_type.value_or(property.type));
    return bytes;
}

const PlyProperty* PlyElement::find(std::string_view property) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [property](const PlyProperty& candidate) { return candidate.name == property; });
    return found == properties.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(const std::string& path, std::string_view content) {
    return HeaderReader(path, content).read();
}

}  // namespace espalier::importer
