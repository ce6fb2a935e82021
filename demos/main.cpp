// The program scree: parses the command line, runs a command, and maps errors to a message and an exit status.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>
#include <system_error>

#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/options/help_formatter.h"
#include "host/device_error.h"
#include "host/files/partial_file.h"

namespace {

constexpr const char* examples = R"(Examples:
  scree list                                            the demos
  scree run avalanche --frames out --video out.mp4      frames and a video, without a display
  scree sweep wall --set seed=1..20 -o walls.csv        many runs into one table
  scree view wall                                       a window: grab and throw bodies
  scree run pile --bodies 10k --steps 300 --report -    a report as JSON
  scree export wall -o wall.json                        a scene as a file, to edit
  scree run wall.json --seconds 5                       and to run
  scree compare mix --steps 60                          CPU against GPU, bit by bit
  scree check                                           the stability suite
  scree validate --page validation.html                 experiments against theory, with plots

Exit status: 0 done, 1 failed or missed a promise, 2 wrong usage or input, 130 interrupted.)";

int tell(const std::string& message, int status = scree::demos::wrong_usage) {
    scree::demos::say("scree: {}\n", scree::demos::printable(message));
    return status;
}

// Opens /dev/null on closed standard streams; else the next opened file would get the stream's descriptor and its
// output.
void occupy_closed_streams() {
    for (int stream = 0; stream < 3; ++stream) {
        if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", O_RDONLY);
    }
}

std::string cause_of(const CLI::App& program, const CLI::ParseError& error) {
    if (!program.get_subcommands().empty() || program.remaining_size() == 0) return error.what();
    const std::string word = program.remaining().front();
    std::string known;
    for (const CLI::App* command : program.get_subcommands(nullptr)) known += (known.empty() ? "" : ", ") + command->get_name();
    return fmt::format("unknown {} \"{}\"; the commands are {}", word.starts_with('-') ? "option" : "command", word, known);
}

// Without memory: a message may not need any.
int tell_no_memory() {
    constexpr std::string_view message = "scree: beyond memory: the scene does not fit; ask for fewer --bodies\n";
    (void)!::write(STDERR_FILENO, message.data(), message.size());
    return scree::demos::wrong_usage;
}

// Where an exception cannot leave, such as in the parser of the command line.
[[noreturn]] void end_at_once() {
    try {
        if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        scree::host::remove_unfinished();
        ::_exit(tell_no_memory());
    } catch (...) {
        std::abort();
    }
    std::abort();
}

// From the first static object on: those of libraries allocate before main.
struct EndAtOnce {
    EndAtOnce() { std::set_terminate(end_at_once); }
};
const EndAtOnce from_the_start __attribute__((init_priority(101)));

int run(int argc, char** argv) {
    namespace demos = scree::demos;
    int status = demos::done;
    CLI::App program("scree simulates very large scenes of rigid bodies, with the same bits on every GPU and on the CPU.",
                     "scree");
    program.set_version_flag("--version", "scree " SCREE_VERSION);
    program.formatter(std::make_shared<demos::HelpFormatter>());
    program.require_subcommand(1);
    program.footer(examples);
    demos::add_list(program, status);
    demos::add_devices(program, status);
    demos::add_run(program, status);
    demos::add_sweep(program, status);
    demos::add_view(program, status);
    demos::add_compare(program, status);
    demos::add_check(program, status);
    demos::add_validate(program, status);
    demos::add_bench(program, status);
    demos::add_export(program, status);
    try {
        program.parse(argc, argv);
        if (std::fflush(stdout) != 0) return tell("the output cannot be written", demos::promise_missed);
    } catch (const CLI::Success& help) {
        const int shown = program.exit(help);
        std::cout.flush();
        if (!std::cout || std::fflush(stdout) != 0) return tell("the output cannot be written", demos::promise_missed);
        return shown;
    } catch (const CLI::ParseError& error) {
        return tell(cause_of(program, error) + "\nscree --help and scree COMMAND --help say more");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const demos::WorkFailed& error) {
        return tell(error.what(), demos::promise_missed);
    } catch (const scree::host::DeviceLost& error) {
        return tell(error.what(), demos::promise_missed);
    } catch (const std::system_error& error) {
        return tell(error.what(), demos::promise_missed);  // such as a full stream or a thread that cannot start
    } catch (const std::exception& error) {
        return tell(error.what());
    }
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    occupy_closed_streams();
    scree::demos::listen_for_interrupt();
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {  // also from the command line, and from telling of another error
        return tell_no_memory();
    }
}
