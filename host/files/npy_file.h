// numpy's files: .npy, one array, and .npz, several that grow while they are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace scree::host {

// Writes an array as .npy (format 1.0, C order), atomically. Throws FileError.
void write_npy(const std::filesystem::path& path, std::span<const float> values, std::span<const std::size_t> shape);
void write_npy(const std::filesystem::path& path, std::span<const std::int32_t> values, std::span<const std::size_t> shape);

// Arrays whose first axis grows; bounded memory, since what was appended lies in unnamed files beside the target. The file
// appears when it is finished. Throws FileError.
class NpzFile {
public:
    explicit NpzFile(const std::filesystem::path& path);
    ~NpzFile();
    NpzFile(const NpzFile&) = delete;
    NpzFile& operator=(const NpzFile&) = delete;

    // `type`: numpy's, without the byte order: "f8", "f4", "i8", "i4", "b1". `row`: the shape behind the first axis.
    std::size_t add_array(const std::string& name, const std::string& type, const std::vector<std::size_t>& row);
    void append(std::size_t array, std::span<const std::byte> rows);  // whole rows
    template <class Value>
    void append(std::size_t array, const std::vector<Value>& rows) {
        append(array, std::as_bytes(std::span(rows)));
    }
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
