#include "byte_sizes.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "exit_code.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

constexpr double largest_size = 1e15;

std::optional<double> factor_of(std::string_view suffix) {
    if (suffix.empty() || suffix == "B") return 1.0;
    double factor = 0.0;
    switch (std::toupper(static_cast<unsigned char>(suffix.front()))) {
        case 'K':
            factor = 0x1p10;
            break;
        case 'M':
            factor = 0x1p20;
            break;
        case 'G':
            factor = 0x1p30;
            break;
        default:
            return std::nullopt;
    }
    const std::string_view rest = suffix.substr(1);
    if (!rest.empty() && rest != "B" && rest != "iB") return std::nullopt;
    return factor;
}

}  // namespace

std::uint64_t parse_byte_size(const std::string& input, std::string_view option) {
    char* end = nullptr;
    const double value = std::strtod(input.c_str(), &end);
    const std::optional<double> factor = factor_of(end);
    const bool is_number = end != input.c_str() && std::isfinite(value) && factor;
    const double bytes = is_number ? std::floor(value * *factor) : 0.0;
    if (!(bytes >= 1.0 && bytes <= largest_size)) {
        throw CommandError(ExitCode::usage,
                           text(option, ": '", printable(input),
                                "' is no amount of bytes. Write a number above zero, with K, M or G for powers of "
                                "1024, such as 65536, 64K or 1.5M."));
    }
    return static_cast<std::uint64_t>(bytes);
}

}  // namespace espalier::tools
