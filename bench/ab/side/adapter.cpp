// Implements ../side.h over the public calls of the commit whose headers are on the include path.
//
// It serves commits from e2cbbab4 on, whose queries return their results. Where a later commit renames a call or a
// field, test for it with `if constexpr (requires ...)`. Where the calls change as a whole, put both generations into
// headers of their own, and select one by a header of the library that only one of them has.
#include "../side.h"

#include <bit>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>
#include <runtime/lanes/select.hpp>

#if !defined(ESPALIER_SIDE_FLAGS)
#define ESPALIER_SIDE_FLAGS ""
#endif

namespace {

using namespace espalier;

std::uint64_t mix(std::uint64_t digest, std::uint32_t value) { return (digest ^ value) * 0x100000001B3u; }
std::uint64_t mix(std::uint64_t digest, bool value) { return mix(digest, std::uint32_t{value}); }
std::uint64_t mix(std::uint64_t digest, float value) { return mix(digest, std::bit_cast<std::uint32_t>(value)); }
std::uint64_t mix(std::uint64_t digest, const Vec3& v) { return mix(mix(mix(digest, v.x), v.y), v.z); }

/// FNV-1a over the bits of the values; never 0.
template <class... Values>
std::uint64_t digest_of(const Values&... values) {
    std::uint64_t digest = 0xCBF29CE484222325u;
    ((digest = mix(digest, values)), ...);
    return digest | 1;
}

Vec3 vector_at(const float* n) { return {n[0], n[1], n[2]}; }

// ---- answers: what of each two commits must agree about; the digest is 0 for no and for nothing found ----

std::uint64_t digest(std::uint32_t count) { return count; }
std::uint64_t digest(YesNo answer) { return answer.yes() ? 1 : 0; }
std::uint64_t digest(const RayHit& hit) {
    return hit.t < std::numeric_limits<float>::infinity() ? digest_of(hit.t, hit.normal) : 0;
}
std::uint64_t digest(const ClosestPoint& nearest) { return nearest ? digest_of(nearest.distance) : 0; }
std::uint64_t digest(const SweepHit& hit) { return hit ? digest_of(hit.t, hit.starts_overlapping) : 0; }
std::uint64_t digest(const BlobDistance& nearest) { return nearest ? digest_of(nearest.distance) : 0; }

// ---- questions: how each is made of floats ----

struct RayQuestion {
    using Question = Ray;
    static constexpr std::size_t floats = 7;
    static Ray make(const float* n) {
        Ray ray;
        ray.origin = vector_at(n);
        ray.direction = vector_at(n + 3);
        ray.t_max = n[6];
        return ray;
    }
};

struct PointQuestion {
    using Question = Vec3;
    static constexpr std::size_t floats = 3;
    static Vec3 make(const float* n) { return vector_at(n); }
};

struct SphereQuestion {
    using Question = Sphere;
    static constexpr std::size_t floats = 4;
    static Sphere make(const float* n) { return {vector_at(n), n[3]}; }
};

struct CapsuleQuestion {
    using Question = Capsule;
    static constexpr std::size_t floats = 7;
    static Capsule make(const float* n) { return {vector_at(n), vector_at(n + 3), n[6]}; }
};

struct OrientedBoxQuestion {
    using Question = OrientedBox;
    static constexpr std::size_t floats = 12;
    static OrientedBox make(const float* n) {
        return {vector_at(n), {vector_at(n + 3), vector_at(n + 6), vector_at(n + 9)}};
    }
};

struct BoxQuestion {
    using Question = Box;
    static constexpr std::size_t floats = 6;
    static Box make(const float* n) { return {vector_at(n), vector_at(n + 3)}; }
};

template <class Shape>
struct SweepQuestion {
    struct Question {
        typename Shape::Question shape;
        Vec3 displacement;
    };
    static constexpr std::size_t floats = Shape::floats + 3;
    static Question make(const float* n) { return {Shape::make(n), vector_at(n + Shape::floats)}; }
};

struct PlacementQuestion {
    using Question = Transform;
    static constexpr std::size_t floats = 8;
    static Transform make(const float* n) { return {{n[0], n[1], n[2], n[3]}, vector_at(n + 4), n[7]}; }
};

struct NoQuestion {
    struct Question {};
    static constexpr std::size_t floats = 0;
    static Question make(const float*) { return {}; }
};

// ---- kinds ----

/// Answers one question after the other with `ask(blob, question)`.
template <class QuestionMaker, auto ask>
struct OneByOne : QuestionMaker {
    using Answer = decltype(ask(std::declval<const Blob&>(), std::declval<const typename QuestionMaker::Question&>()));
    static void run(const EspalierSideAsset& asset, std::span<const typename QuestionMaker::Question> questions,
                    std::span<Answer> answers) {
        const Blob& blob = *static_cast<const Blob*>(asset.blob);
        for (std::size_t i = 0; i < questions.size(); ++i) answers[i] = ask(blob, questions[i]);
    }
};
/// Answers all questions with one call of `ask(blob, questions, answers)`.
template <class AnswerType, auto ask>
struct Batch : RayQuestion {
    using Answer = AnswerType;
    static void run(const EspalierSideAsset& asset, std::span<const Ray> rays, std::span<Answer> answers) {
        static_cast<void>(ask(*static_cast<const Blob*>(asset.blob), rays, answers));
    }
};
struct Open : NoQuestion {
    using Answer = YesNo;
    static void run(const EspalierSideAsset& asset, std::span<const Question>, std::span<YesNo> answers) {
        const std::span bytes(static_cast<const std::byte*>(asset.bytes), asset.size);
        for (YesNo& answer : answers) answer = YesNo::of(bool(open(bytes)));
    }
};

constexpr auto closest = [](const Blob& blob, const auto&... rest) { return raycast(blob, rest...); };
constexpr auto any = [](const Blob& blob, const auto&... rest) { return occluded(blob, rest...); };
constexpr auto nearest = [](const Blob& blob, const Vec3& point) { return closest_point(blob, point); };
constexpr auto overlap = [](const Blob& blob, const auto& shape) { return overlaps(blob, shape); };
constexpr auto moved = [](const Blob& blob, const auto& question) {
    return sweep(blob, question.shape, question.displacement);
};
constexpr auto count_overlaps = [](const Blob& blob, const auto& shape) {
    std::uint32_t count = 0;
    static_cast<void>(for_each_overlap(blob, shape, [&count](TriangleId) { ++count; }));
    return count;
};
constexpr auto collision = [](const Blob& blob, const Transform& place) {
    return overlaps(blob, PlacedBlob(blob, place), WorkLimit::unlimited());
};
/// The contacts with a body that was found, and how deep the deepest is.
struct BodyContacts {
    std::uint32_t count = 0;
    float deepest = 0.0f;
};
std::uint64_t digest(const BodyContacts& found) { return found.count > 0 ? digest_of(found.count, found.deepest) : 0; }
constexpr auto body_contacts = [](const Blob& blob, const auto& body) {
    Contact contacts[32];
    const Filled filled = find_contacts(blob, body, 0.0f, contacts);
    return BodyContacts{static_cast<std::uint32_t>(filled.count), contacts[0].distance};
};
constexpr auto count_contacts = [](const Blob& blob, const Transform& place) {
    std::uint32_t count = 0;
    static_cast<void>(for_each_contact(
        blob, PlacedBlob(blob, place), [&count](const PairContact&) { ++count; }, WorkLimit::unlimited()));
    return count;
};
constexpr auto apart = [](const Blob& blob, const Transform& place) {
    return distance(blob, PlacedBlob(blob, place), WorkLimit::unlimited());
};

template <class Kind>
constexpr EspalierSideKind kind_named(const char* name) {
    using Question = typename Kind::Question;
    using Answer = typename Kind::Answer;
    return {
        name,
        Kind::floats,
        sizeof(Question),
        sizeof(Answer),
        [](const float* floats, std::size_t count, void* questions) {
            for (std::size_t i = 0; i < count; ++i)
                new (static_cast<Question*>(questions) + i) Question(Kind::make(floats + i * Kind::floats));
        },
        [](const EspalierSideAsset* asset, const void* questions, std::size_t count, void* answers) {
            Kind::run(*asset, {static_cast<const Question*>(questions), count}, {static_cast<Answer*>(answers), count});
        },
        [](const void* answers, std::size_t count, std::uint64_t* digests) {
            for (std::size_t i = 0; i < count; ++i) digests[i] = digest(static_cast<const Answer*>(answers)[i]);
        }};
}

const EspalierSideKind kinds[] = {kind_named<OneByOne<RayQuestion, closest>>("closest_hit"),
                                  kind_named<OneByOne<RayQuestion, any>>("any_hit"),
                                  kind_named<Batch<RayHit, closest>>("closest_hit_batch"),
                                  kind_named<Batch<YesNo, any>>("any_hit_batch"),
                                  kind_named<OneByOne<PointQuestion, nearest>>("closest_point"),
                                  kind_named<OneByOne<SphereQuestion, overlap>>("overlaps_sphere"),
                                  kind_named<OneByOne<SphereQuestion, count_overlaps>>("all_overlaps_sphere"),
                                  kind_named<OneByOne<BoxQuestion, overlap>>("overlaps_box"),
                                  kind_named<OneByOne<BoxQuestion, count_overlaps>>("all_overlaps_box"),
                                  kind_named<OneByOne<CapsuleQuestion, overlap>>("overlaps_capsule"),
                                  kind_named<OneByOne<OrientedBoxQuestion, overlap>>("overlaps_oriented_box"),
                                  kind_named<OneByOne<SphereQuestion, body_contacts>>("contacts_sphere"),
                                  kind_named<OneByOne<CapsuleQuestion, body_contacts>>("contacts_capsule"),
                                  kind_named<OneByOne<OrientedBoxQuestion, body_contacts>>("contacts_oriented_box"),
                                  kind_named<OneByOne<SweepQuestion<SphereQuestion>, moved>>("sweep_sphere"),
                                  kind_named<OneByOne<SweepQuestion<CapsuleQuestion>, moved>>("sweep_capsule"),
                                  kind_named<OneByOne<SweepQuestion<BoxQuestion>, moved>>("sweep_box"),
                                  kind_named<OneByOne<PlacementQuestion, collision>>("collides"),
                                  kind_named<OneByOne<PlacementQuestion, count_contacts>>("all_contacts"),
                                  kind_named<OneByOne<PlacementQuestion, apart>>("minimum_distance"),
                                  kind_named<Open>("open")};

const EspalierSideKind* find_kind(const char* name) {
    for (const EspalierSideKind& kind : kinds)
        if (std::string_view(kind.name) == name) return &kind;
    return nullptr;
}

const char* bake_mesh(const EspalierSideMesh* mesh, const char* profile, unsigned bits,
                      void (*take)(void* to, const void* bytes, std::size_t size), void* to) {
    static std::string message;
    BakeOptions options;
    options.resolution = Resolution::bits(bits);
    options.flat_angle = 5.0;  // edge flags, which contacts read
    const std::string_view word = profile;
    if (word == "fast") options.profile = Profile::fast;
    else if (word == "balanced") options.profile = Profile::balanced;
    else if (word == "small") options.profile = Profile::small;
    else if (word == "tiny") options.profile = Profile::tiny;
    else return "this commit has no such profile";
    std::vector<Vec3> positions;
    std::vector<TriangleVertices> triangles;
    for (std::size_t i = 0; i < mesh->vertices; ++i) positions.push_back(vector_at(mesh->positions + 3 * i));
    for (std::size_t i = 0; i < mesh->triangles; ++i) {
        const std::uint32_t* corners = mesh->corners + 3 * i;
        triangles.push_back({corners[0], corners[1], corners[2]});
    }
    MeshView view;
    view.positions = positions;
    view.triangles = triangles;
    view.name = mesh->name;
    const BakeResult baked = bake({&view, 1}, options);
    message = baked.message;
    if (!baked) return message.c_str();
    take(to, baked.bytes.data(), baked.bytes.size());
    return nullptr;
}

/// The bytes are this side's own, so that their header is all that there is to check.
const char* open_asset(EspalierSideAsset* asset) {
    Blob& blob = *new (asset->blob) Blob;
    blob = open_unchecked({static_cast<const std::byte*>(asset->bytes), asset->size});
    return blob ? nullptr : describe(blob.status());
}

const char* use_set(const char* set) {
    using detail::InstructionSet;
    struct Named {
        const char* name;
        InstructionSet set;
    };
    constexpr Named named[] = {{"scalar", InstructionSet::scalar},
                               {"sse42", InstructionSet::sse42},
                               {"avx2", InstructionSet::avx2},
                               {"avx512", InstructionSet::avx512},
                               {"neon", InstructionSet::neon}};
    const std::string_view word = set;
#if ESPALIER_X86
    const InstructionSet best = detail::detect_instruction_set();
    for (const Named& candidate : named) {
        if (word == "best" ? candidate.set != best : word != candidate.name) continue;
        if (candidate.set > best) return nullptr;  // each set includes those before it
        detail::known_instruction_set = static_cast<std::uint8_t>(static_cast<unsigned>(candidate.set) + 1u);
        return candidate.name;
    }
#else
    for (const Named& candidate : named)
        if (candidate.set == detail::instruction_set() && (word == "best" || word == candidate.name))
            return candidate.name;
#endif
    return nullptr;
}

const EspalierSide side = {
#if defined(__clang__)
    "clang " __clang_version__ " " ESPALIER_SIDE_FLAGS,
#else
    "gcc " __VERSION__ " " ESPALIER_SIDE_FLAGS,
#endif
    bake_mesh,
    sizeof(Blob),
    open_asset,
    use_set,
    find_kind};

}  // namespace

extern "C" __attribute__((visibility("default"))) const EspalierSide* espalier_side() { return &side; }
