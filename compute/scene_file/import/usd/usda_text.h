// Words, strings, numbers, lists and values of USD's text format.
#pragma once

#include <string>
#include <vector>

#include "compute/scene_file/import/usd/usd_value.h"

namespace scree::imports {

class UsdaText {
public:
    UsdaText(const std::string& text, std::string shown)
        : at_(text.data()), end_(text.data() + text.size()), shown_(std::move(shown)) {}

protected:
    [[noreturn]] void fail(const std::string& reason) const;
    bool ends() const { return at_ >= end_; }
    char peek();  // behind spaces and comments; 0 at the end
    bool accept(char c);
    bool accept_here(char c);  // without spaces before it
    void expect(char c);
    std::string word();
    bool at_string();
    std::string string();
    UsdValue value(int depth);
    UsdValue samples(int depth);
    std::vector<UsdItem> items();

    static constexpr int deepest = 100;  // of prims, dictionaries and lists within one another
    std::string here_ = "/";             // the prim at hand, at which relative paths begin

private:
    void skip();
    std::string asset();
    std::string path();
    double number();
    void add_to(UsdValue& whole, UsdValue one, bool first);
    UsdValue list(int depth);
    UsdValue tuple(int depth);
    UsdValue dictionary(int depth);
    UsdItem item();

    const char* at_;
    const char* end_;
    int line_ = 1;
    std::string shown_;
};

}  // namespace scree::imports
