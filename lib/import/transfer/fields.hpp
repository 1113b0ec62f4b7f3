// Values from one process to another of the same program: transfer() lists the fields of each type once, for the
// process that writes them and for the one that reads them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <espalier/import.hpp>

namespace espalier::importer {

/// Writes each value to a stream.
class FieldWriter {
public:
    explicit FieldWriter(std::FILE* file) : file_(file) {}

    template <class... Values>
    void operator()(const Values&... values) {
        (write(values), ...);
    }
    void flush() { std::fflush(file_); }

private:
    template <class Value>
    void write(const Value& value) {
        if constexpr (std::is_trivially_copyable_v<Value>) std::fwrite(&value, sizeof value, 1, file_);
        else transfer(*this, const_cast<Value&>(value));  // which only reads them for a writer
    }
    template <class Value>
    void write(const std::optional<Value>& value) {
        (*this)(value.has_value());
        if (value) (*this)(*value);
    }
    void write(const std::string& value) { write_all(std::span(value)); }
    template <class Element>
    void write(const std::vector<Element>& value) {
        write_all(std::span(value));
    }
    template <class Element>
    void write_all(std::span<Element> values) {
        (*this)(std::uint64_t{values.size()});
        if constexpr (std::is_trivially_copyable_v<Element>)
            std::fwrite(values.data(), sizeof(Element), values.size(), file_);
        else
            for (const Element& each : values) write(each);
    }

    std::FILE* file_;
};

/// The other process ended before it wrote all.
struct EndOfFields {};

/// Reads the same values in the same order. Throws EndOfFields at their end. The writer may have been damaged: a number
/// of elements that is too large reads up to the end of the stream.
class FieldReader {
public:
    /// Takes what reads the next bytes, fewer than there is room for at the end.
    explicit FieldReader(std::function<std::size_t(std::span<std::byte>)> source) : source_(std::move(source)) {}

    template <class... Values>
    void operator()(Values&... values) {
        (read(values), ...);
    }

private:
    template <class Value>
    void read(Value& value) {
        if constexpr (std::is_trivially_copyable_v<Value>) read_bytes(std::as_writable_bytes(std::span(&value, 1)));
        else transfer(*this, value);
    }
    template <class Value>
    void read(std::optional<Value>& value) {
        std::uint8_t has_value = 0;
        read(has_value);
        if (has_value != 0) read(value.emplace());
    }
    void read(std::string& value) { read_all(value); }
    template <class Element>
    void read(std::vector<Element>& value) {
        read_all(value);
    }
    template <class Elements>
    void read_all(Elements& values) {
        using Element = typename Elements::value_type;
        std::uint64_t left = 0;
        read(left);
        values.clear();
        while (left > 0) {
            const std::size_t first = values.size();
            const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, most_at_once));
            values.resize(first + count);
            const auto added = std::span(values).subspan(first);
            if constexpr (std::is_trivially_copyable_v<Element>) read_bytes(std::as_writable_bytes(added));
            else
                for (Element& each : added) read(each);
            left -= count;
        }
    }
    void read_bytes(std::span<std::byte> bytes) {
        if (source_(bytes) != bytes.size()) throw EndOfFields();
    }

    static constexpr std::uint64_t most_at_once = 1 << 16;
    std::function<std::size_t(std::span<std::byte>)> source_;
};

template <class Fields>
void transfer(Fields& fields, ImportDiagnostic& diagnostic) {
    fields(diagnostic.kind, diagnostic.message, diagnostic.file, diagnostic.mesh, diagnostic.triangle);
}

template <class Fields>
void transfer(Fields& fields, ImportedMesh& mesh) {
    fields(mesh.positions, mesh.triangles, mesh.materials, mesh.file, mesh.mesh, mesh.name);
}

template <class Fields>
void transfer(Fields& fields, ImportedFile& file) {
    fields(file.path, file.opened, file.format, file.meshes, file.mesh_names, file.mesh_paths, file.triangles,
           file.materials, file.material_names, file.points_and_lines, file.metres_per_unit, file.unit_origin,
           file.stated_up, file.warnings);
}

template <class Fields>
void transfer(Fields& fields, ImportResult& result) {
    fields(result.meshes, result.places, result.files, result.status, result.reason);
}

}  // namespace espalier::importer
