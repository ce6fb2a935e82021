// Batched copies between host memory and buffers.
#include "host/vulkan/transfer.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/vulkan/command_buffer.h"

namespace scree::host {
namespace {

constexpr std::size_t least_staged = std::size_t{64} << 10, most_staged = std::size_t{16} << 20;  // bytes per submission

void check_range(std::size_t bytes, std::size_t offset, std::size_t size) {
    if (offset <= size && bytes <= size - offset) return;
    throw std::out_of_range("bytes " + std::to_string(offset) + " and the next " + std::to_string(bytes) +
                            " lie outside a buffer of " + std::to_string(size));
}

// Ranges of buffers that a recording has written.
class Written {
public:
    // False if some of the range was written before.
    bool add(const Buffer& buffer, std::size_t begin, std::size_t end) {
        std::map<std::size_t, std::size_t>& ranges = ranges_[buffer.handle()];
        const auto after = ranges.lower_bound(begin);
        if (after != ranges.end() && after->first < end) return false;
        if (after != ranges.begin() && std::prev(after)->second > begin) return false;
        ranges.emplace_hint(after, begin, end);
        return true;
    }
    void clear() { ranges_.clear(); }

private:
    std::map<VkBuffer, std::map<std::size_t, std::size_t>> ranges_;  // begin, end
};

// Makes a staging buffer that holds `bytes`, or as much as a submission may, unless it does already.
void hold(Buffer& staging, const std::shared_ptr<Device>& device, const char* name, std::size_t bytes, BufferUse use) {
    const std::size_t wanted = std::min(std::bit_ceil(std::max(bytes, least_staged)), most_staged);
    if (staging && staging.bytes() >= wanted) return;
    staging = {};  // freed first
    staging = Buffer(device, name, wanted, use);
}

// The filling of a staging buffer, which is submitted when full and reused.
class Staging {
public:
    Staging(const std::shared_ptr<Device>& device, const Buffer& buffer, std::optional<CommandBuffer>& copies)
        : device_(device), buffer_(buffer), copies_(copies) {}

    // Splits a piece to fit: calls copy(recording, buffer, offset in it, done, count) for each part, and `sent` after
    // each submission.
    template <typename Copy, typename Sent>
    void add(std::size_t bytes, const Copy& copy, const Sent& sent) {
        for (std::size_t done = 0; done < bytes;) {
            if (used_ == buffer_.bytes()) submit(sent);
            const std::size_t count = std::min(bytes - done, buffer_.bytes() - used_);
            if (used_ == 0) begin();
            copy(*copies_, buffer_, used_, done, count);
            used_ += count;
            done += count;
        }
    }
    template <typename Sent>
    void submit(const Sent& sent) {
        if (used_ == 0) return;
        copies_->end();
        device_->submit_and_wait({copies_->handle()});
        sent(static_cast<const std::byte*>(buffer_.mapped()));
        used_ = 0;
    }

private:
    void begin() {
        if (copies_)
            copies_->begin_again();
        else
            copies_.emplace(device_);
    }

    std::shared_ptr<Device> device_;
    const Buffer& buffer_;
    std::optional<CommandBuffer>& copies_;
    std::size_t used_ = 0;
};

}  // namespace

void Transfer::upload(std::span<const Upload> pieces) {
    std::size_t staged = 0;
    for (const Upload& piece : pieces) {
        check_range(piece.data.size(), piece.offset, piece.to->bytes());
        if (!piece.to->mapped()) staged += piece.data.size();
    }
    device_->wait_idle();
    for (const Upload& piece : pieces)
        if (piece.to->mapped() && !piece.data.empty())
            std::memcpy(static_cast<std::byte*>(piece.to->mapped()) + piece.offset, piece.data.data(), piece.data.size());
    if (staged == 0) return;
    hold(sent_, device_, "staging for writing", staged, BufferUse::upload);
    Staging staging(device_, sent_, copies_);
    Written written;
    const auto sent = [&](const std::byte*) { written.clear(); };
    for (const Upload& piece : pieces) {
        if (piece.to->mapped()) continue;
        staging.add(
            piece.data.size(),
            [&](CommandBuffer& commands, const Buffer& from, std::size_t place, std::size_t done, std::size_t count) {
                std::memcpy(static_cast<std::byte*>(from.mapped()) + place, piece.data.data() + done, count);
                const std::size_t begin = piece.offset + done;
                if (!written.add(*piece.to, begin, begin + count)) {  // of overlapping pieces the last one counts
                    commands.barrier();
                    written.clear();
                    written.add(*piece.to, begin, begin + count);
                }
                commands.copy(from, *piece.to, count, place, piece.offset + done);
            },
            sent);
    }
    staging.submit(sent);
}

void Transfer::download(std::span<const Download> pieces) {
    std::size_t staged = 0;
    for (const Download& piece : pieces) {
        check_range(piece.data.size(), piece.offset, piece.from->bytes());
        if (!piece.from->mapped()) staged += piece.data.size();
    }
    device_->wait_idle();
    for (const Download& piece : pieces)
        if (piece.from->mapped() && !piece.data.empty())
            std::memcpy(piece.data.data(), static_cast<const std::byte*>(piece.from->mapped()) + piece.offset, piece.data.size());
    if (staged == 0) return;
    hold(received_, device_, "staging for reading", staged, BufferUse::readback);
    Staging staging(device_, received_, copies_);
    struct Part {
        std::byte* to;
        std::size_t place, count;
    };
    std::vector<Part> under_way;
    const auto sent = [&](const std::byte* mapped) {
        for (const Part& part : under_way) std::memcpy(part.to, mapped + part.place, part.count);
        under_way.clear();
    };
    for (const Download& piece : pieces) {
        if (piece.from->mapped()) continue;
        staging.add(
            piece.data.size(),
            [&](CommandBuffer& commands, const Buffer& to, std::size_t place, std::size_t done, std::size_t count) {
                commands.copy(*piece.from, to, count, piece.offset + done, place);
                under_way.push_back({piece.data.data() + done, place, count});
            },
            sent);
    }
    staging.submit(sent);
}

void upload(const std::shared_ptr<Device>& device, std::span<const Upload> pieces) {
    Transfer(device).upload(pieces);
}
void download(const std::shared_ptr<Device>& device, std::span<const Download> pieces) {
    Transfer(device).download(pieces);
}

}  // namespace scree::host
