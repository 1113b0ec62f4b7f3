// Faces that name vertices which their file does not have.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <import/base/error.hpp>
#include <import/base/importers.hpp>

namespace espalier::importer {

/// A deformable mesh keeps all its triangles.
inline std::string_view way_out_of_bad_triangle(const ImportOptions& options) {
    return options.keep_vertices
               ? "Correct it, or export the file again."
               : "Correct it, or export the file again; --drop-bad-triangles leaves such triangles out.";
}

/// How many corners name such a vertex, and the first of them: where it is, and the number as the file writes it, which
/// a reader that counts from 1 or backwards has replaced when the baker looks at it.
class MissingVertices {
public:
    /// `describe` returns "line 12: a face names vertex -9, and the file has 4".
    template <class Describe>
    void add(const Describe& describe) {
        if (count_++ == 0) first_ = describe();
    }
    /// Does nothing without one. Throws ImportError (invalid_input) when the options require all vertices, else
    /// appends a warning: the baker drops the triangles.
    void report(ImportedFile& file, const ImportOptions& options) const {
        if (count_ == 0) return;
        if (options.require_vertices) {
            throw ImportError(ImportStatus::invalid_input,
                              text('\'', printable(file.path), "', ", first_, ". ", way_out_of_bad_triangle(options)),
                              {.file = file.path, .kind = "missing_vertex"});
        }
        add_warning(
            file, "missing_vertex",
            text(printable(file.path), ", ", first_,
                 count_ == 1 ? "."
                             : text("; so ", count_ == 2 ? "does " : "do ", counted(count_ - 1, "more corner"), ".")));
    }

private:
    std::uint64_t count_ = 0;
    std::string first_;
};

/// The number of a vertex as a file writes it, which may have any number of digits.
inline std::string written_number(std::string_view word) {
    constexpr std::size_t longest = 40;
    return word.size() <= longest ? std::string(word) : text(word.substr(0, longest), "...");
}

/// Returns "line 12: a face names vertex 9, and the file has 4 vertices, counted from 0".
inline std::string words_for_missing(const std::string& place, std::string_view number, std::uint64_t vertices,
                                     unsigned first) {
    return text(place, " names vertex ", written_number(number), ", and the file has ", counted(vertices, "vertex"),
                ", counted from ", first);
}

}  // namespace espalier::importer
