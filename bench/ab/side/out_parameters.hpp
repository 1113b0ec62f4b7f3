// Calls of a commit, from 8ffbad7 on, whose queries write their results to the caller's objects: those that have
// espalier/nearest.hpp.
#pragma once

#include <runtime/simd/select.hpp>

namespace {

// ---- answers: what of each two commits must agree about; the digest is 0 for no and for nothing found ----

template <class Value>
struct Found {
    bool found = false;
    Value value;
};
struct Yes {
    bool yes = false;
};
using BatchYes = std::uint8_t;
using Hit = Found<RayHit>;
using Nearest = Found<espalier::Nearest>;
using Contact = Found<SweepHit>;
using Apart = Found<PairDistance>;

std::uint64_t digest(std::uint8_t yes) { return yes; }
std::uint64_t digest(const Yes& answer) { return answer.yes ? 1 : 0; }
std::uint64_t digest(const espalier::Nearest& nearest) { return digest_of(nearest.distance); }
std::uint64_t digest(const SweepHit& hit) { return digest_of(hit.t, hit.starts_overlapping); }
std::uint64_t digest(const PairDistance& nearest) { return digest_of(nearest.distance); }
template <class Value>
std::uint64_t digest(const Found<Value>& answer) {
    return answer.found ? digest(answer.value) : 0;
}

// ---- calls ----

constexpr float anywhere = std::numeric_limits<float>::infinity();

void ask_closest(const Blob& blob, const Ray& ray, Hit& to) { to.found = raycast(blob, ray, to.value); }
void ask_any(const Blob& blob, const Ray& ray, Yes& to) { to.yes = occluded(blob, ray); }
void ask_closest(const Blob& blob, std::span<const Ray> rays, std::span<RayHit> hits) { raycast(blob, rays, hits); }
void ask_any(const Blob& blob, std::span<const Ray> rays, std::span<BatchYes> answers) {
    occluded(blob, rays, answers);
}
void ask_nearest(const Blob& blob, const Vec3& point, Nearest& to) {
    to.found = closest_point(blob, point, anywhere, to.value);
}
template <class Shape>
void ask_overlap(const Blob& blob, const Shape& shape, Yes& to) {
    to.yes = overlaps(blob, shape);
}
void count_overlaps(const Blob& blob, const Sphere& sphere, std::uint32_t& count) {
    for_each_overlap(blob, sphere, [&count](Triangle) { return ++count, keep_going; });
}
template <class Shape>
void ask_sweep(const Blob& blob, const Shape& shape, const Vec3& way, Contact& to) {
    to.found = sweep(blob, shape, way, to.value);
}
void ask_collision(const Blob& blob, const Placement& placement, Yes& to) {
    to.yes = false;
    static_cast<void>(collides(blob, blob, placement, to.yes));
}
void count_contacts(const Blob& blob, const Placement& placement, std::uint32_t& count) {
    static_cast<void>(
        for_each_contact(blob, blob, placement, [&count](const TrianglePair&) { return ++count, keep_going; }));
}
void ask_distance(const Blob& blob, const Placement& placement, Apart& to) {
    to.found = false;
    static_cast<void>(minimum_distance(blob, blob, placement, anywhere, to.value, to.found));
}
void ask_open(std::span<const std::byte> bytes, Yes& to) {
    Blob blob;
    to.yes = open(bytes, blob) == Status::ok;
}

// ---- bakes ----

using AnyProfile = format::Profile;
constexpr auto tiny = AnyProfile(3);  // commits without it refuse it

/// Returns the bytes, or none and the reason in `message`.
std::vector<std::byte> bake_bytes(const MeshView& view, AnyProfile profile, unsigned bits, std::string& message) {
    BakeOptions options;
    options.bits = bits;
    options.profile = profile;
    const auto baked = bake({&view, 1}, options);
    if (!baked) message = baked.error().message;
    return baked ? std::vector<std::byte>(baked.value().blob.begin(), baked.value().blob.end())
                 : std::vector<std::byte>();
}

const char* open_own(std::span<const std::byte> bytes, Blob& blob) {
    const Status status = open_trusted_image(bytes, blob);
    return status == Status::ok ? nullptr : describe(status);
}

}  // namespace
