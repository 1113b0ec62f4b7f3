// A listing of bytes with their meaning: offset, hexadecimal, text. It goes through the bytes in order and skips none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/exit_code.hpp"
#include "report/json_output.hpp"

namespace espalier::tools {

class ByteListing {
public:
    /// Prints as it goes, or collects JSON. `limit` lines at most, 0: all.
    ByteListing(std::span<const std::byte> bytes, std::size_t limit, bool json);

    /// A line that stands for no bytes.
    void heading(const std::string& text);
    /// The next `count` bytes, over several lines when they are many; the meaning stands in the first.
    void field(std::size_t count, const std::string& meaning);
    /// All bytes from here up to `offset`, which counts as at() does, if any.
    void field_up_to(std::size_t offset, const std::string& meaning);
    [[nodiscard]] std::size_t at() const { return at_ - part_; }
    /// Whether the rest would be left out anyway, so that its text need not be made.
    [[nodiscard]] bool full() const { return limit_ != 0 && lines_ >= limit_; }

    /// Prints what was left out, ends the listing, and reports the refusal of the blob, if any. Returns its exit
    /// status.
    ExitCode finish(const CommandError* refusal = nullptr);

    /// Makes at() count from where it was constructed, as long as it lives: for a blob inside of a scene.
    class Part {
    public:
        explicit Part(ByteListing& listing) : listing_(listing), outer_(listing.part_) { listing.part_ = listing.at_; }
        ~Part() { listing_.part_ = outer_; }
        Part(const Part&) = delete;
        Part& operator=(const Part&) = delete;

    private:
        ByteListing& listing_;
        std::size_t outer_;
    };

private:
    void line(std::size_t count, const std::string& meaning);

    std::span<const std::byte> bytes_;
    std::size_t limit_;
    bool json_;
    std::size_t at_ = 0;
    std::size_t part_ = 0;
    std::size_t lines_ = 0;
    Json collected_ = Json::array();
};

struct HeaderField {
    std::size_t at;
    std::size_t bytes;
    const char* name;
    enum class Kind : std::uint8_t { integer, signed_integer, real, hexadecimal, text, vector, point, zero } kind;
};

/// Lists the header at the beginning of the bytes, as far as there are bytes: a refused blob may end within it.
void list_header(std::span<const std::byte> bytes, std::span<const HeaderField> fields, ByteListing& listing);

}  // namespace espalier::tools
