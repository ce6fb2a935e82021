// The command line: parses it, runs a command, and maps errors to a message and an exit status.
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "compute/scene/meshes/decomposed.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/options/help_formatter.h"
#include "demos/program/options/option_parsing.h"
#include "host/device_error.h"

namespace scree::demos {

namespace {

constexpr const char* examples = R"(Examples:
  scree list                                            the demos
  scree run avalanche --frames out --video out.mp4      frames and a video, without a display
  scree sweep wall --set seed=1..20 -o walls.csv        many runs into one table
  scree view wall                                       a window: grab and throw bodies
  scree serve wall                                      the same in a browser, live
  scree run pile --bodies 10k --steps 300 --report -    a report as JSON
  scree export wall -o wall.json                        a scene as a file, to edit
  scree run wall.json --seconds 5                       and to run
  scree info robot.urdf                                 degrees of freedom, joints, drives
  scree compare mix --steps 60                          CPU against GPU, bit by bit
  scree check                                           the stability suite
  scree validate --page validation.html                 experiments against theory, with plots

Exit status: 0 done, 1 failed or missed a promise, 2 wrong usage or input, 130 interrupted.)";

int tell(const std::string& message, int status = wrong_usage) {
    say("scree: {}\n", printable(message));
    return status;
}

std::string hint_of(const std::string& near) {
    return near.empty() ? "" : ", nearest: \"" + near + "\"";
}

// The first option among words that a command does not know; "" if there is none.
std::string unknown_option(const std::vector<std::string>& words) {
    const auto found = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-') && word != "-"; });
    return found == words.end() ? "" : found->substr(0, found->find('='));
}

std::string nearest_option(const CLI::App& command, const std::string& option) {
    std::vector<std::string> known;
    for (const CLI::Option* one : command.get_options())
        known.insert(known.end(), one->get_lnames().begin(), one->get_lnames().end());
    const std::string near = nearest(option.substr(std::min(option.find_first_not_of('-'), option.size())), known);
    return near.empty() ? "" : "--" + near;
}

std::string cause_of(const CLI::App& program, const CLI::ParseError& error) {
    if (!program.get_subcommands().empty()) {
        const CLI::App& command = *program.get_subcommands().front();
        const std::string option = unknown_option(command.remaining());
        if (option.empty() || dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return error.what();
        return fmt::format("{}: unknown option \"{}\"{}", command.get_name(), option, hint_of(nearest_option(command, option)));
    }
    if (program.remaining_size() == 0) return error.what();
    const std::string word = program.remaining().front();
    if (word.starts_with('-')) return fmt::format("unknown option \"{}\"{}", word, hint_of(nearest_option(program, word)));
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands(nullptr)) names.push_back(command->get_name());
    return fmt::format("unknown command \"{}\"{}; the commands are {}", word, hint_of(nearest(word, names)),
                       fmt::join(names, ", "));
}

}  // namespace

int run_command_line(int argc, char** argv) {
    int status = done;
    CLI::App program("scree simulates very large scenes of rigid bodies, with the same bits on every GPU and on the CPU.",
                     "scree");
    program.set_version_flag("--version", "scree " SCREE_VERSION);
    program.formatter(std::make_shared<HelpFormatter>());
    program.require_subcommand(1);
    program.footer(examples);
    add_list(program, status);
    add_devices(program, status);
    add_run(program, status);
    add_sweep(program, status);
    add_view(program, status);
    add_serve(program, status);
    add_compare(program, status);
    add_check(program, status);
    add_validate(program, status);
    add_bench(program, status);
    add_export(program, status);
    add_info(program, status);
    try {
        program.parse(argc, argv);
        if (std::fflush(stdout) != 0) return tell("the output cannot be written", promise_missed);
    } catch (const CLI::Success& help) {
        const int shown = program.exit(help);
        std::cout.flush();
        if (!std::cout || std::fflush(stdout) != 0) return tell("the output cannot be written", promise_missed);
        return shown;
    } catch (const CLI::ParseError& error) {
        return tell(cause_of(program, error) + "\nscree --help and scree COMMAND --help say more");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const DecompositionStopped&) {
        return tell("interrupted", interrupted);
    } catch (const WorkFailed& error) {
        return tell(error.what(), promise_missed);
    } catch (const host::DeviceLost& error) {
        return tell(error.what(), promise_missed);
    } catch (const std::system_error& error) {
        return tell(error.what(), promise_missed);  // such as a full stream or a thread that cannot start
    } catch (const std::exception& error) {
        return tell(error.what());
    }
    return status;
}

}  // namespace scree::demos
