// The header of a PLY file: which elements follow, in which form.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::tools {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::size_t size_of(PlyType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}
constexpr bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::int8;
    std::optional<PlyType> count_type;  ///< of a list: the type of the number of its entries
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    [[nodiscard]] bool has_list() const;
    /// How many bytes one takes at least in the binary form; exactly so many without lists.
    [[nodiscard]] std::size_t least_bytes() const;
    [[nodiscard]] const PlyProperty* find(std::string_view property) const;
};

enum class PlyForm : std::uint8_t { text, little_endian, big_endian };

struct PlyHeader {
    PlyForm form = PlyForm::text;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0;    ///< where the data begins
    std::uint64_t lines = 0;  ///< of the header

    [[nodiscard]] const PlyElement* find(std::string_view element) const;
};

/// Throws CommandError (invalid_input) if the file is no PLY, or a line of the header is wrong.
PlyHeader read_ply_header(const std::string& path, std::string_view content);

}  // namespace espalier::tools
