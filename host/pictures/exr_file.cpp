// Frames as OpenEXR files, by tinyexr. https://openexr.com/en/latest/OpenEXRFileLayout.html
#include "host/pictures/exr_file.h"

#include <tinyexr.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "host/files/file.h"

namespace scree::host {
namespace {

struct Channel {
    std::string name;
    const float* values;
    int kept;  // TINYEXR_PIXELTYPE_*
};

EXRChannelInfo named(const std::string& name) {
    EXRChannelInfo info{};
    if (name.size() >= sizeof info.name) throw ImageError("EXR: the name " + name + " is too long");
    std::memcpy(info.name, name.c_str(), name.size() + 1);
    return info;
}

}  // namespace

std::vector<std::uint8_t> exr_bytes(const Image& image, bool alpha, std::span<const ExrLayer> layers) {
    const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (pixels == 0 || image.rgba.size() != pixels * (image.bits == 16 ? 8 : 4))
        throw ImageError("EXR: the picture's size is not that of its pixels");
    const std::string letters = alpha ? "RGBA" : "RGB";
    std::vector<std::vector<float>> light(letters.size(), std::vector<float>(pixels));
    std::vector<Channel> channels;
    for (std::size_t k = 0; k < letters.size(); ++k) {
        for (std::size_t i = 0; i < pixels; ++i) light[k][i] = light_at(image, 4 * i + k);
        channels.push_back({letters.substr(k, 1), light[k].data(), TINYEXR_PIXELTYPE_HALF});
    }
    for (const ExrLayer& layer : layers) {
        if (layer.values.size() != pixels)
            throw ImageError("EXR: the layer " + layer.name + " has another size than the picture");
        channels.push_back({layer.name, layer.values.data(), TINYEXR_PIXELTYPE_FLOAT});
    }
    // The format wants channels sorted by name.
    std::sort(channels.begin(), channels.end(), [](const Channel& a, const Channel& b) { return a.name < b.name; });

    std::vector<EXRChannelInfo> infos;
    std::vector<int> given(channels.size(), TINYEXR_PIXELTYPE_FLOAT), kept;
    std::vector<unsigned char*> planes;
    for (const Channel& channel : channels) {
        infos.push_back(named(channel.name));
        kept.push_back(channel.kept);
        // tinyexr reads them only.
        planes.push_back(reinterpret_cast<unsigned char*>(const_cast<float*>(channel.values)));
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = static_cast<int>(channels.size());
    header.channels = infos.data();
    header.pixel_types = given.data();
    header.requested_pixel_types = kept.data();
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    EXRImage whole;
    InitEXRImage(&whole);
    whole.num_channels = header.num_channels;
    whole.images = planes.data();
    whole.width = image.width;
    whole.height = image.height;
    unsigned char* memory = nullptr;
    const char* error = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&whole, &header, &memory, &error);
    const std::unique_ptr<unsigned char, decltype(&std::free)> made(memory, &std::free);
    if (size == 0) {
        const std::string why = error != nullptr ? error : "unknown reason";
        FreeEXRErrorMessage(error);
        throw ImageError("EXR encoding: " + why);
    }
    return {memory, memory + size};
}

void write_exr(const std::filesystem::path& path, const Image& image, bool alpha, std::span<const ExrLayer> layers) {
    try {
        write_atomically(path, std::as_bytes(std::span<const std::uint8_t>(exr_bytes(image, alpha, layers))));
    } catch (const FileError& error) {
        throw ImageError(error.what());
    }
}

}  // namespace scree::host
