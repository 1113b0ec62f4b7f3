#include <import/base/importers.hpp>

#include <array>
#include <cctype>
#include <limits>
#include <utility>

#include <import/base/mesh_collector.hpp>
#include <import/base/missing_vertices.hpp>
#include <import/base/not_finite_vertices.hpp>
#include <import/base/numbers.hpp>
#include <import/base/occurrences.hpp>
#include <import/base/polygon.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

constexpr std::uint32_t off_no_vertex = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t most_colour_numbers = 4;
// The shortest are "0 0 0 " and "0 ".
constexpr std::size_t least_vertex_bytes = 6;
constexpr std::size_t least_face_bytes = 2;

/// The words of a text, across its lines or up to the end of one. A comment begins with '#'.
class OffWords {
public:
    explicit OffWords(std::string_view content) : lines_(content) {}

    /// Returns an empty word at the end of the text.
    std::string_view next() {
        std::string_view word = next_on_line();
        while (word.empty() && next_line()) word = next_on_line();
        return word;
    }
    /// Returns an empty word at the end of the line.
    std::string_view next_on_line() { return words_.next(); }
    /// Moves to the next line with a word. Returns false if there is none.
    bool next_line() {
        for (std::string_view line; lines_.next(line);) {
            words_ = Words(line.substr(0, line.find('#')));
            if (!words_.rest().empty()) return true;
        }
        return false;
    }
    [[nodiscard]] bool has_more_on_line() const { return !words_.rest().empty(); }
    /// Returns the number of the words that are left on the line.
    [[nodiscard]] std::size_t count_on_line() const {
        Words left = words_;
        std::size_t count = 0;
        while (!left.next().empty()) ++count;
        return count;
    }
    /// Moves to the end of the line and returns how many words were left on it.
    std::size_t take_line() {
        std::size_t count = 0;
        while (!next_on_line().empty()) ++count;
        return count;
    }
    [[nodiscard]] std::uint64_t line() const { return lines_.number(); }

private:
    Lines lines_;
    Words words_{{}};
};

/// The word that a file begins with: "OFF", or "STCNOFF" with letters for what each vertex has beside its position.
struct OffKeyword {
    std::size_t more_numbers = 0;   ///< of each vertex
    bool has_more_axes = false;     ///< 4 or n: the vertices are not in space
    std::string_view glued_number;  ///< many files of a well-known collection begin with "OFF490 518 0"
};

std::optional<OffKeyword> parse_keyword(std::string_view word) {
    OffKeyword keyword;
    const auto take = [&word](std::string_view letters) {
        if (!word.starts_with(letters)) return false;
        word.remove_prefix(letters.size());
        return true;
    };
    if (take("ST")) keyword.more_numbers += 2;
    if (take("C")) keyword.more_numbers += most_colour_numbers;
    if (take("N")) keyword.more_numbers += 3;
    if (take("4")) keyword.has_more_axes = true;
    if (take("n")) keyword.has_more_axes = true;
    if (!take("OFF") && !take("off")) return std::nullopt;
    if (!word.empty() && std::isdigit(static_cast<unsigned char>(word[0])) == 0) return std::nullopt;
    keyword.glued_number = word;
    return keyword;
}

class OffReader {
public:
    OffReader(std::string_view content, const ImportOptions& options, UnitlessFile& file)
        : content_(content), words_(content), body_(content), options_(options), file_(file) {}

    void read() {
        read_header();
        read_vertices();
        for (std::uint64_t face = 0; face < face_count_; ++face) read_face(face);
        missing_vertices_.report(file_.record(), options_);
        crossing_.warn(file_, "crossing_polygon", crossing_polygon_words);
        warn_about_more();
        if (!options_.keep_vertices) file_.record().points_and_lines += unused_vertices(positions_.size(), triangles_);
        file_.add("", std::move(positions_), std::move(triangles_), {});
    }

private:
    void read_header() {
        const std::optional<OffKeyword> keyword = parse_keyword(words_.next());
        if (!keyword) {
            throw_file_error(ImportStatus::invalid_input, file_.path(),
                             " is no OFF: it does not begin with 'OFF'. Name the file with its format's ending.");
        }
        if (keyword->has_more_axes) {
            refuse(ImportStatus::unsupported,
                   "its vertices have other than three coordinates (4OFF, nOFF), and are no surface in space. Export "
                   "it as OFF.");
        }
        more_numbers_ = keyword->more_numbers;
        std::string_view word = keyword->glued_number.empty() ? words_.next() : keyword->glued_number;
        if (word == "BINARY") {
            refuse(ImportStatus::unsupported,
                   "it is a binary OFF, and only the text is read. Export it as text, or as binary PLY.");
        }
        vertex_count_ = count(word, "vertices", least_vertex_bytes);
        const bool is_one_line = words_.has_more_on_line();
        face_count_ = count(words_.next(), "faces", least_face_bytes);
        // The number of edges, which nothing depends on; some programs leave it out.
        if (!is_one_line || words_.has_more_on_line()) words_.next();
        body_ = words_;
    }

    /// A number of the header, for so many things the file must have room.
    std::uint64_t count(std::string_view word, const char* things, std::size_t least_bytes) const {
        const std::optional<std::int64_t> number = parse_integer(word);
        if (!number || *number < 0) {
            refuse(text("'", printable(word.substr(0, 40)), "' is not the number of ", things, '.'));
        }
        const auto result = static_cast<std::uint64_t>(*number);
        const std::size_t room = content_.size() / least_bytes + 1;
        if (result > room || result >= off_no_vertex) {
            refuse(text("the header states ", result, ' ', things, ", and the file has bytes for ", room,
                        ". Is it whole?"));
        }
        return result;
    }

    /// Where each vertex has a line of its own, as many lines as there are have the numbers of the first one.
    [[nodiscard]] std::string other_vertex_count() const {
        OffWords ahead = body_;
        std::uint64_t lines = 0;
        std::size_t of_first = 0;
        while (!ahead.has_more_on_line() && ahead.next_line()) {
            const std::size_t numbers = ahead.take_line();
            if (lines == 0) of_first = numbers;
            if (numbers != of_first) break;
            ++lines;
        }
        if (lines == 0 || lines == vertex_count_) return {};
        return text("; it states ", counted(vertex_count_, "vertex"), ", and the first ", counted(lines, "line"),
                    lines == 1 ? " looks like one" : " look like one each");
    }

    void warn_about_more() {
        if (!words_.has_more_on_line() && !words_.next_line()) return;
        const std::uint64_t line = words_.line();
        std::uint64_t lines = 1;
        while (words_.next_line()) ++lines;
        file_.warn("trailing_bytes",
                   text(", line ", line, ": the header states ", counted(face_count_, "face"), ", and ",
                        counted(lines, "line"), " more than that ", lines == 1 ? "follows" : "follow",
                        other_vertex_count(), ". What follows was not read: correct the header."));
    }

    /// Colours, normals and texture coordinates have three, four or two numbers, which programs disagree on: where
    /// each vertex has a line of its own they end with it.
    [[nodiscard]] bool each_vertex_has_a_line() const {
        if (words_.has_more_on_line()) return false;
        OffWords ahead = words_;
        std::size_t of_first = 0;
        for (std::uint64_t vertex = 0; vertex < vertex_count_; ++vertex) {
            const std::size_t on_line = ahead.next_line() ? ahead.count_on_line() : 0;
            if (vertex == 0) of_first = on_line;
            if (on_line <= 3 || on_line != of_first) return false;
            if (more_numbers_ > 0) return true;
        }
        return vertex_count_ > 0;
    }

    void read_vertices() {
        const bool by_lines = each_vertex_has_a_line();
        positions_.reserve(vertex_count_);
        for (std::uint64_t vertex = 0; vertex < vertex_count_; ++vertex) {
            if (by_lines) words_.next_line();
            std::array<double, 3> numbers{};
            for (double& number : numbers) {
                const std::string_view word = by_lines ? words_.next_on_line() : words_.next();
                if (word.empty()) {
                    refuse(text("the header states ", counted(vertex_count_, "vertex"), ", and the file has ", vertex,
                                ": it ends within vertex ", vertex, ", counted from 0. Is it whole?"));
                }
                const std::optional<double> value = parse_coordinate(word);
                if (!value) refuse_word(word, "not a number");
                number = *value;
            }
            positions_.push_back({numbers[0], numbers[1], numbers[2]});
            not_finite_.look_at(vertex, positions_.back(),
                                [&] { return text("line ", words_.line(), ": vertex ", vertex, ", counted from 0,"); });
            for (std::size_t i = 0; !by_lines && i < more_numbers_; ++i) words_.next();
            if (by_lines) words_.take_line();
        }
    }

    void read_face(std::uint64_t face) {
        const std::string_view word = words_.next();
        if (word.empty()) {
            refuse(text("the header states ", counted(face_count_, "face"), ", and the file has ", face,
                        other_vertex_count(), ". Is it whole? Each face begins a line of its own."));
        }
        const std::optional<std::int64_t> count = parse_integer(word);
        if (!count || *count < 0) refuse_word(word, "not the number of a face's corners");
        corners_.clear();
        for (std::int64_t corner = 0; corner < *count; ++corner) corners_.push_back(read_corner(face));
        end_line(face);
        if (*count < 3) {
            file_.record().points_and_lines += *count > 0;
            return;
        }
        not_finite_.check(corners_, file_.record(), options_, 0, triangles_.size());
        const PolygonCut cut = cutter_.cut_face(corners_, positions_, triangles_);
        if (cut == PolygonCut::too_tangled) refuse(tangled_polygon_words);
        if (cut == PolygonCut::crossing) crossing_.add(words_.line());
    }

    /// The vertex, or a number that no vertex has.
    std::uint32_t read_corner(std::uint64_t face) {
        const std::string_view word = words_.next();
        if (word.empty()) {
            refuse(text("the header states ", counted(face_count_, "face"), ", and the file has ", face,
                        ": it ends within face ", face, ", counted from 0", other_vertex_count(), ". Is it whole?"));
        }
        const std::optional<std::int64_t> vertex = parse_integer(word);
        if (!vertex) refuse_word(word, "not the number of a vertex");
        if (*vertex >= 0 && static_cast<std::uint64_t>(*vertex) < positions_.size())
            return static_cast<std::uint32_t>(*vertex);
        missing_vertices_.add([&] {
            return words_for_missing(text("line ", words_.line(), ": face ", face), word, positions_.size(), 0);
        });
        return off_no_vertex;
    }

    /// Skips a colour, which has no stated length and ends with the line.
    void end_line(std::uint64_t face) {
        if (const std::size_t more = words_.count_on_line(); more > most_colour_numbers) {
            refuse(text(more, " numbers follow the corners of face ", face,
                        ", and a colour has at most four. Write each face on a line of its own."));
        }
        words_.take_line();
    }

    [[noreturn]] void refuse_word(std::string_view word, const char* problem) const {
        refuse(text("'", printable(word.substr(0, 40)), "' is ", problem, other_vertex_count(),
                    ". Correct it, or export the file again."));
    }
    [[noreturn]] void refuse(const std::string& problem) const { refuse_line(file_.path(), words_.line(), problem); }
    [[noreturn]] void refuse(ImportStatus code, const char* problem) const {
        throw_file_error(code, file_.path(), ": ", problem);
    }

    std::string_view content_;
    OffWords words_;
    OffWords body_;  // behind the header
    const ImportOptions& options_;
    UnitlessFile& file_;
    PolygonCutter cutter_;
    std::size_t more_numbers_ = 0;
    std::uint64_t vertex_count_ = 0;
    std::uint64_t face_count_ = 0;
    std::vector<Vec3d> positions_;
    std::vector<TriangleVertices> triangles_;
    std::vector<std::uint32_t> corners_;
    MissingVertices missing_vertices_;
    NotFiniteVertices not_finite_;
    Occurrences crossing_;
};

}  // namespace

void import_off(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    UnitlessFile file(path, "OFF", options, imported);
    std::string content = utf8_text(read_bytes(path));
    file.leave_out_zero_bytes(content);
    OffReader(content, options, file).read();
    file.finish();
}

}  // namespace espalier::importer
