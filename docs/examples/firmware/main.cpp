// Tests on a microcontroller whether an arm hits a table. The mesh lies in flash: no heap, no C library, no copy in
// RAM.
#include <espalier/espalier.hpp>

#include "board/semihosting.hpp"
#include "table.h"

namespace {

using espalier::Vec3;

/// The joints of an arm that stands beside the table, as the kinematics of a path have them.
struct Pose {
    const char* name;
    Vec3 shoulder;
    Vec3 elbow;
    Vec3 wrist;
    Vec3 tip;
};

constexpr Pose path[] = {
    {"at rest", {-0.9f, 0.0f, 0.9f}, {-0.8f, 0.0f, 1.3f}, {-0.45f, 0.0f, 1.25f}, {-0.4f, 0.0f, 1.1f}},
    {"above the mug", {-0.9f, 0.0f, 0.9f}, {-0.7f, -0.1f, 1.25f}, {-0.35f, -0.15f, 1.1f}, {-0.3f, -0.15f, 0.95f}},
    {"too low", {-0.9f, 0.0f, 0.9f}, {-0.6f, 0.0f, 1.1f}, {-0.2f, 0.1f, 0.9f}, {-0.15f, 0.1f, 0.74f}},
    {"through the crate", {-0.9f, 0.0f, 0.9f}, {-0.5f, 0.0f, 1.15f}, {0.0f, 0.05f, 0.95f}, {0.3f, 0.05f, 0.9f}},
    {"back", {-0.9f, 0.0f, 0.9f}, {-0.8f, 0.0f, 1.3f}, {-0.45f, 0.0f, 1.25f}, {-0.4f, 0.0f, 1.1f}},
    {"without a number",
     {-0.9f, 0.0f, 0.9f},
     {-0.8f, __builtin_nanf(""), 1.3f},
     {-0.45f, 0.0f, 1.25f},
     {-0.4f, 0.0f, 1.1f}},
};

struct Link {
    const char* name;
    espalier::Capsule shape;
};

void print_number(std::uint32_t number) {
    char digits[11] = {};
    char* first = digits + 10;
    do {
        *--first = static_cast<char>('0' + number % 10);
        number /= 10;
    } while (number != 0);
    board::print(first);
}

/// Prints why a link does not pass.
void refuse(const char* link, const char* verb, const char* reason) {
    board::print(": the ");
    board::print(link);
    board::print(verb);
    board::print(reason);
    board::print("\n");
}

/// Returns whether the pose is free. Only a no proves that: a query that was refused, for example because of a NaN in
/// the pose, is neither yes nor no. Yes and no are exact; the clearance is printed where there is one.
bool check(const espalier::Blob& table, const Pose& pose) {
    const Link links[] = {{"upper arm", {pose.shoulder, pose.elbow, 0.06f}},
                          {"forearm", {pose.elbow, pose.wrist, 0.05f}},
                          {"gripper", {pose.wrist, pose.tip, 0.03f}}};
    board::print(pose.name);
    constexpr float farthest = 1000.0f;  // metres: a clearance in millimetres that fits an integer
    float clearance = farthest;
    for (const Link& link : links) {
        const espalier::YesNo hits = overlaps(table, link.shape);
        if (!hits.no()) {
            if (hits.yes()) refuse(link.name, " hits the table", "");
            else refuse(link.name, " cannot be checked: ", describe(hits.status()));
            return false;
        }
        const espalier::ClosestPoint nearest =
            closest_point(table, espalier::Segment{link.shape.from, link.shape.to}, farthest);
        if (is_refused(nearest.status)) {
            refuse(link.name, " has no clearance: ", describe(nearest.status));
            return false;
        }
        if (nearest && nearest.distance - link.shape.radius < clearance)
            clearance = nearest.distance - link.shape.radius;
    }
    if (clearance < farthest) {
        board::print(": clear by ");
        print_number(static_cast<std::uint32_t>(clearance * 1000.0f));
        board::print(" mm\n");
    } else {
        board::print(": nothing is near\n");
    }
    return true;
}

}  // namespace

int main() {
    // The blob is part of this program, so its bytes can be trusted. Call open() for bytes that come by cable or are
    // written to flash separately: it proves that every query on them is safe. A static Blob that is initialised by the
    // call takes no stack.
    static const espalier::Blob table = espalier::open_unchecked(table_bytes());
    if (!table) {
        board::print(describe(table.status()));
        return 1;
    }
    bool is_free = true;
    for (const Pose& pose : path) is_free = check(table, pose) && is_free;
    board::print(is_free ? "the path is free\n" : "the path is not free\n");
    return 0;
}
