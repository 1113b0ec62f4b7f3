#include <import/base/importers.hpp>

#include <array>
#include <utility>

#include <import/base/mesh_collector.hpp>
#include <import/base/numbers.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

constexpr std::size_t corner_numbers = 9;
constexpr std::size_t colour_numbers = 3;  // before those of the corners

class RawReader {
public:
    RawReader(std::string_view content, UnitlessFile& file) : lines_(content), file_(file) {}

    void read() {
        for (std::string_view line; lines_.next(line);) read_line(line);
        end_group();
        if (coloured_line_ == 0) return;
        file_.warn("colour_or_corner", text(", line ", coloured_line_,
                                            ": of twelve numbers the first three were read as a colour. Some "
                                            "programs write the four corners of a quad so; export triangles."));
    }

private:
    void read_line(std::string_view line) {
        Words words(line);
        std::array<double, corner_numbers + colour_numbers> numbers{};
        std::size_t count = 0;
        std::string_view word = words.next();
        if (word.empty()) return;
        for (; count < numbers.size() && !word.empty(); word = words.next()) {
            const std::optional<double> number = parse_coordinate(word);
            if (!number) break;
            numbers[count++] = *number;
        }
        if (count == 0 && words.rest().empty()) {
            end_group();
            name_ = word;
        } else if (count == corner_numbers || count == numbers.size()) {
            for (; !word.empty(); word = words.next()) refuse_number(word, count);
            const bool is_coloured = count == numbers.size();
            if (is_coloured && coloured_line_ == 0) coloured_line_ = lines_.number();
            add_triangle(numbers.data() + (is_coloured ? colour_numbers : 0));
        } else if (word.empty()) {
            refuse(text("it has ", counted(count, "number"), ", and a triangle has nine, or twelve with a colour"));
        } else {
            refuse(text("'", printable(word.substr(0, 40)), "' is not a number, and a triangle has nine"));
        }
    }

    /// Behind the numbers of a triangle the name of its texture may follow, in one word or several.
    void refuse_number(std::string_view word, std::size_t count) const {
        const bool looks_like_one = word.find_first_not_of("0123456789+-.,") == std::string_view::npos;
        if (!looks_like_one && !parse_coordinate(word)) return;
        if (count == corner_numbers + colour_numbers) refuse("it has more than twelve numbers");
        refuse(text("'", printable(word.substr(0, 40)), "' follows nine numbers, and only the name of a texture may"));
    }

    void add_triangle(const double* coordinates) {
        for (int i = 0; i < 3; ++i, coordinates += 3)
            corners_.push_back({coordinates[0], coordinates[1], coordinates[2]});
    }

    void end_group() {
        file_.add_triangles(name_, std::move(corners_));
        corners_ = {};
    }

    [[noreturn]] void refuse(const std::string& problem) const {
        refuse_line(file_.path(), lines_.number(), problem + ". Correct it, or export the file again.");
    }

    Lines lines_;
    UnitlessFile& file_;
    std::string name_;
    std::vector<Vec3d> corners_;
    std::uint64_t coloured_line_ = 0;  // the first one
};

}  // namespace

void import_raw(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    UnitlessFile file(path, "RAW", options, imported);
    std::string content = utf8_text(read_bytes(path));
    file.leave_out_zero_bytes(content);
    RawReader(content, file).read();
    file.finish();
}

}  // namespace espalier::importer
