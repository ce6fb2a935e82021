// Values of USD files: numbers, texts, lists of edits, dictionaries, samples over time.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace scree::imports {

// An element of a list: a text, a path, or an asset with a path in it and a shift and stretch of its time.
struct UsdItem {
    std::string text, path;
    double offset = 0, scale = 1;
    bool operator==(const UsdItem& o) const { return text == o.text && path == o.path; }
    bool operator<(const UsdItem& o) const { return std::tie(text, path) < std::tie(o.text, o.path); }
};

enum class UsdEdit { whole, added, prepended, appended, deleted, ordered };
struct UsdEdits {  // of a list, in the order of their writing
    std::vector<std::pair<UsdEdit, std::vector<UsdItem>>> all;
};
// The list after the edits of a stronger opinion.
void apply_edits(const UsdEdits& edits, std::vector<UsdItem>& list);

struct UsdValue {
    enum class Kind { none, blocked, numbers, texts, edits, members, samples } kind = Kind::none;
    std::vector<double> numbers{};  // quaternions w first, matrices row by row
    std::size_t width = 1;          // numbers of an element
    bool array = false;
    std::vector<std::string> texts{};  // strings, tokens, assets
    UsdEdits edits{};
    std::shared_ptr<std::map<std::string, UsdValue>> members{};
    std::shared_ptr<std::vector<std::pair<double, UsdValue>>> samples{};

    std::size_t count() const { return numbers.size() / width; }
    static UsdValue of_text(std::string text) {
        UsdValue value;
        value.kind = Kind::texts;
        value.texts.push_back(std::move(text));
        return value;
    }
    static UsdValue of_number(double number) {
        UsdValue value;
        value.kind = Kind::numbers;
        value.numbers.push_back(number);
        return value;
    }
    static UsdValue of_edits(UsdEdit edit, std::vector<UsdItem> items) {
        UsdValue value;
        value.kind = Kind::edits;
        value.edits.all.emplace_back(edit, std::move(items));
        return value;
    }
};

// Between samples linear, outside of them the nearest; texts are held.
UsdValue sample_at(const UsdValue& samples, double time);

}  // namespace scree::imports
