#include "lattice_step.hpp"

#include <charconv>
#include <cmath>
#include <optional>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"
#include "files/blob_file.hpp"

namespace espalier::tools {

namespace {

std::optional<int> exponent_in(const char* begin, const char* end) {
    int number = 0;
    const auto [stopped, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || stopped != end) return std::nullopt;
    return number;
}

std::optional<int> step_exponent(const std::string& input) {
    if (input.starts_with("2^")) return exponent_in(input.data() + 2, input.data() + input.size());
    const std::optional<double> step = parse_double(input);
    if (!step || !std::isfinite(*step) || *step <= 0.0) return std::nullopt;
    int exponent = 0;
    if (std::frexp(*step, &exponent) != 0.5) return std::nullopt;
    return exponent - 1;
}

}  // namespace

int parse_step_exponent(const std::string& input, const char* option) {
    const std::optional<int> exponent = step_exponent(input);
    if (exponent) return *exponent;
    throw CommandError(ExitCode::usage, text(option, ": '", printable(input),
                                             "' is no power of two. Write a step such as 2^-14, or 0.25, in units of "
                                             "the blob."));
}

Lattice lattice_of_blob(const std::string& path) {
    const BlobFile file = open_blob_file(path);
    if (file.blob.triangle_count() != 0) return file.blob.lattice();
    throw CommandError(ExitCode::invalid_input, text('\'', printable(path),
                                                     "' is a blob without triangles, which has no lattice: choose "
                                                     "another blob, or write the step with --step."));
}

}  // namespace espalier::tools
