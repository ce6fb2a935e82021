// USD's binary format, crate: tables of tokens, fields, paths and specs. Facts from pxr/usd/usd/crateFile.cpp of OpenUSD.
#include <algorithm>
#include <map>

#include "compute/scene_file/import/usd/crate_bytes.h"
#include "compute/scene_file/import/usd/crate_values.h"
#include "compute/scene_file/import/usd/usd_layer.h"

namespace scree::imports {

namespace {

constexpr std::uint64_t most_path_letters = 1'000'000;  // beside 64 a byte
constexpr int deepest_crate = 200;

class CrateTables {
public:
    CrateTables(Crate& crate, UsdLayer& layer) : crate_(crate), layer_(layer) {}
    void read();

private:
    CrateCursor section(const std::string& name);
    void read_sections();
    void read_tokens();
    void read_strings();
    void read_fields();
    void read_field_sets();
    void read_paths();
    void read_specs();
    void add_spec(std::uint32_t path, std::uint64_t field_set, std::int64_t type);
    std::vector<std::uint32_t> indices(CrateCursor& from, std::uint64_t count);

    Crate& crate_;
    UsdLayer& layer_;
    std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> sections_;  // start and size
    struct Field {
        std::uint32_t name;
        std::uint64_t rep;
    };
    std::vector<Field> fields_;
    std::vector<std::uint32_t> field_sets_;
};

CrateCursor CrateTables::section(const std::string& name) {
    const auto found = sections_.find(name);
    if (found == sections_.end()) throw CrateError("it has no section " + name);
    return CrateCursor(std::string_view(crate_.bytes).substr(0, found->second.first + found->second.second), found->second.first);
}

void CrateTables::read_sections() {
    CrateCursor head(crate_.bytes);
    head.take(8);  // its magic
    const auto major = head.read<std::uint8_t>(), minor = head.read<std::uint8_t>();
    head.take(6);
    crate_.minor = minor;
    if (major != 0 || minor < 4 || minor > 14)
        throw CrateError("it is of version " + std::to_string(major) + "." + std::to_string(minor) +
                         "; versions 0.4 to 0.14 are read");
    head.seek(head.read<std::uint64_t>());
    const std::size_t count = head.count(32);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view name = head.take(16);
        const auto start = head.read<std::uint64_t>(), size = head.read<std::uint64_t>();
        if (start > crate_.bytes.size() || size > crate_.bytes.size() - start) throw CrateError("a section lies beyond the end");
        sections_[std::string(name.substr(0, name.find('\0')))] = {start, size};
    }
}

void CrateTables::read_tokens() {
    CrateCursor from = section("TOKENS");
    const auto count = from.read<std::uint64_t>(), size = from.read<std::uint64_t>(), packed = from.read<std::uint64_t>();
    const std::string all = unpacked_bytes(from.take(packed), size);
    if (count > crate_.bytes.size()) throw CrateError("it has more tokens than bytes");
    if (count > all.size()) throw CrateError("there are fewer tokens than it says");
    std::size_t at = 0;
    while (crate_.tokens.size() < count) {
        const std::size_t end = all.find('\0', at);
        if (end == all.npos) throw CrateError("there are fewer tokens than it says");
        crate_.tokens.push_back(all.substr(at, end - at));
        at = end + 1;
    }
}

void CrateTables::read_strings() {
    CrateCursor from = section("STRINGS");
    const std::size_t count = from.count(4);
    for (std::size_t i = 0; i < count; ++i) crate_.strings.push_back(from.read<std::uint32_t>());
}

std::vector<std::uint32_t> CrateTables::indices(CrateCursor& from, std::uint64_t count) {
    std::vector<std::uint32_t> all;
    for (const std::int64_t one : unpacked_integers(from, count, false))
        all.push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(one)));
    return all;
}

void CrateTables::read_fields() {
    CrateCursor from = section("FIELDS");
    const auto count = from.read<std::uint64_t>();
    const std::vector<std::uint32_t> names = indices(from, count);
    const auto packed = from.read<std::uint64_t>();
    const std::string reps = unpacked_bytes(from.take(packed), 8 * count);
    CrateCursor each(reps);
    for (const std::uint32_t name : names) fields_.push_back({name, each.read<std::uint64_t>()});
}

void CrateTables::read_field_sets() {
    CrateCursor from = section("FIELDSETS");
    const auto count = from.read<std::uint64_t>();
    if (count > 8 * crate_.bytes.size()) throw CrateError("it has more fields than its bytes can tell");
    field_sets_ = indices(from, count);
}

// A tree in depth-first order: of each node whether a child follows it, and how far its next sibling is.
void CrateTables::read_paths() {
    CrateCursor from = section("PATHS");
    const auto total = from.read<std::uint64_t>(), count = from.read<std::uint64_t>();
    if (std::max(total, count) > 4 * crate_.bytes.size()) throw CrateError("it has more paths than its bytes can tell");
    const std::vector<std::uint32_t> at = indices(from, count);
    const std::vector<std::int64_t> names = unpacked_integers(from, count, false), jumps = unpacked_integers(from, count, false);
    if (total > count + 1) throw CrateError("there are fewer paths than it says");
    crate_.paths.resize(static_cast<std::size_t>(total));
    std::vector<bool> seen(at.size());
    std::uint64_t letters = 0;
    struct Branch {
        std::size_t node;
        std::string parent;
        int depth;
    };
    std::vector<Branch> open;
    if (!at.empty()) open.push_back({0, "", 0});
    while (!open.empty()) {
        auto [node, parent, depth] = std::move(open.back());
        open.pop_back();
        while (true) {
            if (node >= at.size() || seen[node]) throw CrateError("its paths are no tree");
            seen[node] = true;
            const std::int64_t name = names[node], jump = jumps[node];
            std::string path = "/";
            if (!parent.empty()) {
                const std::string& token = crate_.token(static_cast<std::uint64_t>(name < 0 ? -name : name));
                const bool variant = token.starts_with('{');
                path = name < 0 ? parent + "." + token : variant ? parent + token : usd_child(parent, token);
            }
            letters += path.size();
            if (letters > most_path_letters + 64 * crate_.bytes.size())
                throw CrateError("its paths are longer than its bytes can tell");
            if (at[node] >= crate_.paths.size()) throw CrateError("a path has a number beyond their count");
            crate_.paths[at[node]] = path;
            const bool child = jump == -1 || jump > 0, sibling = jump >= 0;
            if (sibling && child) open.push_back({node + static_cast<std::size_t>(jump), parent, depth});
            if (child) {
                if (++depth > deepest_crate) throw CrateError("its prims lie deeper than 200 within one another");
                parent = path;
            } else if (!sibling) {
                break;
            }
            ++node;
        }
    }
}

void CrateTables::add_spec(std::uint32_t path, std::uint64_t field_set, std::int64_t type) {
    using Kind = UsdSpec::Kind;
    static const std::map<std::int64_t, Kind> kinds = {{1, Kind::attribute},    {6, Kind::prim},     {7, Kind::root},
                                                       {8, Kind::relationship}, {10, Kind::variant}, {11, Kind::variant_set}};
    const auto kind = kinds.find(type);
    if (kind == kinds.end()) return;
    if (path >= crate_.paths.size()) throw CrateError("a spec is of a path beyond their count");
    UsdSpec& spec = layer_.specs[crate_.paths[path]];
    spec.kind = kind->second;
    for (std::uint64_t i = field_set; i < field_sets_.size() && field_sets_[i] != 0xFFFFFFFF; ++i) {
        if (field_sets_[i] >= fields_.size()) throw CrateError("a spec has a field beyond their count");
        const Field& field = fields_[field_sets_[i]];
        const std::string& name = crate_.token(field.name);
        if (spec.packed.size() > 1000) throw CrateError("a spec has more than 1000 fields");
        if (name == "primChildren")
            spec.children = crate_.value(field.rep).texts;
        else if (name == "properties" || name == "propertyChildren")
            spec.properties = crate_.value(field.rep).texts;
        else
            spec.packed.emplace_back(name, field.rep);
    }
}

void CrateTables::read_specs() {
    CrateCursor from = section("SPECS");
    const auto count = from.read<std::uint64_t>();
    if (count > 2 * crate_.bytes.size()) throw CrateError("it has more specs than its bytes can tell");
    const std::vector<std::uint32_t> paths = indices(from, count), sets = indices(from, count);
    const std::vector<std::int64_t> types = unpacked_integers(from, count, false);
    for (std::size_t i = 0; i < paths.size(); ++i) add_spec(paths[i], sets[i], types[i]);
}

void CrateTables::read() {
    read_sections();
    read_tokens();
    read_strings();
    read_fields();
    read_field_sets();
    read_paths();
    read_specs();
}

}  // namespace

std::shared_ptr<UsdLayer> layer_of_crate(std::string bytes, const std::string& shown) {
    auto layer = std::make_shared<UsdLayer>();
    auto crate = std::make_shared<Crate>();
    layer->shown = shown;
    crate->bytes = std::move(bytes);
    try {
        CrateTables(*crate, *layer).read();
    } catch (const CrateError& error) {
        refuse({shown, 0, ""}, std::string("is a broken crate file: ") + error.what());
    }
    layer->unpack = [crate, shown](std::uint64_t rep) {
        try {
            return crate->value(rep);
        } catch (const CrateError& error) {
            refuse({shown, 0, ""}, std::string("is a broken crate file: ") + error.what());
        }
    };
    return layer;
}

}  // namespace scree::imports
