// The layout of --help: descriptions in a column of their own, wrapped at 100 characters.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace scree::demos {

class HelpFormatter : public CLI::Formatter {
public:
    std::string make_option(const CLI::Option* option, bool is_positional) const override;
    std::string make_subcommand(const CLI::App* command) const override;
    // The type, and the range or values of a checked option.
    std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace scree::demos
