// USD's text format. https://openusd.org/release/glossary.html, and the grammar of pxr/usd/sdf.
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "compute/scene_file/import/usd/usd_layer.h"

namespace scree::imports {

namespace {

constexpr int deepest_text = 100;  // of prims, dictionaries and lists within one another

class Usda {
public:
    Usda(const std::string& text, UsdLayer& layer) : at_(text.data()), end_(text.data() + text.size()), layer_(layer) {}
    void read();

private:
    [[noreturn]] void fail(const std::string& reason) const { refuse({layer_.shown, line_, ""}, reason); }
    void skip();
    char peek();
    bool accept(char c);
    void expect(char c);
    std::string word();
    bool at_string();
    std::string string();
    std::string asset();
    std::string path();
    double number();
    UsdValue value(int depth);
    void add_to(UsdValue& whole, UsdValue one, bool first);
    UsdValue list(int depth);
    UsdValue tuple(int depth);
    UsdValue dictionary(int depth);
    UsdValue samples(int depth);
    std::vector<UsdItem> items();
    UsdItem item();
    void metadata(UsdSpec& spec);
    void metadatum(UsdSpec& spec, const std::string& edit, const std::string& name);
    UsdSpec& spec_at(const std::string& path, UsdSpec::Kind kind);
    void prim(const std::string& specifier, const std::string& parent, int depth);
    void body(const std::string& path, int depth);
    void variant_set(const std::string& path, int depth);
    void property(const std::string& first, const std::string& path);
    void relationship(const std::string& edit, const std::string& path);
    void keep(UsdSpec& spec, const std::string& name, UsdValue value);

    const char* at_;
    const char* end_;
    int line_ = 1;
    std::string here_ = "/";  // the prim at hand
    UsdLayer& layer_;
};

bool is_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == ':' || (c & 0x80) != 0;
}

std::optional<UsdEdit> edit_of(const std::string& word) {
    if (word == "add") return UsdEdit::added;
    if (word == "prepend") return UsdEdit::prepended;
    if (word == "append") return UsdEdit::appended;
    if (word == "delete") return UsdEdit::deleted;
    if (word == "reorder") return UsdEdit::ordered;
    return std::nullopt;
}

// As crate files call them.
std::string field_of(const std::string& name) {
    if (name == "variants") return "variantSelection";
    if (name == "variantSets") return "variantSetNames";
    if (name == "inherits") return "inheritPaths";
    return name;
}

void Usda::skip() {
    for (; at_ < end_; ++at_) {
        if (*at_ == '\n') ++line_;
        if (*at_ == '#')
            while (at_ + 1 < end_ && at_[1] != '\n') ++at_;
        else if (*at_ != ' ' && *at_ != '\t' && *at_ != '\n' && *at_ != '\r' && *at_ != ';')
            return;
    }
}
char Usda::peek() {
    skip();
    return at_ < end_ ? *at_ : '\0';
}
bool Usda::accept(char c) {
    if (peek() != c || at_ >= end_) return false;
    ++at_;
    return true;
}
void Usda::expect(char c) {
    if (!accept(c))
        fail(std::string("expected '") + c + "'" +
             (at_ < end_ ? " before \"" + std::string(at_, at_ + std::min<std::ptrdiff_t>(end_ - at_, 20)) + "\""
                         : ", and the file ends"));
}

std::string Usda::word() {
    skip();
    const char* from = at_;
    while (at_ < end_ && is_name(*at_)) ++at_;
    if (at_ == from)
        fail(at_ < end_ ? "expected a name before \"" + std::string(at_, at_ + std::min<std::ptrdiff_t>(end_ - at_, 20)) + "\""
                        : "the file ends where a name is due");
    return {from, at_};
}

bool Usda::at_string() {
    const char c = peek();
    return c == '"' || c == '\'';
}

std::string Usda::string() {
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

std::string Usda::asset() {
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

std::string Usda::path() {
    expect('<');
    const char* from = at_;
    while (at_ < end_ && *at_ != '>' && *at_ != '\n') ++at_;
    if (at_ >= end_ || *at_ != '>') fail("a path does not end with '>' on its line");
    constexpr std::ptrdiff_t longest = 10000;
    if (at_ - from > longest) fail("a path is longer than 10000 letters");
    std::string text(from, at_++);
    return usd_absolute(text, here_);
}

double Usda::number() {
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

void Usda::add_to(UsdValue& whole, UsdValue one, bool first) {
    using Kind = UsdValue::Kind;
    if (one.kind == Kind::blocked) one = UsdValue::of_text("None");
    if (one.kind != Kind::numbers && one.kind != Kind::texts) fail("a list or tuple has a value that does not belong there");
    if (!first && one.kind != whole.kind) fail("a list or tuple mixes numbers and texts");
    whole.kind = one.kind;
    whole.numbers.insert(whole.numbers.end(), one.numbers.begin(), one.numbers.end());
    whole.texts.insert(whole.texts.end(), one.texts.begin(), one.texts.end());
}

UsdValue Usda::tuple(int depth) {
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

UsdValue Usda::list(int depth) {
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

UsdValue Usda::dictionary(int depth) {
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

UsdValue Usda::samples(int depth) {
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

UsdValue Usda::value(int depth) {
    if (depth > deepest_text) fail("values lie deeper than 100 within one another");
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

UsdItem Usda::item() {
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

std::vector<UsdItem> Usda::items() {
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

void Usda::keep(UsdSpec& spec, const std::string& name, UsdValue value) {
    for (auto& [key, known] : spec.fields) {
        if (key != name) continue;
        if (known.kind == UsdValue::Kind::edits && value.kind == UsdValue::Kind::edits)
            known.edits.all.insert(known.edits.all.end(), value.edits.all.begin(), value.edits.all.end());
        else
            known = std::move(value);
        return;
    }
    spec.fields.emplace_back(name, std::move(value));
}

void Usda::metadatum(UsdSpec& spec, const std::string& edit, const std::string& name) {
    expect('=');
    const bool lists = name == "references" || name == "payload" || name == "inherits" || name == "specializes" ||
                       name == "apiSchemas" || name == "variantSets" || name == "subLayers";
    if (lists)
        keep(spec, field_of(name), UsdValue::of_edits(edit_of(edit).value_or(UsdEdit::whole), items()));
    else
        keep(spec, field_of(name), value(0));
}

// Between parentheses, if there are any.
void Usda::metadata(UsdSpec& spec) {
    if (!accept('(')) return;
    while (!accept(')')) {
        if (at_string()) {
            string();  // a comment
            continue;
        }
        std::string name = word(), edit;
        if (edit_of(name)) edit = std::exchange(name, word());
        metadatum(spec, edit, name);
        accept(',');
    }
}

UsdSpec& Usda::spec_at(const std::string& path, UsdSpec::Kind kind) {
    UsdSpec& spec = layer_.specs[path];
    spec.kind = kind;
    return spec;
}

void Usda::relationship(const std::string& edit, const std::string& path) {
    const std::string name = word();
    const std::string whole = path + "." + name;
    const bool known = layer_.find(whole) != nullptr;
    UsdSpec& spec = spec_at(whole, UsdSpec::Kind::relationship);
    if (!known) layer_.specs[path].properties.push_back(name);
    if (accept('=')) keep(spec, "targetPaths", UsdValue::of_edits(edit_of(edit).value_or(UsdEdit::whole), items()));
    UsdSpec ignored;
    metadata(ignored);
}

void Usda::property(const std::string& first, const std::string& path) {
    std::string type = first, edit;
    while (type == "custom" || type == "uniform" || type == "varying" || type == "config" || edit_of(type)) {
        if (edit_of(type)) edit = type;
        type = word();
    }
    if (type == "rel") return relationship(edit, path);
    const bool array = accept('[');
    if (array) expect(']');
    const std::string name = word();
    std::string part = "default";
    if (at_ < end_ && *at_ == '.') {
        ++at_;
        part = word();
    }
    const std::string whole = path + "." + name;
    const bool known = layer_.find(whole) != nullptr;
    UsdSpec& spec = spec_at(whole, UsdSpec::Kind::attribute);
    if (!known) layer_.specs[path].properties.push_back(name);
    keep(spec, "typeName", UsdValue::of_text(type + (array ? "[]" : "")));
    if (accept('=')) {
        if (part == "connect")
            keep(spec, "connectionPaths", UsdValue::of_edits(edit_of(edit).value_or(UsdEdit::whole), items()));
        else if (part == "timeSamples")
            keep(spec, part, samples(0));
        else
            keep(spec, part, value(0));
    }
    UsdSpec ignored;
    metadata(ignored);
}

void Usda::variant_set(const std::string& path, int depth) {
    const std::string set = string();
    expect('=');
    expect('{');
    while (!accept('}')) {
        if (!at_string()) fail("expected the name of a variant");
        const std::string choice = string();
        const std::string variant = path + "{" + set + "=" + choice + "}";
        metadata(spec_at(variant, UsdSpec::Kind::variant));
        expect('{');
        body(variant, depth + 1);
    }
}

// Up to its closing brace.
void Usda::body(const std::string& path, int depth) {
    if (depth > deepest_text) fail("prims lie deeper than 100 within one another");
    while (!accept('}')) {
        const std::string first = word();
        if (first == "def" || first == "over" || first == "class") {
            prim(first, path, depth + 1);
        } else if (first == "variantSet") {
            if (!at_string()) fail("expected the name of a set of variants");
            variant_set(path, depth + 1);
        } else if (first == "reorder") {
            const std::string what = word();
            if (what != "rel" && accept('='))
                items();
            else
                property(first, path);
        } else {
            property(first, path);
        }
    }
}

void Usda::prim(const std::string& specifier, const std::string& parent, int depth) {
    std::string type;
    if (!at_string()) type = word();
    if (!at_string()) fail("expected the name of a prim between quotes");
    const std::string name = string();
    if (name.empty() || name.find_first_of("/.{}[]<>") != name.npos) fail("\"" + name.substr(0, 60) + "\" is no name of a prim");
    const std::string path = usd_child(parent, name);
    if (layer_.find(path)) fail("the prim " + path.substr(0, 200) + " is there twice");
    layer_.specs[parent].children.push_back(name);
    UsdSpec& spec = spec_at(path, UsdSpec::Kind::prim);
    keep(spec, "specifier", UsdValue::of_number(specifier == "def" ? 0 : specifier == "over" ? 1 : 2));
    if (!type.empty()) keep(spec, "typeName", UsdValue::of_text(type));
    const std::string above = std::exchange(here_, path);
    metadata(spec);
    expect('{');
    body(path, depth);
    here_ = above;
}

void Usda::read() {
    metadata(spec_at("/", UsdSpec::Kind::root));
    while (peek() != '\0') {
        const std::string first = word();
        if (first == "reorder") {
            word();
            expect('=');
            items();
        } else if (first == "def" || first == "over" || first == "class") {
            prim(first, "/", 0);
        } else {
            fail("expected def, over or class, not \"" + first.substr(0, 60) + "\"");
        }
    }
    if (at_ < end_) fail("a byte of 0 is in the text");
}

}  // namespace

std::shared_ptr<UsdLayer> layer_of_usda(const std::string& text, const std::string& shown) {
    auto layer = std::make_shared<UsdLayer>();
    layer->shown = shown;
    Usda(text, *layer).read();
    return layer;
}

}  // namespace scree::imports
