// Contacts of bodies with one blob.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "shapes/batches.hpp"

#include <cstring>
#include <vector>

#include <espalier/contact.hpp>

namespace espalier::python {

namespace {

/// Returns (offsets, contacts, statuses).
py::tuple contact_lists(const HeldBlob& self, const std::string& kind, const py::tuple& given, const py::handle& margin,
                        std::size_t most, unsigned threads) {
    Floats margins(margin, "margin", {});
    return list_for_shapes<Contact>(
        {kind, given, origin_of(self.blob)}, &margins, dtype_of("contact"), threads,
        [&](const auto& shape, std::size_t i, Growing<Contact>& contacts) requires requires {
            find_contacts(self.blob, shape, 0.0f, std::span<Contact>());
        } {
            const Filled filled =
                find_contacts(self.blob, shape, margins.as<float>().at(i), contacts.places(most).first(most));
            contacts.add(filled.count);
            return filled.status;
        });
}

/// Returns (offsets, planes, statuses).
py::tuple plane_lists(const HeldBlob& self, const std::string& kind, const py::tuple& given, const py::handle& margin,
                      std::size_t most, unsigned threads) {
    Floats margins(margin, "margin", {});
    return list_for_shapes<ContactPlane>(
        {kind, given, origin_of(self.blob)}, &margins, dtype_of("contact_plane"), threads,
        [&](const auto& shape, std::size_t i, Growing<ContactPlane>& planes) requires requires {
            collect_planes(self.blob, shape, 0.0f, std::span<ContactPlane>());
        } {
            const Filled filled =
                collect_planes(self.blob, shape, margins.as<float>().at(i), planes.places(most).first(most));
            planes.add(filled.count);
            return filled.status;
        });
}

/// Returns the way along each list of planes that `offsets` divides.
py::array solved_ways(const py::array_t<py::ssize_t, py::array::c_style>& offsets, const py::array& planes,
                      const py::handle& wishes, const py::handle& skins) {
    if (!planes.dtype().equal(dtype_of("contact_plane")) || (planes.flags() & py::array::c_style) == 0)
        throw py::type_error("planes must be a contiguous array of CONTACT_PLANE");
    Floats wish(wishes, "wish", {3}), skin(skins, "skin", {});
    const Batch batch({&wish, &skin});
    if (static_cast<std::size_t>(offsets.size()) != batch.count() + 1)
        throw py::value_error("there must be a list of planes for each wish");
    const std::span all(static_cast<const ContactPlane*>(planes.data()), static_cast<std::size_t>(planes.size()));
    py::array results = batch.results(dtype_of("way"));
    auto* ways = static_cast<Result<Vec3>*>(results.mutable_data());
    for (std::size_t i = 0; i < batch.count(); ++i) {
        const py::ssize_t first = offsets.data()[i], end = offsets.data()[i + 1];
        if (first < 0 || end < first || end > planes.size()) throw py::value_error("offsets are those of other lists");
        const auto some = all.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
        ways[i] = solve_planes(some, wish.as<Vec3>().at(i), skin.as<float>().at(i));
    }
    return results;
}

/// Returns (offsets, numbers) of the contacts that support each body best, of lists that `offsets` divides.
py::tuple kept_contacts(const py::array_t<py::ssize_t, py::array::c_style>& offsets, const py::array& given) {
    if (!given.dtype().equal(dtype_of("contact")) || (given.flags() & py::array::c_style) == 0)
        throw py::type_error("contacts must be a contiguous array of CONTACT");
    std::vector<Contact> contacts(static_cast<std::size_t>(given.size()));
    if (!contacts.empty())
        std::memcpy(static_cast<void*>(contacts.data()), given.data(), contacts.size() * sizeof(Contact));
    // The triangle plays no part: its place keeps the number of the contact.
    for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].triangle.index = static_cast<std::uint32_t>(i);
    const py::ssize_t count = offsets.size();
    py::array_t<py::ssize_t> ends(count);
    Growing<std::uint32_t> numbers;
    if (count > 0) ends.mutable_data()[0] = 0;
    for (py::ssize_t i = 1; i < count; ++i) {
        const py::ssize_t first = offsets.data()[i - 1], end = offsets.data()[i];
        if (first < 0 || end < first || end > given.size()) throw py::value_error("offsets are those of other lists");
        const std::span<Contact> some(contacts.data() + first, static_cast<std::size_t>(end - first));
        const std::size_t kept = reduce_contacts(some);
        for (const Contact& contact : some.first(kept)) numbers.push(contact.triangle.index);
        ends.mutable_data()[i] = static_cast<py::ssize_t>(numbers.count());
    }
    return py::make_tuple(ends, numbers.to_numpy(py::dtype::of<std::uint32_t>()));
}

}  // namespace

void bind_contacts(py::module_& module) {
    module.def("contact_lists", contact_lists);
    module.def("kept_contacts", kept_contacts);
    module.def("plane_lists", plane_lists);
    module.def("solved_ways", solved_ways);
}

}  // namespace espalier::python
