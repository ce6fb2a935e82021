// Words and values of USD's text format.
#include "compute/scene_file/import/usd/usda_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "compute/scene_file/import/notes.h"
#include "compute/scene_file/import/usd/usd_layer.h"

namespace scree::imports {

namespace {

bool is_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == ':' || (c & 0x80) != 0;
}

}  // namespace

void UsdaText::fail(const std::string& reason) const {
    refuse({shown_, line_, ""}, reason);
}

bool UsdaText::accept_here(char c) {
    if (at_ >= end_ || *at_ != c) return false;
    ++at_;
    return true;
}

void UsdaText::skip() {
    for (; at_ < end_; ++at_) {
        if (*at_ == '\n') ++line_;
        if (*at_ == '#')
            while (at_ + 1 < end_ && at_[1] != '\n') ++at_;
        else if (*at_ != ' ' && *at_ != '\t' && *at_ != '\n' && *at_ != '\r' && *at_ != ';')
            return;
    }
}
char UsdaText::peek() {
    skip();
    return at_ < end_ ? *at_ : '\0';
}
bool UsdaText::accept(char c) {
    if (peek() != c || at_ >= end_) return false;
    ++at_;
    return true;
}
void UsdaText::expect(char c) {
    if (!accept(c))
        fail(std::string("expected '") + c + "'" +
             (at_ < end_ ? " before \"" + std::string(at_, at_ + std::min<std::ptrdiff_t>(end_ - at_, 20)) + "\""
                         : ", and the file ends"));
}

std::string UsdaText::word() {
    skip();
    const char* from = at_;
    while (at_ < end_ && is_name(*at_)) ++at_;
    if (at_ == from)
        fail(at_ < end_ ? "expected a name before \"" + std::string(at_, at_ + std::min<std::ptrdiff_t>(end_ - at_, 20)) + "\""
                        : "the file ends where a name is due");
    return {from, at_};
}

bool UsdaText::at_string() {
    const char c = peek();
    return c == '"' || c == '\'';
}

std::string UsdaText::string() {
    const char quote = peek();
    const bool tripled = end_ - at_ >= 3 && at_[1] == quote && at_[2] == quote;
    at_ += tripled ? 3 : 1;
    std::string text;
    while (true) {
        if (at_ >= end_) fail("a string does not end");
        if (*at_ == quote && (!tripled || (end_ - at_ >= 3 && at_[1] == quote && at_[2] == quote))) break;
        if (*at_ == '\n') {
            if (!tripled) fail("a string does not end on its line");
            ++line_;
        }
        if (*at_ == '\\' && at_ + 1 < end_) {
            ++at_;
            text += *at_ == 'n' ? '\n' : *at_ == 't' ? '\t' : *at_ == 'r' ? '\r' : *at_;
            ++at_;
        } else {
            text += *at_++;
        }
    }
    at_ += tripled ? 3 : 1;
    return text;
}

std::string UsdaText::asset() {
    const bool tripled = end_ - at_ >= 3 && at_[1] == '@' && at_[2] == '@';
    at_ += tripled ? 3 : 1;
    const char* from = at_;
    while (at_ < end_ && *at_ != '\n' && !(*at_ == '@' && (!tripled || (end_ - at_ >= 3 && at_[1] == '@' && at_[2] == '@'))))
        ++at_;
    if (at_ >= end_ || *at_ == '\n') fail("the name of an asset does not end on its line");
    std::string name(from, at_);
    at_ += tripled ? 3 : 1;
    return name;
}

std::string UsdaText::path() {
    expect('<');
    const char* from = at_;
    while (at_ < end_ && *at_ != '>' && *at_ != '\n') ++at_;
    if (at_ >= end_ || *at_ != '>') fail("a path does not end with '>' on its line");
    constexpr std::ptrdiff_t longest = 10000;
    if (at_ - from > longest) fail("a path is longer than 10000 letters");
    std::string text(from, at_++);
    return usd_absolute(text, here_);
}

double UsdaText::number() {
    skip();
    const char* from = at_;
    if (from < end_ && *from == '+') ++from;
    double number = 0;
    const auto [rest, error] = std::from_chars(from, end_, number);
    if (error == std::errc::result_out_of_range) {  // too large, or too small
        const std::string_view text(from, static_cast<std::size_t>(rest - from));
        const std::size_t power = text.find_first_of("eE");
        const bool small = power != text.npos && text.substr(power + 1).starts_with('-');
        number = small ? 0 : (text.starts_with('-') ? -1 : 1) * std::numeric_limits<double>::infinity();
    } else if (error != std::errc()) {
        fail("expected a value before \"" + std::string(at_, at_ + std::min<std::ptrdiff_t>(end_ - at_, 20)) + "\"");
    }
    at_ = rest;
    return number;
}

void UsdaText::add_to(UsdValue& whole, UsdValue one, bool first) {
    using Kind = UsdValue::Kind;
    if (one.kind == Kind::blocked) one = UsdValue::of_text("None");
    if (one.kind != Kind::numbers && one.kind != Kind::texts) fail("a list or tuple has a value that does not belong there");
    if (!first && one.kind != whole.kind) fail("a list or tuple mixes numbers and texts");
    whole.kind = one.kind;
    whole.numbers.insert(whole.numbers.end(), one.numbers.begin(), one.numbers.end());
    whole.texts.insert(whole.texts.end(), one.texts.begin(), one.texts.end());
}

UsdValue UsdaText::tuple(int depth) {
    UsdValue whole;
    expect('(');
    for (bool first = true; !accept(')'); first = false) {
        if (!first) expect(',');
        if (accept(')')) break;
        add_to(whole, value(depth + 1), first);
    }
    whole.width = std::max<std::size_t>(1, whole.numbers.size());
    return whole;
}

UsdValue UsdaText::list(int depth) {
    UsdValue whole;
    expect('[');
    whole.array = true;
    whole.kind = UsdValue::Kind::numbers;
    for (bool first = true; !accept(']'); first = false) {
        if (!first) expect(',');
        if (accept(']')) break;
        const char c = peek();
        if ((c >= '0' && c <= '9') || c == '-') {  // most are long lists of numbers
            if (!first && (whole.kind != UsdValue::Kind::numbers || whole.width != 1)) fail("a list mixes values");
            whole.numbers.push_back(number());
            continue;
        }
        UsdValue one = value(depth + 1);
        const std::size_t width = one.width;
        add_to(whole, std::move(one), first);
        if (!first && width != whole.width) fail("a list has tuples of different lengths");
        whole.width = width;
    }
    return whole;
}

UsdValue UsdaText::dictionary(int depth) {
    UsdValue whole;
    whole.kind = UsdValue::Kind::members;
    whole.members = std::make_shared<std::map<std::string, UsdValue>>();
    expect('{');
    while (!accept('}')) {
        word();  // its type
        if (accept('[')) expect(']');
        const std::string name = at_string() ? string() : word();
        expect('=');
        (*whole.members)[name] = value(depth + 1);
        accept(',');
    }
    return whole;
}

UsdValue UsdaText::samples(int depth) {
    UsdValue whole;
    whole.kind = UsdValue::Kind::samples;
    std::map<double, UsdValue> sorted;
    expect('{');
    while (!accept('}')) {
        const double time = number();
        expect(':');
        if (!(std::abs(time) < 1e30)) fail("a sample is at no finite time");
        sorted[time] = value(depth + 1);
        accept(',');
    }
    whole.samples = std::make_shared<std::vector<std::pair<double, UsdValue>>>();
    for (auto& [time, one] : sorted) whole.samples->emplace_back(time, std::move(one));
    return whole;
}

UsdValue UsdaText::value(int depth) {
    if (depth > deepest) fail("values lie deeper than 100 within one another");
    const char c = peek();
    if (c == '(') return tuple(depth);
    if (c == '[') return list(depth);
    if (c == '{') return dictionary(depth);
    if (c == '"' || c == '\'') return UsdValue::of_text(string());
    if (c == '@') return UsdValue::of_text(asset());
    if (c == '<') return UsdValue::of_text(path());
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_') {
        const char* from = at_;
        const std::string name = word();
        if (name == "None") return {.kind = UsdValue::Kind::blocked};
        if (name == "true" || name == "True") return UsdValue::of_number(1);
        if (name == "false" || name == "False") return UsdValue::of_number(0);
        if (name != "inf" && name != "nan") return UsdValue::of_text(name);
        at_ = from;
    }
    return UsdValue::of_number(number());
}

UsdItem UsdaText::item() {
    UsdItem one;
    const char c = peek();
    if (c == '@') {
        one.text = asset();
        if (peek() == '<') one.path = path();
    } else if (c == '<') {
        one.path = path();
    } else {
        one.text = at_string() ? string() : word();
    }
    if (c == '"' || c == '\'' || !accept('(')) return one;
    while (!accept(')')) {
        const std::string name = word();
        expect('=');
        const UsdValue said = value(1);
        if (said.kind != UsdValue::Kind::numbers || said.numbers.size() != 1) continue;
        if (name == "offset") one.offset = said.numbers[0];
        if (name == "scale" && said.numbers[0] != 0) one.scale = said.numbers[0];
    }
    return one;
}

std::vector<UsdItem> UsdaText::items() {
    std::vector<UsdItem> all;
    if (!accept('[')) {
        all.push_back(item());
        if (all[0].text == "None" && all[0].path.empty()) all.clear();
        return all;
    }
    for (bool first = true; !accept(']'); first = false) {
        if (!first) expect(',');
        if (accept(']')) break;
        all.push_back(item());
    }
    return all;
}

}  // namespace scree::imports
