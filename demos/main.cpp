// The program scree, from its first static object to its last words.
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "demos/program/commands/commands.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "host/files/partial_file.h"

namespace {

// Opens /dev/null on closed standard streams; else the next opened file would get the stream's descriptor and its
// output.
void occupy_closed_streams() {
    for (int stream = 0; stream < 3; ++stream) {
        if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", O_RDONLY);
    }
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

}  // namespace

int main(int argc, char** argv) {
    occupy_closed_streams();
    scree::demos::listen_for_interrupt();
    try {
        return scree::demos::run_command_line(argc, argv);
    } catch (const std::bad_alloc&) {  // also from the command line, and from telling of another error
        return tell_no_memory();
    }
}
