// The few contacts that support a body: of the forces and levers of all, those that span most.
#include <espalier/contact.hpp>
#include <runtime/contacts/touch.hpp>

namespace espalier {

using namespace detail;
using namespace detail::contacts;

namespace {

/// A force along the normal: its direction, and its lever about the middle of all points, in times of the largest.
struct Support {
    Vec3 force;
    Vec3 lever;
};

class Supports {
public:
    explicit Supports(std::span<const Contact> contacts) {
        float share = 0.0f;
        for (const Contact& contact : contacts) {
            share += 1.0f;
            middle_ = middle_ + (contact.point - middle_) * (1.0f / share);
        }
        for (const Contact& contact : contacts) size_ = maximum(size_, largest(contact.point - middle_));
    }
    [[nodiscard]] Support of(const Contact& contact) const {
        const Vec3 arm = size_ > 0.0f ? (contact.point - middle_) * (1.0f / size_) : Vec3{};
        return {contact.normal, cross(arm, contact.normal)};
    }

    /// How far the points reach from their middle.
    [[nodiscard]] float size() const { return size_; }

private:
    Vec3 middle_;
    float size_ = 0.0f;
};

Support difference(const Support& a, const Support& b) { return {a.force - b.force, a.lever - b.lever}; }
float inner(const Support& a, const Support& b) { return dot(a.force, b.force) + dot(a.lever, b.lever); }

float squared_distance_to(const Support& a, const Support& p) {
    const Support from_a = difference(p, a);
    return inner(from_a, from_a);
}
float squared_distance_to(const Support& a, const Support& b, const Support& p) {
    const Support side = difference(b, a), from_a = difference(p, a);
    const float along = inner(from_a, side), length = inner(side, side);
    if (along <= 0.0f) return inner(from_a, from_a);
    if (along >= length) return squared_distance_to(b, p);
    return maximum(inner(from_a, from_a) - along * along / length, 0.0f);
}
/// Returns the squared distance to the triangle of three supports: to its inside if p lies over it, else to its sides.
float squared_distance_to(const Support& a, const Support& b, const Support& c, const Support& p) {
    const Support ab = difference(b, a), ac = difference(c, a), ap = difference(p, a);
    const float bb = inner(ab, ab), cc = inner(ac, ac), bc = inner(ab, ac), pb = inner(ap, ab), pc = inner(ap, ac);
    const float whole = bb * cc - bc * bc, u = pb * cc - pc * bc, v = pc * bb - pb * bc;
    if (whole > 0.0f && u >= 0.0f && v >= 0.0f && u + v <= whole)
        return maximum(inner(ap, ap) - (u * pb + v * pc) / whole, 0.0f);
    return minimum(squared_distance_to(a, b, p), minimum(squared_distance_to(b, c, p), squared_distance_to(a, c, p)));
}

void swap_places(Contact& a, Contact& b) {
    const Contact held = a;
    a = b;
    b = held;
}

/// Returns how far a contact is from the hull of those kept, at most three.
float squared_distance(const Supports& supports, std::span<const Contact> kept, const Contact& contact) {
    const Support p = supports.of(contact);
    if (kept.empty()) return inner({{}, p.lever}, {{}, p.lever});  // from the middle
    const Support a = supports.of(kept[0]);
    if (kept.size() == 1) return squared_distance_to(a, p);
    const Support b = supports.of(kept[1]);
    return kept.size() == 2 ? squared_distance_to(a, b, p) : squared_distance_to(a, b, supports.of(kept[2]), p);
}

std::size_t deepest_of(std::span<const Contact> contacts) {
    std::size_t deepest = 0;
    for (std::size_t i = 1; i < contacts.size(); ++i)
        if (contacts[i].distance < contacts[deepest].distance) deepest = i;
    return deepest;
}

std::size_t most_alike(const Supports& supports, std::span<const Contact> kept, const Contact& contact) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < kept.size(); ++i) {
        const Support p = supports.of(contact);
        if (squared_distance_to(supports.of(kept[i]), p) < squared_distance_to(supports.of(kept[best]), p)) best = i;
    }
    return best;
}

}  // namespace

std::size_t reduce_contacts(std::span<Contact> contacts) noexcept {
    if (contacts.empty()) return 0;
    const Supports supports(contacts);
    // Less than this is the same support: a hundredth of the largest lever, or half a degree.
    constexpr float alike = 1e-4f;
    // Those that touch come first, since they alone carry the body. With others in their place it sinks, those of the
    // next step are others again, and it rocks.
    float farthest = maximum(contacts[deepest_of(contacts)].distance, 0.0f);
    std::size_t kept = 0;
    while (kept < contacts.size() && kept < max_reduced_contacts) {
        float most = kept == 0 ? -1.0f : alike;
        std::size_t best = contacts.size();
        for (std::size_t i = kept; i < contacts.size(); ++i) {
            if (contacts[i].distance > farthest) continue;
            const float distance = squared_distance(supports, contacts.first(kept), contacts[i]);
            if (distance > most) {
                most = distance;
                best = i;
            }
        }
        if (best == contacts.size()) {
            if (farthest == infinity) break;
            farthest = infinity;
            continue;
        }
        swap_places(contacts[kept++], contacts[best]);
    }
    if (kept == 0) kept = 1;  // no lever is a number
    const std::span<Contact> few = contacts.first(kept), rest = contacts.subspan(kept);
    if (!rest.empty()) {
        Contact& deepest = rest[deepest_of(rest)];
        if (few[deepest_of(few)].distance - deepest.distance > supports.size() * (1.0f / 256.0f))
            swap_places(few[most_alike(supports, few, deepest)], deepest);
    }
    swap_places(few[0], few[deepest_of(few)]);
    return kept;
}

}  // namespace espalier
