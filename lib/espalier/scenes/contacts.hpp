// Contacts of a body with all instances of a scene, baked or moving.
//
// They are what find_contacts() returns for each instance by itself, with as many places, moved to the world: the loop
// that scene.hpp describes. An edge where two instances meet counts as a border, on which contacts lean; join_borders()
// (bake.hpp) corrects that for pieces on one lattice.
//
// Thread safety: any number of threads may query one scene. No call allocates.
#pragma once

#include <span>

#include <espalier/contact.hpp>
#include <espalier/scene.hpp>
#include <espalier/shapes.hpp>

namespace espalier {

/// Writes the contacts of a body with all instances, in world space, the deepest first; of equally deep ones that of
/// the lowest instance, then as find_contacts() of a blob has them. `margin` is in world units.
///
/// `room` is memory for the contacts of one instance, with as many places as `contacts` at least. The callable of the
/// filter is called once for each instance near the body, with no_triangle: it keeps or leaves out whole instances.
///
/// Status: ok; output_full if all places are taken: of more contacts the deepest are kept; or a refusal, as of
/// find_contacts() of a blob: what is out of the range of an instance near the body is so for the scene (out_of_range).
/// Refuses less room (invalid_argument). A contact has no status: an element of `contacts` does not convert to bool.
/// Cost: expected O(log n) for n instances, the queries of the few near the body, and O(places) for each contact.
template <ContactBody Body>
Filled find_contacts(const SceneView& scene, const Body& body, float margin, std::span<InScene<Contact>> contacts,
                     std::span<Contact> room, const SceneFilter& filter = {}) noexcept;

}  // namespace espalier

// Numerics. Points are those of to_world(), normals those of normal_to_world(), distances local ones times the scale of
// the instance, rounded once; the margin is divided by it. In a tile, all are moved once more.
