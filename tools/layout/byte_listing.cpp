#include "listing.hpp"

#include <algorithm>
#include <iostream>

#include <import/base/numbers.hpp>

#include "report/diagnostics.hpp"

namespace espalier::tools {

namespace {

constexpr std::size_t bytes_in_a_line = 16;
constexpr std::size_t hexadecimal_column = 3 * bytes_in_a_line + 1;

std::string in_hexadecimal(Bytes bytes) {
    constexpr char digits[] = "0123456789abcdef";
    std::string result;
    for (const std::byte byte : bytes) {
        if (!result.empty()) result += ' ';
        result += digits[std::to_integer<unsigned>(byte) >> 4];
        result += digits[std::to_integer<unsigned>(byte) & 15u];
    }
    return result;
}

std::string value_of_field(Bytes bytes, const HeaderField& field) {
    using Kind = HeaderField::Kind;
    if (field.kind == Kind::zero) return {};
    if (field.kind == Kind::text)
        return text(" \"", printable({reinterpret_cast<const char*>(bytes.data()) + field.at, field.bytes}), '"');
    if (field.kind == Kind::hexadecimal) return text(' ', checksum_text(read_u32(bytes, field.at)));
    if (field.kind == Kind::signed_integer)
        return text(' ', static_cast<int>(static_cast<std::int16_t>(read_u16(bytes, field.at))));
    std::string values;
    for (std::size_t at = field.at; field.kind == Kind::real64 && at < field.at + field.bytes; at += 8)
        values += text(' ', read_f64(bytes, at));
    if (!values.empty()) return values;
    for (std::size_t at = field.at; at < field.at + field.bytes; at += 4) {
        values +=
            field.kind == Kind::real
                ? text(' ', read_f32(bytes, at))
                : text(' ', read_bits(bytes, 8 * at, 8 * static_cast<unsigned>(std::min<std::size_t>(field.bytes, 4))));
    }
    return values;
}

}  // namespace

ByteListing::ByteListing(Bytes bytes, std::size_t limit, bool json) : bytes_(bytes), limit_(limit), json_(json) {}

void ByteListing::heading(const std::string& text) {
    if (full()) return;
    ++lines_;
    if (json_) {
        collected_.push_back({{"heading", text}});
    } else {
        std::cout << "-- " << text << '\n';
    }
}

void ByteListing::field(std::size_t count, const std::string& meaning) {
    std::string once = meaning;
    while (count > 0) {
        const std::size_t part = std::min(count, bytes_in_a_line);
        line(part, once);
        once.clear();
        count -= part;
    }
}

void ByteListing::field_up_to(std::size_t offset, const std::string& meaning) {
    if (offset > at()) field(offset - at(), meaning);
}

void ByteListing::line(std::size_t count, const std::string& meaning) {
    if (full()) return;
    ++lines_;
    std::string bytes = in_hexadecimal(bytes_.subspan(at_, count));
    if (json_) {
        collected_.push_back({{"at", at_}, {"bytes", std::move(bytes)}, {"meaning", meaning}});
    } else {
        if (!meaning.empty()) bytes.resize(hexadecimal_column, ' ');
        std::cout << checksum_text(static_cast<std::uint32_t>(at_)) << "  " << bytes << meaning << '\n';
    }
    at_ += count;
}

ExitCode ByteListing::finish(const CommandError* refusal) {
    const std::size_t left_out = bytes_.size() - at_;
    if (json_) {
        Json document = json_document();
        document["lines"] = std::move(collected_);
        document["bytes_left_out"] = left_out;
        if (refusal != nullptr) return report_failure(*refusal, &document);
        print_json(document);
        return ExitCode::ok;
    }
    if (left_out > 0) {
        std::cout << "-- left out: " << counted(left_out, "byte") << " from "
                  << checksum_text(static_cast<std::uint32_t>(at_)) << " on\n";
    }
    finish_standard_output();
    return refusal == nullptr ? ExitCode::ok : report_failure(*refusal, nullptr);
}

void list_header(Bytes bytes, std::span<const HeaderField> fields, ByteListing& listing) {
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
