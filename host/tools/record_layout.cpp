// Parser and std430 layout of the records in a header that GLSL and C++ share.
#include "host/tools/record_layout.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

namespace scree::host {
namespace {

struct Token {
    std::string text;
    std::size_t line = 0;
};

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Tokens of the text without comments. A preprocessor line is one token, which begins with '#'.
std::vector<Token> tokens_of(const std::string& text) {
    std::vector<Token> tokens;
    std::size_t line = 1;
    const auto skip_to = [&](std::size_t from, std::size_t to) {
        line += static_cast<std::size_t>(
            std::count(text.begin() + static_cast<std::ptrdiff_t>(from), text.begin() + static_cast<std::ptrdiff_t>(to), '\n'));
        return to;
    };
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i + 1;
        if (text.compare(i, 2, "//") == 0) {
            i = std::min(text.find('\n', i), text.size());
        } else if (text.compare(i, 2, "/*") == 0) {
            const std::size_t close = text.find("*/", i + 2);
            i = skip_to(i, close == std::string::npos ? text.size() : close + 2);
        } else if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
            i = skip_to(i, i + 1);
        } else if (text[i] == '#') {
            do end = std::min(text.find('\n', end), text.size() - 1) + 1;
            while (end < text.size() && text[end - 2] == '\\');
            tokens.push_back({text.substr(i, end - i), line});
            i = skip_to(i, end);
        } else {
            while (is_word(text[i]) && end < text.size() && is_word(text[end])) ++end;
            tokens.push_back({text.substr(i, end - i), line});
            i = end;
        }
    }
    return tokens;
}

struct Type {
    std::size_t bytes, alignment;
};
const std::map<std::string, Type> known_types = {
    {"uint", {4, 4}},   {"int", {4, 4}},     {"float", {4, 4}},   {"vec2", {8, 8}},   {"uvec2", {8, 8}},   {"ivec2", {8, 8}},
    {"vec3", {12, 16}}, {"uvec3", {12, 16}}, {"ivec3", {12, 16}}, {"vec4", {16, 16}}, {"uvec4", {16, 16}}, {"ivec4", {16, 16}},
};

std::size_t rounded_up(std::size_t bytes, std::size_t alignment) {
    return (bytes + alignment - 1) / alignment * alignment;
}

class Parser {
public:
    Parser(std::vector<Record>& records, const std::string& text, std::string path)
        : tokens_(tokens_of(text)), path_(std::move(path)), records_(records) {}

    void read() {
        for (int depth = 0; at_ < tokens_.size();) {
            const std::string& word = tokens_[at_].text;
            if (word == "struct" && depth == 0) {
                read_record();
                continue;
            }
            if (word == "CONSTANT" && depth == 0) note_constant();
            depth += word == "{" ? 1 : word == "}" ? -1 : 0;
            if (depth < 0) fail("'}' closes nothing");
            ++at_;
        }
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        const std::size_t line = tokens_.empty() ? 1 : tokens_[std::min(at_, tokens_.size() - 1)].line;
        throw RecordError(path_ + ":" + std::to_string(line) + ": " + what);
    }
    const std::string& peek() const {
        if (at_ >= tokens_.size()) fail("the file ends within a record");
        return tokens_[at_].text;
    }
    bool take(const std::string& word) {
        if (peek() != word) return false;
        ++at_;
        return true;
    }
    void expect(const std::string& word) {
        if (!take(word)) fail("'" + word + "' is expected, not '" + peek() + "'");
    }
    std::string take_name(const char* of_what) {
        if (!is_word(peek()[0]) || std::isdigit(static_cast<unsigned char>(peek()[0])) != 0)
            fail(std::string("the name of ") + of_what + " is expected, not '" + peek() + "'");
        return tokens_[at_++].text;
    }

    static std::optional<std::size_t> number(std::string text) {
        if (text.ends_with('u')) text.pop_back();
        if (text.empty() || text.size() > 6 ||
            !std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); }))
            return std::nullopt;
        return std::stoul(text);
    }
    // CONSTANT uint NAME = 4u;
    void note_constant() {
        if (at_ + 5 >= tokens_.size() || tokens_[at_ + 3].text != "=" || tokens_[at_ + 5].text != ";") return;
        if (const auto value = number(tokens_[at_ + 4].text)) constants_[tokens_[at_ + 2].text] = *value;
    }
    std::size_t array_count() {
        if (!take("[")) return 0;
        const auto named = constants_.find(peek());
        const auto count = named != constants_.end() ? named->second : number(peek());
        if (!count || *count == 0) fail("'" + peek() + "' is no length of an array: a number, or a constant of this file");
        ++at_;
        expect("]");
        if (peek() == "[") fail("an array of arrays");
        return *count;
    }

    Type type_of(const std::string& name) const {
        if (const auto known = known_types.find(name); known != known_types.end()) return known->second;
        const auto record = std::find_if(records_.begin(), records_.end(), [&](const Record& r) { return r.name == name; });
        if (record == records_.end()) fail("'" + name + "' is no type that a record can have, nor a record before this one");
        return {record->bytes, record->alignment};
    }

    void read_record() {
        expect("struct");
        Record record;
        record.name = take_name("a record");
        if (take(";")) return;  // forward declaration
        expect("{");
        packed_ = 0;
        while (!take("}")) {
            if (peek()[0] == '#') fail("the preprocessor within a record");
            const std::string type = peek();
            const Type of = type_of(take_name("a type"));
            do read_member(record, type, of);
            while (take(","));
            expect(";");
        }
        if (record.members.empty()) fail(record.name + " has no members");
        const std::size_t end = packed_;
        record.bytes = rounded_up(end, record.alignment);
        if (record.bytes != end)
            fail(record.name + " has " + std::to_string(end) + " bytes in C++ and " + std::to_string(record.bytes) +
                 " in std430; fill it up with scalars");
        expect(";");
        records_.push_back(std::move(record));
    }

    void read_member(Record& record, const std::string& type, const Type& of) {
        RecordMember member{.type = type, .name = take_name("a member"), .count = array_count()};
        for (const RecordMember& other : record.members)
            if (other.name == member.name) fail(record.name + " has two members " + member.name);
        member.offset = rounded_up(packed_, of.alignment);
        member.stride = rounded_up(of.bytes, of.alignment);
        const std::string full = record.name + "." + member.name;
        if (member.offset != packed_)
            fail(full + " is at byte " + std::to_string(packed_) + " in C++ and at " + std::to_string(member.offset) +
                 " in std430; fill the gap with scalars");
        if (member.count > 0 && member.stride != of.bytes)
            fail(full + ": an array of " + type + " has gaps in std430 and none in C++");
        packed_ += member.count > 0 ? member.count * member.stride : of.bytes;
        record.alignment = std::max(record.alignment, of.alignment);
        record.members.push_back(std::move(member));
    }

    std::vector<Token> tokens_;
    std::string path_;
    std::size_t at_ = 0;
    std::size_t packed_ = 0;  // size of the record so far without padding, bytes
    std::map<std::string, std::size_t> constants_;
    std::vector<Record>& records_;  // those of earlier files first
};

}  // namespace

void add_records(std::vector<Record>& records, const std::string& text, const std::string& path) {
    Parser(records, text, path).read();
}

}  // namespace scree::host
