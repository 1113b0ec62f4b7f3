#include "header_listing.hpp"

#include <string>

#include "base/numbers.hpp"
#include "blob_layout.hpp"

namespace espalier::tools {

namespace {

std::string value_of_field(std::span<const std::byte> bytes, const HeaderField& field) {
    const auto integer = [&](std::size_t at, std::size_t width) {
        return width == 1 ? read_u8(bytes, at) : width == 2 ? read_u16(bytes, at) : read_u32(bytes, at);
    };
    switch (field.kind) {
        case HeaderField::Kind::integer:
            return text(' ', integer(field.at, field.bytes));
        case HeaderField::Kind::signed_integer:
            return text(' ', static_cast<int>(static_cast<std::int16_t>(read_u16(bytes, field.at))));
        case HeaderField::Kind::real:
            return text(' ', read_f32(bytes, field.at));
        case HeaderField::Kind::hexadecimal:
            return text(' ', checksum_text(read_u32(bytes, field.at)));
        case HeaderField::Kind::text:
            return text(" \"", printable({reinterpret_cast<const char*>(bytes.data()) + field.at, field.bytes}), '"');
        case HeaderField::Kind::vector:
            return text(' ', read_u32(bytes, field.at), ' ', read_u32(bytes, field.at + 4), ' ',
                        read_u32(bytes, field.at + 8));
        case HeaderField::Kind::point:
            return text(' ', read_f32(bytes, field.at), ' ', read_f32(bytes, field.at + 4), ' ',
                        read_f32(bytes, field.at + 8));
        case HeaderField::Kind::zero:
            return {};
    }
    return {};
}

}  // namespace

void list_header(std::span<const std::byte> bytes, std::span<const HeaderField> fields, ByteListing& listing) {
    listing.heading("header");
    for (const HeaderField& field : fields) {
        if (field.at + field.bytes > bytes.size()) {
            listing.field_up_to(bytes.size(), field.name);
            listing.heading(text("cut short: a header has ", fields.back().at + fields.back().bytes, " bytes"));
            return;
        }
        listing.field(field.bytes, field.name + value_of_field(bytes, field));
    }
}

}  // namespace espalier::tools
