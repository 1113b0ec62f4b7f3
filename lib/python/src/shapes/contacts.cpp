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
}

}  // namespace espalier::python
