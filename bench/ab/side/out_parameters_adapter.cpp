// Implements ../side.h over the public calls of the commit whose headers are on the include path.
//
// This file serves commits from 8ffbad7 on whose queries write their results to the caller's objects: those that have
// espalier/nearest.hpp. adapter.cpp serves the later ones.
#include "../side.h"

#include <bit>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>
#include <runtime/simd/select.hpp>

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
    using Question = Placement;
    static constexpr std::size_t floats = 8;
    static Placement make(const float* n) { return {{n[0], n[1], n[2], n[3]}, vector_at(n + 4), n[7]}; }
};

struct NoQuestion {
    struct Question {};
    static constexpr std::size_t floats = 0;
    static Question make(const float*) { return {}; }
};

// ---- answers: what of each two commits must agree about ----

template <class Value>
struct Found {
    bool found = false;
    Value value;
};
struct YesNo {
    bool yes = false;
};
struct Count {
    std::uint32_t count = 0;
};

/// Each is 0 for no and for nothing found.
std::uint64_t digest(std::uint8_t yes) { return yes; }
std::uint64_t digest(const YesNo& answer) { return answer.yes ? 1 : 0; }
std::uint64_t digest(const Count& answer) { return answer.count; }
std::uint64_t digest(const RayHit& hit) {
    return hit.t < std::numeric_limits<float>::infinity() ? digest_of(hit.t, hit.normal) : 0;
}
std::uint64_t digest(const Nearest& nearest) { return digest_of(nearest.distance); }
std::uint64_t digest(const SweepHit& hit) { return digest_of(hit.t, hit.starts_overlapping); }
std::uint64_t digest(const PairDistance& nearest) { return digest_of(nearest.distance); }
template <class Value>
std::uint64_t digest(const Found<Value>& answer) {
    return answer.found ? digest(answer.value) : 0;
}

// ---- kinds ----

/// Answers one question after the other with Kind::answer.
template <class Kind, class QuestionMaker, class AnswerType>
struct OneByOne : QuestionMaker {
    using Answer = AnswerType;
    static void run(const EspalierSideAsset& asset, std::span<const typename QuestionMaker::Question> questions,
                    std::span<Answer> answers) {
        const Blob& blob = *static_cast<const Blob*>(asset.blob);
        for (std::size_t i = 0; i < questions.size(); ++i) Kind::answer(blob, questions[i], answers[i]);
    }
};

struct ClosestHit : OneByOne<ClosestHit, RayQuestion, Found<RayHit>> {
    static void answer(const Blob& blob, const Ray& ray, Answer& to) { to.found = raycast(blob, ray, to.value); }
};

struct AnyHit : OneByOne<AnyHit, RayQuestion, YesNo> {
    static void answer(const Blob& blob, const Ray& ray, Answer& to) { to.yes = occluded(blob, ray); }
};

struct ClosestHitBatch : RayQuestion {
    using Answer = RayHit;
    static void run(const EspalierSideAsset& asset, std::span<const Ray> rays, std::span<RayHit> hits) {
        raycast(*static_cast<const Blob*>(asset.blob), rays, hits);
    }
};

struct AnyHitBatch : RayQuestion {
    using Answer = std::uint8_t;
    static void run(const EspalierSideAsset& asset, std::span<const Ray> rays, std::span<std::uint8_t> answers) {
        occluded(*static_cast<const Blob*>(asset.blob), rays, answers);
    }
};

struct ClosestPoint : OneByOne<ClosestPoint, PointQuestion, Found<Nearest>> {
    static void answer(const Blob& blob, Vec3 point, Answer& to) {
        to.found = closest_point(blob, point, std::numeric_limits<float>::infinity(), to.value);
    }
};

template <class Shape>
struct Overlaps : OneByOne<Overlaps<Shape>, Shape, YesNo> {
    static void answer(const Blob& blob, const typename Shape::Question& shape, YesNo& to) {
        to.yes = overlaps(blob, shape);
    }
};

struct AllOverlaps : OneByOne<AllOverlaps, SphereQuestion, Count> {
    static void answer(const Blob& blob, const Sphere& sphere, Count& to) {
        std::uint32_t count = 0;
        for_each_overlap(blob, sphere, [&count](Triangle) { return ++count, keep_going; });
        to.count = count;
    }
};

template <class Shape>
struct Sweep : OneByOne<Sweep<Shape>, SweepQuestion<Shape>, Found<SweepHit>> {
    static void answer(const Blob& blob, const typename SweepQuestion<Shape>::Question& question, Found<SweepHit>& to) {
        to.found = sweep(blob, question.shape, question.displacement, to.value);
    }
};

struct Collides : OneByOne<Collides, PlacementQuestion, YesNo> {
    static void answer(const Blob& blob, const Placement& placement, YesNo& to) {
        to.yes = false;
        static_cast<void>(collides(blob, blob, placement, to.yes));
    }
};

struct AllContacts : OneByOne<AllContacts, PlacementQuestion, Count> {
    static void answer(const Blob& blob, const Placement& placement, Count& to) {
        std::uint32_t count = 0;
        static_cast<void>(
            for_each_contact(blob, blob, placement, [&count](const TrianglePair&) { return ++count, keep_going; }));
        to.count = count;
    }
};

struct Distance : OneByOne<Distance, PlacementQuestion, Found<PairDistance>> {
    static void answer(const Blob& blob, const Placement& placement, Answer& to) {
        to.found = false;
        static_cast<void>(
            minimum_distance(blob, blob, placement, std::numeric_limits<float>::infinity(), to.value, to.found));
    }
};

struct Open : NoQuestion {
    using Answer = YesNo;
    static void run(const EspalierSideAsset& asset, std::span<const Question>, std::span<YesNo> answers) {
        const std::span bytes(static_cast<const std::byte*>(asset.bytes), asset.size);
        for (YesNo& answer : answers) {
            Blob blob;
            answer.yes = open(bytes, blob) == Status::ok;
        }
    }
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

const EspalierSideKind kinds[] = {kind_named<ClosestHit>("closest_hit"),
                                  kind_named<AnyHit>("any_hit"),
                                  kind_named<ClosestHitBatch>("closest_hit_batch"),
                                  kind_named<AnyHitBatch>("any_hit_batch"),
                                  kind_named<ClosestPoint>("closest_point"),
                                  kind_named<Overlaps<SphereQuestion>>("overlaps_sphere"),
                                  kind_named<AllOverlaps>("all_overlaps_sphere"),
                                  kind_named<Overlaps<BoxQuestion>>("overlaps_box"),
                                  kind_named<Sweep<SphereQuestion>>("sweep_sphere"),
                                  kind_named<Sweep<CapsuleQuestion>>("sweep_capsule"),
                                  kind_named<Sweep<BoxQuestion>>("sweep_box"),
                                  kind_named<Collides>("collides"),
                                  kind_named<AllContacts>("all_contacts"),
                                  kind_named<Distance>("minimum_distance"),
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
    options.bits = bits;
    const std::string_view word = profile;
    if (word == "fast") options.profile = format::Profile::fast;
    else if (word == "balanced") options.profile = format::Profile::balanced;
    else if (word == "small") options.profile = format::Profile::small;
    else if (word == "tiny") options.profile = format::Profile(3);  // commits without it refuse it
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
    const auto baked = bake({&view, 1}, options);
    if (!baked) {
        message = baked.error().message;
        return message.c_str();
    }
    const auto& bytes = baked.value().blob;
    take(to, bytes.data(), bytes.size());
    return nullptr;
}

/// The bytes are this side's own, so that their header is all that there is to check.
const char* open_asset(EspalierSideAsset* asset) {
    Blob& blob = *new (asset->blob) Blob;
    const Status status = open_trusted_image({static_cast<const std::byte*>(asset->bytes), asset->size}, blob);
    return status == Status::ok ? nullptr : describe(status);
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
