#include <import/base/importers.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include <import/base/mesh_collector.hpp>
#include <import/base/not_finite_vertices.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

// Binary: 80 bytes of any content, the count, and for each triangle a normal, three corners and 16 bits.
constexpr std::size_t stl_header_bytes = 84;
constexpr std::size_t triangle_bytes = 50;
constexpr std::size_t normal_bytes = 12;

bool is_word(std::string_view word, std::string_view lower_case) {
    return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

void read_binary(std::string_view bytes, UnitlessFile& file) {
    if (bytes.size() < stl_header_bytes) {
        throw_file_error(ImportStatus::invalid_input, file.path(),
                         " is no STL: it does not begin with 'solid', and with ", bytes.size(),
                         " bytes it is too short for the binary form. Is the file whole?");
    }
    const std::uint64_t count = little_endian<std::uint32_t>(bytes.data() + 80);
    const std::size_t stored = (bytes.size() - stl_header_bytes) / triangle_bytes;
    if (count > stored) {
        throw_file_error(ImportStatus::invalid_input, file.path(), " is no whole binary STL: it states ",
                         counted(count, "triangle"), ", and its ", bytes.size(), " bytes have room for ", stored,
                         ". It is no text either: that begins with 'solid' and has no zero byte. Export it "
                         "again.");
    }
    std::vector<Vec3d> corners;
    corners.reserve(3 * count);
    for (std::size_t triangle = 0; triangle < count; ++triangle) {
        const char* corner = bytes.data() + stl_header_bytes + triangle * triangle_bytes + normal_bytes;
        for (int i = 0; i < 3; ++i, corner += 12) {
            const auto coordinate = [corner](int axis) { return double(little_endian<float>(corner + 4 * axis)); };
            corners.push_back({coordinate(0), coordinate(1), coordinate(2)});
        }
    }
    const std::size_t unread = bytes.size() - stl_header_bytes - count * triangle_bytes;
    if (unread > 0) {
        file.warn("trailing_bytes", text(": ", counted(unread, "byte"), " after the ", counted(count, "triangle"),
                                         " that the file states were not read."));
    }
    file.add_triangles("", std::move(corners));
}

class TextReader {
public:
    TextReader(std::string_view content, const ImportOptions& options, UnitlessFile& file)
        : lines_(content), options_(options), file_(file) {}

    void read() {
        for (std::string_view line; lines_.next(line);) {
            Words words(line);
            for (std::string_view word = words.next(); !word.empty(); word = words.next()) read_word(word, words);
        }
        if (state_ != State::outside && state_ != State::solid) refuse("the file ends within a facet. Is it whole?");
        if (state_ == State::solid) {
            file_.warn("missing_end",
                       text(", line ", lines_.number(), ": the file ends without 'endsolid'. Is it whole?"));
            end_solid();
        }
    }

private:
    enum class State { outside, solid, facet, loop, after_loop };

    void read_word(std::string_view word, Words& words) {
        if (is_word(word, "solid") && state_ == State::outside) {
            name_ = take_name(words);
            state_ = State::solid;
        } else if (is_word(word, "facet") && state_ == State::solid) {
            for (int i = 0; i < 4; ++i) words.next();  // the normal, which follows from the corners
            state_ = State::facet;
        } else if (is_word(word, "outer") && state_ == State::facet) {
            words.next();  // "loop"
            state_ = State::loop;
            loop_begin_ = corners_.size();
        } else if (is_word(word, "vertex") && state_ == State::loop) {
            read_corner(words);
        } else if (is_word(word, "endloop") && state_ == State::loop) {
            const std::size_t count = corners_.size() - loop_begin_;
            if (count != 3) refuse(text("a facet has ", counted(count, "corner"), ", not 3. Export the file again."));
            state_ = State::after_loop;
        } else if (is_word(word, "endfacet") && state_ == State::after_loop) {
            state_ = State::solid;
        } else if (is_word(word, "endsolid") && state_ == State::solid) {
            take_name(words);
            end_solid();
        } else {
            refuse(text("'", printable(word.substr(0, 40)), "' is not expected ", place(),
                        " of an STL text. Is the file whole?"));
        }
    }

    /// Returns a solid's name: the rest of the line, or what precedes the first "facet normal" there. The words
    /// continue behind it.
    static std::string_view take_name(Words& words) {
        const std::string_view rest = words.rest();
        Words left(rest);
        for (std::string_view word = left.next(); !word.empty(); word = left.next()) {
            if (!is_word(word, "facet") || !is_word(Words(left).next(), "normal")) continue;
            const auto length = static_cast<std::size_t>(word.data() - rest.data());
            words = Words(rest.substr(length));
            return Words(rest.substr(0, length)).rest();
        }
        words = Words({});
        return rest;
    }

    [[nodiscard]] const char* place() const {
        constexpr const char* places[] = {"outside the solids", "between the facets", "before the corners of a facet",
                                          "among the corners of a facet", "after the corners of a facet"};
        return places[static_cast<std::size_t>(state_)];
    }

    void read_corner(Words& words) {
        std::array<double, 3> numbers{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string_view word = words.next();
            if (word.empty())
                refuse(text("a vertex has ", counted(axis, "coordinate"), ", not 3: ", "xyz"[axis],
                            axis < 2 ? " and what follows it are missing" : " is missing", ". Is the file whole?"));
            const auto value = parse_coordinate(word);
            if (!value)
                refuse(text("'", printable(word), "' is not a coordinate. Correct it, or export the file again."));
            numbers[axis] = *value;
        }
        corners_.push_back({numbers[0], numbers[1], numbers[2]});
        const auto not_finite = words_for_not_finite(corners_.back());
        if (not_finite && options_.require_vertices) {
            refuse_not_finite(file_.path(), options_, text("line ", lines_.number(), ": a vertex"), *not_finite,
                              file_.record().meshes, (corners_.size() - 1) / 3);
        }
    }

    void end_solid() {
        file_.add_triangles(name_, std::move(corners_));
        corners_ = {};
        state_ = State::outside;
    }

    [[noreturn]] void refuse(const std::string& problem) const { refuse_line(file_.path(), lines_.number(), problem); }

    Lines lines_;
    const ImportOptions& options_;
    UnitlessFile& file_;
    State state_ = State::outside;
    std::string name_;
    std::vector<Vec3d> corners_;
    std::size_t loop_begin_ = 0;
};

/// Its size is that of the triangles that it states. Binary files may begin with "solid" too.
bool is_exactly_binary(std::string_view bytes) {
    return bytes.size() >= stl_header_bytes &&
           bytes.size() - stl_header_bytes ==
               triangle_bytes * std::uint64_t{little_endian<std::uint32_t>(bytes.data() + 80)};
}

bool is_text(std::string_view bytes) {
    bytes = bytes.substr(0, bytes.find_last_not_of('\0') + 1);
    if (bytes.find('\0') != std::string_view::npos) return false;
    Lines lines(bytes);
    std::string_view first;
    while (first.empty()) {
        std::string_view line;
        if (!lines.next(line)) return false;
        first = Words(line).next();
    }
    return is_word(first, "solid");
}

}  // namespace

void import_stl(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    UnitlessFile file(path, "STL", options, imported);
    std::string bytes = read_bytes(path);
    const bool is_binary = is_exactly_binary(bytes);
    if (!is_binary) bytes = utf8_text(std::move(bytes));
    if (!is_binary && is_text(bytes)) {
        file.leave_out_zero_bytes(bytes);
        TextReader(bytes, options, file).read();
    } else {
        read_binary(bytes, file);
    }
    file.finish();
}

}  // namespace espalier::importer
