// Values of a crate file: numbers of all types, arrays, lists of edits, samples.
#include "compute/scene_file/import/usd/crate_values.h"

#include <algorithm>
#include <bit>

#include "compute/scene_file/import/usd/crate_types.h"

namespace scree::imports {

namespace {

using namespace crate;

class CrateValue {
public:
    CrateValue(const Crate& crate, std::uint64_t rep, int depth)
        : crate_(crate),
          from_(crate.bytes),
          type_(static_cast<unsigned>(rep >> 48) & 0xFF),
          depth_(depth),
          payload_(rep & ((std::uint64_t{1} << 48) - 1)),
          array_((rep >> 63) != 0),
          inlined_(((rep >> 62) & 1) != 0),
          packed_(((rep >> 61) & 1) != 0) {}
    UsdValue read();

private:
    UsdValue numbers(const Layout& layout);
    UsdValue inlined(const Layout& layout);
    void packed_numbers(const Layout& layout, std::uint64_t count, std::vector<double>& into);
    UsdValue texts();
    const std::string& text_of(std::uint32_t index) const;
    UsdValue edits();
    UsdItem item();
    UsdValue samples_of();
    UsdValue selections_of();
    void skip_dictionary();
    std::uint64_t length();
    std::vector<UsdItem> list();

    const Crate& crate_;
    CrateCursor from_;
    unsigned type_;
    int depth_;
    std::uint64_t payload_;
    bool array_, inlined_, packed_;
};

// Of an array at the cursor.
std::uint64_t CrateValue::length() {
    if (crate_.minor < 5) from_.read<std::uint32_t>();
    return crate_.minor < 7 ? from_.read<std::uint32_t>() : from_.read<std::uint64_t>();
}

void CrateValue::packed_numbers(const Layout& layout, std::uint64_t count, std::vector<double>& into) {
    const bool wide = layout.part == int64 || layout.part == uint64;
    const auto add = [&](const std::vector<std::int64_t>& all) {
        for (const std::int64_t one : all)
            into.push_back(layout.part == uint32   ? static_cast<double>(static_cast<std::uint32_t>(one))
                           : layout.part == uint64 ? static_cast<double>(static_cast<std::uint64_t>(one))
                                                   : static_cast<double>(one));
    };
    if (layout.part == int32 || layout.part == uint32 || wide) return add(unpacked_integers(from_, count, wide));
    const auto code = from_.read<char>();  // of reals that are whole, or of few values
    if (code == 'i') return add(unpacked_integers(from_, count, false));
    if (code != 't') throw CrateError("an array of reals is coded in an unknown way");
    const auto size = from_.read<std::uint32_t>();
    std::vector<double> table;
    for (std::uint32_t i = 0; i < size; ++i) table.push_back(number_at(from_, layout.part));
    for (const std::int64_t one : unpacked_integers(from_, count, false)) {
        if (one < 0 || static_cast<std::uint64_t>(one) >= table.size()) throw CrateError("an array has a value beyond its table");
        into.push_back(table[static_cast<std::size_t>(one)]);
    }
}

UsdValue CrateValue::inlined(const Layout& layout) {
    UsdValue value;
    value.kind = UsdValue::Kind::numbers;
    value.width = layout.width;
    const auto low = static_cast<std::uint32_t>(payload_);
    const auto small = [&](std::size_t i) { return static_cast<double>(static_cast<std::int8_t>(low >> (8 * i))); };
    if (type_ == matrix2 || type_ == matrix3 || type_ == matrix4) {
        const std::size_t side = type_ - matrix2 + 2;
        value.numbers.resize(side * side);
        for (std::size_t i = 0; i < side; ++i) value.numbers[i * side + i] = small(i);
    } else if (layout.width > 1) {
        for (std::size_t i = 0; i < layout.width; ++i) value.numbers.push_back(small(i));
    } else if (layout.part == int64 || layout.part == uint64) {
        value.numbers.push_back(layout.part == int64 ? static_cast<double>(static_cast<std::int32_t>(low)) : low);
    } else if (layout.part == real) {
        value.numbers.push_back(static_cast<double>(std::bit_cast<float>(low)));
    } else {
        const std::string bytes(reinterpret_cast<const char*>(&low), sizeof low);
        CrateCursor in(bytes);
        value.numbers.push_back(number_at(in, layout.part));
    }
    return value;
}

UsdValue CrateValue::numbers(const Layout& layout) {
    const bool always_inlined = layout.width == 1 && bytes_of(layout.part) <= 4;
    if (!array_ && (inlined_ || always_inlined)) return inlined(layout);
    UsdValue value;
    value.kind = UsdValue::Kind::numbers;
    value.width = layout.width;
    value.array = array_;
    if (array_ && payload_ == 0) return value;
    from_.seek(payload_);
    const std::uint64_t count = array_ ? length() : 1;
    if (count > most_crate_numbers / layout.width) throw CrateError("an array has more than 50000000 numbers");
    constexpr std::uint64_t least_packed = 16;
    if (packed_ && count >= least_packed) {
        if (layout.width != 1) throw CrateError("an array of tuples is compressed");
        packed_numbers(layout, count, value.numbers);
    } else {
        if (count * layout.width > from_.left() / bytes_of(layout.part)) throw CrateError("an array is longer than the file");
        value.numbers.reserve(static_cast<std::size_t>(count * layout.width));
        for (std::uint64_t i = 0; i < count * layout.width; ++i) value.numbers.push_back(number_at(from_, layout.part));
    }
    if (type_ >= quatd && type_ <= quath)  // their real part comes last
        for (std::size_t i = 0; i + 3 < value.numbers.size(); i += 4)
            std::rotate(value.numbers.begin() + static_cast<std::ptrdiff_t>(i),
                        value.numbers.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                        value.numbers.begin() + static_cast<std::ptrdiff_t>(i) + 4);
    return value;
}

const std::string& CrateValue::text_of(std::uint32_t index) const {
    return type_ == text || type_ == string_list ? crate_.string(index) : crate_.token(index);
}

UsdValue CrateValue::texts() {
    UsdValue value;
    value.kind = UsdValue::Kind::texts;
    const bool many = array_ || type_ == token_list || type_ == string_list;
    if (!many) {
        value.texts.push_back(text_of(static_cast<std::uint32_t>(payload_)));
        return value;
    }
    value.array = true;
    if (payload_ == 0) return value;
    from_.seek(payload_);
    const std::uint64_t count = array_ ? length() : from_.read<std::uint64_t>();
    if (count > from_.left() / 4) throw CrateError("a list of texts is longer than the file");
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto index = from_.read<std::uint32_t>();
        value.texts.push_back(type_ == asset ? crate_.string(index) : text_of(index));
    }
    return value;
}

// Entries of a name and a distance to their value, behind which the next one follows.
void CrateValue::skip_dictionary() {
    std::uint64_t count = from_.read<std::uint64_t>();
    while (count-- > 0) {
        from_.read<std::uint32_t>();
        const std::uint64_t start = from_.at();
        const auto distance = from_.read<std::int64_t>();
        if (distance < 8) throw CrateError("a dictionary leads back");
        from_.seek(start + static_cast<std::uint64_t>(distance));
        from_.read<std::uint64_t>();
    }
}

UsdItem CrateValue::item() {
    UsdItem one;
    if (type_ == path_edits || type_ == path_list) {
        one.path = crate_.path(from_.read<std::uint32_t>());
    } else if (type_ == token_edits) {
        one.text = crate_.token(from_.read<std::uint32_t>());
    } else if (type_ == string_edits) {
        one.text = crate_.string(from_.read<std::uint32_t>());
    } else {
        one.text = crate_.string(from_.read<std::uint32_t>());
        const auto index = from_.read<std::uint32_t>();
        if (index != 0xFFFFFFFF) one.path = crate_.path(index);
        if (type_ == reference_edits || crate_.minor >= 8) one.offset = from_.read<double>(), one.scale = from_.read<double>();
        if (type_ == reference_edits) skip_dictionary();
        if (one.path == "/") one.path.clear();
    }
    return one;
}

std::vector<UsdItem> CrateValue::list() {
    std::vector<UsdItem> all;
    const std::size_t count = from_.count(4);
    for (std::size_t i = 0; i < count; ++i) all.push_back(item());
    return all;
}

UsdValue CrateValue::edits() {
    UsdValue value;
    value.kind = UsdValue::Kind::edits;
    from_.seek(payload_);
    if (type_ == payload) {
        value.edits.all.emplace_back(UsdEdit::whole, std::vector<UsdItem>{item()});
        return value;
    }
    if (type_ == path_list) {
        value.edits.all.emplace_back(UsdEdit::whole, list());
        return value;
    }
    const auto bits = from_.read<std::uint8_t>();
    if ((bits & 3) == 1) value.edits.all.emplace_back(UsdEdit::whole, std::vector<UsdItem>{});
    static constexpr std::pair<unsigned, UsdEdit> order[] = {{2, UsdEdit::whole},      {4, UsdEdit::added},
                                                             {32, UsdEdit::prepended}, {64, UsdEdit::appended},
                                                             {8, UsdEdit::deleted},    {16, UsdEdit::ordered}};
    for (const auto& [bit, edit] : order)
        if (bits & bit) value.edits.all.emplace_back(edit, list());
    return value;
}

UsdValue CrateValue::selections_of() {
    UsdValue value;
    value.kind = UsdValue::Kind::members;
    value.members = std::make_shared<std::map<std::string, UsdValue>>();
    from_.seek(payload_);
    const std::size_t count = from_.count(8);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string& set = crate_.string(from_.read<std::uint32_t>());
        (*value.members)[set] = UsdValue::of_text(crate_.string(from_.read<std::uint32_t>()));
    }
    return value;
}

UsdValue CrateValue::samples_of() {
    UsdValue value;
    value.kind = UsdValue::Kind::samples;
    value.samples = std::make_shared<std::vector<std::pair<double, UsdValue>>>();
    from_.seek(payload_);
    const auto jump = [&] {
        const std::uint64_t start = from_.at();
        from_.seek(start + static_cast<std::uint64_t>(from_.read<std::int64_t>()));
    };
    jump();
    const UsdValue times = crate_.value(from_.read<std::uint64_t>(), depth_ + 1);
    jump();
    const std::size_t count = from_.count(8);
    if (times.kind != UsdValue::Kind::numbers || times.numbers.size() != count) throw CrateError("samples have no times");
    constexpr std::size_t most_sampled = 4'000'000;  // numbers; what comes later is not needed to begin with
    std::size_t sampled = 0;
    for (std::size_t i = 0; i < count && sampled < most_sampled; ++i) {
        if (i > 0 && !(times.numbers[i] > times.numbers[i - 1])) throw CrateError("samples are out of order");
        value.samples->emplace_back(times.numbers[i], crate_.value(from_.read<std::uint64_t>(), depth_ + 1));
        sampled += 1 + value.samples->back().second.numbers.size();
    }
    return value;
}

UsdValue CrateValue::read() {
    if (depth_ > 3) throw CrateError("values lie within one another without end");
    if (const Layout layout = layout_of(type_); layout.width > 0) return numbers(layout);
    switch (type_) {
        case text:
        case token:
        case asset:
        case token_list:
        case string_list:
            return texts();
        case specifier:
        case permission:
        case variability:
            return UsdValue::of_number(static_cast<double>(payload_ & 0xFFFFFFFF));
        case doubles: {
            UsdValue value;
            value.kind = UsdValue::Kind::numbers;
            value.array = true;
            from_.seek(payload_);
            const std::size_t count = from_.count(8);
            for (std::size_t i = 0; i < count; ++i) value.numbers.push_back(from_.read<double>());
            return value;
        }
        case offsets: {
            UsdValue value;
            value.kind = UsdValue::Kind::numbers;
            value.array = true;
            value.width = 2;
            from_.seek(payload_);
            const std::size_t count = from_.count(16);
            for (std::size_t i = 0; i < 2 * count; ++i) value.numbers.push_back(from_.read<double>());
            return value;
        }
        case token_edits:
        case string_edits:
        case path_edits:
        case reference_edits:
        case payload_edits:
        case payload:
        case path_list:
            return edits();
        case selections:
            return selections_of();
        case samples:
            return samples_of();
        case blocked:
            return {.kind = UsdValue::Kind::blocked};
        default:
            return {};  // dictionaries, and what is newer
    }
}

}  // namespace

const std::string& Crate::token(std::uint64_t index) const {
    if (index >= tokens.size()) throw CrateError("a token has a number beyond their count");
    return tokens[static_cast<std::size_t>(index)];
}
const std::string& Crate::string(std::uint64_t index) const {
    if (index >= strings.size()) throw CrateError("a string has a number beyond their count");
    return token(strings[static_cast<std::size_t>(index)]);
}
const std::string& Crate::path(std::uint64_t index) const {
    if (index >= paths.size()) throw CrateError("a path has a number beyond their count");
    return paths[static_cast<std::size_t>(index)];
}

UsdValue Crate::value(std::uint64_t rep, int depth) const {
    return CrateValue(*this, rep, depth).read();
}

}  // namespace scree::imports
