// A file that is written bit by bit and appears under its name when it is complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace scree::host {

// Bytes are collected into larger writes. Throws FileError naming the path.
class GrowingFile {
public:
    explicit GrowingFile(const std::filesystem::path& path);
    ~GrowingFile();  // removes what was not committed
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;

    void append(std::string_view bytes);
    void append(std::span<const std::byte> bytes) {
        append(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
    // Replaces bytes that were appended before, at a distance from the first. Not in a pipe.
    void overwrite(std::uint64_t at, std::span<const std::byte> bytes);
    std::uint64_t size() const;  // bytes so far
    void commit();               // gives it its name, in place of an older file

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

// Bytes that are written now and read once, later: in a file without a name, in the folder of `beside`.
class ScratchFile {
public:
    explicit ScratchFile(const std::filesystem::path& beside);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    void append(std::span<const std::byte> bytes);
    std::uint64_t size() const;
    // Calls take(std::string_view) with all bytes in order, block by block.
    template <class Take>
    void read(const Take& take) {
        rewind();
        for (std::string_view block = next(); !block.empty(); block = next()) take(block);
    }

private:
    void rewind();
    std::string_view next();
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
