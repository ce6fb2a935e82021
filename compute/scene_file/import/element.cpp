// Reading attributes of XML elements.
#include "compute/scene_file/import/element.h"

#include <charconv>
#include <cmath>

namespace scree::imports {

namespace {

constexpr const char* xml_blank = " \t\r\n";

std::string shortened(const std::string& text) {
    return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

std::string choices(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all;
}

}  // namespace

std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t most) {
    std::vector<double> numbers;
    for (;;) {
        const std::size_t begin = text.find_first_not_of(xml_blank);
        if (begin == text.npos) return numbers;
        text.remove_prefix(begin);
        if (numbers.size() == most) return std::nullopt;
        if (text.front() == '+') text.remove_prefix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || !(std::abs(value) <= 1e30)) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (!text.empty() && text.find_first_of(xml_blank) != 0) return std::nullopt;
        numbers.push_back(value);
    }
}

Element::Element(const host::XmlElement& element, Notes& notes, const Defaults* inherited) : tree_(&element), notes_(&notes) {
    for (const host::XmlAttribute& one : element.attributes) given_.push_back({&one, false});
    if (!inherited) return;
    const std::size_t own = given_.size();
    for (const auto& [name, attribute] : *inherited) {
        bool said = false;
        for (std::size_t i = 0; i < own; ++i) said = said || given_[i].attribute->name == name;
        if (!said) given_.push_back({&attribute, false});
    }
}

Origin Element::origin() const {
    std::string name;
    for (const host::XmlAttribute& one : tree_->attributes)
        if (one.name == "name") name = " \"" + shortened(one.value) + "\"";
    return {*tree_->file, tree_->line, shortened(tree_->name) + name};
}

const host::XmlAttribute* Element::find(const char* attribute) {
    for (Given& one : given_) {
        if (one.attribute->name != attribute) continue;
        one.read = true;
        return one.attribute;
    }
    return nullptr;
}

bool Element::has(const char* attribute) const {
    for (const Given& one : given_)
        if (one.attribute->name == attribute) return true;
    return false;
}

std::string Element::text(const char* attribute, const std::string& otherwise) {
    const host::XmlAttribute* found = find(attribute);
    return found ? found->value : otherwise;
}

double Element::number(const char* attribute, double otherwise) {
    const std::vector<double> read = numbers(attribute, 1, 1);
    return read.empty() ? otherwise : read[0];
}

long Element::whole(const char* attribute, long otherwise) {
    const double value = number(attribute, static_cast<double>(otherwise));
    if (value != std::floor(value) || std::abs(value) > 9e15) refuse(attribute, "must be a whole number");
    return static_cast<long>(value);
}

bool Element::flag(const char* attribute, bool otherwise) {
    const host::XmlAttribute* found = find(attribute);
    if (!found) return otherwise;
    if (found->value == "true" || found->value == "1") return true;
    if (found->value == "false" || found->value == "0") return false;
    refuse(attribute, "must be true or false, is \"" + shortened(found->value) + "\"");
}

std::vector<double> Element::numbers(const char* attribute, std::size_t least, std::size_t most) {
    const host::XmlAttribute* found = find(attribute);
    if (!found) return {};
    const auto read = numbers_in(found->value, most);
    if (!read || read->size() < least) {
        const std::string count = most == 1       ? "a number"
                                  : least == most ? std::to_string(most) + " numbers"
                                                  : std::to_string(least) + " to " + std::to_string(most) + " numbers";
        refuse(attribute, "must be " + count + " within 1e30, is \"" + shortened(found->value) + "\"");
    }
    return *read;
}

std::size_t Element::word(const char* attribute, const std::vector<std::string>& known, std::size_t otherwise) {
    const host::XmlAttribute* found = find(attribute);
    if (!found) return otherwise;
    for (std::size_t i = 0; i < known.size(); ++i)
        if (found->value == known[i]) return i;
    refuse(attribute, "is \"" + shortened(found->value) + "\"; known: " + choices(known));
}

void Element::ignore(std::initializer_list<const char*> attributes, const char* reason) {
    for (const char* one : attributes)
        if (find(one)) note(one, reason);
}

void Element::pass(std::initializer_list<const char*> attributes) {
    for (const char* one : attributes) find(one);
}

void Element::note(const char* attribute, const std::string& reason) {
    notes_->add(origin(), attribute, reason);
}

void Element::refuse(const std::string& reason) const {
    imports::refuse(origin(), reason);
}

void Element::refuse(const char* attribute, const std::string& reason) const {
    Origin at = origin();
    for (const Given& one : given_)  // an attribute may stand lines below its element, or in a default
        if (one.attribute->name == attribute) at.line = one.attribute->line;
    imports::refuse(at, std::string("\"") + attribute + "\" " + reason);
}

void Element::finish() {
    for (const Given& one : given_) {
        if (one.read || one.attribute->name == "name") continue;
        Origin at = origin();
        at.line = one.attribute->line;
        notes_->add(at, shortened(one.attribute->name), "is unknown here and left out");
    }
}

}  // namespace scree::imports
