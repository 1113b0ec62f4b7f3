// Claims about opening without the proof: it is what open would say of sound bytes, from the header alone.
// No fuzz target opens like this: on bytes that the baker did not write it promises nothing.
#include "support/testing.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <runtime/base/bits.hpp>

#include "support/machine/exact_buffer.hpp"

namespace espalier::tests::open_unchecked_test {
namespace {

namespace at = format::header;
Bytes blob_with_copies() { return bake_or_throw(make_soup(60, 1), with_copies()); }

bool are_equal(const detail::BlobData& a, const detail::BlobData& b) {
    const auto same = [&](auto member) { return a.*member == b.*member; };
    using Data = detail::BlobData;
    return same(&Data::bytes) && same(&Data::nodes) && same(&Data::leaves) && same(&Data::sources) &&
           same(&Data::ids) && same(&Data::materials) && same(&Data::copies) && same(&Data::edge_flags) &&
           same(&Data::bounds) && same(&Data::size) && same(&Data::features) && same(&Data::triangle_count) &&
           same(&Data::vertex_count) && same(&Data::node_count) && same(&Data::leaf_bytes) &&
           same(&Data::source_count) && same(&Data::source_triangles) && same(&Data::copy_count) &&
           same(&Data::checksum) && std::equal(a.origin, a.origin + 4, b.origin) &&
           std::equal(a.extent, a.extent + 4, b.extent) &&
           std::equal(a.extent_steps, a.extent_steps + 4, b.extent_steps) && same(&Data::steps_per_unit) &&
           same(&Data::base_unit) && same(&Data::max_error) && same(&Data::step_exponent) && same(&Data::bits) &&
           same(&Data::depth) && same(&Data::id_kind_bits) && same(&Data::profile) && same(&Data::refusal);
}

void check_opens_alike(std::span<const std::byte> bytes) {
    const Blob proved = open(bytes);
    const Blob trusted = open_unchecked(bytes);
    REQUIRE(proved);
    REQUIRE(trusted);
    CHECK(are_equal(detail::data_of(proved), detail::data_of(trusted)));
}

/// A refused blob is a default one but for its status.
bool is_empty(const Blob& blob) {
    detail::BlobData data = detail::data_of(blob);
    data.refusal = OpenStatus::ok;
    return are_equal(data, detail::data_of(Blob()));
}

/// A blob of which nothing but its first page can be read.
class FirstPage {
public:
    explicit FirstPage(const Bytes& bytes) : page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
        size_ = bytes.size();
        mapping_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        REQUIRE(mapping_ != MAP_FAILED);
        std::memcpy(mapping_, bytes.data(), page_);
        REQUIRE(mprotect(static_cast<std::byte*>(mapping_) + page_, size_ - page_, PROT_NONE) == 0);
    }
    ~FirstPage() { munmap(mapping_, size_); }
    FirstPage(const FirstPage&) = delete;
    FirstPage& operator=(const FirstPage&) = delete;

    [[nodiscard]] std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(mapping_), size_}; }

private:
    std::size_t page_;
    std::size_t size_ = 0;
    void* mapping_ = nullptr;
};

TEST_CASE("unchecked: it opens as open does with every section and misalignment") {
    for (const TestBlob& blob : small_test_blobs()) check_opens_alike(blob.opened.bytes);
    for_each_profile([](Profile profile) {
        check_opens_alike(bake_or_throw(Mesh{}, with_profile(profile)));
        const Bytes bytes = make_blob_with_every_section(profile);
        for (std::size_t misalignment = 0; misalignment < 16; ++misalignment)
            check_opens_alike(ExactBuffer(bytes, misalignment).bytes());
    });
    const Bytes copies = blob_with_copies();
    const Blob blob = open(copies);
    REQUIRE(blob);
    REQUIRE(blob.duplicate_reference_count() > 0);
    check_opens_alike(copies);
}

TEST_CASE("unchecked: nothing behind the header is read") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = bake_or_throw(make_terrain(60, 1), with_profile(profile));
        const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
        REQUIRE(bytes.size() > 2 * page);
        const FirstPage first_page(bytes);
        const Blob blob = open_unchecked(first_page.bytes());
        CHECK(blob.status() == OpenStatus::ok);
        CHECK(blob.triangle_count() == get(bytes, at::triangle_count_at, 4));
    });
}

TEST_CASE("unchecked: padding of sections and bytes after the nodes are not read") {
    for_each_profile([](Profile profile) {
        const BakeOptions options = {.profile = profile, .original_ids = true};
        Bytes bytes;
        Blob blob;
        std::uint64_t step_bytes = 0;
        for (unsigned seed = 1; step_bytes % 4 == 0; ++seed) {  // until they need filling up
            bytes = bake_or_throw(make_terrain(62, seed), options);
            blob = open(bytes);
            REQUIRE(blob);
            step_bytes = get(bytes, at::id_step_bytes_at, 4);
        }
        CHECK(open_unchecked(FirstPage(bytes).bytes()).status() == OpenStatus::ok);
        const std::size_t blocks = format::ids::block_count(blob.triangle_count()) * format::ids::block_bytes(true);
        bytes[bytes.size() - blocks - 1] |= std::byte{0x80};  // the last byte of what fills up the steps
        repair_checksum(bytes);
        CHECK(open_unchecked(bytes).status() == OpenStatus::ok);
        CHECK(open(bytes).status() == OpenStatus::bad_section);
        break_node(bytes, at::bytes);
        repair_checksum(bytes);
        CHECK(open(bytes).status() == OpenStatus::bad_node);
    });
}

TEST_CASE("unchecked: neither the checksum nor a node is checked") {
    for_each_profile([](Profile profile) {
        Bytes bytes = make_blob_with_every_section(profile);
        put(bytes, at::checksum_at, get(bytes, at::checksum_at, 4) ^ 1, 4);
        break_node(bytes, at::bytes);
        CHECK(open(bytes).status() == OpenStatus::bad_checksum);
        const Blob blob = open_unchecked(bytes);
        CHECK(blob.status() == OpenStatus::ok);
        CHECK(blob.checksum() == get(bytes, at::checksum_at, 4));
    });
}

TEST_CASE("unchecked: short and long and absent images are refused as open does") {
    for_each_profile([](Profile profile) {
        const Bytes bytes = make_blob_with_every_section(profile);
        const auto check = [](std::span<const std::byte> changed, OpenStatus expected) {
            const Blob blob = open_unchecked(changed);
            CHECK(blob.status() == expected);
            CHECK(open(changed).status() == expected);
            CHECK(is_empty(blob));
        };
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            const ExactBuffer shorter(std::span<const std::byte>(bytes).first(size), size % 16);
            check(shorter.bytes(), OpenStatus::too_short);
        }
        Bytes longer = bytes;
        longer.push_back(std::byte{0});
        check(longer, OpenStatus::trailing_bytes);
        Bytes other = bytes;
        std::reverse(other.begin(), other.begin() + 4);  // what another byte order would make of it
        check(other, OpenStatus::not_a_blob);
    });
}

TEST_CASE("unchecked: every changed header bit gives the status of open") {
    for_each_profile([](Profile profile) {
        for (const Bytes& bytes :
             {make_blob_with_every_section(profile), bake_or_throw(Mesh{}, with_profile(profile))}) {
            unsigned refused = 0, trusted = 0;
            for (std::size_t bit = 0; bit < 8 * at::bytes; ++bit) {
                Bytes changed = bytes;
                changed[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
                if (bit / 8 < at::checksum_at || bit / 8 >= at::checksum_at + 4) repair_checksum(changed);
                const Blob blob = open_unchecked(changed);
                const Blob proved = open(changed);
                const OpenStatus status = blob.status();
                const OpenStatus expected = proved.status();
                CAPTURE(bit);
                if (status != OpenStatus::ok) {
                    CHECK(status == expected);
                    CHECK(is_empty(blob));
                    ++refused;
                } else if (expected == OpenStatus::ok) {
                    CHECK(are_equal(detail::data_of(blob), detail::data_of(proved)));
                } else {  // the proof goes further than the header
                    CHECK((expected == OpenStatus::bad_node || expected == OpenStatus::bad_leaf ||
                           expected == OpenStatus::bad_section || expected == OpenStatus::bad_checksum));
                    ++trusted;
                }
            }
            CHECK(refused > 500);
            CHECK(trusted >= 32);
        }
    });
}

TEST_CASE("unchecked: a refusal replaces a blob that was open") {
    const Bytes bytes = make_blob_with_every_section(Profile::small);
    Blob blob = open_unchecked(bytes);
    REQUIRE(blob);
    blob = open_unchecked({});
    CHECK(blob.status() == OpenStatus::too_short);
    CHECK(is_empty(blob));
}

TEST_CASE("numerics: a whole number converts to the float of the machine") {
    for (std::uint32_t number = 0; number < 1u << 24; ++number)
        if (detail::whole_float(number) != static_cast<float>(number)) FAIL(number);
}

}  // namespace
}  // namespace espalier::tests::open_unchecked_test
