// XML files, read with TinyXML-2.
#include "host/files/xml_file.h"

#include <tinyxml2.h>

#include <algorithm>

namespace scree::host {

namespace {

constexpr int most_xml_depth = 100;  // readers are recursive

[[noreturn]] void refuse_xml(const std::string& name, int line, const std::string& reason) {
    throw FileError(name + ":" + std::to_string(std::max(line, 1)) + ": " + reason);
}

std::string xml_reason(const tinyxml2::XMLDocument& document) {
    using namespace tinyxml2;
    switch (document.ErrorID()) {
        case XML_ERROR_EMPTY_DOCUMENT:
            return "is empty";
        case XML_ERROR_MISMATCHED_ELEMENT:
            return "an element is closed by another's end tag, or by none";
        case XML_ERROR_PARSING_ATTRIBUTE:
            return "an attribute is malformed; it is written name=\"value\"";
        case XML_ERROR_PARSING_ELEMENT:
            return "an element is malformed";
        case XML_ERROR_PARSING_COMMENT:
            return "a comment is not closed by -->";
        case XML_ERROR_PARSING_TEXT:
            return "text is not followed by a tag";
        case XML_ERROR_PARSING_CDATA:
            return "CDATA is not closed by ]]>";
        case XML_ELEMENT_DEPTH_EXCEEDED:
            return "elements are nested too deeply";
        default:
            return std::string("is not XML (") + XMLDocument::ErrorIDToName(document.ErrorID()) + ")";
    }
}

XmlElement xml_tree(const tinyxml2::XMLElement& from, const std::shared_ptr<const std::string>& file, int depth) {
    const std::string& name = *file;
    if (depth > most_xml_depth) refuse_xml(name, from.GetLineNum(), "elements are nested deeper than 100");
    XmlElement element{from.Name(), file, from.GetLineNum(), {}, {}};
    for (const tinyxml2::XMLAttribute* one = from.FirstAttribute(); one; one = one->Next()) {
        for (const XmlAttribute& before : element.attributes)
            if (before.name == one->Name())
                refuse_xml(name, one->GetLineNum(),
                           "the attribute \"" + before.name + "\" of <" + element.name + "> appears twice");
        // Each is compared with all before: an element of a thousand attributes is no model.
        if (element.attributes.size() == 1000) refuse_xml(name, one->GetLineNum(), "more than 1000 attributes");
        element.attributes.push_back({one->Name(), one->Value(), one->GetLineNum()});
    }
    for (const tinyxml2::XMLElement* child = from.FirstChildElement(); child; child = child->NextSiblingElement())
        element.children.push_back(xml_tree(*child, file, depth + 1));
    return element;
}

}  // namespace

XmlElement xml_of(std::string_view bytes, const std::string& name) {
    if (const std::size_t zero = bytes.find('\0'); zero != bytes.npos)
        refuse_xml(name, 1 + static_cast<int>(std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(zero), '\n')),
                   "is not text: it has a byte 0");
    tinyxml2::XMLDocument document;
    if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS)
        refuse_xml(name, document.ErrorLineNum(), xml_reason(document));
    const tinyxml2::XMLElement* root = document.RootElement();
    if (!root) refuse_xml(name, 1, "has no element");
    return xml_tree(*root, std::make_shared<const std::string>(name), 0);
}

}  // namespace scree::host
