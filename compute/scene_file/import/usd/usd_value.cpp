// Edits of lists, and samples between two times.
#include "compute/scene_file/import/usd/usd_value.h"

#include <algorithm>
#include <set>

namespace scree::imports {

void apply_edits(const UsdEdits& edits, std::vector<UsdItem>& list) {
    const auto without = [&](const std::vector<UsdItem>& items) {
        const std::set<UsdItem> gone(items.begin(), items.end());
        std::erase_if(list, [&](const UsdItem& one) { return gone.contains(one); });
    };
    for (const auto& [edit, items] : edits.all) {
        if (edit == UsdEdit::whole) list = items;
        if (edit == UsdEdit::deleted) without(items);
        if (edit == UsdEdit::prepended) without(items), list.insert(list.begin(), items.begin(), items.end());
        if (edit == UsdEdit::appended) without(items), list.insert(list.end(), items.begin(), items.end());
        if (edit != UsdEdit::added) continue;
        std::set<UsdItem> known(list.begin(), list.end());
        for (const UsdItem& item : items)
            if (known.insert(item).second) list.push_back(item);
    }
}

UsdValue sample_at(const UsdValue& samples, double time) {
    if (!samples.samples || samples.samples->empty()) return {};
    const auto& all = *samples.samples;
    const auto after = std::upper_bound(all.begin(), all.end(), time, [](double t, const auto& one) { return t < one.first; });
    if (after == all.begin()) return after->second;
    UsdValue value = (after - 1)->second;
    if (after == all.end() || value.kind != UsdValue::Kind::numbers || after->second.kind != value.kind) return value;
    const UsdValue& next = after->second;
    if (next.numbers.size() != value.numbers.size() || next.width != value.width) return value;
    const double part = (time - (after - 1)->first) / (after->first - (after - 1)->first);
    for (std::size_t i = 0; i < value.numbers.size(); ++i) value.numbers[i] += part * (next.numbers[i] - value.numbers[i]);
    return value;
}

}  // namespace scree::imports
