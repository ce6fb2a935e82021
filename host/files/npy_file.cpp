// numpy's files. https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html; a .npz is a ZIP archive of .npy
// files, here without compression (PKWARE, .ZIP File Format Specification 6.3.10).
#include "host/files/npy_file.h"

#include <array>
#include <bit>
#include <deque>

#include "host/files/file.h"
#include "host/files/growing_file.h"

namespace scree::host {
namespace {

// The magic, version 1.0, and a header padded so that the data begin at a multiple of 64 bytes.
std::string npy_head(const std::string& type, std::span<const std::size_t> shape) {
    std::string sizes;
    for (const std::size_t size : shape) sizes += std::to_string(size) + ",";
    const char order = type == "b1" ? '|' : std::endian::native == std::endian::little ? '<' : '>';
    std::string header = std::string("{'descr': '") + order + type + "', 'fortran_order': False, 'shape': (" + sizes + "), }";
    constexpr std::size_t before = 10;
    header.append(63 - (before + header.size()) % 64, ' ');
    header += '\n';
    std::string head("\x93NUMPY\x01\x00", 8);
    head += static_cast<char>(header.size() & 0xFF);
    head += static_cast<char>(header.size() >> 8);
    return head + header;
}

void write_array(const std::filesystem::path& path, const char* type, std::span<const std::byte> values,
                 std::span<const std::size_t> shape) {
    std::string file = npy_head(type, shape);
    file.append(reinterpret_cast<const char*>(values.data()), values.size());
    write_atomically(path, file);
}

// ---- ZIP
constexpr std::uint32_t too_long = 0xFFFFFFFF;  // a length that stands in the ZIP64 field

// CRC-32 (ISO 3309), by bytes.
class Crc {
public:
    void take(std::string_view bytes) {
        for (const char byte : bytes) value_ = table()[(value_ ^ static_cast<std::uint8_t>(byte)) & 0xFF] ^ (value_ >> 8);
    }
    std::uint32_t value() const { return ~value_; }

private:
    static const std::array<std::uint32_t, 256>& table() {
        static const std::array<std::uint32_t, 256> made = [] {
            std::array<std::uint32_t, 256> values{};
            for (std::uint32_t i = 0; i < 256; ++i) {
                std::uint32_t rest = i;
                for (int bit = 0; bit < 8; ++bit) rest = (rest & 1) != 0 ? 0xEDB88320u ^ (rest >> 1) : rest >> 1;
                values[i] = rest;
            }
            return values;
        }();
        return made;
    }
    std::uint32_t value_ = 0xFFFFFFFF;
};

template <class Number>
void put_number(std::string& to, Number value) {
    for (std::size_t k = 0; k < sizeof value; ++k) to += static_cast<char>(value >> (8 * k) & 0xFF);
}

struct ZipEntry {
    std::string name;
    std::uint32_t crc = 0;
    std::uint64_t bytes = 0, offset = 0;
};

// What the local header and the central directory have in common, and the lengths in ZIP64's way.
std::string common_header(const ZipEntry& entry, bool with_offset) {
    std::string made;
    put_number(made, std::uint16_t{45});  // needs ZIP64
    put_number(made, std::uint16_t{0});
    put_number(made, std::uint16_t{0});   // stored
    put_number(made, std::uint16_t{0});   // time
    put_number(made, std::uint16_t{33});  // 1 January 1980: equal runs give equal files
    put_number(made, entry.crc);
    put_number(made, too_long);
    put_number(made, too_long);
    put_number(made, static_cast<std::uint16_t>(entry.name.size()));
    put_number(made, static_cast<std::uint16_t>(with_offset ? 28 : 20));  // of the ZIP64 field
    return made;
}
std::string long_field(const ZipEntry& entry, bool with_offset) {
    std::string made;
    put_number(made, std::uint16_t{1});
    put_number(made, static_cast<std::uint16_t>(with_offset ? 24 : 16));
    put_number(made, entry.bytes);
    put_number(made, entry.bytes);
    if (with_offset) put_number(made, entry.offset);
    return made;
}
std::string local_header(const ZipEntry& entry) {
    std::string made = "PK\x03\x04";
    return made + common_header(entry, false) + entry.name + long_field(entry, false);
}
std::string directory_entry(const ZipEntry& entry) {
    std::string made = "PK\x01\x02";
    put_number(made, std::uint16_t{45});
    made += common_header(entry, true);
    put_number(made, std::uint16_t{0});  // comment
    put_number(made, std::uint16_t{0});  // disk
    put_number(made, std::uint16_t{0});  // attributes
    put_number(made, std::uint32_t{0});
    put_number(made, too_long);  // offset
    return made + entry.name + long_field(entry, true);
}
std::string end_of_directory(std::uint64_t entries, std::uint64_t offset, std::uint64_t bytes) {
    std::string made = "PK\x06\x06";
    put_number(made, std::uint64_t{44});
    put_number(made, std::uint16_t{45});
    put_number(made, std::uint16_t{45});
    put_number(made, std::uint32_t{0});
    put_number(made, std::uint32_t{0});
    put_number(made, entries);
    put_number(made, entries);
    put_number(made, bytes);
    put_number(made, offset);
    made += "PK\x06\x07";
    put_number(made, std::uint32_t{0});
    put_number(made, offset + bytes);
    put_number(made, std::uint32_t{1});
    made += "PK\x05\x06";
    for (int k = 0; k < 4; ++k) put_number(made, std::uint16_t{static_cast<std::uint16_t>(k < 2 ? 0 : entries)});
    put_number(made, too_long);
    put_number(made, too_long);
    put_number(made, std::uint16_t{0});
    return made;
}

}  // namespace

void write_npy(const std::filesystem::path& path, std::span<const float> values, std::span<const std::size_t> shape) {
    write_array(path, "f4", std::as_bytes(values), shape);
}

void write_npy(const std::filesystem::path& path, std::span<const std::int32_t> values, std::span<const std::size_t> shape) {
    write_array(path, "i4", std::as_bytes(values), shape);
}

struct NpzFile::Impl {
    struct Array {
        std::string name, type;
        std::vector<std::size_t> row;
        std::unique_ptr<ScratchFile> rows;
        std::size_t row_bytes() const {
            std::size_t bytes = static_cast<std::size_t>(type[1] - '0');
            for (const std::size_t size : row) bytes *= size;
            return bytes;
        }
    };
    std::filesystem::path path;
    GrowingFile file;
    std::deque<Array> arrays;
    std::vector<ZipEntry> entries;

    void write(Array& array) {
        std::vector<std::size_t> shape = array.row;
        const std::size_t row = array.row_bytes();
        shape.insert(shape.begin(), row == 0 ? 0 : static_cast<std::size_t>(array.rows->size() / row));
        const std::string head = npy_head(array.type, shape);
        Crc crc;
        crc.take(head);
        array.rows->read([&](std::string_view block) { crc.take(block); });
        const ZipEntry& entry =
            entries.emplace_back(ZipEntry{array.name + ".npy", crc.value(), head.size() + array.rows->size(), file.size()});
        file.append(local_header(entry));
        file.append(head);
        array.rows->read([&](std::string_view block) { file.append(block); });
    }
};

NpzFile::NpzFile(const std::filesystem::path& path) : interior_(new Impl{path, GrowingFile(path), {}, {}}) {}
NpzFile::~NpzFile() = default;

std::size_t NpzFile::add_array(const std::string& name, const std::string& type, const std::vector<std::size_t>& row) {
    interior_->arrays.push_back({name, type, row, std::make_unique<ScratchFile>(interior_->path)});
    return interior_->arrays.size() - 1;
}

void NpzFile::append(std::size_t array, std::span<const std::byte> rows) {
    interior_->arrays.at(array).rows->append(rows);
}

void NpzFile::finish() {
    for (Impl::Array& array : interior_->arrays) interior_->write(array);
    const std::uint64_t offset = interior_->file.size();
    for (const ZipEntry& entry : interior_->entries) interior_->file.append(directory_entry(entry));
    interior_->file.append(end_of_directory(interior_->entries.size(), offset, interior_->file.size() - offset));
    interior_->file.commit();
}

}  // namespace scree::host
