// Files of USD scenes. A .usdz is a ZIP archive whose files are stored as they are; its first one is the scene.
#include "compute/scene_file/import/usd/usd_files.h"

#include <algorithm>

#include "compute/scene_file/import/usd/crate_bytes.h"

namespace scree::imports {

namespace {

constexpr std::size_t most_layers = 2000, most_packed_files = 100000;

std::string lower_ending(const std::string& name) {
    std::string ending = std::filesystem::path(name).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

// Where the table of an archive's files begins, by the record at its end.
std::pair<std::size_t, std::size_t> table_of_zip(const std::string& bytes) {
    constexpr std::size_t record = 22;
    const std::size_t last = bytes.size() < record ? bytes.npos : bytes.rfind("PK\x05\x06", bytes.size() - record);
    if (last == bytes.npos) throw CrateError("it has no table of files");
    CrateCursor from(bytes, last + 10);
    const auto count = from.read<std::uint16_t>();
    from.take(4);
    return {from.read<std::uint32_t>(), count};
}

}  // namespace

const UsdFiles::Package& UsdFiles::package(const Origin& at, const std::string& file) {
    const auto [found, fresh] = packages_.try_emplace(file);
    Package& made = found->second;
    if (!fresh) return made;
    made.bytes = folder_.bytes(at, file);
    try {
        const auto [start, count] = table_of_zip(made.bytes);
        CrateCursor table(made.bytes, start);
        for (std::size_t i = 0; i < std::min(count, most_packed_files); ++i) {
            if (table.read<std::uint32_t>() != 0x02014B50) throw CrateError("its table of files is broken");
            table.take(6);
            const auto method = table.read<std::uint16_t>();
            table.take(8);
            const auto size = table.read<std::uint32_t>();
            table.take(4);
            const auto name = table.read<std::uint16_t>(), extra = table.read<std::uint16_t>(),
                       note = table.read<std::uint16_t>();
            table.take(8);
            CrateCursor head(made.bytes, table.read<std::uint32_t>());
            const std::string called(table.take(name));
            table.take(std::size_t{extra} + note);
            if (method != 0) throw CrateError("\"" + called.substr(0, 200) + "\" is compressed, which a .usdz never is");
            head.take(26);
            const auto name_there = head.read<std::uint16_t>(), extra_there = head.read<std::uint16_t>();
            head.take(std::size_t{name_there} + extra_there);
            const std::size_t begin = head.at();
            head.take(size);
            if (made.first.empty()) made.first = called;
            made.files[std::filesystem::path(called).lexically_normal().generic_string()] = {begin, size};
        }
    } catch (const CrateError& error) {
        refuse(at, "\"" + file + "\" is a broken .usdz: " + error.what());
    }
    if (made.files.empty()) refuse(at, "\"" + file + "\" has no files");
    return made;
}

std::shared_ptr<UsdLayer> UsdFiles::read(const Origin& at, const std::string& file, const std::string& inside) {
    const std::string path = folder_.path_of(at, file);
    const bool packed = lower_ending(path) == ".usdz";
    std::string in = inside;
    if (packed && in.empty()) in = package(at, path).first;
    const std::string place = packed ? path + "[" + in + "]" : path;
    std::shared_ptr<UsdLayer>& layer = layers_[place];
    if (layer) return layer;
    if (layers_.size() > most_layers) refuse(at, "the scene has more than 2000 files");
    // Messages name files as they were named.
    const std::string shown = layers_.size() == 1 ? folder_.shown() : file + (inside.empty() ? "" : "[" + inside + "]");
    if (packed) {
        const Package& all = package(at, path);
        const auto found = all.files.find(std::filesystem::path(in).lexically_normal().generic_string());
        if (found == all.files.end()) refuse(at, "\"" + in.substr(0, 200) + "\" is not in the package " + file);
        const auto [start, size] = found->second;
        layer = layer_of_usd(all.bytes.substr(start, size), shown);
    } else {
        layer = layer_of_usd(folder_.bytes(at, path), shown);
    }
    layer->place = place;
    return layer;
}

std::shared_ptr<UsdLayer> UsdFiles::root(const std::string& name) {
    return read({folder_.shown(), 0, ""}, name, "");
}

std::shared_ptr<UsdLayer> UsdFiles::beside(const UsdLayer& layer, const Origin& at, const std::string& asset) {
    namespace fs = std::filesystem;
    if (asset.find("://") != asset.npos) refuse(at, "names \"" + asset.substr(0, 200) + "\", and files are read, not addresses");
    const std::size_t bracket = asset.ends_with(']') ? asset.find('[') : asset.npos;
    const std::string file = asset.substr(0, bracket);
    const std::string inside = bracket == asset.npos ? "" : asset.substr(bracket + 1, asset.size() - bracket - 2);
    const std::size_t open = layer.place.ends_with(']') ? layer.place.find('[') : layer.place.npos;
    if (open != layer.place.npos) {  // within a package, its own files come first
        const std::string package_file = layer.place.substr(0, open);
        const fs::path own = layer.place.substr(open + 1, layer.place.size() - open - 2);
        const std::string in = (own.parent_path() / file).lexically_normal().generic_string();
        if (package(at, package_file).files.contains(in)) return read(at, package_file, in);
        refuse(at, "names \"" + asset.substr(0, 200) + "\", which is not in the package");
    }
    const fs::path path = fs::path(layer.place).parent_path() / file;
    return read(at, path.string(), inside);
}

}  // namespace scree::imports
