// XML files as trees of elements with their lines.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/files/file.h"

namespace scree::host {

struct XmlAttribute {
    std::string name, value;
    int line = 0;
};
struct XmlElement {
    std::string name;
    std::shared_ptr<const std::string> file;  // as it is shown
    int line = 0;
    std::vector<XmlAttribute> attributes;
    std::vector<XmlElement> children;
};

// The root element. Comments, text and processing instructions are left out. Throws FileError "NAME:LINE: reason" for what is
// not well formed, has an attribute twice, or is nested deeper than 100 elements.
XmlElement xml_of(std::string_view bytes, const std::string& name);

}  // namespace scree::host
