// A listing of the bytes of blobs and scenes with their meaning: offset, hexadecimal, text. It goes through the bytes
// in order and skips none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <espalier/blob.hpp>
#include <espalier/scene.hpp>

#include "base/exit_code.hpp"
#include "places.hpp"
#include "report/json.hpp"

namespace espalier::tools {

class ByteListing {
public:
    /// Prints as it goes, or collects JSON. `limit` lines at most, 0: all.
    ByteListing(Bytes bytes, std::size_t limit, bool json);

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

    Bytes bytes_;
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
    /// One number of up to 4 bytes, or several of 4.
    enum class Kind : std::uint8_t { integer, signed_integer, real, real64, hexadecimal, text, zero } kind;
};

/// Lists the header at the beginning of the bytes, as far as there are bytes: a refused blob may end within it.
void list_header(Bytes bytes, std::span<const HeaderField> fields, ByteListing& listing);

/// Lists the nodes of a blob, from where the listing stands, which is their beginning.
void list_nodes(Bytes bytes, const Blob& blob, ByteListing& listing);

/// The words for what leaves are: those of a scene's tree are instances.
struct PackedNodeWords {
    const char* leaves;
    const char* leaf_block;
};

/// Lists one packed node, from where the listing stands.
void list_packed_node(Bytes bytes, const NodeFields& node, std::size_t number, const PackedNodeWords& words,
                      ByteListing& listing);

/// From where the listing stands, which is the beginning of the block of node `node`. The blob was opened on `bytes`.
void list_leaf_block(Bytes bytes, const Blob& blob, std::size_t node, ByteListing& listing);

void list_corners(Bytes bytes, const Blob& blob, const Section& section, ByteListing& listing);
void list_vertex_sources(Bytes bytes, const Blob& blob, const Section& section, ByteListing& listing);

/// Lists the header of a blob, as far as there are bytes.
void list_blob_header(Bytes bytes, ByteListing& listing);

/// Lists every byte of a blob, from where the listing stands. The blob was opened on `bytes`.
void list_blob(Bytes bytes, const Blob& blob, ByteListing& listing);

/// Lists the header of a scene, as far as there are bytes.
void list_scene_header(Bytes bytes, ByteListing& listing);

/// Lists every byte of a scene, which was opened on `bytes`.
void list_scene(Bytes bytes, const BakedScene& scene, ByteListing& listing);

}  // namespace espalier::tools
