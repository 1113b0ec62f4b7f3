// Contacts of a body with all instances of a scene, baked or moving.
//
// They are what find_contacts() returns for each instance separately, given as much room, and moved to the world: the
// loop that scene.hpp describes. An edge at which two instances meet counts as a border, where contacts may lean;
// join_borders() (bake.hpp) corrects this for pieces on one lattice.
//
// Any number of threads may query the same scene, and no call allocates.
#pragma once

#include <span>

#include <espalier/contact.hpp>
#include <espalier/scene.hpp>
#include <espalier/shapes.hpp>

namespace espalier {

/// Writes the contacts of a body with all instances, in world space, the deepest first. Of equally deep contacts, that
/// of the lowest instance comes first, and within one instance the order is that of find_contacts() of a blob. `margin`
/// is in world units.
///
/// `room` is scratch memory for the contacts of one instance, and must have at least as many elements as `contacts`.
/// The callable of the filter is called once for each instance near the body, with no_triangle: it keeps or rejects
/// whole instances.
///
/// Returns ok; output_full if there is no room for all contacts, in which case the deepest are kept; or a refusal like
/// that of find_contacts() of a blob. What is out of range for an instance near the body is out of range for the scene.
/// Refuses too little `room` (invalid_argument). A contact has no status, so an element of `contacts` does not convert
/// to bool. Expected cost: O(log n) for n instances, plus the queries of the few near the body and O(contacts.size())
/// for each contact.
template <ContactBody Body>
Filled find_contacts(const SceneView& scene, const Body& body, float margin, std::span<InScene<Contact>> contacts,
                     std::span<Contact> room, const SceneFilter& filter = {}) noexcept;

}  // namespace espalier

// Numerics. Points are those of to_world() and normals those of normal_to_world(); distances are local ones times the
// scale of the instance, rounded once, and the margin is divided by it. In a tile, all of them are transformed once
// more.
