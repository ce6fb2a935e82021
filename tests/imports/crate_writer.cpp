// Crate files for tests. Numbers become what the type name of their attribute says; whole arrays are compressed.
#include "tests/imports/crate_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <vector>

namespace scree::imported {

namespace {

using imports::UsdEdit;
using imports::UsdItem;
using imports::UsdLayer;
using imports::UsdSpec;
using imports::UsdValue;

class CrateWriter {
public:
    CrateWriter(const UsdLayer& layer, int minor) : layer_(layer), minor_(minor) {}
    std::string bytes();

private:
    template <class T>
    static void put(std::string& to, T value) {
        to.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    std::uint32_t token(const std::string& text) { return index_in(tokens_, text); }
    std::uint32_t string(const std::string& text) { return index_in(strings_, text); }
    std::uint32_t path(const std::string& text) { return index_in(paths_, text); }
    static std::uint32_t index_in(std::vector<std::string>& all, const std::string& text) {
        const auto index = static_cast<std::size_t>(std::find(all.begin(), all.end(), text) - all.begin());
        if (index == all.size()) all.push_back(text);
        return static_cast<std::uint32_t>(index);
    }
    static std::string packed(const std::string& raw);
    static std::string coded(const std::vector<std::int64_t>& all, bool wide = false);
    static std::uint64_t rep(unsigned type, std::uint64_t payload, unsigned bits = 0) {
        return (std::uint64_t{bits} << 61) | (std::uint64_t{type} << 48) | payload;
    }
    std::uint64_t place() { return out_.size(); }
    std::uint64_t value(const UsdValue& value, const std::string& name, const std::string& type);
    std::uint64_t numbers(const UsdValue& value, const std::string& type);
    std::uint64_t list(const std::vector<std::string>& all, unsigned type);
    std::uint64_t edits(const UsdValue& value, const std::string& name);
    std::uint64_t samples(const UsdValue& value, const std::string& type);
    void count(std::uint64_t size);
    std::vector<std::pair<std::uint32_t, std::uint64_t>> fields_of(const UsdSpec& spec);
    void tree();
    void section(const std::string& name, const std::string& content);

    const UsdLayer& layer_;
    int minor_;
    std::string out_;
    std::vector<std::string> tokens_{""}, strings_, paths_{"/"};
    std::vector<std::pair<std::string, std::pair<std::uint64_t, std::uint64_t>>> sections_;
    std::vector<std::int64_t> tree_paths_, tree_names_, tree_jumps_;
};

// One chunk of literals alone, which is a block of LZ4.
std::string CrateWriter::packed(const std::string& raw) {
    std::string block(1, '\0');
    std::size_t length = raw.size();
    block += static_cast<char>(std::min<std::size_t>(length, 15) << 4);
    if (length >= 15) {
        length -= 15;
        for (; length >= 255; length -= 255) block += static_cast<char>(255);
        block += static_cast<char>(length);
    }
    return block + raw;
}

std::string CrateWriter::coded(const std::vector<std::int64_t>& all, bool wide) {
    std::string raw, codes((2 * all.size() + 7) / 8, '\0'), rest;
    constexpr std::int64_t common = 1;
    wide ? put(raw, common) : put(raw, static_cast<std::int32_t>(common));
    std::int64_t last = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::int64_t step = all[i] - last;
        last = all[i];
        unsigned code = 0;
        if (step != common) {
            const auto size = std::abs(step);
            code = size < (wide ? 30000 : 120) ? 1 : size < (wide ? 2000000000 : 30000) ? 2 : 3;
            if (wide)
                code == 1   ? put(rest, static_cast<std::int16_t>(step))
                : code == 2 ? put(rest, static_cast<std::int32_t>(step))
                            : put(rest, step);
            else
                code == 1   ? put(rest, static_cast<std::int8_t>(step))
                : code == 2 ? put(rest, static_cast<std::int16_t>(step))
                            : put(rest, static_cast<std::int32_t>(step));
        }
        codes[i / 4] = static_cast<char>(static_cast<unsigned char>(codes[i / 4]) | (code << (2 * (i % 4))));
    }
    const std::string bytes = packed(raw + codes + rest);
    std::string made;
    put(made, static_cast<std::uint64_t>(bytes.size()));
    return made + bytes;
}

void CrateWriter::count(std::uint64_t size) {
    if (minor_ < 5) put(out_, std::uint32_t{1});
    minor_ < 7 ? put(out_, static_cast<std::uint32_t>(size)) : put(out_, size);
}

std::uint16_t half_bits(double x) {  // of whole and simple numbers
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(x));
    if ((bits & 0x7FFFFFFF) == 0) return static_cast<std::uint16_t>(bits >> 16);
    return static_cast<std::uint16_t>(((bits >> 16) & 0x8000) | ((((bits >> 23) & 255) - 112) << 10) | ((bits >> 13) & 1023));
}

std::uint64_t CrateWriter::numbers(const UsdValue& value, const std::string& type) {
    const std::string element = type.substr(0, type.find('['));
    const bool quaternion = element.starts_with("quat"), matrix = element.starts_with("matrix");
    const char part = element == "token" || element == "bool"                  ? 'b'
                      : element.starts_with("int")                             ? 'i'
                      : element.ends_with("h")                                 ? 'h'
                      : element.ends_with("f") || element.starts_with("float") ? 'f'
                                                                               : 'd';
    unsigned kind = part == 'b' ? 1 : part == 'i' ? (element == "int64" ? 5 : 3) : part == 'h' ? 7 : part == 'f' ? 8 : 9;
    const unsigned of_part = part == 'd' ? 0 : part == 'f' ? 1 : part == 'h' ? 2 : 3;
    if (value.width > 1) kind = 19 + 4 * static_cast<unsigned>(value.width - 2) + of_part;
    if (quaternion) kind = 16 + of_part;
    if (matrix) kind = value.width == 16 ? 15 : value.width == 9 ? 14 : 13;
    const auto put_number = [&](double x) {
        if (kind == 5) return put(out_, static_cast<std::int64_t>(x));
        if (part == 'b') return put(out_, static_cast<std::uint8_t>(x));
        if (part == 'i') return put(out_, static_cast<std::int32_t>(x));
        if (part == 'h') return put(out_, half_bits(x));
        part == 'f' ? put(out_, static_cast<float>(x)) : put(out_, x);
    };
    const auto put_all = [&] {
        for (std::size_t i = 0; i < value.numbers.size(); ++i)
            put_number(value.numbers[quaternion ? i / 4 * 4 + (i + 1) % 4 : i]);
    };
    if (!value.array) {
        const double x = value.numbers[0];
        if (value.width == 1 && part == 'f') return rep(kind, std::bit_cast<std::uint32_t>(static_cast<float>(x)), 2);
        if (value.width == 1 && part == 'i' && kind == 3)
            return rep(kind, static_cast<std::uint32_t>(static_cast<std::int32_t>(x)), 2);
        if (value.width == 1 && part == 'b') return rep(kind, static_cast<std::uint32_t>(x), 2);
        if (value.width == 1 && part == 'd' && static_cast<double>(static_cast<float>(x)) == x)
            return rep(kind, std::bit_cast<std::uint32_t>(static_cast<float>(x)), 2);
        const bool bytes = std::all_of(value.numbers.begin(), value.numbers.end(),
                                       [](double one) { return one == std::trunc(one) && std::abs(one) < 128; });
        if (value.width > 1 && value.width < 5 && !quaternion && bytes) {
            std::uint32_t four = 0;
            for (std::size_t i = 0; i < value.width; ++i)
                four |= std::uint32_t{static_cast<std::uint8_t>(static_cast<std::int8_t>(value.numbers[i]))} << (8 * i);
            return rep(kind, four, 2);
        }
        const std::uint64_t start = place();
        put_all();
        return rep(kind, start);
    }
    if (value.numbers.empty()) return rep(kind, 0, 4);
    const std::uint64_t start = place();
    count(value.count());
    const bool whole = std::all_of(value.numbers.begin(), value.numbers.end(),
                                   [](double one) { return one == std::trunc(one) && std::abs(one) < 1e9; });
    if (value.width == 1 && whole && value.numbers.size() >= 16 &&
        (part == 'i' || (minor_ >= 6 && (part == 'f' || part == 'd')))) {
        std::vector<std::int64_t> all;
        for (const double one : value.numbers) all.push_back(static_cast<std::int64_t>(one));
        if (part != 'i') put(out_, 'i');
        out_ += coded(all, kind == 5);
        return rep(kind, start, 5);
    }
    put_all();
    return rep(kind, start, 4);
}

std::uint64_t CrateWriter::list(const std::vector<std::string>& all, unsigned type) {
    const std::uint64_t start = place();
    put(out_, static_cast<std::uint64_t>(all.size()));
    for (const std::string& one : all) put(out_, type == 50 ? string(one) : token(one));
    return rep(type, start);
}

std::uint64_t CrateWriter::edits(const UsdValue& value, const std::string& name) {
    static const std::map<std::string, unsigned> types = {{"apiSchemas", 32},  {"variantSetNames", 33}, {"inheritPaths", 34},
                                                          {"specializes", 34}, {"targetPaths", 34},     {"connectionPaths", 34},
                                                          {"references", 35},  {"payload", 55}};
    const unsigned type = types.at(name);
    const auto put_item = [&](const UsdItem& item) {
        if (type == 32) return put(out_, token(item.text));
        if (type == 33) return put(out_, string(item.text));
        if (type == 34) return put(out_, path(item.path));
        put(out_, string(item.text));
        put(out_, item.path.empty() ? std::uint32_t{0xFFFFFFFF} : path(item.path));
        if (type == 35 || minor_ >= 8) put(out_, item.offset), put(out_, item.scale);
        if (type != 35) return;
        // Data of the user: a dictionary of one number, which is to be left out.
        put(out_, std::uint64_t{1});
        put(out_, string("custom"));
        put(out_, std::int64_t{8});
        put(out_, rep(8, 0, 2));
    };
    if (type == 55 && minor_ < 8) {  // a single payload
        const std::uint64_t start = place();
        put_item(value.edits.all.at(0).second.at(0));
        return rep(47, start);
    }
    std::map<UsdEdit, std::vector<UsdItem>> by_kind(value.edits.all.begin(), value.edits.all.end());
    static const std::pair<UsdEdit, unsigned> order[] = {{UsdEdit::whole, 2},     {UsdEdit::added, 4},   {UsdEdit::prepended, 32},
                                                         {UsdEdit::appended, 64}, {UsdEdit::deleted, 8}, {UsdEdit::ordered, 16}};
    const std::uint64_t start = place();
    std::uint8_t bits = by_kind.contains(UsdEdit::whole) ? 1 : 0;
    for (const auto& [edit, bit] : order)
        if (by_kind.contains(edit)) bits = static_cast<std::uint8_t>(bits | bit);
    put(out_, bits);
    for (const auto& [edit, bit] : order) {
        if (!by_kind.contains(edit)) continue;
        put(out_, static_cast<std::uint64_t>(by_kind[edit].size()));
        for (const UsdItem& item : by_kind[edit]) put_item(item);
    }
    return rep(type, start);
}

std::uint64_t CrateWriter::samples(const UsdValue& value, const std::string& type) {
    std::vector<std::uint64_t> reps;
    UsdValue times;
    for (const auto& [time, one] : *value.samples) {
        times.numbers.push_back(time);
        reps.push_back(this->value(one, "default", type));
    }
    const std::uint64_t at_times = place();
    put(out_, static_cast<std::uint64_t>(times.numbers.size()));
    for (const double time : times.numbers) put(out_, time);
    const std::uint64_t start = place();
    put(out_, std::int64_t{8});
    put(out_, rep(48, at_times));
    put(out_, std::int64_t{8});
    put(out_, static_cast<std::uint64_t>(reps.size()));
    for (const std::uint64_t one : reps) put(out_, one);
    return rep(46, start);
}

std::uint64_t CrateWriter::value(const UsdValue& value, const std::string& name, const std::string& type) {
    using Kind = UsdValue::Kind;
    if (value.kind == Kind::blocked) return rep(51, 0);
    if (value.kind == Kind::edits) return edits(value, name);
    if (value.kind == Kind::samples) return samples(value, type);
    if (value.kind == Kind::numbers) {
        if (name == "specifier") return rep(42, static_cast<std::uint64_t>(value.numbers[0]), 2);
        return numbers(value, type);
    }
    if (value.kind == Kind::members && name == "variantSelection") {
        const std::uint64_t start = place();
        put(out_, static_cast<std::uint64_t>(value.members->size()));
        for (const auto& [key, one] : *value.members) put(out_, string(key)), put(out_, string(one.texts.at(0)));
        return rep(45, start);
    }
    if (value.kind != Kind::texts) {  // a dictionary, which nobody asks for
        const std::uint64_t start = place();
        put(out_, std::uint64_t{0});
        return rep(31, start);
    }
    if (!value.array) return type == "string" ? rep(10, string(value.texts[0]), 2) : rep(11, token(value.texts[0]), 2);
    const std::uint64_t start = place();
    count(value.texts.size());
    for (const std::string& one : value.texts) put(out_, token(one));
    return rep(11, start, 4);
}

std::vector<std::pair<std::uint32_t, std::uint64_t>> CrateWriter::fields_of(const UsdSpec& spec) {
    const UsdValue* said = spec.find("typeName");
    const std::string type = said && spec.kind == UsdSpec::Kind::attribute ? said->texts.at(0) : "double";
    std::vector<std::pair<std::uint32_t, std::uint64_t>> fields;
    for (const auto& [name, one] : spec.fields) {
        if (name != "subLayers") {
            fields.emplace_back(token(name), value(one, name, name == "typeName" ? "token" : type));
            continue;
        }
        std::vector<std::string> names;
        for (const UsdItem& item : one.edits.all.at(0).second) names.push_back(item.text);
        fields.emplace_back(token(name), list(names, 50));
        const std::uint64_t start = place();
        put(out_, static_cast<std::uint64_t>(names.size()));
        for (const UsdItem& item : one.edits.all.at(0).second) put(out_, item.offset), put(out_, item.scale);
        fields.emplace_back(token("subLayerOffsets"), rep(49, start));
    }
    if (!spec.children.empty()) fields.emplace_back(token("primChildren"), list(spec.children, 41));
    if (!spec.properties.empty()) fields.emplace_back(token("properties"), list(spec.properties, 41));
    return fields;
}

// Paths as a tree, each with those below it behind it.
void CrateWriter::tree() {
    std::map<std::string, std::map<std::string, std::string>> below;  // of each path: names and paths
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        const std::string one = paths_[i];
        if (one == "/") continue;
        std::size_t cut = one.ends_with('}') ? one.rfind('{') : one.find('.', one.rfind('/') + 1);
        bool drops = !one.ends_with('}');
        if (cut == one.npos) {
            cut = one.rfind('/');
            if (const std::size_t brace = one.rfind('}'); brace != one.npos && brace > cut) cut = brace + 1, drops = false;
        }
        const std::string parent = cut == 0 ? "/" : one.substr(0, cut);
        below[parent][one.substr(drops ? cut + (one[cut] == '/' ? 1 : 0) : cut)] = one;
        index_in(paths_, parent);
    }
    const std::function<void(const std::string&, const std::string&, bool)> add = [&](const std::string& name,
                                                                                      const std::string& whole, bool sibling) {
        const std::size_t node = tree_paths_.size();
        tree_paths_.push_back(path(whole));
        const bool property = name.starts_with('.');
        const std::int64_t index = token(property ? name.substr(1) : name);
        tree_names_.push_back(property ? -index : index);
        tree_jumps_.push_back(0);
        const auto& children = below[whole];
        std::size_t left = children.size();
        for (const auto& [child, child_path] : children) add(child, child_path, --left > 0);
        const auto size = static_cast<std::int64_t>(tree_paths_.size() - node);
        tree_jumps_[node] = children.empty() ? (sibling ? 0 : -2) : (sibling ? size : -1);
    };
    add("", "/", false);
}

void CrateWriter::section(const std::string& name, const std::string& content) {
    sections_.push_back({name, {place(), content.size()}});
    out_ += content;
}

std::string CrateWriter::bytes() {
    out_.assign(88, '\0');
    std::vector<std::pair<std::uint32_t, std::uint64_t>> fields;
    std::vector<std::int64_t> sets, spec_paths, spec_sets, spec_types;
    std::map<std::string, const UsdSpec*> sorted;
    for (const auto& [where, spec] : layer_.specs) sorted[where] = &spec;
    for (const auto& [where, spec] : sorted) {
        static constexpr std::int64_t types[] = {7, 6, 1, 8, 10, 11};
        spec_paths.push_back(path(where));
        spec_types.push_back(types[static_cast<std::size_t>(spec->kind)]);
        spec_sets.push_back(static_cast<std::int64_t>(sets.size()));
        for (const auto& field : fields_of(*spec)) {
            sets.push_back(static_cast<std::int64_t>(fields.size()));
            fields.push_back(field);
        }
        sets.push_back(-1);
    }
    tree();
    for (const std::string& one : strings_) token(one);
    std::string content, reps;
    for (const std::string& one : tokens_) content += one + '\0';
    std::string tokens;
    put(tokens, static_cast<std::uint64_t>(tokens_.size()));
    put(tokens, static_cast<std::uint64_t>(content.size()));
    put(tokens, static_cast<std::uint64_t>(packed(content).size()));
    section("TOKENS", tokens + packed(content));
    content.clear();
    put(content, static_cast<std::uint64_t>(strings_.size()));
    for (const std::string& one : strings_) put(content, token(one));
    section("STRINGS", content);
    content.clear();
    put(content, static_cast<std::uint64_t>(fields.size()));
    std::vector<std::int64_t> names;
    for (const auto& [name, one] : fields) names.push_back(name), put(reps, one);
    content += coded(names);
    put(content, static_cast<std::uint64_t>(packed(reps).size()));
    section("FIELDS", content + packed(reps));
    const auto counted = [](std::size_t count) {
        std::string made;
        put(made, static_cast<std::uint64_t>(count));
        return made;
    };
    section("FIELDSETS", counted(sets.size()) + coded(sets));
    section("PATHS",
            counted(paths_.size()) + counted(tree_paths_.size()) + coded(tree_paths_) + coded(tree_names_) + coded(tree_jumps_));
    section("SPECS", counted(spec_paths.size()) + coded(spec_paths) + coded(spec_sets) + coded(spec_types));
    const std::uint64_t start = place();
    put(out_, static_cast<std::uint64_t>(sections_.size()));
    for (auto& [name, where] : sections_) {
        name.resize(16, '\0');
        out_ += name;
        put(out_, where.first);
        put(out_, where.second);
    }
    out_.replace(0, 8, "PXR-USDC");
    out_[9] = static_cast<char>(minor_);
    std::memcpy(out_.data() + 16, &start, sizeof start);
    return out_;
}

}  // namespace

std::string crate_of(const UsdLayer& layer, int minor) {
    return CrateWriter(layer, minor).bytes();
}

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files, int method) {
    std::string out, table;
    const auto put = [](std::string& to, std::uint64_t value, std::size_t bytes) {
        for (std::size_t i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i));
    };
    const auto common = [&](std::string& to, const std::pair<std::string, std::string>& file) {
        put(to, 20, 2), put(to, 0, 2), put(to, static_cast<std::uint64_t>(method), 2), put(to, 0, 8);
        put(to, file.second.size(), 4), put(to, file.second.size(), 4);
        put(to, file.first.size(), 2), put(to, 0, 2);
    };
    for (const auto& file : files) {
        const std::size_t start = out.size();
        put(out, 0x04034B50, 4);
        common(out, file);
        out += file.first + file.second;
        put(table, 0x02014B50, 4), put(table, 20, 2);
        common(table, file);
        put(table, 0, 8), put(table, 0, 2), put(table, start, 4);
        table += file.first;
    }
    const std::size_t begin = out.size();
    out += table;
    put(out, 0x06054B50, 4), put(out, 0, 4), put(out, files.size(), 2), put(out, files.size(), 2);
    put(out, table.size(), 4), put(out, begin, 4), put(out, 0, 2);
    return out;
}

}  // namespace scree::imported
