// Documents about the program: printed tables are current, keys of reports are explained, commands and options exist.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "demos/program/commands/commands.h"
#include "demos/program/outputs/report.h"
#include "demos/suite/selection.h"
#include "demos/suite/suite.h"
#include "demos/validate/experiment.h"
#include "tests/house/pages.h"

namespace {

using namespace scree;

struct Program {
    CLI::App app{"scree"};
    int status = 0;
    Program() {
        app.add_flag("--version");
        for (auto add :
             {demos::add_list, demos::add_devices, demos::add_run, demos::add_sweep, demos::add_view, demos::add_serve,
              demos::add_compare, demos::add_check, demos::add_validate, demos::add_bench, demos::add_export, demos::add_info})
            add(app, status);
    }
    const CLI::App* command(const std::string& name) {
        for (const CLI::App* each : app.get_subcommands(nullptr))
            if (each->get_name() == name) return each;
        return nullptr;
    }
    bool knows_anywhere(const std::string& option) {
        const auto commands = app.get_subcommands(nullptr);
        return app.get_option_no_throw(option) || std::any_of(commands.begin(), commands.end(), [&](const CLI::App* each) {
                   return each->get_option_no_throw(option) != nullptr;
               });
    }
};

// What is wrong with a command line: "" if it is of another program, or scree knows its command and options.
std::string fault_of(Program& program, const std::string& line) {
    static const std::regex option("--?[a-z][a-z-]*|--?[a-z]");
    std::istringstream words(line);
    std::vector<std::string> all;
    for (std::string word; words >> word && word[0] != '#' && word != "|";) all.push_back(word);
    if (all.size() > 2 && all[0] == "mpirun" && all[1] == "-n") all.erase(all.begin(), all.begin() + 3);
    if (all.empty()) return "";
    std::size_t from = 1;
    const CLI::App* command = &program.app;
    if (all[0] == "demos/run" && std::count(all.begin(), all.end(), "--") == 1) {  // what follows are options of scree run
        command = program.command("run");
        from = static_cast<std::size_t>(std::find(all.begin(), all.end(), "--") - all.begin()) + 1;
    } else if (all[0].find('/') != std::string::npos && all[0].find('=') == std::string::npos) {
        return std::filesystem::exists(house::root() / all[0]) ? "" : all[0] + ": no such file";
    } else if (all[0] != "scree" || all.size() < 2 || std::isupper(static_cast<unsigned char>(all[1][0])) != 0) {
        return "";
    } else if (all[1][0] != '-') {
        command = program.command(all[1]);
        if (!command) return all[1] + ": no such command";
        from = 2;
    }
    for (std::size_t i = from; i < all.size(); ++i) {
        std::string word = all[i].substr(0, all[i].find_first_of("=,;"));
        if (!std::regex_match(word, option)) continue;
        if (!command->get_option_no_throw(word)) return word + ": no option of " + command->get_name();
    }
    return "";
}

}  // namespace

TEST_CASE("the table of promises in the book is what the program prints", "[demos]") {
    const std::string table = demos::promises_as_markdown(demos::select_demos({}));
    REQUIRE(table.find("| stack |") != std::string::npos);
    INFO(
        "write the output of `scree check --list --markdown` into demos/docs/evidence/promises.md, behind the line <!-- promises "
        "-->");
    const std::string mark = "<!-- promises -->\n", text = house::text_of("demos/docs/evidence/promises.md");
    REQUIRE(text.find(mark) != std::string::npos);
    REQUIRE(text.substr(text.find(mark) + mark.size()) == "\n" + table);
}

TEST_CASE("the table of experiments in the book is what the program prints", "[demos]") {
    const std::string table = demos::experiments_as_markdown(demos::all_experiments());
    REQUIRE(table.find("| pendulum |") != std::string::npos);
    INFO(
        "write the output of `scree validate --list --markdown` into demos/docs/evidence/experiments.md, behind <!-- experiments "
        "-->");
    REQUIRE(house::text_of("demos/docs/evidence/experiments.md")
                .find("<!-- experiments -->\n\n" + table + "\n<!-- end of experiments -->\n") != std::string::npos);
}

TEST_CASE("the book says what every key of a report means", "[demos]") {
    const std::string text = house::text_of("demos/docs/guide/reports.md");
    const nlohmann::json report = nlohmann::json::parse(demos::json_of({}));
    for (const auto& [key, value] : report.items()) {
        INFO(key);
        CHECK(text.find("`" + key + "`") != std::string::npos);
    }
}

TEST_CASE("the program knows every command and option that a page names", "[demos]") {
    Program program;
    CHECK(fault_of(program, "scree walk pile") == "walk: no such command");
    CHECK(fault_of(program, "mpirun -n 2 scree run pile --steps 3 --stepz 4 # --x") == "--stepz: no option of run");
    CHECK(fault_of(program, "demos/run pile -- --stepz 4") == "--stepz: no option of run");
    CHECK(fault_of(program, "demos/walk pile") == "demos/walk: no such file");
    CHECK(fault_of(program, "scree run pile --raw - | ffmpeg --stepz") == "");
    // Of cmake, pip, mpirun and scripts of the tree.
    const std::set<std::string> of_others = {"--bind-to",    "--bins",    "--box3d",   "--build", "--fresh",
                                             "--from-start", "--install", "--quality", "--keep"};
    static const std::regex option("--[a-z][a-z-]*");
    std::size_t lines = 0, options = 0;
    for (const house::Page& page : house::pages()) {
        INFO(page.path);
        const auto check = [&](const std::string& line) {
            ++lines;
            INFO(line);
            CHECK(fault_of(program, line) == "");
        };
        for (const house::Block& block : page.blocks) {
            std::istringstream text(block.text);
            for (std::string line; block.language == "sh" && std::getline(text, line);) check(line);
        }
        for (const std::string& span : page.spans) {
            if (span.rfind("scree ", 0) == 0 || span.rfind("mpirun ", 0) == 0) check(span);
            const std::string word = span.substr(0, span.find_first_of(" =|"));
            if (!std::regex_match(word, option) || of_others.count(word) > 0) continue;
            ++options;
            INFO(span);
            CHECK(program.knows_anywhere(word));
        }
    }
    CHECK(lines > 80);
    CHECK(options > 30);
}
