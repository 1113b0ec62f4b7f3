// Any bytes as the arguments of the baker for C: structures, arrays of any stride, callbacks that refuse. The result
// has a message that helps, or a blob that passes the deep check; all memory is given back.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/c/bake.h>
#include <espalier/espalier.h>

#include "input.hpp"
#include "judge.hpp"
#include "support/blobs/c_bake_options.hpp"
#include "support/machine/exact_buffer.hpp"
#include "target.hpp"

using namespace espalier;
using namespace espalier::tests;
using fuzz::Input;

namespace {

/// Counts the blocks of a result, and has none after some.
struct Allocator {
    std::size_t left, live = 0;

    static void* allocate(std::size_t size, void* user) {
        auto& self = *static_cast<Allocator*>(user);
        if (self.left == 0) return nullptr;
        --self.left;
        ++self.live;
        return std::malloc(size);
    }
    static void release(void* memory, std::size_t, void* user) {
        --static_cast<Allocator*>(user)->live;
        std::free(memory);
    }
};

espalier_visit count_down(const char*, double, void* left) {
    auto& calls = *static_cast<std::uint32_t*>(left);
    return calls-- == 0 ? ESPALIER_VISIT_STOP : ESPALIER_VISIT_NEXT;
}

/// An array of three numbers for each element. It is as long as its description states, and no longer.
class Array {
public:
    Array(Input& input, std::size_t number_bytes, bool makes_small_numbers)
        : count_(input.below(40)), stride_(static_cast<std::ptrdiff_t>(input.take<std::int8_t>())) {
        const std::size_t element = 3 * number_bytes;
        const std::size_t length = static_cast<std::size_t>(stride_ < 0 ? -stride_ : stride_);
        const std::size_t steps = count_ == 0 ? 0 : count_ - 1;
        std::vector<std::byte> bytes(count_ == 0 ? 0 : length * steps + element);
        for (std::byte& byte : bytes) byte = std::byte{0};
        first_ = stride_ < 0 ? length * steps : 0;
        for (std::size_t i = 0; i < count_; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                write(bytes.data() + (stride_ < 0 ? first_ - i * length : i * length) + k * number_bytes, input,
                      number_bytes, makes_small_numbers);
        buffer_ = std::make_unique<ExactBuffer>(bytes, input.below(16));
    }
    [[nodiscard]] const void* first() const { return buffer_->bytes().data() + first_; }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }

private:
    static void write(std::byte* place, Input& input, std::size_t bytes, bool makes_small_numbers) {
        std::uint64_t any = makes_small_numbers ? input.take<std::uint8_t>() : 0;
        if (!makes_small_numbers && bytes == 8) {
            const double number = input.below(8) == 0 ? input.take<double>() : double(input.take<std::int8_t>());
            std::memcpy(&any, &number, sizeof number);
        } else if (!makes_small_numbers) {
            const float number =
                input.below(8) == 0 ? input.take<float>() : static_cast<float>(input.take<std::int8_t>());
            std::memcpy(&any, &number, sizeof number);
        }
        std::memcpy(place, &any, bytes);
    }

    std::size_t count_;
    std::ptrdiff_t stride_;
    std::size_t first_;
    std::unique_ptr<ExactBuffer> buffer_;
};

espalier_bake_options read_options(Input& input) {
    espalier_bake_options options;
    espalier_init_bake_options(&options, sizeof options);
    const auto choices = input.take<std::uint32_t>();
    unsigned bit = 0;
    const auto spoil = [&](auto& field) {
        if ((choices >> bit++ & 1u) != 0) field = input.take<std::remove_reference_t<decltype(field)>>();
    };
    for_each_choice(options, spoil);
    for_each_number(options, spoil);
    if ((choices >> 30 & 1u) != 0) options.size = input.take<std::uint16_t>();
    options.threads = 1;
    return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 4096) return 0;
    Input input(std::span(data, size));
    espalier_bake_options options = read_options(input);
    Allocator allocator = {1 + input.below(4)};
    if (allocator.left == 4) allocator.left = 0;
    options.allocate = Allocator::allocate;
    options.release = Allocator::release;
    options.memory_user = &allocator;
    std::uint32_t calls_left = input.take<std::uint8_t>();
    if (calls_left < 100) options.progress = count_down;
    options.progress_user = &calls_left;

    espalier_mesh_view view;
    espalier_init_mesh_view(&view, sizeof view);
    view.coordinate_type = input.take<std::uint8_t>() & 3u;
    view.index_type = input.take<std::uint8_t>() & 3u;
    const Array positions(input, view.coordinate_type == ESPALIER_COORDINATE_FLOAT64 ? 8 : 4, false);
    const Array triangles(input, view.index_type == ESPALIER_INDEX_UINT16 ? 2 : 4, true);
    view.positions = positions.first();
    view.position_count = positions.count();
    view.position_stride = positions.stride();
    view.triangles = triangles.first();
    view.triangle_count = triangles.count();
    view.triangle_stride = triangles.stride();
    std::vector<std::uint32_t> materials(triangles.count(), input.take<std::uint32_t>() >> 14);
    if (input.below(2) == 0) view.materials = materials.data();
    if (input.below(2) == 0) view.name = "fuzzed";
    const auto hostile = input.take<std::uint8_t>();
    if (hostile == 1) view.positions = nullptr;
    if (hostile == 2) view.triangles = nullptr;
    if (hostile == 3) view.position_count = ~std::size_t{0};
    if (hostile == 4) view.triangle_count = ~std::size_t{0} / 2;
    if (hostile == 5) view.size = input.take<std::uint16_t>();

    const espalier_mesh_view meshes[2] = {view, view};
    const std::size_t mesh_count = 1 + input.below(2);
    std::vector<float> poses(input.below(3) * mesh_count * 3 * positions.count());
    for (float& coordinate : poses) coordinate = static_cast<float>(input.take<std::int8_t>());
    if (positions.count() != 0) options.pose_count = poses.size() / (mesh_count * 3 * positions.count());
    if (!poses.empty()) options.poses = poses.data();
    if (hostile == 6) options.allocate = nullptr, options.release = nullptr;
    if (hostile == 7) options.poses = nullptr;

    const espalier_bake_result* const baked = espalier_bake(meshes, mesh_count, hostile == 8 ? nullptr : &options);
    const auto fail_if = [](bool condition, const char* what) {
        if (condition) fuzz::fail("the baker for C", what);
    };
    fail_if(baked == nullptr || baked->message == nullptr || baked->report == nullptr, "null where none may be");
    fail_if((baked->status == ESPALIER_BAKE_OK) != (baked->message[0] == '\0'),
            "a message that is not needed, or none");
    if (baked->status == ESPALIER_BAKE_INTERNAL) fuzz::fail("internal error", baked->message);
    if (baked->status == ESPALIER_BAKE_OK) {
        const std::span bytes(static_cast<const std::byte*>(baked->bytes), baked->byte_count);
        if (const VerifyReport report = verify(bytes); !report) fuzz::fail("verify", report.message);
        fail_if(baked->report->bytes != baked->byte_count, "another number of bytes in the report");
        fail_if(!(baked->report->max_error >= 0.0), "an error that is negative or NaN");
    } else {
        fail_if(baked->bytes != nullptr || baked->remap != nullptr, "a blob that was refused");
    }
    espalier_release_bake_result(baked);
    fail_if(allocator.live != 0, "memory that is not given back");
    return 0;
}
