// The layout of --help.
#include "demos/program/options/help_formatter.h"

#include <sstream>

namespace scree::demos {

namespace {

constexpr std::size_t help_width = 100, column = 28;

// `name` and `text` side by side; a long name is on a line of its own.
std::string entry(const std::string& name, const std::string& text) {
    std::string result = "  " + name, line;
    if (result.size() + 2 > column) {
        result += "\n";
    } else {
        line = result;
        result.clear();
    }
    line.resize(column, ' ');
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const bool first = line.size() == column;
        if (!first && line.size() + 1 + word.size() > help_width) {
            result += line + "\n";
            line = std::string(column, ' ') + word;
        } else {
            line += (first ? "" : " ") + word;
        }
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line.empty() ? result : result + line + "\n";
}

}  // namespace

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
    if (is_positional) return entry(make_option_name(option, true) + make_option_opts(option), make_option_desc(option));
    std::string name = make_option_name(option, false);
    if (const std::size_t flag = name.find('{'); flag != name.npos) name.erase(flag);  // "--no-sleep{false}"
    return entry(name + make_option_opts(option), make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
    return entry(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    std::string type = option->get_type_name();
    if (const std::size_t range = type.find('['), colon = type.find(':'); colon != type.npos)
        type = type.substr(0, colon) + (range == type.npos ? "" : " " + type.substr(range, type.find(']') + 1 - range));
    return type.empty() || option->get_expected_max() == 0 ? "" : " " + type;
}

}  // namespace scree::demos
