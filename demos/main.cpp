// The program scree, from its first static object to its last words.
#include <cstdlib>
#include <exception>
#include <new>

#include "demos/program/commands/commands.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "host/files/partial_file.h"
#include "host/system/interrupts.h"
#include "host/system/machine.h"

namespace {

// Without memory: a message may not need any.
int tell_no_memory() {
    scree::host::tell_in_signal("scree: beyond memory: the scene does not fit; ask for fewer --bodies\n");
    return scree::demos::wrong_usage;
}

// Where an exception cannot leave, such as in the parser of the command line.
[[noreturn]] void end_at_once() {
    try {
        if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        scree::host::remove_unfinished();
        std::_Exit(tell_no_memory());
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

}  // namespace

int main(int argc, char** argv) {
    scree::host::prepare_streams();
    scree::demos::listen_for_interrupt();
    try {
        return scree::demos::run_command_line(argc, scree::host::utf8_arguments(argv));
    } catch (const std::bad_alloc&) {  // also from the command line, and from telling of another error
        return tell_no_memory();
    }
}
