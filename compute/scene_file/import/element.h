// Elements of XML as readers see them: every attribute is read, ignored with a reason, or told as unknown.
#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compute/scene_file/import/notes.h"
#include "host/files/xml_file.h"

namespace scree::imports {

// Attributes that an element has unless it says otherwise.
using Defaults = std::map<std::string, host::XmlAttribute>;

class Element {
public:
    // `inherited` may be null.
    Element(const host::XmlElement& element, Notes& notes, const Defaults* inherited = nullptr);

    const host::XmlElement& tree() const { return *tree_; }
    const std::string& tag() const { return tree_->name; }
    Origin origin() const;
    Notes& notes() const { return *notes_; }

    bool has(const char* attribute) const;
    std::string text(const char* attribute, const std::string& otherwise = "");
    double number(const char* attribute, double otherwise);  // finite, within 1e30
    long whole(const char* attribute, long otherwise);
    bool flag(const char* attribute, bool otherwise);
    // Between least and most numbers; none if the attribute is absent.
    std::vector<double> numbers(const char* attribute, std::size_t least, std::size_t most);
    template <std::size_t count>
    std::array<double, count> numbers(const char* attribute, const std::array<double, count>& otherwise) {
        const std::vector<double> read = numbers(attribute, count, count);
        std::array<double, count> result = otherwise;
        for (std::size_t i = 0; i < read.size(); ++i) result[i] = read[i];
        return result;
    }
    std::size_t word(const char* attribute, const std::vector<std::string>& known, std::size_t otherwise);

    void ignore(std::initializer_list<const char*> attributes, const char* reason);  // notes those that are there
    void pass(std::initializer_list<const char*> attributes);                        // without a word
    void note(const char* attribute, const std::string& reason);
    [[noreturn]] void refuse(const std::string& reason) const;
    [[noreturn]] void refuse(const char* attribute, const std::string& reason) const;
    // Notes all attributes that nobody has read.
    void finish();

private:
    struct Given {
        const host::XmlAttribute* attribute;
        bool read;
    };
    const host::XmlAttribute* find(const char* attribute);

    const host::XmlElement* tree_;
    Notes* notes_;
    std::vector<Given> given_;
};

// Numbers separated by spaces; none if the text is anything else.
std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t most);

}  // namespace scree::imports
