#include <import/gltf/data/accessors.hpp>

#include <algorithm>
#include <bit>

#include <import/base/numbers.hpp>

namespace espalier::importer {

namespace {

std::uint32_t unsigned_at(const std::byte* place, std::size_t bytes) {
    std::uint32_t result = 0;
    for (std::size_t i = bytes; i-- > 0;) result = result << 8 | std::to_integer<std::uint32_t>(place[i]);
    return result;
}

double value_at(const std::byte* place, GltfComponent component) {
    const std::uint32_t bits = unsigned_at(place, bytes_of(component));
    if (component == GltfComponent::float_32) return static_cast<double>(std::bit_cast<float>(bits));
    if (component == GltfComponent::signed_8) return static_cast<std::int8_t>(bits);
    if (component == GltfComponent::signed_16) return static_cast<std::int16_t>(bits);
    return bits;
}

double largest(GltfComponent component) {
    if (component == GltfComponent::signed_8) return 127.0;
    if (component == GltfComponent::unsigned_8) return 255.0;
    if (component == GltfComponent::signed_16) return 32767.0;
    return component == GltfComponent::unsigned_16 ? 65535.0 : 1.0;
}

std::size_t components_of(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    return type == "MAT4" ? 16 : 0;
}

/// Bits of the types that a use allows: float, normalised integers of 8 and 16 bits, others of these, of 32 bits.
constexpr unsigned float_types = 1, normalised_types = 2, integer_types = 4, index_types = 8;

struct Allowed {
    std::size_t components;
    unsigned types;
};

Allowed allowed_for(GltfUse use) {
    if (use == GltfUse::position || use == GltfUse::displacement)
        return {3, float_types | normalised_types | integer_types};
    if (use == GltfUse::index) return {1, index_types};
    if (use == GltfUse::joints) return {4, index_types};
    if (use == GltfUse::weights || use == GltfUse::rotation) return {4, float_types | normalised_types};
    if (use == GltfUse::matrix) return {16, float_types};
    return {3, float_types | normalised_types | integer_types};
}

bool allows(unsigned types, GltfComponent component, bool normalised) {
    if (component == GltfComponent::float_32) return (types & float_types) != 0;
    const bool is_signed = component == GltfComponent::signed_8 || component == GltfComponent::signed_16;
    if ((types & index_types) != 0) return !is_signed && !normalised;
    if (component == GltfComponent::unsigned_32) return false;
    return (types & (normalised ? normalised_types : integer_types)) != 0;
}

}  // namespace

std::size_t bytes_of(GltfComponent component) {
    if (component == GltfComponent::signed_8 || component == GltfComponent::unsigned_8) return 1;
    return component == GltfComponent::signed_16 || component == GltfComponent::unsigned_16 ? 2 : 4;
}

const std::byte* GltfAccessor::place(std::size_t element, std::size_t of) const {
    const std::size_t within = of * bytes_of(component);
    if (replaced != nullptr) {
        const auto found = std::lower_bound(replaced->begin(), replaced->end(), element);
        if (found != replaced->end() && *found == element) {
            const auto row = static_cast<std::size_t>(found - replaced->begin());
            return replacements.data() + row * components * bytes_of(component) + within;
        }
    }
    return is_stored() ? bytes.data() + element * stride + within : nullptr;
}

double GltfAccessor::number(std::size_t element, std::size_t of) const {
    const std::byte* at = place(element, of);
    if (at == nullptr) return 0.0;
    const double value = value_at(at, component);
    return normalised && component != GltfComponent::float_32 ? std::max(value / largest(component), -1.0) : value;
}

std::uint32_t GltfAccessor::whole(std::size_t element, std::size_t of) const {
    const std::byte* at = place(element, of);
    return at == nullptr ? 0 : unsigned_at(at, bytes_of(component));
}

GltfObject GltfData::object(std::size_t number, std::string_view words) const {
    return root_.object_in("accessors", number, text(words, ", accessor ", number));
}

std::uint64_t GltfData::claimed_count(std::size_t number) const {
    return object(number, root_.words()).required_whole("count");
}

GltfAccessor GltfData::described(std::size_t number, GltfUse use, std::string_view words) const {
    const GltfObject json = object(number, words);
    GltfAccessor result;
    const std::uint64_t component = json.required_whole("componentType");
    result.component = static_cast<GltfComponent>(component);
    if (component < 5120 || component > 5126 || component == 5124) {
        json.refuse(text("its componentType ", component, " is unknown. Export it with another type."));
    }
    result.normalised = json.flag("normalized");
    result.count = json.required_whole("count");
    if (result.count == 0) json.fail("its count is 0, and glTF requires at least one element");
    result.components = components_of(json.text_of("type"));
    const Allowed allowed = allowed_for(use);
    if (result.components != allowed.components || !allows(allowed.types, result.component, result.normalised)) {
        json.fail(text("type ", printable(json.text_of("type")), " of componentType ", component,
                       result.normalised ? " (normalized)" : "", " is not allowed there"));
    }
    return result;
}

GltfAccessor GltfData::accessor(std::size_t number, GltfUse use, std::string_view words) {
    GltfAccessor result = described(number, use, words);
    const GltfObject json = object(number, words);
    if (json.has("bufferView")) {
        const std::size_t bytes = result.components * bytes_of(result.component);
        result.bytes = elements(json, result.count, bytes, &result.stride);
    }
    if (const auto sparse = json.object("sparse")) read_replacements(number, *sparse, result);
    return result;
}

void GltfData::read_replacements(std::size_t number, const GltfObject& sparse, GltfAccessor& accessor) {
    const std::uint64_t count = sparse.required_whole("count");
    const auto places = sparse.object("indices");
    const auto values = sparse.object("values");
    if (!places || !values) sparse.fail("it has no \"indices\" or no \"values\"");
    const auto component = static_cast<GltfComponent>(places->required_whole("componentType"));
    if (component != GltfComponent::unsigned_8 && component != GltfComponent::unsigned_16 &&
        component != GltfComponent::unsigned_32) {
        places->fail("its componentType is no unsigned integer");
    }
    const std::size_t bytes = bytes_of(component);
    const std::span<const std::byte> stored = elements(*places, count, bytes, nullptr);
    accessor.replacements = elements(*values, count, accessor.components * bytes_of(accessor.component), nullptr);
    std::shared_ptr<const std::vector<std::uint32_t>>& known = replaced_[number];
    if (known != nullptr) {
        accessor.replaced = known;
        return;
    }
    std::vector<std::uint32_t> replaced;
    replaced.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t element = unsigned_at(stored.data() + i * bytes, bytes);
        if (element >= accessor.count || (i > 0 && element <= replaced.back())) {
            places->fail(text("element ", element, " is not behind the one before it, or not one of ", accessor.count));
        }
        replaced.push_back(element);
    }
    accessor.replaced = known = std::make_shared<const std::vector<std::uint32_t>>(std::move(replaced));
}

/// The bytes from the first element to the end of the last. Without `stride` they must follow each other.
std::span<const std::byte> GltfData::elements(const GltfObject& place, std::size_t count, std::size_t bytes,
                                              std::size_t* stride) {
    const std::size_t number = place.required_index("bufferView", view_count());
    const std::uint64_t offset = place.whole("byteOffset").value_or(0);
    const GltfBufferView stored = view(number);
    const std::size_t step = stride == nullptr || stored.stride == 0 ? bytes : stored.stride;
    if (step < bytes)
        place.fail(text("bufferView ", number, " has a byteStride of ", step, " for elements of ", bytes));
    if (stored.packed != 0 && step != stored.packed) {
        place.fail(text("its elements follow each other every ", step, " bytes, and EXT_meshopt_compression packs ",
                        stored.packed, " bytes for each in bufferView ", number));
    }
    if (stride != nullptr) *stride = step;
    if (count == 0) return {};
    const std::size_t size = stored.bytes.size();
    if (offset > size || bytes > size - offset || count - 1 > (size - offset - bytes) / step) {
        place.fail(text("its ", count, " elements from byte ", offset, " on are not inside of the ", size,
                        " bytes of bufferView ", number));
    }
    return stored.bytes.subspan(offset, (count - 1) * step + bytes);
}

}  // namespace espalier::importer
