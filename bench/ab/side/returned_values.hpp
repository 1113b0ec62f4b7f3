// Calls of a commit whose queries return their results: those that have espalier/distance.hpp.
#pragma once

#include <runtime/lanes/select.hpp>

namespace {

using Placement = Transform;

// ---- answers: what of each two commits must agree about; the digest is 0 for no and for nothing found ----

using Yes = YesNo;
using BatchYes = YesNo;
using Hit = RayHit;
using Nearest = ClosestPoint;
using Contact = SweepHit;
using Apart = BlobDistance;

std::uint64_t digest(YesNo answer) { return answer.yes() ? 1 : 0; }
std::uint64_t digest(const ClosestPoint& nearest) { return nearest ? digest_of(nearest.distance) : 0; }
std::uint64_t digest(const SweepHit& hit) { return hit ? digest_of(hit.t, hit.starts_overlapping) : 0; }
std::uint64_t digest(const BlobDistance& nearest) { return nearest ? digest_of(nearest.distance) : 0; }

// ---- calls ----

void ask_closest(const Blob& blob, const Ray& ray, Hit& to) { to = raycast(blob, ray); }
void ask_any(const Blob& blob, const Ray& ray, Yes& to) { to = occluded(blob, ray); }
void ask_closest(const Blob& blob, std::span<const Ray> rays, std::span<RayHit> hits) {
    static_cast<void>(raycast(blob, rays, hits));
}
void ask_any(const Blob& blob, std::span<const Ray> rays, std::span<BatchYes> answers) {
    static_cast<void>(occluded(blob, rays, answers));
}
void ask_nearest(const Blob& blob, const Vec3& point, Nearest& to) { to = closest_point(blob, point); }
template <class Shape>
void ask_overlap(const Blob& blob, const Shape& shape, Yes& to) {
    to = overlaps(blob, shape);
}
void count_overlaps(const Blob& blob, const Sphere& sphere, std::uint32_t& count) {
    static_cast<void>(for_each_overlap(blob, sphere, [&count](TriangleId) { ++count; }));
}
template <class Shape>
void ask_sweep(const Blob& blob, const Shape& shape, const Vec3& way, Contact& to) {
    to = sweep(blob, shape, way);
}
void ask_collision(const Blob& blob, const Placement& placement, Yes& to) {
    to = overlaps(blob, PlacedBlob(blob, placement), WorkLimit::unlimited());
}
void count_contacts(const Blob& blob, const Placement& placement, std::uint32_t& count) {
    static_cast<void>(for_each_contact(
        blob, PlacedBlob(blob, placement), [&count](const PairContact&) { ++count; }, WorkLimit::unlimited()));
}
void ask_distance(const Blob& blob, const Placement& placement, Apart& to) {
    to = distance(blob, PlacedBlob(blob, placement), WorkLimit::unlimited());
}
void ask_open(std::span<const std::byte> bytes, Yes& to) { to = YesNo::of(bool(open(bytes))); }

// ---- bakes ----

using AnyProfile = Profile;
constexpr AnyProfile tiny = Profile::tiny;

/// Returns the bytes, or none and the reason in `message`.
std::vector<std::byte> bake_bytes(const MeshView& view, AnyProfile profile, unsigned bits, std::string& message) {
    BakeOptions options;
    options.resolution = Resolution::bits(bits);
    options.profile = profile;
    BakeResult baked = bake({&view, 1}, options);
    message = baked.message;
    return std::move(baked.bytes);
}

const char* open_own(std::span<const std::byte> bytes, Blob& blob) {
    blob = open_unchecked(bytes);
    return blob ? nullptr : describe(blob.status());
}

}  // namespace
