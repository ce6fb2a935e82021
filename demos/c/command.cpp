// The C interface: the commands of the program.
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "demos/c/call.h"
#include "demos/program/commands/commands.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"

int scree_command(int argc, const char* const* argv) {
    using namespace scree;
    int status = demos::wrong_usage;
    const scree_result result = c::called([&] {
        if (argc < 1) c::refuse("argc: must be at least 1, the name of the program");
        c::given_array(argv, static_cast<std::size_t>(argc), "argv");
        std::vector<std::string> words;
        for (int i = 0; i < argc; ++i) words.emplace_back(&c::given(argv[i], "argv"));
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        demos::listen_for_interrupt();
        status = demos::run_command_line(argc, pointers.data());
    });
    if (result != SCREE_OK) std::fprintf(stderr, "scree: %s\n", scree_error_message());
    return status;
}
